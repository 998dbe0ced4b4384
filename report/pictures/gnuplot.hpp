// Curves and colour fields by the program gnuplot. No text of a user reaches it as a command.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/stop_token.hpp"
#include "viscontact/results/picture_kind.hpp"

namespace viscontact::report {

/// gnuplot is not installed or cannot be started.
class GnuplotMissing : public Error {
 public:
  using Error::Error;
};

struct Curve {
  std::string legend;  ///< empty: no entry in the legend
  std::string style;   ///< for gnuplot, such as "lines linewidth 2"
  std::vector<std::pair<double, double>>
      points;  ///< (x, y); a number that is not finite cuts the line
};

/// Values that are shown as colours in equal cells of a rectangle, row by row from the bottom, each
/// row from the left. Cells with non-finite values are transparent. The commands in Panel::settings
/// set the colours (palette, cbrange).
struct ColourField {
  std::size_t columns = 0, rows = 0;  ///< at least 2 each
  /// Sides of the rectangle in the units of the axes; left < right and bottom < top.
  double left = 0, right = 0, bottom = 0, top = 0;
  std::vector<double> values;  ///< columns * rows; gnuplot gets four digits
};

/// Curves, and possibly a colour field, on common axes.
struct Panel {
  std::string title, x_label, y_label;  ///< plain text; may be empty
  bool x_log = false, y_log = false;    ///< a logarithmic axis, without values <= 0
  std::vector<std::string> settings;    ///< further gnuplot commands, passed as they are
  std::vector<Curve> curves;            ///< a curve without points is left out
  std::optional<ColourField> field{};   ///< drawn behind the curves
};

/// Settings of a panel that put the legend below the plot, and the name of the horizontal axis
/// between the numbers of the axis and the legend. gnuplot by itself leaves no room for the name,
/// so that the legend would cover a part of it.
inline constexpr const char* kLegendBelow =
    "set key below Left reverse noopaque height 0.6\nset xlabel offset 0,0.35";

/// Quotes any text, also of several lines, so that gnuplot executes nothing in it as a command.
std::string quoted_for_gnuplot(const std::string& text);

/// Draws the panels one below the other, as an SVG (one element, which may stand in an HTML page),
/// a PDF, a PNG, or as gnuplot's script with the data, which gnuplot turns into an SVG. `width` > 0
/// and `height` > 0 are the size of the picture [pixels of an SVG; for each of them a PDF has a
/// point and a PNG two pixels]. If format.width > 0, it replaces `width`, and the height changes in
/// proportion. Throws GnuplotMissing(kExternalProgram) if gnuplot cannot be run,
/// Error(kExternalProgram) if gnuplot fails (as it does if nothing is to be drawn) or has not ended
/// after ten minutes, Error(kInterrupted) if `stop` requests a stop, and std::system_error if the
/// system has no free socket. A script is made without gnuplot.
std::string draw_picture(const results::PictureFormat& format, const std::vector<Panel>& panels,
                         int width, int height, const StopToken& stop = {});

/// Draws as draw_picture() does with the default format.
std::string draw_svg(const std::vector<Panel>& panels, int width, int height,
                     const StopToken& stop = {});

}  // namespace viscontact::report
