// Reads the layout of vtk.cpp, not VTK's formats in general.
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
#include "viscontact/particle_runs/io/vtk.hpp"
#include "viscontact/particles/domain/periods.hpp"

namespace viscontact::particles {

namespace {

/// The array `name` of the contacts, or zeros if the frame has no such array. Throws
/// Error(kBadInput) if the array does not have `count` numbers.
template <class Number>
std::vector<Number> numbers_or_zeros(const VtkReader& reader, const char* name, std::size_t count) {
  auto numbers = reader.has_array("CellData", name) ? reader.array<Number>("CellData", name)
                                                    : std::vector<Number>(count);
  if (numbers.size() != count) reader.refuse();
  return numbers;
}

/// For each of `count` contacts, the numbers that contact laws remember and files show
/// (pair_memory.hpp). Throws Error(kBadInput) as numbers_or_zeros() does.
std::vector<ShownMemory> read_memories(const VtkReader& reader, std::size_t count) {
  std::vector<ShownMemory> memories(count);
  std::size_t place = 0;
  for (const auto& field : kMemoryFields) {
    if (!field.is_shown) continue;
    const auto values = reader.array<double>("CellData", field.name);
    if (values.size() != count) reader.refuse();
    for (std::size_t i = 0; i < count; ++i) {
      const std::span numbers(memories[i]);
      numbers[place] = values[i];
    }
    ++place;
  }
  return memories;
}

/// The contacts of a frame, first those of two particles and then those with obstacles. Throws
/// Error(kBadInput) if arrays have other lengths, or if a number of a particle, image or kind of
/// friction does not exist.
std::vector<CurrentContact> read_contacts(const VtkReader& reader, std::int64_t particles) {
  const auto gaps = reader.array<double>("CellData", "gap");
  const auto gammas = reader.array<double>("CellData", "gamma");
  const auto partners = reader.array<std::int32_t>("CellData", "j");
  const auto images = numbers_or_zeros<std::int32_t>(reader, "image", gaps.size());
  const auto frictions = numbers_or_zeros<std::int32_t>(reader, "friction", gaps.size());
  const auto normal_forces = reader.array<double>("CellData", "normal_force");
  const auto tangential_forces =
      numbers_or_zeros<double>(reader, "tangential_force", 3 * gaps.size());
  const auto solid_forces = numbers_or_zeros<double>(reader, "solid_force", gaps.size());
  const auto memories = read_memories(reader, gaps.size());
  // Entries are indices of points, which are the numbers of particles and not their ids. A contact
  // with an obstacle is a vertex with one entry, a contact of two particles a line with two.
  const auto vertices = reader.array<std::int64_t>("Verts", "connectivity");
  const auto lines = reader.array<std::int64_t>("Lines", "connectivity");
  const auto walls = vertices.size(), pairs = lines.size() / 2;
  if (gaps.size() != walls + pairs || gammas.size() != gaps.size() ||
      partners.size() != gaps.size() || normal_forces.size() != gaps.size() ||
      lines.size() % 2 != 0)
    reader.refuse();
  const auto particle = [&](std::int64_t place) {
    if (place < 0 || place >= particles) reader.refuse();
    return static_cast<std::int32_t>(place);
  };
  const auto image = [&](std::int32_t number) {
    if (number < -kLargestImage || number > kLargestImage) reader.refuse();
    return number;
  };
  const auto friction = [&](std::int32_t number) {
    if (number < 0 || number > static_cast<std::int32_t>(ContactFriction::kSlides)) reader.refuse();
    return static_cast<ContactFriction>(number);
  };
  std::vector<CurrentContact> contacts;
  const auto add = [&](std::size_t i, std::int32_t first, std::int64_t second) {
    contacts.push_back({.first = first,
                        .second = particle(second),
                        .gap = gaps[i],
                        .gamma = gammas[i],
                        .image = first < 0 ? 0 : image(images[i]),
                        .friction = friction(frictions[i]),
                        .normal_force = normal_forces[i],
                        .tangential_force = {tangential_forces[3 * i], tangential_forces[3 * i + 1],
                                             tangential_forces[3 * i + 2]},
                        .solid_force = solid_forces[i],
                        .shown = memories[i]});
  };
  for (std::size_t i = 0; i < pairs; ++i) add(walls + i, particle(lines[2 * i]), lines[2 * i + 1]);
  for (std::size_t i = 0; i < walls; ++i) {
    if (partners[i] >= 0) reader.refuse();
    add(i, partners[i], vertices[i]);
  }
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
  content.contacts = read_contacts(reader, std::ssize(points) / 3);
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
