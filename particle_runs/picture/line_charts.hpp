// Curves over linear axes as SVG, for pages and pictures that need no other program.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace viscontact::particles {

struct ChartCurve {
  std::string legend{};  ///< plain text
  std::string colour{};  ///< "#rrggbb"
  bool is_dashed = false;
  /// In the order of x. A number that is not finite interrupts the line. Of many points only some
  /// are drawn.
  std::vector<std::pair<double, double>> points{};
};

struct LineChart {
  std::string title{}, x_label{}, y_label{};  ///< plain text
  std::vector<ChartCurve> curves{};           ///< in the order of the legend
  /// The upper end of the vertical axis; nothing: the largest y. Lines above it are cut off. The
  /// lower end is 0, or the smallest y if that is below 0.
  std::optional<double> top{};
};

/// The charts beside each other as one SVG, complete in itself. A chart without a finite point has
/// axes from 0 to 1.
std::string line_charts(std::span<const LineChart> charts);

}  // namespace viscontact::particles
