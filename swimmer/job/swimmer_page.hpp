// The report of a swimmer: a page with pictures and tables.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/report/page.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/swimmer/case/swimmer_case.hpp"
#include "viscontact/swimmer/optimal_stroke.hpp"
#include "viscontact/swimmer/resistance/resistance_fit.hpp"
#include "viscontact/swimmer/resistance/resistance_table.hpp"
#include "viscontact/swimmer/swim.hpp"

namespace viscontact::swimmer {

struct StrokeResult {
  double period = 0;  ///< [T], > 0
  SwimSums sums;
  SwimErrors errors;
  std::vector<SwimRow> rows;  ///< state at times of one period, in order of time, at least one
};

struct SwimmerResults {
  SwimmerCase c;
  ResistanceTable table;  ///< scaled to the spheres of the case
  ResistanceFit fit;
  std::optional<StrokeResult> stroke;   ///< result of the section [stroke] of the case, if any
  std::optional<StrokeResult> optimal;  ///< result of the section [optimal] of the case, if any
  /// How the search for the stroke of least energy converged, with energies in the period of the
  /// case. It has an element if there is an optimal stroke, else it is empty.
  std::vector<OptimalStrokeStep> convergence;
  /// Derivative of the least energy by the displacement [M L/T^2] in the period of the case; 0
  /// without an optimal stroke.
  double energy_per_displacement = 0;
};

/// The names of all pictures that the report can have. A picture is stored in plots/NAME.svg; only
/// these files are replaced or removed.
inline constexpr auto kSwimmerPictures = std::to_array<std::string_view>(
    {"loops", "position", "power", "arms", "forces", "convergence"});

/// Writes report.html and plots/NAME.svg into `folder`. `provenance` says how the results were
/// made. Without gnuplot the page has no still pictures, and a warning says so. Throws
/// Error(kExternalProgram) if gnuplot fails, Error(kBadInput) if a file cannot be written or a file
/// of the user would be replaced, Error(kWrongUsage) if the environment variable SOURCE_DATE_EPOCH
/// is not a time, and Error(kInterrupted) if `stop` requests a stop.
void write_swimmer_report(const SwimmerResults& results, const std::filesystem::path& folder,
                          const results::Provenance& provenance, const StopToken& stop);

}  // namespace viscontact::swimmer
