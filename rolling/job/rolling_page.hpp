// The report of a rolling sphere: a page with pictures and tables.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/motions/pair_fit.hpp"
#include "viscontact/report/page.hpp"
#include "viscontact/results/failed_models.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/rolling/case/rolling_case.hpp"

namespace viscontact::rolling {

struct RollingResults {
  RollingCase c;
  motions::PairFit fit;  ///< scaled to radius and viscosity of the case
  /// For each model that did not fail, its name and its trajectory, which has at least one row.
  std::vector<std::pair<std::string, RollingTrajectory>> trajectories;
  std::vector<results::FailedModel> failed;  ///< models without a trajectory
};

/// The largest Stokes number m u/(6 pi mu r^2) of a motion, with the speed u of the centre relative
/// to the plane.
double stokes_of(const RollingCase& c, const RollingEnd& end);
/// The largest Reynolds number 2 r rho_f u/mu; nothing if the case gives no density of the fluid.
std::optional<double> reynolds_of(const RollingCase& c, const RollingEnd& end);

/// A sentence for each model whose Reynolds number is too large for Stokes flow, whose motion ends
/// at the wall opposite, or whose gap gets below the smallest gap of the fit, where no row of a
/// table supports the formula of the fit.
std::vector<std::string> rolling_warnings(const RollingResults& results);

/// The names of all pictures that the report can have. A picture is stored in plots/NAME.svg; only
/// these files are replaced or removed.
inline constexpr auto kRollingPictures =
    std::to_array<std::string_view>({"gap", "velocity", "rotation", "slip", "friction"});

/// Writes report.html and plots/NAME.svg into `folder`. `provenance` says how the results were
/// made. Without gnuplot the page has no still pictures, and a warning says so. Throws
/// Error(kExternalProgram) if gnuplot fails, after the page is written without still pictures;
/// Error(kBadInput) if a file cannot be written or a file of the user would be replaced;
/// Error(kWrongUsage) if the environment variable SOURCE_DATE_EPOCH is not a time; and
/// Error(kInterrupted) if `stop` requests a stop.
void write_rolling_report(const RollingResults& results, const std::filesystem::path& folder,
                          const results::Provenance& provenance, const StopToken& stop);

}  // namespace viscontact::rolling
