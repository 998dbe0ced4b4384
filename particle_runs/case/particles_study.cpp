// Cases, rows and means of a sweep over a case of particles.
#include "viscontact/particle_runs/case/particles_study.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <fstream>
#include <limits>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact::particles {
namespace {

/// Throws Error(kWrongUsage) if a key is varied twice, is in [sweep] or [output], or is the seed of
/// the arrangement although there are draws, which vary the seed.
void check_varied_keys(const sweep::Points& points) {
  if (points.draws > 0 && points.is_varied(sweep::kDrawKey))
    throw Error(ErrorKind::kWrongUsage, "{} cannot be varied beside draws, which vary it",
                sweep::kDrawKey);
  sweep::check_keys(points, [](const std::string& key) {
    const auto section = key.substr(0, key.find('.'));
    if (section == "sweep" || section == "output")
      throw Error(ErrorKind::kWrongUsage,
                  "{} cannot be varied, because it changes no motion of a run", key);
  });
}

std::vector<std::string> columns_of(const ParticlesCase& c) {
  std::vector<std::string> columns = {"particles"};
  if (c.arrangement) columns.emplace_back(fraction_column(c));
  for (const auto* column :
       {"to_time", "steps", "unconverged_steps", "iterations", "largest_residual",
        "largest_impulse_residual", "largest_gamma_error", "divided_steps", "unresolved_contacts",
        "largest_overlap", "final_overlap", "contacts", "glued"})
    columns.emplace_back(column);
  if (c.setting.fluid)
    for (const auto* column : {"apparent_viscosity", "mean_apparent_viscosity", "dissipation",
                               "mean_dissipation", "velocity_error_estimate"})
      columns.emplace_back(column);
  if (c.setting.lubrication)
    for (const auto* column : {"mean_viscosity", "mean_viscosity_error", "mean_n1", "mean_n1_error",
                               "mean_n2", "mean_n2_error", "mean_pressure", "mean_pressure_error"})
      columns.emplace_back(column);
  return columns;
}

/// The text "MEAN,STANDARD_ERROR" of `values`. Both fields are empty if there are no values or if a
/// value is not finite; the second field is empty if there is one value.
std::string mean_fields(const std::vector<double>& values) {
  if (values.empty()) return ",";
  const auto n = static_cast<double>(values.size());
  // This form of the mean has no rounding error if all values are equal (Welford 1962).
  double mean = 0, squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    mean += (values[i] - mean) / static_cast<double>(i + 1);
  for (const double value : values) squares += (value - mean) * (value - mean);
  if (!std::isfinite(mean) || !std::isfinite(squares)) return ",";
  return format_number(mean) + "," +
         (values.size() < 2 ? "" : format_number(std::sqrt(squares / (n - 1) / n)));
}

struct Draws {
  std::string keys;  ///< the varied keys, each followed by a comma
  std::uint64_t succeeded = 0, failed = 0;
  std::vector<std::vector<double>> values;  ///< those of the draws, for each column
};

std::string row_of(const Draws& draws) {
  std::string text = fmt::format("{}{},{}", draws.keys, draws.succeeded, draws.failed);
  for (const auto& values : draws.values) text += "," + mean_fields(values);
  return text + "\n";
}

}  // namespace

sweep::Points planned_particles(const std::filesystem::path& case_path) {
  const auto c = read_particles_case(case_path);
  const auto request = c.sweep.value_or(case_file::SweepRequest{});
  auto points = sweep::points_of_case(request.vary, case_path, request.vary_line);
  points.samples = request.samples;
  points.draws = request.draws;
  return points;
}

ParticlesSweep::ParticlesSweep(const std::filesystem::path& case_path, sweep::Points points)
    : cases_(case_path), points_(std::move(points)) {
  if (points_.variations.empty() && points_.draws == 0)
    throw Error(ErrorKind::kWrongUsage, "the sweep varies no key and has no draws");
  if (points_.variations.empty() && points_.samples > 0)
    throw Error(ErrorKind::kWrongUsage,
                "random samples need a varied key, which gives their range");
  check_varied_keys(points_);
  // The same as for the points of a grid in sweep/variation.cpp. Without a limit the product of
  // points and draws could exceed 64 bits.
  constexpr std::uint64_t kMostRows = 1000000000000;
  if (points_.draws > kMostRows / points_.count())
    throw Error(ErrorKind::kWrongUsage, "{} points with {} draws are more than {} rows",
                points_.count(), points_.draws, kMostRows);
  const auto base = cases_.with({});
  files_ = files_of(base);
  if (base.arrangement) points_.first_draw = base.arrangement->seed;
  if (points_.draws > 0 && !base.arrangement)
    throw Error(ErrorKind::kWrongUsage, "{} has no section [arrangement], which draws need",
                case_path.string());
  const auto last_seed = points_.first_draw + points_.draws;
  if (constexpr auto kMost = std::numeric_limits<int>::max();
      points_.draws > 0 && last_seed - 1 > static_cast<std::uint64_t>(kMost))
    throw Error(ErrorKind::kWrongUsage,
                "there are {} draws, but arrangement.seed begins at {} and is at most {}",
                points_.draws, points_.first_draw, kMost);
  units_ = base.units;
  result_columns_ = columns_of(base);
  sweep::check_ends(points_, [&](const auto& numbers) { (void)cases_.with(numbers); });
}

std::string ParticlesSweep::case_text(std::uint64_t index) const {
  assert(index < points_.rows());
  return text_for_any_folder(cases_.root_with(points_.numbers(index)), case_path());
}

std::string ParticlesSweep::base_text() const {
  return text_for_any_folder(cases_.root_with({}), case_path());
}

std::string ParticlesSweep::identity(std::uint64_t index, const std::string& version) const {
  assert(index < points_.rows());
  std::string hashes;
  for (const auto& file : files_) hashes += sha256(read_file(file));
  return sha256(fmt::format("{}\n{}\n{}", version, case_text(index), hashes));
}

sweep::Study ParticlesSweep::study(const std::string& version, ParticlesRunner run) const {
  // The identities of the first and the last row are enough, because other rows differ from them
  // only in the varied numbers, which are in the file.
  return {points_, result_columns_,
          sweep::head_of("sweep of particles", read_file(case_path()), points_,
                         identity(0, version) + identity(points_.rows() - 1, version), version,
                         units()),
          std::move(run)};
}

std::string table_of_means(const ParticlesSweep& sweep, const std::filesystem::path& path) {
  const auto& columns = sweep.result_columns();
  const auto& points = sweep.points();
  const std::size_t keys = points.keys().size(), varied = points.variations.size();
  CsvComments head = {{"viscontact", "means of a sweep of particles"},
                      {"rows", std::to_string(points.count())}};
  if (sweep.units().are_said()) head["units"] = sweep.units().words();
  std::string text = write_csv_comments(head);
  for (const auto& variation : points.variations) text += variation.key + ",";
  text += "draws,failed";
  for (const auto& column : columns) text += fmt::format(",{0}.mean,{0}.standard_error", column);
  text += "\n";

  std::ifstream file(path, std::ios::binary);
  const std::uint64_t draws_of_a_point = points.rows() / points.count();
  std::uint64_t row = 0;
  bool header_is_read = false;
  Draws draws;
  for (std::string line; row < points.rows() && std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    if (!header_is_read) {
      header_is_read = true;
      continue;
    }
    const auto fields = csv_fields(line);
    if (fields.size() != keys + columns.size() + 1 ||
        !line.starts_with(points.key_fields(row) + ","))
      throw_bad_input({path.string()}, "row {} is not that of the sweep", row + 1);
    if (row % draws_of_a_point == 0) {
      draws = {};
      for (std::size_t i = 0; i < varied; ++i) draws.keys += fields[i] + ",";
      draws.values.resize(columns.size());
    }
    const bool has_failed = !fields.back().empty();
    ++(has_failed ? draws.failed : draws.succeeded);
    for (std::size_t i = 0; i < columns.size() && !has_failed; ++i)
      if (const auto value = parse_number(fields[keys + i])) draws.values[i].push_back(*value);
    if (++row % draws_of_a_point == 0) text += row_of(draws);
  }
  if (row < points.rows())
    throw_bad_input({path.string()}, "has {} rows; the sweep has {}", row, points.rows());
  return text;
}

std::filesystem::path path_of_means(const std::filesystem::path& rows) {
  auto name = rows.stem();
  name += "_means";
  name += rows.extension();
  return rows.parent_path() / name;
}

}  // namespace viscontact::particles
