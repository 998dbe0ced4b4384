// Curves drawn by gnuplot as SVG.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"

namespace viscontact {

/// gnuplot is not installed, or cannot be started.
class GnuplotMissing : public Error {
 public:
  using Error::Error;
};

struct Curve {
  std::string legend;                             ///< empty: none
  std::string style;                              ///< gnuplot's, such as "lines linewidth 2"
  std::vector<std::pair<double, double>> points;  ///< a non-finite ordinate interrupts the line
};

/// Values shown as colours (settings: palette, cbrange) in equal cells of a rectangle, row by row from the bottom, each row from the left.
/// Non-finite: transparent.
struct ColourField {
  std::size_t columns = 0, rows = 0;  ///< at least 2
  double left = 0, right = 0, bottom = 0, top = 0;
  std::vector<double> values;
};

struct Panel {
  std::string title, x_label, y_label;
  bool x_log = false, y_log = false;
  std::vector<std::string> settings;  ///< further gnuplot commands
  std::vector<Curve> curves;
  std::optional<ColourField> field{};  ///< below the curves
};

/// Any text as a string of gnuplot's, in which it finds no command; it may have several lines.
std::string quoted_for_gnuplot(const std::string& text);

/// The panels one below the other as one SVG element, to stand in an HTML page. Throws
/// GnuplotMissing(kExternalProgram) if gnuplot cannot be run, Error(kExternalProgram) if it fails or
/// has not ended after ten minutes.
std::string draw_svg(const std::vector<Panel>& panels, int width, int height);

}  // namespace viscontact
