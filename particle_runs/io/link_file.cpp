// link_file.hpp has the columns.
#include "viscontact/particle_runs/io/link_file.hpp"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>

#include "viscontact/common/vtk/vtk_xml.hpp"
#include "viscontact/membranes/membrane_shape.hpp"

namespace viscontact::particles {
namespace {

/// Estimates of errors in a fluid; without one their columns are missing.
constexpr Presence kOfFluid = only_over_time(kInFluid);
constexpr Condition kInSpace{[](const RunFacts& run) { return run.dimension == 3; }, "in 3D"};
constexpr Condition kInPlane{[](const RunFacts& run) { return run.dimension < 3; }, "in 2D"};
constexpr Condition kInFluidInPlane{
    [](const RunFacts& run) { return run.is_in_fluid && run.dimension < 3; }, "in a fluid"};

/// The error of the force at `place` in State::link_forces. If `count` is 2, it is the error of the
/// vector of the two forces from there. There is none if no error is known.
std::optional<double> error_of(std::span<const double> errors, std::size_t place,
                               std::size_t count = 1) {
  if (errors.empty()) return {};
  assert(place + count <= errors.size());
  return count == 1 ? errors[place] : std::hypot(errors[place], errors[place + 1]);
}

template <class Row>
CsvTable<Row> table_of_links(const std::vector<Column<Row>>& columns, const Setting& setting,
                             int dimension) {
  RunFacts run;
  run.dimension = dimension;
  run.is_in_fluid = setting.fluid.has_value();
  return {columns_in(Output::kOverTime, columns, run), dimension};
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

struct BodyRow {
  double time;
  std::size_t id;
  const BodyMotion& body;
};

const std::vector<Column<BodyRow>>& body_columns() {
  static const std::vector<Column<BodyRow>> columns = {
      column<BodyRow>({"time", "T"}, [](const BodyRow& row) { return row.time; }),
      column<BodyRow>({"id", "", "number of the body in the case, from 0"},
                      [](const BodyRow& row) { return row.id; }),
      column<BodyRow>({"centre", "L", "of mass", {}, ""},
                      [](const BodyRow& row) { return row.body.centre; }),
      column<BodyRow>({"angle", "", "the turn since the start", only_over_time(kInPlane)},
                      [](const BodyRow& row) { return row.body.angle[2]; }),
      column<BodyRow>({"velocity", "L/T", "of the centre of mass", {}, "v"},
                      [](const BodyRow& row) { return row.body.velocity; }),
      column<BodyRow>({"orientation", "", "the turn since the start", only_over_time(kInSpace)},
                      [](const BodyRow& row) { return Quaternion(row.body.orientation); }),
      column<BodyRow>({"angular_velocity", "1/T", ""},
                      [](const BodyRow& row) { return Turn{row.body.angular_velocity}; }),
  };
  return columns;
}

std::string body_rows(const Setting& setting, const State& state,
                      std::span<const double> /*force_errors*/) {
  const auto& p = state.particles;
  const auto table = table_of_links(body_columns(), setting, p.dimension);
  std::string text;
  for (std::size_t b = 0; b < p.bodies.count(); ++b)
    table.add(text, {state.time, b, p.bodies.bodies[b]});
  return text;
}

struct HingeRow {
  double time;
  std::size_t id;
  Vector force;
  double torque;
  std::optional<double> force_error_estimate, torque_error_estimate;
  double angle, angular_velocity;
};

const std::vector<Column<HingeRow>>& hinge_columns() {
  static const std::vector<Column<HingeRow>> columns = {
      column<&HingeRow::time>({"time", "T"}),
      column<&HingeRow::id>({"id", "", "number of the hinge in the case, from 0"}),
      column<&HingeRow::force>({"force", "M L/T²", "on the body"}),
      column<&HingeRow::torque>({"torque", "M L²/T²",
                                 "of the torsion spring and the stops on the body",
                                 only_over_time(kInPlane)}),
      column<&HingeRow::force_error_estimate>(
          {"force_error_estimate", "M L/T²", "", only_over_time(kInFluidInPlane)}),
      column<&HingeRow::torque_error_estimate>(
          {"torque_error_estimate", "M L²/T²", "", only_over_time(kInFluidInPlane)}),
      column<&HingeRow::angle>(
          {"angle", "", "of the body in radians, counter-clockwise", only_over_time(kInPlane)}),
      column<&HingeRow::angular_velocity>(
          {"angular_velocity", "1/T", "of the body", only_over_time(kInPlane)}),
  };
  return columns;
}

std::string hinge_rows(const Setting& setting, const State& state,
                       std::span<const double> force_errors) {
  const auto& p = state.particles;
  const auto table = table_of_links(hinge_columns(), setting, p.dimension);
  const auto forces = Links::forces_of_hinge(p.dimension);
  std::string text;
  for (std::size_t k = 0; k < setting.links.hinges.size(); ++k) {
    HingeRow row{};
    row.time = state.time;
    row.id = k;
    for (std::size_t d = 0; d < static_cast<std::size_t>(p.dimension); ++d)
      row.force[d] = force_of(state, k * forces + d);
    if (p.dimension == 2) {
      row.torque = force_of(state, k * forces + 2);
      row.force_error_estimate = error_of(force_errors, k * forces, 2);
      row.torque_error_estimate = error_of(force_errors, k * forces + 2);
      const auto particle = index_of(setting.links.hinges[k].point.particle);
      const auto body = p.bodies.of_particle.empty() ? -1 : p.bodies.of_particle[particle];
      row.angle = body < 0 ? p.angles[particle] : p.bodies.bodies[index_of(body)].angle[2];
      row.angular_velocity = p.angular_velocities[particle];
    }
    table.add(text, row);
  }
  return text;
}

/// A row of springs.csv or arms.csv.
struct LineRow {
  double time;
  std::size_t id;
  double length, force, power;
  std::optional<double> force_error_estimate;
};

/// Springs have no power.
std::vector<Column<LineRow>> line_columns(bool is_arm) {
  std::vector<Column<LineRow>> columns = {
      column<&LineRow::time>({"time", "T"}),
      column<&LineRow::id>({"id", "", "number in the case, from 0"}),
      column<&LineRow::length>({"length", "L", "distance of the centres"}),
      column<&LineRow::force>({"force", "M L/T²", "> 0 where it pushes the ends apart"}),
  };
  if (is_arm)
    columns.push_back(column<&LineRow::power>(
        {"power", "M L²/T³", "> 0 where the arm does work on the particles"}));
  columns.push_back(
      column<&LineRow::force_error_estimate>({"force_error_estimate", "M L/T²", "", kOfFluid}));
  return columns;
}

const std::vector<Column<LineRow>>& spring_columns() {
  static const auto columns = line_columns(false);
  return columns;
}
const std::vector<Column<LineRow>>& arm_columns() {
  static const auto columns = line_columns(true);
  return columns;
}

std::string spring_rows(const Setting& setting, const State& state,
                        std::span<const double> force_errors) {
  const auto& p = state.particles;
  const auto table = table_of_links(spring_columns(), setting, p.dimension);
  const auto& springs = setting.links.springs;
  std::string text;
  for (std::size_t k = 0; k < springs.size(); ++k) {
    const auto place = setting.links.place_of_spring(k, p.dimension);
    table.add(text, {state.time, k, distance(p, springs[k].first, springs[k].second),
                     force_of(state, place), 0, error_of(force_errors, place)});
  }
  return text;
}

std::string arm_rows(const Setting& setting, const State& state,
                     std::span<const double> force_errors) {
  const auto& p = state.particles;
  const auto table = table_of_links(arm_columns(), setting, p.dimension);
  const auto& arms = setting.links.arms;
  std::string text;
  for (std::size_t k = 0; k < arms.size(); ++k) {
    const auto place = setting.links.place_of_arm(k, p.dimension);
    table.add(text,
              {state.time, k, distance(p, arms[k].first, arms[k].second), force_of(state, place),
               state.arm_powers.empty() ? 0 : state.arm_powers[k], error_of(force_errors, place)});
  }
  return text;
}

struct MembraneRow {
  double time;
  std::size_t id;
  MembraneMeasures measures;
};

template <auto kMember>
Column<MembraneRow> of_membrane(const Declaration& declaration) {
  return column<MembraneRow>(declaration,
                             [](const MembraneRow& row) { return row.measures.*kMember; });
}

const std::vector<Column<MembraneRow>>& membrane_columns() {
  using Measures = MembraneMeasures;
  static const std::vector<Column<MembraneRow>> columns = {
      column<&MembraneRow::time>({"time", "T"}),
      column<&MembraneRow::id>({"id", "", "number of the membrane in the case, from 0"}),
      of_membrane<&Measures::x>({"x", "L", "of the centre of the area inside"}),
      of_membrane<&Measures::y>({"y", "L", "likewise"}),
      of_membrane<&Measures::inclination>(
          {"inclination", "", "direction of the long axis of this area, from -pi/2 to pi/2"}),
      of_membrane<&Measures::area>({"area", "L²", "inside"}),
      of_membrane<&Measures::perimeter>({"perimeter", "L"}),
      of_membrane<&Measures::membrane_speed>(
          {"membrane_speed", "L/T", "mean speed of the beads relative to their mean velocity"}),
      of_membrane<&Measures::tank_treading_frequency>(
          {"tank_treading_frequency", "1/T",
           "number of turns per time that the membrane makes around the area inside relative to "
           "its long axis, positive counter-clockwise"}),
  };
  return columns;
}

std::string membrane_rows(const Setting& setting, const State& state,
                          std::span<const double> /*force_errors*/) {
  const auto table = table_of_links(membrane_columns(), setting, state.particles.dimension);
  const auto& membranes = membranes_of(setting);
  std::string text;
  for (std::size_t m = 0; m < membranes.size(); ++m)
    table.add(text, {state.time, m, measure(membranes[m], state.particles)});
  return text;
}

}  // namespace

std::vector<TimeTable> time_tables(const Setting& setting, const Particles& particles) {
  const auto& links = setting.links;
  std::vector<TimeTable> tables;
  const auto add = [&](const char* name, const auto& columns, std::size_t count, auto* rows) {
    if (count == 0) return;
    tables.push_back({name, table_of_links(columns, setting, particles.dimension).header(), rows});
  };
  add("bodies.csv", body_columns(), particles.bodies.count(), body_rows);
  add("hinges.csv", hinge_columns(), links.hinges.size(), hinge_rows);
  add("springs.csv", spring_columns(), links.springs.size(), spring_rows);
  add("arms.csv", arm_columns(), links.arms.size(), arm_rows);
  add("membranes.csv", membrane_columns(), membranes_of(setting).size(), membrane_rows);
  return tables;
}

std::vector<ColumnTable> link_column_tables() {
  return {
      column_table("`bodies.csv`", body_columns()), column_table("`hinges.csv`", hinge_columns()),
      column_table("`springs.csv`", spring_columns()), column_table("`arms.csv`", arm_columns()),
      column_table("`membranes.csv`", membrane_columns())};
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
