// particles.xyz: all frames of a run as extended XYZ, for OVITO and ASE.
#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/descriptor.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/common/vtk/vtk_xml.hpp"
#include "viscontact/particle_runs/io/vtk.hpp"
#include "viscontact/particle_runs/run/particles_pages.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/domain/periods.hpp"

namespace viscontact::particles {
namespace {

namespace fs = std::filesystem;

std::string in_words(const Vector& x) {
  return fmt::format("{} {} {}", format_number(x[0]), format_number(x[1]), format_number(x[2]));
}

struct Cell {
  Vector corner{};
  std::array<Vector, 3> edges{};
  std::array<bool, 3> periodic{};
};

/// The cell of the case at `time`; nothing without a domain. Its edge along an axis without a
/// period is that of the domain, or of the box around it. OVITO shows no cell of volume 0, so that
/// a case in the plane has a cell as thick as the largest disc.
std::optional<Cell> cell_at(const ParticlesCase& c, const VtkReader& frame, double time,
                            double largest_radius) {
  assert(largest_radius > 0);
  Cell cell;
  Vector to{};
  if (const auto* disc = std::get_if<DiscDomain>(&c.setting.domain)) {
    const Vector half = {disc->radius, disc->radius, 0};
    cell.corner = disc->centre - half;
    to = disc->centre + half;
  } else if (const auto* box = std::get_if<BoxDomain>(&c.setting.domain)) {
    cell.corner = box->from;
    to = box->to;
  } else if (const auto* cylinder = std::get_if<CylinderDomain>(&c.setting.domain)) {
    cell.corner = {-cylinder->radius, -cylinder->radius, 0};
    to = {cylinder->radius, cylinder->radius, cylinder->height};
  } else {
    return {};
  }
  if (c.particles.dimension == 2) {
    cell.corner[2] = -largest_radius;
    to[2] = largest_radius;
  }
  if (frame.has_array("FieldData", "periods")) {
    const auto numbers = frame.array<double>("FieldData", "periods");
    if (numbers.size() != 9) frame.refuse();
    Vector corner = 0.5 * (cell.corner + to);
    for (std::size_t k = 0; k < 3; ++k) {
      auto& edge = cell.edges[k];
      edge = {numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]};
      cell.periodic[k] = norm(edge) > 0;
      if (!cell.periodic[k]) edge[k] = to[k] - cell.corner[k];
      corner = corner - 0.5 * edge;
    }
    cell.corner = corner;
    return cell;
  }
  PeriodicCell periods = cell_of(c.setting);
  periods.moved_for = time;
  for (std::size_t d = 0; d < 3; ++d) {
    cell.periodic[d] = periods.lengths[d] > 0;
    Vector& edge = cell.edges[d];
    edge[d] = to[d] - cell.corner[d];
    if (!cell.periodic[d]) continue;
    Periods one{};
    one[d] = 1;
    edge = shift_of(periods, one);
  }
  // The images of a sheared cell have moved. They are the same for the shortest second edge.
  auto& [first, second, third] = cell.edges;
  if (cell.periodic[0] && cell.periodic[1] && periods.is_sheared())
    second = second - std::round(dot(second, first) / dot(first, first)) * first;
  return cell;
}

/// A property of the particles: an array of the points of a frame, and its columns in the file.
struct XyzColumn {
  const char* array;  ///< in a frame
  const char* name;   ///< in the file
  std::size_t count;  ///< of a particle
  bool is_whole;
};

/// Reads frames and writes them as text.
class XyzText {
 public:
  /// The columns are those that `last` has, because OVITO reads the names of the first frame only,
  /// and a source may add particles with more properties later.
  XyzText(const ParticlesCase& c, const VtkReader& last) : case_(c) {
    for (const XyzColumn& column : std::to_array<XyzColumn>({{"velocity", "velo", 3, false},
                                                             {"radius", "radius", 1, false},
                                                             {"mass", "mass", 1, false},
                                                             {"id", "id", 1, true},
                                                             {"body", "body", 1, true},
                                                             {"angle", "angle", 1, false}}))
      if (last.has_array("PointData", column.array)) columns_.push_back(column);
    is_turned_ = last.has_array("PointData", "orientation") || last.has_array("PointData", "angle");
  }

  std::string of(const VtkReader& frame, double time) const {
    const auto radii = frame.array<double>("PointData", "radius");
    const auto points = numbers(frame, {"Points", "", 3, false}, radii.size(), "Points");
    std::vector<std::vector<double>> lists;
    for (const auto& column : columns_) lists.push_back(numbers(frame, column, radii.size()));
    const auto orientations = orientations_of(frame, radii.size());
    const auto omegas = angular_velocities_of(frame, radii.size());
    const auto sums = sums_of_contacts(frame, radii.size());
    std::string text = fmt::format("{}\n{}\n", radii.size(), header(frame, time, radii));
    for (std::size_t k = 0; k < radii.size(); ++k) {
      text += 'X';
      const auto put = [&](const std::vector<double>& list, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) text += ' ' + format_number(list[k * count + i]);
      };
      put(points, 3);
      for (std::size_t n = 0; n < columns_.size(); ++n) put(lists[n], columns_[n].count);
      if (is_turned_) {
        put(orientations, 4);
        put(omegas, 3);
      }
      put(sums, kSums);
      text += '\n';
    }
    return text;
  }

 private:
  static constexpr std::size_t kSums = 3;

  std::string header(const VtkReader& frame, double time, const std::vector<double>& radii) const {
    const double largest = radii.empty() ? 0 : std::ranges::max(radii);
    std::string text;
    std::array<bool, 3> periodic{};
    if (const auto cell = cell_at(case_, frame, time, largest > 0 ? largest : 1)) {
      periodic = cell->periodic;
      text =
          fmt::format("Lattice=\"{} {} {}\" Origin=\"{}\" ", in_words(cell->edges[0]),
                      in_words(cell->edges[1]), in_words(cell->edges[2]), in_words(cell->corner));
    }
    const auto letter = [&](std::size_t d) { return periodic[d] ? 'T' : 'F'; };
    text += fmt::format("pbc=\"{} {} {}\" Properties=species:S:1:pos:R:3", letter(0), letter(1),
                        letter(2));
    for (const auto& column : columns_)
      text += fmt::format(":{}:{}:{}", column.name, column.is_whole ? 'I' : 'R', column.count);
    if (is_turned_) text += ":orientation:R:4:omega:R:3";
    return text + ":gamma:R:1:normal_force:R:1:contacts:I:1 Time=" + format_number(time);
  }

  /// The numbers of a column for each of `count` particles, 0 if the frame does not have them.
  static std::vector<double> numbers(const VtkReader& frame, const XyzColumn& column,
                                     std::size_t count, const char* section = "PointData") {
    std::vector<double> values(count * column.count);
    if (!frame.has_array(section, column.array)) return values;
    if (column.is_whole) {
      const auto whole = frame.array<std::int32_t>(section, column.array);
      values.assign(whole.begin(), whole.end());
    } else {
      values = frame.array<double>(section, column.array);
    }
    if (values.size() != count * column.count) frame.refuse();
    return values;
  }

  /// Unit quaternions x, y, z, w, in OVITO's order.
  std::vector<double> orientations_of(const VtkReader& frame, std::size_t count) const {
    std::vector<double> turned;
    if (frame.has_array("PointData", "orientation")) {
      const auto q = numbers(frame, {"orientation", "", 4, false}, count);
      for (std::size_t k = 0; k < q.size(); k += 4)
        turned.insert(turned.end(), {q[k + 1], q[k + 2], q[k + 3], q[k]});
    } else if (is_turned_) {
      for (const double angle : numbers(frame, {"angle", "", 1, false}, count))
        turned.insert(turned.end(), {0, 0, std::sin(angle / 2), std::cos(angle / 2)});
    }
    return turned;
  }

  std::vector<double> angular_velocities_of(const VtkReader& frame, std::size_t count) const {
    if (!is_turned_) return {};
    if (case_.particles.dimension == 3)
      return numbers(frame, {"angular_velocity", "", 3, false}, count);
    std::vector<double> omegas;
    for (const double omega : numbers(frame, {"angular_velocity", "", 1, false}, count))
      omegas.insert(omegas.end(), {0, 0, omega});
    return omegas;
  }

  /// For each particle the sums over its contacts of gamma and of the normal force, and their
  /// number.
  static std::vector<double> sums_of_contacts(const VtkReader& frame, std::size_t count) {
    const auto gammas = frame.array<double>("CellData", "gamma");
    const auto forces = frame.array<double>("CellData", "normal_force");
    // A contact with an obstacle has one entry, a contact of two particles two.
    const auto vertices = frame.array<std::int64_t>("Verts", "connectivity");
    const auto lines = frame.array<std::int64_t>("Lines", "connectivity");
    if (gammas.size() != vertices.size() + lines.size() / 2 || lines.size() % 2 != 0 ||
        forces.size() != gammas.size())
      frame.refuse();
    std::vector<double> sums(kSums * count);
    const auto add = [&](std::int64_t particle, std::size_t contact) {
      if (particle < 0 || particle >= static_cast<std::int64_t>(count)) frame.refuse();
      const auto at = kSums * static_cast<std::size_t>(particle);
      sums[at] += gammas[contact];
      sums[at + 1] += forces[contact];
      sums[at + 2] += 1;
    };
    for (std::size_t i = 0; i < vertices.size(); ++i) add(vertices[i], i);
    for (std::size_t i = 0; i < lines.size(); ++i) add(lines[i], vertices.size() + i / 2);
    return sums;
  }

  const ParticlesCase& case_;
  std::vector<XyzColumn> columns_;
  bool is_turned_ = false;
};

}  // namespace

void write_xyz(const ParticlesCase& c, const fs::path& folder,
               const results::Provenance& provenance) {
  const fs::path path = folder / "particles.xyz";
  const auto frames = read_pvd(folder / "particles.pvd");
  if (frames.empty()) throw_bad_input({(folder / "particles.pvd").string()}, "has no frame");
  const auto read = [&](const std::string& name) { return read_file(folder / name); };
  const auto reader = [&](const std::string& text, const std::string& name) {
    return VtkReader(text, (folder / name).string(), "frame");
  };
  const auto last = read(frames.back().second);
  const XyzText lines(c, reader(last, frames.back().second));
  write_file_by(path, [&](const fs::path& place) {
    const Descriptor file(::open(place.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    bool is_first = true;
    for (const auto& [time, name] : frames) {
      const auto frame = read(name);
      auto text = lines.of(reader(frame, name), time);
      if (is_first) text = results::output_text(path, TextKind::kXyz, text, provenance);
      is_first = false;
      if (!write_all(file, text))
        throw_bad_input({path.string()}, "cannot be written ({})", std::strerror(errno));
    }
  });
}

}  // namespace viscontact::particles
