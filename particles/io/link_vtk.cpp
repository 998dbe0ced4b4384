// Writes hinges, springs and arms as VTK PolyData (link_vtk.hpp). Lengths [L] and forces [M L/T^2]
// are in the units of the case. A change must keep the numbers of Kind, which files contain.
#include "viscontact/particles/io/link_vtk.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "viscontact/common/vtk/appended_data.hpp"

namespace viscontact::particles {
namespace {

enum class Kind : std::int32_t { kHinge, kSpring, kArm };

/// The arrays of the file.
struct DrawnCells {
  std::vector<double> points, forces;
  std::vector<std::int32_t> kinds, ids;
  PolyCells cells;

  std::int64_t add_point(const Vector& x) {
    points.insert(points.end(), x.begin(), x.end());
    return std::ssize(points) / 3 - 1;
  }
  void add_cell(Kind kind, std::size_t id, const Vector& force) {
    kinds.push_back(static_cast<std::int32_t>(kind));
    ids.push_back(static_cast<std::int32_t>(id));
    forces.insert(forces.end(), force.begin(), force.end());
  }
};

/// A place in space; on an axis the first number is along z.
Vector in_space(const Vector& x, int dimension) { return dimension == 1 ? Vector{0, 0, x[0]} : x; }

/// Adds the line of a spring or arm that pushes its ends apart with `force`.
void add_line(DrawnCells& drawn, const Particles& p, Kind kind, std::size_t id, std::int32_t first,
              std::int32_t second, double force) {
  const Vector from = p.position(index_of(first));
  const Vector apart = nearest_image(p.cell, p.position(index_of(second)) - from);
  const auto begin = drawn.add_point(in_space(from, p.dimension));
  const auto end = drawn.add_point(in_space(from + apart, p.dimension));
  drawn.cells.add_line(begin, end);
  const double distance = norm(apart);
  drawn.add_cell(kind, id,
                 distance > 0 ? in_space(force / distance * apart, p.dimension) : Vector{});
}

}  // namespace

std::string write_links(const Setting& setting, const State& state) {
  const auto& p = state.particles;
  const auto& links = setting.links;
  const auto force = [&](std::size_t place) {
    return state.link_forces.empty() ? 0 : state.link_forces[place];
  };
  DrawnCells drawn;
  for (std::size_t k = 0; k < links.hinges.size(); ++k) {
    drawn.cells.add_vertex(drawn.add_point(links.hinges[k].at));
    Vector on_body{};
    for (std::size_t d = 0; d < static_cast<std::size_t>(p.dimension); ++d)
      on_body[d] = force(k * Links::forces_of_hinge(p.dimension) + d);
    drawn.add_cell(Kind::kHinge, k, on_body);
  }
  for (std::size_t k = 0; k < links.springs.size(); ++k)
    add_line(drawn, p, Kind::kSpring, k, links.springs[k].first, links.springs[k].second,
             force(links.place_of_spring(k, p.dimension)));
  for (std::size_t k = 0; k < links.arms.size(); ++k)
    add_line(drawn, p, Kind::kArm, k, links.arms[k].first, links.arms[k].second,
             force(links.place_of_arm(k, p.dimension)));
  AppendedData data;
  auto text = AppendedData::opening("PolyData");
  text += drawn.cells.opening(drawn.points.size() / 3);
  text += "<CellData Scalars=\"kind\" Vectors=\"force\">\n";
  text += data.array("Int32", "kind", 1, drawn.kinds);
  text += data.array("Int32", "id", 1, drawn.ids);
  text += data.array("Float64", "force", 3, drawn.forces);
  text += "</CellData>\n" + drawn.cells.closing(data, drawn.points);
  return text + data.closing();
}

}  // namespace viscontact::particles
