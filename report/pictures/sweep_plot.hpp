// The picture of a sweep, from its CSV file. Values are in the units of the case. `sweep --plot`
// makes it. A change must keep that files larger than the memory can be drawn.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/results/picture_kind.hpp"

namespace viscontact::report {

/// What to draw. A column is a column of the file, or "COLUMN/KEY" for its quotient by a key that
/// the sweep varies.
struct SweepPlot {
  std::string x;                     ///< key of the horizontal axis
  std::string y;                     ///< key for a map of columns[0]; empty: lines over x
  std::vector<std::string> columns;  ///< at least one
  /// The other keys of a grid that have several values. Lines over x are drawn for each combination
  /// of these values. Without effect on a map.
  std::vector<std::string> others{};
  /// Whether the file has the columns COLUMN.mean and COLUMN.standard_error in place of COLUMN.
  /// Lines then have bars of one standard error on both sides.
  bool is_of_means = false;
};

/// A picture with lines, or with a heat map over the grid of two
/// keys. Axes and colours are logarithmic if all values are positive and span a decade or more.
/// Throws Error(kBadInput) that lists the columns of the file if a column does not exist,
/// Error(kBadInput) if there is nothing to draw, and Error(kExternalProgram) if gnuplot is missing
/// or fails.
std::string plot_sweep(const std::filesystem::path& sweep_file, const SweepPlot& plot,
                       const results::PictureFormat& format, const StopToken& stop = {});

}  // namespace viscontact::report
