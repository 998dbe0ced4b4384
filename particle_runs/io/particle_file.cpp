// Reads and writes particles as CSV; particle_file.hpp has the columns.
#include "viscontact/particle_runs/io/particle_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>
#include <unordered_map>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/particle_runs/io/particle_columns.hpp"

namespace viscontact::particles {
namespace {

constexpr std::size_t kColumns = 14, kId = 8, kAngle = 9, kAngularVelocity = 10;
using Row = CsvRow<kColumns>;
using Names = std::array<std::string, kColumns>;

// The required columns come first, as read_csv() expects: position, radius, mass. The velocity,
// columns that belong to other dimensions, the id and the rotation follow. kId, kAngle, ... are
// indices in all three lists.
// clang-format off
const Names kDiscs = {"x", "y", "radius", "mass", "vx", "vy", "z", "vz", "id", "angle",
  "angular_velocity", "angular_velocity_x", "angular_velocity_y", "angular_velocity_z"};
const Names kSpheres = {"x", "y", "z", "radius", "mass", "vx", "vy", "vz", "id", "angle",
  "angular_velocity", "angular_velocity_x", "angular_velocity_y", "angular_velocity_z"};
const Names kOnAxis = {"z", "radius", "mass", "vz", "x", "y", "vx", "vy", "id", "angle",
  "angular_velocity", "angular_velocity_x", "angular_velocity_y", "angular_velocity_z"};
// clang-format on
constexpr std::size_t kAngularVelocityX = 11;

/// The columns that final_particles.csv of a run of this kind may have.
std::vector<std::string> columns_of_runs(int dimension, bool in_fluid) {
  RunFacts run = kAllFacts;
  run.dimension = dimension;
  run.is_in_fluid = in_fluid;
  run.has_given_loads = !in_fluid;
  std::vector<std::string> names;
  for (const auto* one : columns_in(Output::kAtEnd, particle_columns(), run))
    std::ranges::copy(one->names(dimension), std::back_inserter(names));
  return names;
}

enum class Sign { kAny, kNotNegative, kPositive };

/// Throws Error(kBadInput) if the number is missing or has the wrong sign, if its magnitude is
/// above 1e100, or, unless any sign is allowed, if it is between 0 and 1e-100.
double allowed(const Row& row, const Names& names, std::size_t column, Sign sign,
               const std::string& file) {
  const double value = required_field(row, names, column, file);
  // Squares and cubes of numbers up to this one and of their inverses are finite and not 0.
  constexpr double kLargest = 1e100;
  if (sign == Sign::kNotNegative && !(value == 0 || value >= 1 / kLargest))
    throw_bad_input({file, row.line, names[column]}, "{} is {}; it must be 0 or at least 1e-100",
                    names[column], value);
  if (sign == Sign::kPositive && !(value >= 1 / kLargest))
    throw_bad_input({file, row.line, names[column]}, "{} is {}; it must be > 0, at least 1e-100",
                    names[column], value);
  if (!(std::abs(value) <= kLargest))
    throw_bad_input({file, row.line, names[column]}, "{} is {}; it must be at most {} in magnitude",
                    names[column], value, kLargest);
  return value;
}

/// Throws Error(kBadInput) for unknown columns, which read_csv_rows() would ignore (a misspelt
/// velocity, for example), and for incomplete velocities. `names` has the columns of this
/// dimension.
void check_header(const std::string& text, const std::string& file, const Names& names,
                  int dimension, bool in_fluid) {
  // The columns of kDiscs up to `id` are those that each file may have, whatever its dimension.
  const std::span known(kDiscs.begin(), kId + 1);
  auto others = columns_of_runs(dimension, in_fluid);
  std::erase_if(others, [&](const std::string& name) {
    return std::ranges::find(known, name) != known.end();
  });
  const auto header = csv_header(text);
  std::vector<std::string> velocities;
  for (const auto& name : header.names) {
    if (name.starts_with("semi_axis_"))
      throw_bad_input(
          {file, header.line, name},
          "has a column '{}' of ellipses or plates; the particles of a file must be discs or "
          "spheres, and each ellipse or plate a table [[particle]] with semi_axes or length",
          name);
    if (std::ranges::find(known, name) == known.end() &&
        std::ranges::find(others, name) == others.end())
      throw_bad_input(
          {file, header.line, name},
          "has a column '{}', which is not known{}; the known columns are id, x, y, z, vx, vy, vz, "
          "radius, mass{}{}",
          shortened(name),
          name.empty() ? " (pandas writes its index so; to_csv(..., index=False) does not)" : "",
          others.empty() ? "" : ", ", fmt::join(others, ", "));
    if (name.starts_with('v')) velocities.push_back(name);
  }
  const auto d = static_cast<std::size_t>(dimension);
  for (const auto& name : std::span(names).subspan(d + 2, d))
    if (!velocities.empty() && std::ranges::find(velocities, name) == velocities.end())
      throw_bad_input({file, header.line, name},
                      "has the column {} of the velocity, but not {}; it must have all components "
                      "of the velocity or none",
                      velocities.front(), name);
}

/// The ids of the rows. Empty if the file has no column `id`, if all its fields are empty, or if
/// the ids are 0, 1, ..., as without the column.
std::vector<std::int32_t> read_ids(const std::vector<Row>& rows, const std::string& file) {
  const auto has_id = [](const Row& row) { return row.fields[kId].has_value(); };
  if (std::ranges::none_of(rows, has_id)) return {};
  constexpr double kLargest = std::numeric_limits<std::int32_t>::max();
  std::vector<std::int32_t> ids;
  std::unordered_map<std::int32_t, int> line_of;
  for (const auto& row : rows) {
    const double id = required_field(row, kDiscs, kId, file);
    if (!(id >= 0 && id <= kLargest && id == std::floor(id)))
      throw_bad_input({file, row.line, "id"}, "id is {}; it must be a whole number from 0 to {}",
                      id, kLargest);
    ids.push_back(static_cast<std::int32_t>(id));
    const auto [other, is_new] = line_of.emplace(ids.back(), row.line);
    if (!is_new)
      throw_bad_input({file, row.line, "id"},
                      "id is {}, which is the id of the particle in line {}; each particle must "
                      "have an id of its own",
                      ids.back(), other->second);
  }
  const auto is_place = [place = 0](std::int32_t id) mutable { return id == place++; };
  if (std::ranges::all_of(ids, is_place)) ids.clear();
  return ids;
}

}  // namespace

ParticleFile read_particles(const std::filesystem::path& path, int dimension, bool in_fluid) {
  assert(dimension >= 1 && dimension <= 3);
  const auto& names = dimension == 1 ? kOnAxis : dimension == 2 ? kDiscs : kSpheres;
  const auto d = static_cast<std::size_t>(dimension);
  const std::string file = path.string(), text = read_file(path);
  std::vector<Row> rows;
  read_csv_rows(text, file, names, in_fluid ? d + 1 : d + 2, [&](auto fields, int line) {
    std::ranges::copy(fields, rows.emplace_back(Row{{}, line}).fields.begin());
  });
  check_header(text, file, names, dimension, in_fluid);
  const auto any_of = [](const Row& row, std::size_t from, std::size_t to) {
    return std::any_of(&row.fields[from], row.fields.data() + to,
                       [](const auto& field) { return field.has_value(); });
  };
  const auto turns = [&](const Row& row) { return any_of(row, kAngle, kColumns); };
  const bool any_turns = dimension != 1 && std::ranges::any_of(rows, turns);
  const bool rotate = dimension == 2 && (in_fluid || any_turns);
  const bool spin = dimension == 3 && any_turns;
  if (rows.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw_bad_input({file}, "has {} particles; at most {} are allowed", rows.size(),
                    std::numeric_limits<std::int32_t>::max());
  ParticleFile result;
  auto& p = result.particles;
  p.dimension = dimension;
  for (const auto& row : rows) {
    const auto given_or_0 = [&](std::size_t i) {
      return row.fields[i] ? allowed(row, names, i, Sign::kAny, file) : 0.0;
    };
    for (std::size_t i = 2 * d + 2; i < kId; ++i)
      if (row.fields[i])
        throw_bad_input(
            {file, row.line},
            dimension == 2
                ? "has a value in a column of the third dimension (z or vz); space.dimension is 2"
                : "has a value in a column of another dimension (x, y, vx or vy); space.dimension "
                  "is \"axisymmetric\"");
    for (std::size_t i = 0; i < d; ++i)
      p.positions.push_back(allowed(row, names, i, Sign::kAny, file));
    p.radii.push_back(allowed(row, names, d, Sign::kPositive, file));
    p.masses.push_back(
        in_fluid && !row.fields[d + 1]
            ? 0
            : allowed(row, names, d + 1, in_fluid ? Sign::kNotNegative : Sign::kPositive, file));
    for (std::size_t i = d + 2; i < 2 * d + 2; ++i) p.velocities.push_back(given_or_0(i));
    result.has_velocity.push_back(any_of(row, d + 2, 2 * d + 2));
    result.has_angular_velocity.push_back(any_of(row, kAngularVelocity, kColumns));
    if (rotate) {
      p.angles.push_back(given_or_0(kAngle));
      p.angular_velocities.push_back(given_or_0(kAngularVelocity));
    }
    if (spin) {
      p.orientations.insert(p.orientations.end(), {1, 0, 0, 0});
      for (std::size_t i = 0; i < 3; ++i)
        p.angular_velocities.push_back(given_or_0(kAngularVelocityX + i));
    }
    result.lines.push_back(row.line);
  }
  p.ids = read_ids(rows, file);
  return result;
}

std::string write_particles(const Particles& particles, const std::optional<FluidForces>& forces,
                            std::span<const GivenParticleLoad> loads) {
  assert(!forces || forces->values.empty() ||
         forces->values.size() == particles.count() * motion_components(particles.dimension));
  assert(!forces || forces->errors.empty() ||
         forces->errors.size() == particles.count() * motion_components(particles.dimension));
  auto run = facts_of(particles);
  run.is_in_fluid = forces.has_value();
  run.do_turn = run.do_turn || run.is_in_fluid;
  run.has_given_loads = !loads.empty();
  const CsvTable<ParticleRow> table(columns_in(Output::kAtEnd, particle_columns(), run),
                                    particles.dimension);
  auto text = fmt::format("# rows: {}\n{}", particles.count(), table.header());
  for (const auto& row : rows_of(particles, 0, forces ? &*forces : nullptr, loads))
    table.add(text, row);
  return text;
}

namespace {

CsvTable<ParticleRow> motion_table(int dimension, bool turn, bool has_loads) {
  RunFacts run;
  run.dimension = dimension;
  run.do_turn = turn;
  run.has_given_loads = has_loads;
  return {columns_in(Output::kOverTime, particle_columns(), run, kFirstOfMotion), dimension};
}

}  // namespace

std::string motion_header(int dimension, bool turn, bool has_loads) {
  return motion_table(dimension, turn, has_loads).header();
}

std::string motion_rows(double time, const Particles& particles,
                        const std::vector<GivenParticleLoad>* loads) {
  const auto table = motion_table(particles.dimension, particles.turn(), loads != nullptr);
  std::string text;
  const std::span<const GivenParticleLoad> of_given =
      loads == nullptr ? std::span<const GivenParticleLoad>() : *loads;
  for (const auto& row : rows_of(particles, time, nullptr, of_given)) table.add(text, row);
  return text;
}

}  // namespace viscontact::particles
