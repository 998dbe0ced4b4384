#include "app/run_results.hpp"

#include "common/error.hpp"

namespace viscontact {

RunResults read_run(const std::filesystem::path& folder) {
  const RunFolder run{folder};
  RunResults results{run,
                     read_case(run.case_file()),
                     read_fit(run.fit()),
                     read_comparison(run.comparison()),
                     {},
                     {},
                     {}};
  for (const auto& model : results.comparison.models)
    if (const auto file = run.trajectory(model.model); std::filesystem::exists(file))
      results.trajectories.push_back(read_trajectory(file));
  if (results.trajectories.empty())
    throw_bad_input({run.trajectories().string()},
                    "has no trajectory of the models that the comparison names");
  if (std::filesystem::exists(run.table())) results.table = read_force_table(run.table());
  if (std::filesystem::exists(run.uncertainty()))
    results.uncertainty = read_uncertainty(run.uncertainty());
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

}  // namespace viscontact
