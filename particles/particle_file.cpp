#include "particles/particle_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "common/csv.hpp"
#include "common/error.hpp"
#include "common/number.hpp"

namespace viscontact::particles {
namespace {

// The required columns first, as read_csv wants them; places of position, radius, mass, velocity.
const std::array<std::string, 8> kDiscs = {"x", "y", "radius", "mass", "vx", "vy", "z", "vz"};
const std::array<std::string, 8> kSpheres = {"x", "y", "z", "radius", "mass", "vx", "vy", "vz"};

double allowed(const CsvRow<8>& row, const std::array<std::string, 8>& names, std::size_t column,
               bool positive, const std::string& file) {
  const double value = required_field(row, names, column, file);
  constexpr double kLargest = 1e100;  // squares and cubes of it, and of its inverse, are numbers
  if (positive && !(value >= 1 / kLargest))
    throw_bad_input({file, row.line},
                    fmt::format("{} is {}; it must be > 0, at least 1e-100", names[column], value));
  if (!(std::abs(value) <= kLargest))
    throw_bad_input({file, row.line}, fmt::format("{} is {}; it must be at most {} in magnitude",
                                                  names[column], value, kLargest));
  return value;
}

/// Columns that are no particles' would be passed over, as velocities that are misspelt: refused.
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
    if (name != "id" && std::ranges::find(kDiscs, name) == kDiscs.end())
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
  return result;
}

std::string write_particles(const Particles& particles) {
  const auto d = static_cast<std::size_t>(particles.dimension);
  std::string text = fmt::format("# rows: {}\n", particles.count());
  text += d == 2 ? "id,x,y,vx,vy,radius,mass\n" : "id,x,y,z,vx,vy,vz,radius,mass\n";
  for (std::size_t k = 0; k < particles.count(); ++k) {
    fmt::format_to(std::back_inserter(text), "{}", k);
    const auto add = [&](double value) { (text += ',') += format_number(value); };
    for (std::size_t i = k * d; i < k * d + d; ++i) add(particles.positions[i]);
    for (std::size_t i = k * d; i < k * d + d; ++i) add(particles.velocities[i]);
    add(particles.radii[k]);
    add(particles.masses[k]);
    text += '\n';
  }
  return text;
}

std::string write_contacts(std::span<const ContactNow> contacts) {
  std::string text = fmt::format("# rows: {}\ni,j,gap,gamma\n", contacts.size());
  for (const auto& contact : contacts) {
    // A plane is written second.
    const bool wall = contact.first < 0;
    fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", wall ? contact.second : contact.first,
                   wall ? contact.first : contact.second, format_number(contact.gap),
                   format_number(contact.gamma));
  }
  return text;
}

}  // namespace viscontact::particles
