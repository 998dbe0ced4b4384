// Draws the results of a sweep, which varies keys of a case, from its CSV file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/results/picture_kind.hpp"

namespace viscontact::report {

/// What to draw. The text "COLUMN" means a column of the file, and "COLUMN/KEY" this column divided
/// by a varied key, row by row.
struct SweepPlot {
  std::string x;                     ///< varied key on the horizontal axis
  std::string y;                     ///< key on the vertical axis of a map; empty: lines over x
  std::vector<std::string> columns;  ///< at least one; a map shows the first only
  /// The other varied keys that have several values. Lines are drawn for each combination of these
  /// values. A map ignores them.
  std::vector<std::string> others{};
  /// Whether the file has the columns COLUMN.mean and COLUMN.standard_error in place of COLUMN.
  /// Lines then have bars of one standard error to both sides.
  bool is_of_means = false;
};

/// The content of the picture file: lines, or a map with colours over the grid of two keys. Axes
/// and colours are logarithmic if all values are > 0 and span a decade or more. Throws
/// Error(kBadInput) if a column does not exist or the file cannot be read (the message lists the
/// columns that were found), if no number can be drawn, or if a map has fewer than two values along
/// an axis; Error(kExternalProgram) if gnuplot is missing or fails; and Error(kInterrupted) if
/// `stop` requests a stop. A field that is empty or not a number is not drawn.
std::string plot_sweep(const std::filesystem::path& sweep_file, const SweepPlot& plot,
                       const results::PictureFormat& format, const StopToken& stop = {});

}  // namespace viscontact::report
