// Points, cases and rows of a sweep of particles (particles_sweep.hpp). Everything that determines
// the results of a row must go into identity(), so that results of another row are not kept.
#include "viscontact/sweep/particles/particles_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string_view>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact::sweep {
namespace {

constexpr const char* kSeed = "arrangement.seed";

/// Throws Error(kWrongUsage) for keys that a sweep cannot vary.
void check_keys(const ParticlesSweepPlan& plan) {
  std::set<std::string> seen;
  for (const auto& variation : plan.variations) {
    const auto& key = variation.key;
    if (!seen.insert(key).second)
      throw Error(ErrorKind::kWrongUsage, fmt::format("the key {} is given twice", key));
    if (key == kSeed && plan.draws > 0)
      throw Error(ErrorKind::kWrongUsage,
                  fmt::format("{} cannot be varied beside draws, which vary it", key));
    const auto section = key.substr(0, key.find('.'));
    if (section == "sweep" || section == "output")
      throw Error(ErrorKind::kWrongUsage,
                  fmt::format("{} cannot be varied, because it changes no result of a run", key));
  }
}

/// Names of the columns with results of a case (docs/file-formats.md).
std::vector<std::string> columns_of(const case_file::ParticlesCase& c) {
  std::vector<std::string> columns = {"particles"};
  if (c.arrangement) columns.emplace_back("area_fraction");
  for (const auto* column :
       {"to_time", "steps", "unconverged_steps", "iterations", "largest_residual",
        "largest_impulse_residual", "largest_gamma_error", "divided_steps", "unresolved_contacts",
        "largest_overlap", "final_overlap", "contacts", "glued"})
    columns.emplace_back(column);
  if (c.setting.fluid)
    for (const auto* column : {"apparent_viscosity", "mean_apparent_viscosity", "dissipation",
                               "mean_dissipation", "velocity_error_estimate"})
      columns.emplace_back(column);
  return columns;
}

}  // namespace

ParticlesSweepPlan planned_particles(const std::filesystem::path& case_path) {
  const auto c = case_file::read_particles_case(case_path);
  const auto request = c.sweep.value_or(case_file::ParticlesSweepRequest{});
  ParticlesSweepPlan plan;
  plan.case_path = case_path;
  for (const auto& text : request.vary) {
    try {
      plan.variations.push_back(parse_variation(text));
    } catch (const Error& error) {
      throw_bad_input({case_path.string()}, fmt::format("sweep.vary: {}", error.what()));
    }
  }
  plan.samples = request.samples;
  plan.draws = request.draws;
  return plan;
}

ParticlesSweep::ParticlesSweep(ParticlesSweepPlan plan)
    : plan_(std::move(plan)), case_(plan_.case_path) {
  if (plan_.variations.empty() && plan_.draws == 0)
    throw Error(ErrorKind::kWrongUsage, "the sweep varies no key and has no draws");
  if (plan_.variations.empty() && plan_.samples > 0)
    throw Error(ErrorKind::kWrongUsage,
                "random samples need a varied key, which gives their range");
  check_keys(plan_);
  points_ = plan_.samples > 0 ? plan_.samples : grid_size(plan_.variations);
  constexpr std::uint64_t kMostRows = 1000000000000;
  if (plan_.draws > kMostRows / points_)
    throw Error(ErrorKind::kWrongUsage, fmt::format("{} points with {} draws are more than {} rows",
                                                    points_, plan_.draws, kMostRows));
  const auto base = case_.with({});
  particles_file_ = base.particles_file;
  if (base.arrangement) first_seed_ = base.arrangement->seed;
  if (plan_.draws > 0 && !base.arrangement)
    throw Error(
        ErrorKind::kWrongUsage,
        fmt::format("{} has no section [arrangement], which draws need", plan_.case_path.string()));
  const auto last_seed = first_seed_ + plan_.draws;
  if (constexpr auto kMost = std::numeric_limits<int>::max();
      plan_.draws > 0 && last_seed - 1 > static_cast<std::uint64_t>(kMost))
    throw Error(
        ErrorKind::kWrongUsage,
        fmt::format("there are {} draws, but arrangement.seed begins at {} and is at most {}",
                    plan_.draws, first_seed_, kMost));
  result_columns_ = columns_of(base);
  for (const std::uint64_t index : {std::uint64_t{0}, size() - 1}) {
    try {
      (void)case_.with(numbers(index));
    } catch (const Error& error) {
      std::string values;
      for (const auto& [key, value] : numbers(index)) values += fmt::format(" {} = {}", key, value);
      throw Error(error.kind(), fmt::format("{} (at the point{})", error.what(), values));
    }
  }
}

std::uint64_t ParticlesSweep::size() const {
  return points_ * std::max<std::uint64_t>(plan_.draws, 1);
}

std::vector<std::string> ParticlesSweep::keys() const {
  std::vector<std::string> keys;
  for (const auto& variation : plan_.variations) keys.push_back(variation.key);
  if (plan_.draws > 0) keys.emplace_back(kSeed);
  return keys;
}

std::vector<std::pair<std::string, double>> ParticlesSweep::numbers(std::uint64_t index) const {
  const std::uint64_t draws = std::max<std::uint64_t>(plan_.draws, 1);
  const std::uint64_t point = index / draws;
  auto numbers = plan_.samples > 0 ? random_point(plan_.variations, point, plan_.seed)
                                   : grid_point(plan_.variations, point);
  if (plan_.draws > 0)
    numbers.emplace_back(kSeed,
                         static_cast<double>(first_seed_) + static_cast<double>(index % draws));
  return numbers;
}

std::string ParticlesSweep::case_text(std::uint64_t index) const {
  return case_.text_with(numbers(index));
}

std::string ParticlesSweep::identity(std::uint64_t index, const std::string& version) const {
  return sha256(fmt::format("{}\n{}\n{}", version, case_text(index),
                            particles_file_.empty() ? "" : sha256(read_file(particles_file_))));
}

std::string ParticlesSweep::key_fields(std::uint64_t index) const {
  std::string text;
  for (const auto& [key, value] : numbers(index))
    text += (text.empty() ? "" : ",") + format_number(value);
  return text;
}

std::string ParticlesSweep::row(std::uint64_t index, const RunResults& results) const {
  std::string text = key_fields(index);
  for (const auto& column : result_columns_) {
    const auto value = results.values.find(column);
    text += "," + (value == results.values.end() ? "" : format_number(value->second));
  }
  return text + "," + as_field(results.failure) + "\n";
}

Rows rows_of(const ParticlesSweep& sweep, const std::string& version, ParticlesRunner run) {
  Rows rows;
  rows.size = sweep.size();
  rows.columns = sweep.keys();
  rows.keys = rows.columns.size();
  const auto& results = sweep.result_columns();
  rows.columns.insert(rows.columns.end(), results.begin(), results.end());
  rows.columns.emplace_back("failure");
  // The case of a row has everything that determines its results; a row begins with the numbers
  // that differ from those of the first one.
  rows.comments = {
      {"viscontact", "sweep of particles"},
      {"case", sha256(read_file(sweep.plan().case_path))},
      {"rows", std::to_string(rows.size)},
      {"sweep", sha256(sweep.identity(0, version) + sweep.identity(rows.size - 1, version))},
      {"version of Viscontact", version}};
  rows.key_fields = [&sweep](std::uint64_t index) { return sweep.key_fields(index); };
  rows.row = [&sweep, run = std::move(run)](std::uint64_t index, const StopToken& stop) {
    return sweep.row(index, run(index, stop));
  };
  return rows;
}

}  // namespace viscontact::sweep
