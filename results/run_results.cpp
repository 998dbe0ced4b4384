// Reads the folder of a run (run_folder.hpp).
#include "viscontact/results/run_results.hpp"

#include <utility>

#include "viscontact/common/equal_up_to_rounding.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::results {
namespace {

/// The table in the folder belongs to the run if the fit was made from it, or if the case asks for
/// a fit of a table. (In the second case the report warns if the fit was made from another table.)
/// A case with `exact` or `file` in [fit] needs no table; then table.csv may be the table of an
/// earlier case or any file of the user.
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
