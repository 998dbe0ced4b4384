// Writes bodies.csv, hinges.csv, springs.csv and arms.csv, and links as VTK PolyData; link_file.hpp
// has the columns. Numbers are in the units of the case: times [T], lengths [L], angles [rad],
// velocities [L/T, 1/T], forces [M L/T^2], torques [M L^2/T^2] and powers [M L^2/T^3]; forces,
// torques and powers are per length for discs in a fluid. Links and bodies are numbered from 0;
// forces are 0 before the first step. Nothing is checked or thrown. A change must keep the names
// and the order of the columns and arrays, and the numbers of Kind, which docs/file-formats.md
// states and users' scripts read. Used by run/.
#include "viscontact/particles/io/link_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "viscontact/common/text/number.hpp"
#include "viscontact/common/vtk/vtk_xml.hpp"
#include "viscontact/particles/membranes/membrane.hpp"

namespace viscontact::particles {
namespace {

/// A row: time, id, `values`, and the text `further` with more fields, each after a comma.
std::string row(double time, std::size_t id, const std::vector<double>& values,
                const std::string& further = "") {
  std::string text = fmt::format("{},{}", format_number(time), id);
  for (const double value : values) text += "," + format_number(value);
  return text + further + "\n";
}

/// In a fluid, a comma and a field with the error of the force at `place` in State::link_forces. If
/// `count` is 2, it is the error of the vector of the two forces from there. The field is empty if
/// no error is known. Without a fluid the text is empty.
std::string error_field(const Setting& setting, std::span<const double> errors, std::size_t place,
                        std::size_t count = 1) {
  if (!setting.fluid) return "";
  if (errors.empty()) return ",";
  return "," +
         format_number(count == 1 ? errors[place] : std::hypot(errors[place], errors[place + 1]));
}

/// Adds the first `count` components of a vector, at most 3.
void append(std::vector<double>& values, const Vector& vector, std::size_t count) {
  values.insert(values.end(), vector.begin(), vector.begin() + static_cast<std::ptrdiff_t>(count));
}

/// The force or torque at this place of State::link_forces; 0 before the first step.
double force_of(const State& state, std::size_t place) {
  return state.link_forces.empty() ? 0 : state.link_forces[place];
}

/// Distance [L] from the centre of particle `first` to the nearest image of particle `second`.
double distance(const Particles& p, std::int32_t first, std::int32_t second) {
  return norm(nearest_image(p.cell, p.position(index_of(second)) - p.position(index_of(first))));
}

/// The rows of bodies.csv: time, number, centre, angle or, in space, quaternion (w, x, y, z),
/// velocity and angular velocity, in the order that time_tables() names.
std::string body_rows(const Setting& /*setting*/, const State& state,
                      std::span<const double> /*force_errors*/) {
  std::string text;
  const auto& p = state.particles;
  for (std::size_t b = 0; b < p.bodies.count(); ++b) {
    const auto& body = p.bodies.bodies[b];
    const Vector& w = body.angular_velocity;
    std::vector<double> values;
    if (p.dimension == 3) {
      append(values, body.centre, 3);
      append(values, body.velocity, 3);
      values.insert(values.end(), body.orientation.begin(), body.orientation.end());
      append(values, w, 3);
    } else {
      values = {body.centre[0],   body.centre[1],   body.angle[2],
                body.velocity[0], body.velocity[1], w[2]};
    }
    text += row(state.time, b, values);
  }
  return text;
}

/// The rows of hinges.csv: the force of the hinge on the particle or body that it holds. In the
/// plane the torque of its torsion spring and stops, estimates of errors in a fluid, and the angle
/// and angular velocity of the particle or body follow.
std::string hinge_rows(const Setting& setting, const State& state,
                       std::span<const double> force_errors) {
  std::string text;
  const auto forces = Links::forces_of_hinge(state.particles.dimension);
  for (std::size_t k = 0; k < setting.links.hinges.size(); ++k) {
    std::vector<double> values;
    for (std::size_t i = 0; i < forces; ++i) values.push_back(force_of(state, k * forces + i));
    std::string errors = error_field(setting, force_errors, k * forces, 2);
    if (state.particles.dimension == 2) {
      errors += error_field(setting, force_errors, k * forces + 2);
      const auto particle = index_of(setting.links.hinges[k].point.particle);
      const auto& p = state.particles;
      const auto body = p.bodies.of_particle.empty() ? -1 : p.bodies.of_particle[particle];
      const double angle = body < 0 ? p.angles[particle] : p.bodies.bodies[index_of(body)].angle[2];
      errors += "," + format_number(angle) + "," + format_number(p.angular_velocities[particle]);
    }
    text += row(state.time, k, values, errors);
  }
  return text;
}

/// The rows of springs.csv: the distance of the ends, the force, > 0 if it pushes the ends apart,
/// and in a fluid an estimate of its error.
std::string spring_rows(const Setting& setting, const State& state,
                        std::span<const double> force_errors) {
  std::string text;
  const auto& springs = setting.links.springs;
  for (std::size_t k = 0; k < springs.size(); ++k) {
    const auto place = setting.links.place_of_spring(k, state.particles.dimension);
    text += row(
        state.time, k,
        {distance(state.particles, springs[k].first, springs[k].second), force_of(state, place)},
        error_field(setting, force_errors, place));
  }
  return text;
}

/// The rows of arms.csv: the distance of the ends, the force, > 0 if it pushes the ends apart, the
/// power, > 0 if the arm does work on the particles, and in a fluid an estimate of the error of the
/// force.
std::string arm_rows(const Setting& setting, const State& state,
                     std::span<const double> force_errors) {
  std::string text;
  const auto& arms = setting.links.arms;
  for (std::size_t k = 0; k < arms.size(); ++k) {
    const auto place = setting.links.place_of_arm(k, state.particles.dimension);
    text += row(state.time, k,
                {distance(state.particles, arms[k].first, arms[k].second), force_of(state, place),
                 state.arm_powers.empty() ? 0 : state.arm_powers[k]},
                error_field(setting, force_errors, place));
  }
  return text;
}

}  // namespace

/// The tables of a case, each with the line of its column names; tables of things that the case
/// does not have are left out.
std::vector<TimeTable> time_tables(const Setting& setting, const Particles& particles) {
  const bool in_space = particles.dimension == 3;
  const auto& links = setting.links;
  const std::string error = setting.fluid ? ",force_error_estimate" : "";
  const std::string torque_error = setting.fluid ? ",torque_error_estimate" : "";
  std::vector<TimeTable> tables;
  const auto add = [&](const char* name, const std::string& columns, std::size_t count,
                       auto* rows) {
    if (count > 0) tables.push_back({name, "time,id," + columns + "\n", rows});
  };
  add("bodies.csv",
      in_space ? "x,y,z,vx,vy,vz,orientation_w,orientation_x,orientation_y,orientation_z,"
                 "angular_velocity_x,angular_velocity_y,angular_velocity_z"
               : "x,y,angle,vx,vy,angular_velocity",
      particles.bodies.count(), body_rows);
  add("hinges.csv",
      in_space ? "force_x,force_y,force_z"
               : "force_x,force_y,torque" + error + torque_error + ",angle,angular_velocity",
      links.hinges.size(), hinge_rows);
  add("springs.csv", "length,force" + error, links.springs.size(), spring_rows);
  add("arms.csv", "length,force,power" + error, links.arms.size(), arm_rows);
  add("membranes.csv", kMembraneColumns, membranes_of(setting).size(), membrane_rows);
  return tables;
}

namespace {

// The numbers 0 to 3 that the array `kind` has in VTK files.
enum class Kind : std::int32_t { kHinge, kSpring, kArm, kMembrane };

/// The arrays of the VTK file. Points [L] and forces [M L/T^2] have three numbers each; there is
/// one force, kind and id for each cell.
struct DrawnCells {
  std::vector<double> points, forces;
  std::vector<std::int32_t> kinds, ids;
  PolyCells cells;

  /// Adds a point and returns its number, from 0.
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

/// The components in space of a vector, which on an axis has only one, along z.
Vector in_space(const Vector& x, int dimension) { return dimension == 1 ? Vector{0, 0, x[0]} : x; }

/// Adds the line of a spring or arm, or the line between two neighbouring particles (beads) of a
/// membrane. A `force` > 0 [M L/T^2] pushes the ends of the line apart. The array `force` gets the
/// vector of the force on the second end.
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

/// The content of a VTK file with a vertex for each hinge and a line for each spring, for each arm
/// and for each two neighbouring beads of a membrane, in this order, with the arrays kind, id (the
/// number of the link or membrane) and force.
std::string write_links(const Setting& setting, const State& state) {
  const auto& p = state.particles;
  const auto& links = setting.links;
  DrawnCells drawn;
  for (std::size_t k = 0; k < links.hinges.size(); ++k) {
    drawn.cells.add_vertex(drawn.add_point(links.hinges[k].at));
    Vector on_body{};
    for (std::size_t d = 0; d < static_cast<std::size_t>(p.dimension); ++d)
      on_body[d] = force_of(state, k * Links::forces_of_hinge(p.dimension) + d);
    drawn.add_cell(Kind::kHinge, k, on_body);
  }
  for (std::size_t k = 0; k < links.springs.size(); ++k)
    add_line(drawn, p, Kind::kSpring, k, links.springs[k].first, links.springs[k].second,
             force_of(state, links.place_of_spring(k, p.dimension)));
  for (std::size_t k = 0; k < links.arms.size(); ++k)
    add_line(drawn, p, Kind::kArm, k, links.arms[k].first, links.arms[k].second,
             force_of(state, links.place_of_arm(k, p.dimension)));
  for (std::size_t m = 0; m < links.membranes.size(); ++m) {
    const auto& membrane = links.membranes[m];
    const auto first = links.place_of_membrane(m, p.dimension);
    for (std::int32_t k = 0; k < membrane.count(); ++k)
      add_line(drawn, p, Kind::kMembrane, m, membrane.bead(k), membrane.bead(k + 1),
               force_of(state, first + static_cast<std::size_t>(k)));
  }
  auto text = vtk_opening("PolyData");
  text += drawn.cells.opening(drawn.points.size() / 3);
  text += "<CellData Scalars=\"kind\" Vectors=\"force\">\n";
  text += vtk_array("kind", 1, drawn.kinds);
  text += vtk_array("id", 1, drawn.ids);
  text += vtk_array("force", 3, drawn.forces);
  text += "</CellData>\n" + drawn.cells.closing(drawn.points);
  text += kVtkClosing;
  return text;
}

}  // namespace viscontact::particles
