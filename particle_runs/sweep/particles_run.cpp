// result.json is written after the run and records the case and the version.
#include "viscontact/particle_runs/sweep/particles_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>
#include <vector>

#include "viscontact/arrangement/arrangement.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/files/locks.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/json.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/common/text/on_one_line.hpp"
#include "viscontact/particle_runs/run/particles_pages.hpp"
#include "viscontact/particle_runs/run/particles_stage.hpp"
#include "viscontact/particles/domain/region.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::particles {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Values = std::map<std::string, double>;

/// The largest number if `json` has several, such as the errors at the first and at the last step;
/// nothing if `json` has no finite number.
std::optional<double> number_of(const Json& json) {
  if (json.is_number() && std::isfinite(json.get<double>())) return json.get<double>();
  std::optional<double> largest;
  if (json.is_structured())
    for (const auto& entry : json)
      if (const auto value = number_of(entry); value && (!largest || *value > *largest))
        largest = value;
  return largest;
}

/// Adds the values in the last row of steps.csv at `path` for those columns that `columns` names.
void add_last_step(const fs::path& path, const std::vector<std::string>& columns, Values& values) {
  std::istringstream text(read_file(path));
  std::vector<std::string> names, last;
  for (std::string line; std::getline(text, line);)
    if (!line.starts_with('#')) (names.empty() ? names : last) = csv_fields(line);
  for (std::size_t i = 0; i < std::min(names.size(), last.size()); ++i)
    if (const auto value = parse_number(last[i]);
        value && std::ranges::find(columns, names[i]) != columns.end())
      values[names[i]] = *value;
}

/// The values by the names of the columns, from steps.csv and run.json in the folder `run`; columns
/// without a finite value are left out. If the case `c` has an arrangement of particles, there is
/// also the fraction of the domain that they cover [1].
Values values_of(const ParticlesCase& c, const std::vector<std::string>& columns,
                 const fs::path& run) {
  Values values;
  add_last_step(run / "steps.csv", columns, values);
  read_json(run / "run.json", [&](const Json& json) {
    for (const auto& column : columns)
      if (json.contains(column))
        if (const auto value = number_of(json[column])) values[column] = *value;
  });
  if (c.arrangement)
    values[fraction_column(c)] = size_of(*c.arrangement, c.particles.dimension) /
                                 measure(c.setting.domain, positions_of(c.setting.planes, 0));
  std::erase_if(values, [](const auto& value) { return !std::isfinite(value.second); });
  return values;
}

std::string without(std::string text, const std::string& part) {
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at))
    text.erase(at, part.size());
  return text;
}

/// Removes the files that Viscontact wrote into the folder of a run, except run.json and steps.csv,
/// and likewise those of a run beside it.
void remove_the_rest(const fs::path& run) {
  if (const auto beside = compared_folder(run); fs::is_directory(beside)) remove_the_rest(beside);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(run))
    if (entry.is_regular_file() && entry.path().filename() != "run.json" &&
        entry.path().filename() != "steps.csv")
      files.push_back(entry.path());
  for (const auto& file : files)
    if (results::is_written_by_viscontact(file)) remove_file(file);
}

}  // namespace

fs::path runs_folder(const fs::path& output) { return output.string() + ".runs"; }

ParticlesRuns::ParticlesRuns(const ParticlesSweep& sweep, const fs::path& output,
                             std::string version, int threads, bool keep_all,
                             StartFluidSolver start_solver)
    : sweep_(sweep),
      folder_(runs_folder(output)),
      version_(std::move(version)),
      threads_(threads),
      keep_all_(keep_all),
      start_solver_(std::move(start_solver)) {
  assert(threads >= 1);
}

fs::path ParticlesRuns::folder_of(std::uint64_t index) const {
  assert(index < sweep_.points().rows());
  const auto draws = sweep_.points().draws;
  return folder_ /
         (draws > 0 ? fmt::format("{}-{}", index / draws, index % draws) : std::to_string(index));
}

std::optional<sweep::RowResults> ParticlesRuns::ended(std::uint64_t index) const {
  const auto path = folder_of(index) / "result.json";
  if (!fs::is_regular_file(path)) return {};
  try {
    const auto json = Json::parse(read_file(path));
    if (json.at("case_and_version") != sweep_.identity(index, version_)) return {};
    return sweep::RowResults{
        json.at("values").get<Values>(), {}, json.at("failure").get<std::string>()};
  } catch (const Json::exception&) {
    return {};  // the file is damaged, and the row is computed again
  }
}

bool ParticlesRuns::has_succeeded(std::uint64_t index) const {
  const auto results = ended(index);
  return results && results->failure.empty();
}

double ParticlesRuns::seconds(std::uint64_t index) const {
  const auto path = folder_of(index) / "run" / "run.json";
  if (!fs::is_regular_file(path)) return 0;
  try {
    return Json::parse(read_file(path)).value("seconds", 0.0);
  } catch (const Json::exception&) {
    return 0;
  }
}

sweep::RowResults ParticlesRuns::compute(std::uint64_t index, const StopToken& stop) const {
  if (auto results = ended(index); results && results->failure.empty()) return *results;
  stop.throw_if_stop_requested();
  const terminal::QuietThread quiet;
  const auto folder = folder_of(index), run = folder / "run", file = folder / "case.toml";
  const LockedFolder lock(
      folder, "is being computed by another process; wait until it has ended, or write elsewhere");
  if (auto results = ended(index); results && results->failure.empty()) return *results;
  const auto text = sweep_.case_text(index);
  if (!fs::is_regular_file(file) || read_file(file) != text) write_file(file, text);
  sweep::RowResults results;
  const auto read_values = [&] {
    results.values = values_of(read_particles_case(file), sweep_.result_columns(), run);
  };
  try {
    run_particles({.case_file = file.string(),
                   .folder = run.string(),
                   .restart = "",
                   .threads = threads_,
                   .start_solver = start_solver_,
                   .json = false,
                   .stop = stop});
    read_values();
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInterrupted) throw;
    results.failure = without(on_one_line(error.what()), folder.string() + "/");
    if (error.kind() == ErrorKind::kNotConverged && fs::is_regular_file(run / "run.json"))
      read_values();
  }
  const Json json = {{"case_and_version", sweep_.identity(index, version_)},
                     {"values", results.values},
                     {"failure", results.failure}};
  write_file(folder / "result.json",
             json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  if (results.failure.empty() && !keep_all_) remove_the_rest(run);
  return results;
}

}  // namespace viscontact::particles
