// A plot of the report as data. Both the still picture (gnuplot) and the plot that can be zoomed
// (report/page/panels.js) are made from it, so both must understand every member.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/common/stop_token.hpp"

namespace viscontact::report {

enum class PointKind { kNone, kCircle, kDisc, kSquare, kCross };

/// How a curve is drawn.
struct CurveStyle {
  std::string colour{};        ///< "#rrggbb"
  double width = 2;            ///< width of the line [pixels]; 0: points only
  std::vector<double> dash{};  ///< lengths of dashes and spaces in turn [pixels]; empty: solid
  PointKind point = PointKind::kNone;
  double point_size = 1;  ///< in units of about 7 pixels
};

/// A curve of points (x, y).
struct PlotCurve {
  /// Words in the legend. A curve without words belongs to the entry of the curve before it.
  std::string legend{};
  CurveStyle style{};
  /// The values of x must not decrease; a non-finite y interrupts the line.
  std::vector<std::pair<double, double>> points{};
};

struct PlotAxis {
  std::string label{};
  bool logarithmic = false;
  std::optional<double> low{}, high{};  ///< range before zooming; nothing: as the curves need
};

/// Where the legend of the still picture is.
enum class KeyPlace { kBelow, kTopRight, kBottomRight };

/// Curves on common axes.
struct PlotPanel {
  std::string title{};
  PlotAxis x{}, y{};
  std::vector<PlotCurve> curves{};
  KeyPlace key = KeyPlace::kBelow;
  std::vector<std::string> rows{};  ///< names of y = 1, 2, ... if y numbers rows from the bottom
};

/// Panels one below the other.
struct Plot {
  std::string name{};  ///< name of the file plots/NAME.svg
  int height = 440;    ///< height of the still picture [pixels]
  std::vector<PlotPanel> panels{};
};

/// False if no panel has a curve.
bool shows_something(const Plot& plot);

/// The plot as an SVG element by gnuplot. Throws Error(kExternalProgram) as draw_svg does.
std::string svg_of(const Plot& plot, const StopToken& stop = {});

/// The plot as JSON for report/page/panels.js; the text may stand in a script element.
std::string json_of(const Plot& plot);

}  // namespace viscontact::report
