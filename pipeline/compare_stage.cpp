// Finds the trajectory files of a folder, compares them, and writes the comparison.
#include "viscontact/pipeline/compare_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/report/summaries.hpp"
#include "viscontact/results/failed_models.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/results/run_folder.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::pipeline {
namespace {

namespace fs = std::filesystem;

/// Warns if trajectories were made from different cases or fits, because their distances then have
/// two causes: the models and the inputs. Trajectories that do not state them are skipped.
void warn_of_different_inputs(const std::vector<reduced_model::Trajectory>& trajectories) {
  for (const auto* key : {"case", "fit"}) {
    const reduced_model::Trajectory* first = nullptr;
    for (const auto& trajectory : trajectories) {
      if (!trajectory.provenance.contains(key)) continue;
      if (first == nullptr) first = &trajectory;
      if (trajectory.provenance.at(key) == first->provenance.at(key)) continue;
      terminal::warn("viscontact: warning: {} and {} were made from different {}s", first->model,
                     trajectory.model, key);
      break;
    }
  }
}

/// The index in reduced_model::all_models() of the model after which a file is named, or the number
/// of all models.
std::ptrdiff_t rank_of(const fs::path& file) {
  const auto choice = reduced_model::known_model(file.stem().string());
  return choice ? choice->model - reduced_model::all_models().data()
                : std::ssize(reduced_model::all_models());
}

/// Throws Error(kBadInput) if the folder does not exist.
std::vector<fs::path> trajectory_files(const fs::path& folder) {
  const auto inner = results::RunFolder{folder}.trajectories();
  const fs::path place = fs::is_directory(inner) ? inner : folder;
  if (!fs::is_directory(place))
    throw_bad_input({folder.string()}, "is not a folder with trajectories");
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(place))
    if (entry.path().extension() == ".csv" && entry.path().filename() != "table.csv")
      files.push_back(entry.path());
  // Comparisons list models in this order, and the first file becomes the reference if the usual
  // one has failed.
  std::ranges::sort(files, {},
                    [&](const fs::path& file) { return std::pair(rank_of(file), file); });
  return files;
}

}  // namespace

std::vector<fs::path> files_of_models(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".csv" &&
        rank_of(entry.path()) < std::ssize(reduced_model::all_models()))
      files.push_back(entry.path());
  return files;
}

void print_comparison(const reduced_model::Comparison& comparison, bool json) {
  fmt::print("{}", json ? reduced_model::write_comparison(comparison)
                        : report::comparison_table(comparison));
}

void compare_stage(const fs::path& folder, const std::vector<fs::path>& others,
                   const std::string& reference_model, const fs::path& comparison_path,
                   const std::vector<fs::path>& given, bool json, const StopToken& stop) {
  auto files = trajectory_files(folder);
  files.insert(files.end(), others.begin(), others.end());
  if (files.empty()) throw_bad_input({folder.string()}, "has no trajectory files");
  auto inputs = files;
  if (const auto failed = results::RunFolder{folder}.failed_models(); fs::is_regular_file(failed))
    inputs.push_back(failed);
  const auto provenance = results::provenance_of(given.empty() ? results::Inputs{inputs, {}}
                                                               : results::Inputs{given, inputs});
  std::vector<reduced_model::Trajectory> trajectories;
  for (const auto& file : files) {
    stop.throw_if_stop_requested();
    trajectories.push_back(reduced_model::read_trajectory(file));
  }
  warn_of_different_inputs(trajectories);
  const auto failed = results::failures_without(trajectories, results::RunFolder{folder});
  auto comparison = reduced_model::compare_trajectories(
      trajectories, results::reference_among(trajectories, failed, reference_model), stop);
  comparison.failed_models = failed;
  results::write_output(comparison_path, TextKind::kJson,
                        reduced_model::write_comparison(comparison), provenance);
  print_comparison(comparison, json);
}

}  // namespace viscontact::pipeline
