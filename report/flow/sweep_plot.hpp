// The picture of a sweep.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace viscontact {

/// What to draw of a sweep's file. A column is one of its own, or "COLUMN/KEY", its quotient with a varied key.
struct SweepPlot {
  std::string x;                     ///< key
  std::string y;                     ///< key: a map of columns[0] over x and y; empty: lines over x
  std::vector<std::string> columns;  ///< at least one
};

/// Draws it (SVG): lines, or a heat map over the grid. Axes and colours are logarithmic where all values are positive and span a decade or more. Throws
/// Error(kBadInput) that lists the columns there are for one that is not, or if there is nothing to draw.
std::string plot_sweep(const std::filesystem::path& sweep_file, const SweepPlot& plot);

}  // namespace viscontact
