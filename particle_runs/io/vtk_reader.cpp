// Reads the layout of vtk.cpp, not VTK's formats in general.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/common/vtk/vtk_xml.hpp"
#include "viscontact/particle_runs/io/contact_columns.hpp"
#include "viscontact/particle_runs/io/vtk.hpp"
#include "viscontact/particles/domain/periods.hpp"

namespace viscontact::particles {

namespace {

/// Sets the members of `contacts` that the column has in a frame. Throws Error(kBadInput) if it
/// does not have a number for each, or if a number is not allowed.
template <class Number>
void read_column(const VtkReader& reader, const ContactColumn& column, int dimension,
                 std::vector<CurrentContact>& contacts) {
  const auto count = column.count_in_frames(dimension);
  const auto values = reader.array<Number>("CellData", column.name);
  if (values.size() != count * contacts.size()) reader.refuse();
  std::array<double, 9> entries{};
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(k * count), count, entries.begin());
    if (!column.set(contacts[k], std::span(entries).first(count))) reader.refuse();
  }
}

/// The contacts of a frame, first those of two particles and then those with obstacles. Throws
/// Error(kBadInput) if arrays have other lengths, or if a number of a particle, image or kind of
/// friction does not exist.
std::vector<CurrentContact> read_contacts(const VtkReader& reader, int dimension,
                                          std::int64_t particles) {
  const auto partners = reader.array<std::int32_t>("CellData", "j");
  // Entries are indices of points, which are the numbers of particles and not their ids. A contact
  // with an obstacle is a vertex with one entry, a contact of two particles a line with two.
  const auto vertices = reader.array<std::int64_t>("Verts", "connectivity");
  const auto lines = reader.array<std::int64_t>("Lines", "connectivity");
  const auto walls = vertices.size(), pairs = lines.size() / 2;
  if (partners.size() != walls + pairs || lines.size() % 2 != 0) reader.refuse();
  const auto particle = [&](std::int64_t place) {
    if (place < 0 || place >= particles) reader.refuse();
    return static_cast<std::int32_t>(place);
  };
  std::vector<CurrentContact> contacts(walls + pairs);
  for (const auto& column : contact_columns()) {
    const auto& condition = column.presence.frames;
    if (column.set == nullptr || !condition.holds(kAllFacts)) continue;
    if (!condition.holds({}) && !reader.has_array("CellData", column.name)) continue;
    if (column.is_whole())
      read_column<std::int32_t>(reader, column, dimension, contacts);
    else
      read_column<double>(reader, column, dimension, contacts);
  }
  for (std::size_t i = 0; i < walls; ++i) {
    if (partners[i] >= 0) reader.refuse();
    contacts[i].first = partners[i];
    contacts[i].second = particle(vertices[i]);
    contacts[i].image = 0;
  }
  for (std::size_t i = 0; i < pairs; ++i) {
    auto& contact = contacts[walls + i];
    contact.first = particle(lines[2 * i]);
    contact.second = particle(lines[2 * i + 1]);
    if (contact.image < -kLargestImage || contact.image > kLargestImage) reader.refuse();
  }
  std::ranges::rotate(contacts, contacts.begin() + static_cast<std::ptrdiff_t>(walls));
  return contacts;
}

}  // namespace

VtpContent read_vtp(const std::filesystem::path& path, int dimension) {
  assert(dimension >= 1 && dimension <= 3);
  const std::string text = read_file(path);
  const VtkReader reader(text, path.string(), "frame");
  VtpContent content;
  const auto points = reader.array<double>("Points", "Points");
  if (points.size() % 3 != 0) reader.refuse();
  for (std::size_t i = 0; i < points.size(); ++i)
    if (dimension == 1 ? i % 3 == 2 : i % 3 < static_cast<std::size_t>(dimension))
      content.positions.push_back(points[i]);
  content.radii = reader.array<double>("PointData", "radius");
  if (content.radii.size() != points.size() / 3) reader.refuse();
  content.ids = reader.array<std::int32_t>("PointData", "id");
  if (content.ids.size() != content.radii.size()) reader.refuse();
  const auto velocities = reader.array<double>("PointData", "velocity");
  if (velocities.size() != points.size()) reader.refuse();
  for (std::size_t i = 0; i < velocities.size(); i += 3)
    content.speeds.push_back(std::hypot(velocities[i], velocities[i + 1], velocities[i + 2]));
  if (reader.has_array("PointData", "mass")) {
    content.masses = reader.array<double>("PointData", "mass");
    if (content.masses.size() != content.radii.size()) reader.refuse();
  }
  if (reader.has_array("PointData", "angle")) {
    content.angles = reader.array<double>("PointData", "angle");
    content.angular_velocities = reader.array<double>("PointData", "angular_velocity");
    if (content.angles.size() != points.size() / 3 ||
        content.angular_velocities.size() != content.angles.size())
      reader.refuse();
  }
  if (reader.has_array("PointData", "orientation")) {
    content.orientations = reader.array<double>("PointData", "orientation");
    if (content.orientations.size() != points.size() / 3 * 4) reader.refuse();
  }
  content.contacts = read_contacts(reader, dimension, std::ssize(points) / 3);
  if (reader.has_array("FieldData", "periods")) {
    const auto numbers = reader.array<double>("FieldData", "periods");
    if (numbers.size() != 9) reader.refuse();
    auto& periods = content.periods.emplace();
    for (std::size_t k = 0; k < 9; ++k) periods[k / 3][k % 3] = numbers[k];
  }
  return content;
}

std::vector<std::pair<double, std::string>> read_pvd(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  if (text.find("</Collection>") == std::string::npos)
    throw_bad_input({path.string()}, "is not a whole list of frames");
  std::vector<std::pair<double, std::string>> files;
  constexpr std::string_view kBegin = "<DataSet ";
  for (auto at = text.find(kBegin); at != std::string::npos; at = text.find(kBegin, at + 1)) {
    const auto element = between(std::string_view(text).substr(at), kBegin, "/>");
    const auto time = element ? between(*element, "timestep=\"", "\"") : std::nullopt;
    const auto file = element ? between(*element, "file=\"", "\"") : std::nullopt;
    const auto number = time ? parse_number(std::string(*time)) : std::nullopt;
    if (!number || !file)
      throw_bad_input({path.string()}, "is not a list of frames that viscontact particles wrote");
    files.emplace_back(*number, std::string(*file));
  }
  return files;
}

}  // namespace viscontact::particles
