// link_file.hpp has the columns.
#include "viscontact/particle_runs/io/link_file.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <cstdint>

#include "viscontact/common/text/number.hpp"
#include "viscontact/common/vtk/vtk_xml.hpp"
#include "viscontact/membranes/membrane_shape.hpp"

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
  assert(place + count <= errors.size());
  return "," +
         format_number(count == 1 ? errors[place] : std::hypot(errors[place], errors[place + 1]));
}

void append(std::vector<double>& values, const Vector& vector, std::size_t count) {
  assert(count <= vector.size());
  values.insert(values.end(), vector.begin(), vector.begin() + static_cast<std::ptrdiff_t>(count));
}

/// The force or torque at this place of State::link_forces; 0 before the first step.
double force_of(const State& state, std::size_t place) {
  assert(state.link_forces.empty() || place < state.link_forces.size());
  return state.link_forces.empty() ? 0 : state.link_forces[place];
}

/// The distance from the centre of particle `first` to the nearest image of particle `second` [L].
double distance(const Particles& p, std::int32_t first, std::int32_t second) {
  return norm(nearest_image(p.cell, p.position(index_of(second)) - p.position(index_of(first))));
}

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

/// In the plane the torque, estimates of errors in a fluid, and the motion follow the force.
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

enum class Kind : std::int32_t { kHinge, kSpring, kArm, kMembrane };

/// The arrays of the VTK file, three numbers for each point [L]; each cell has one force [M L/T^2],
/// kind and id.
struct DrawnCells {
  std::vector<double> points, forces;
  std::vector<std::int32_t> kinds, ids;
  PolyCells cells;

  /// Returns the number of the point, from 0.
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

/// A vector on an axis has only one component, along z.
Vector in_space(const Vector& x, int dimension) { return dimension == 1 ? Vector{0, 0, x[0]} : x; }

/// A `force` > 0 [M L/T^2] pushes the ends apart; the array `force` gets that on the second end.
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
