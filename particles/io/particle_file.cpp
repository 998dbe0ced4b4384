// Reads and writes particles and contacts as CSV (docs/file-formats.md). Units are those of
// particle_file.hpp.
#include "viscontact/particles/io/particle_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <unordered_map>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact::particles {
namespace {

constexpr std::size_t kColumns = 9, kId = 8;
using Row = CsvRow<kColumns>;
using Names = std::array<std::string, kColumns>;

// Columns for discs and spheres. The required columns come first, as read_csv expects: position,
// radius, mass. The velocity and the id follow.
const Names kDiscs = {"x", "y", "radius", "mass", "vx", "vy", "z", "vz", "id"};
const Names kSpheres = {"x", "y", "z", "radius", "mass", "vx", "vy", "vz", "id"};

double allowed(const Row& row, const Names& names, std::size_t column, bool positive,
               const std::string& file) {
  const double value = required_field(row, names, column, file);
  // Squares and cubes of this number and of its inverse are finite and not 0.
  constexpr double kLargest = 1e100;
  if (positive && !(value >= 1 / kLargest))
    throw_bad_input({file, row.line},
                    fmt::format("{} is {}; it must be > 0, at least 1e-100", names[column], value));
  if (!(std::abs(value) <= kLargest))
    throw_bad_input({file, row.line}, fmt::format("{} is {}; it must be at most {} in magnitude",
                                                  names[column], value, kLargest));
  return value;
}

/// Throws Error(kBadInput) for unknown columns, which would otherwise be ignored (a misspelt
/// velocity, for example), and for incomplete velocities.
void check_header(const std::filesystem::path& path, bool discs) {
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line) && (line.empty() || line[0] == '#')) {
  }
  if (line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
  std::size_t velocities = 0;
  std::istringstream columns(line);
  for (std::string name; std::getline(columns, name, ',');) {
    const auto first = name.find_first_not_of(" \t\r"), last = name.find_last_not_of(" \t\r");
    name = first == std::string::npos ? "" : name.substr(first, last - first + 1);
    if (std::ranges::find(kDiscs, name) == kDiscs.end())
      throw_bad_input({path.string()}, "has a column '" + shortened(name) +
                                           "', which is not known; the known columns are id, x, y, "
                                           "z, vx, vy, vz, radius, mass");
    if (name.starts_with('v')) ++velocities;
  }
  if (velocities != 0 && velocities != (discs ? 2U : 3U) && !(discs && velocities == 3))
    throw_bad_input(
        {path.string()},
        "has some of the columns vx, vy, vz of the velocity, not all; it must have all of "
        "them or none");
}

/// The ids of the rows. Empty if the file has no column `id`, if all its fields are empty, or if
/// the ids are 0, 1, ..., as they are without the column.
std::vector<std::int32_t> read_ids(const std::vector<Row>& rows, const std::string& file) {
  const auto has_id = [](const Row& row) { return row.fields[kId].has_value(); };
  if (std::ranges::none_of(rows, has_id)) return {};
  constexpr double kLargest = std::numeric_limits<std::int32_t>::max();
  std::vector<std::int32_t> ids;
  std::unordered_map<std::int32_t, int> line_of;
  for (const auto& row : rows) {
    const double id = required_field(row, kDiscs, kId, file);
    if (!(id >= 0 && id <= kLargest && id == std::floor(id)))
      throw_bad_input(
          {file, row.line},
          fmt::format("id is {}; it must be a whole number from 0 to {}", id, kLargest));
    ids.push_back(static_cast<std::int32_t>(id));
    const auto [other, is_new] = line_of.emplace(ids.back(), row.line);
    if (!is_new)
      throw_bad_input({file, row.line},
                      fmt::format("id is {}, which is the id of the particle in line {}; each "
                                  "particle must have an id of its own",
                                  ids.back(), other->second));
  }
  const auto is_place = [place = 0](std::int32_t id) mutable { return id == place++; };
  if (std::ranges::all_of(ids, is_place)) ids.clear();
  return ids;
}

}  // namespace

ParticleFile read_particles(const std::filesystem::path& path, int dimension) {
  const bool discs = dimension == 2;
  const auto& names = discs ? kDiscs : kSpheres;
  const auto d = static_cast<std::size_t>(dimension);
  const auto csv = read_csv(path, names, d + 2);
  check_header(path, discs);
  const std::string file = path.string();
  if (csv.rows.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw_bad_input({file}, fmt::format("has {} particles; at most {} are allowed", csv.rows.size(),
                                        std::numeric_limits<std::int32_t>::max()));
  ParticleFile result;
  auto& p = result.particles;
  p.dimension = dimension;
  for (const auto& row : csv.rows) {
    if (discs && (row.fields[6] || row.fields[7]))
      throw_bad_input(
          {file, row.line},
          "has a value in a column of the third dimension (z or vz); space.dimension is 2");
    for (std::size_t i = 0; i < d; ++i) p.positions.push_back(allowed(row, names, i, false, file));
    p.radii.push_back(allowed(row, names, d, true, file));
    p.masses.push_back(allowed(row, names, d + 1, true, file));
    for (std::size_t i = d + 2; i < 2 * d + 2; ++i)
      p.velocities.push_back(row.fields[i] ? allowed(row, names, i, false, file) : 0.0);
    result.lines.push_back(row.line);
  }
  p.ids = read_ids(csv.rows, file);
  return result;
}

std::string write_particles(const Particles& particles) {
  const auto d = static_cast<std::size_t>(particles.dimension);
  std::string text = fmt::format("# rows: {}\n", particles.count());
  text += d == 2 ? "id,x,y,vx,vy,radius,mass\n" : "id,x,y,z,vx,vy,vz,radius,mass\n";
  for (std::size_t k = 0; k < particles.count(); ++k) {
    fmt::format_to(std::back_inserter(text), "{}", particles.id(k));
    const auto add = [&](double value) { (text += ',') += format_number(value); };
    for (std::size_t i = k * d; i < k * d + d; ++i) add(particles.positions[i]);
    for (std::size_t i = k * d; i < k * d + d; ++i) add(particles.velocities[i]);
    add(particles.radii[k]);
    add(particles.masses[k]);
    text += '\n';
  }
  return text;
}

std::string write_contacts(const Particles& particles, std::span<const CurrentContact> contacts) {
  std::string text = fmt::format("# rows: {}\ni,j,gap,gamma,gamma_error\n", contacts.size());
  for (const auto& contact : contacts) {
    const auto [i, j] = ids_of(particles, contact);
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", i, j, format_number(contact.gap),
                   format_number(contact.gamma), format_number(contact.gamma_error));
  }
  return text;
}

}  // namespace viscontact::particles
