// Reads case, fit, comparison, trajectories, table and uncertainty of a run from the folder of the
// run (run_folder.hpp) for report/. Gaps [L], times [T], velocities [L/T] and forces [M L/T^2] are
// in the units of the case. If case, fit, comparison or all trajectories are missing, or a file is
// damaged, an Error(kBadInput) is thrown, and for a path that the system refuses a
// std::filesystem::filesystem_error. A table or an uncertainty that is missing is no error. That
// the files belong together is not checked here. A change must still read the runs of earlier
// versions.
#include "viscontact/results/run_results.hpp"

#include <utility>

#include "viscontact/common/equal_up_to_rounding.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::results {
namespace {

/// True if the table in the folder belongs to the run: the fit was made from this table, or the
/// case asks for a fit of a table. (In the second case the report warns if the fit was made from
/// another table.) A case with `exact` or `file` in [fit] needs no table; then table.csv may be the
/// table of an earlier case or any file of the user.
bool has_table(const RunFolder& run, const case_file::Case& c, const lubrication::Fit& fit) {
  if (!std::filesystem::is_regular_file(run.table())) return false;
  const bool needs_none =
      lubrication::is_exact_plane(fit) || (c.fit && (c.fit->exact || c.fit->file));
  return !needs_none || content_sha256(read_file(run.table())) == fit.table_sha256;
}

}  // namespace

RunResults read_run(const std::filesystem::path& folder) {
  const RunFolder run{folder};
  RunResults results{run,
                     case_file::read_case(run.case_file()),
                     {},
                     false,
                     reduced_model::read_comparison(run.comparison()),
                     {},
                     {},
                     {}};
  auto fit = lubrication::read_fit(run.fit());
  results.fit_is_scaled = !equal_up_to_rounding(fit.radius, results.c.radius) ||
                          !equal_up_to_rounding(fit.viscosity, results.c.viscosity);
  results.fit = case_file::fit_for(results.c, std::move(fit), run.fit());
  for (const auto& model : results.comparison.models)
    if (const auto file = run.trajectory(model.model); std::filesystem::exists(file))
      results.trajectories.push_back(reduced_model::read_trajectory(file));
  if (results.trajectories.empty())
    throw_bad_input({run.trajectories().string()},
                    "has no trajectory of the models that the comparison names");
  if (!results.fit_is_scaled && has_table(run, results.c, results.fit))
    results.table = lubrication::read_force_table(run.table());
  if (std::filesystem::exists(run.uncertainty()))
    results.uncertainty = reduced_model::read_uncertainty(run.uncertainty());
  return results;
}

std::vector<std::filesystem::path> files_of(const RunResults& results) {
  const auto& run = results.folder;
  std::vector<std::filesystem::path> files = {run.case_file(), run.fit(), run.comparison()};
  for (const auto& trajectory : results.trajectories)
    files.push_back(run.trajectory(trajectory.model));
  if (results.table) files.push_back(run.table());
  if (results.uncertainty) files.push_back(run.uncertainty());
  return files;
}

}  // namespace viscontact::results
