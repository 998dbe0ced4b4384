// The picture of a sweep, which varies keys of a case, from its CSV file, in the units of the case.
// The command `sweep` (app/commands/sweep/) calls it for --plot. A column that does not exist, or a
// file without a number to draw, throws Error(kBadInput). A change must keep that it can draw files
// larger than the memory.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/results/picture_kind.hpp"

namespace viscontact::report {

/// What to draw. A column is "COLUMN" of the file, or "COLUMN/KEY", its quotient by a varied key.
struct SweepPlot {
  std::string x;                     ///< varied key on the horizontal axis
  std::string y;                     ///< key on the vertical axis of a map; empty: lines over x
  std::vector<std::string> columns;  ///< at least one (not checked); a map shows the first only
  /// The other keys with several values in a grid. Lines are drawn for each combination of these
  /// values. Without effect on a map.
  std::vector<std::string> others{};
  /// Whether the file has the columns COLUMN.mean and COLUMN.standard_error in place of COLUMN.
  /// Lines then have bars of one standard error to both sides.
  bool is_of_means = false;
};

/// The content of a picture with lines, or with colours over the grid of two keys. Axes and colours
/// are logarithmic if all values are > 0 and span a decade or more. Throws Error(kBadInput) if a
/// column does not exist or the file cannot be read, in a message that lists the columns, if there
/// is no number to draw, or if a map has fewer than two values along an axis;
/// Error(kExternalProgram) if gnuplot is missing or fails; and Error(kInterrupted) if `stop`
/// requests a stop. A field that is missing or no number is not drawn.
std::string plot_sweep(const std::filesystem::path& sweep_file, const SweepPlot& plot,
                       const results::PictureFormat& format, const StopToken& stop = {});

}  // namespace viscontact::report
