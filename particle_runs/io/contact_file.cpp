// contact_file.hpp has the columns.
#include "viscontact/particle_runs/io/contact_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <iterator>

#include "viscontact/common/error.hpp"
#include "viscontact/particle_runs/io/contact_columns.hpp"
#include "viscontact/particle_runs/io/particle_file.hpp"
#include "viscontact/particles/domain/bounded_region.hpp"
#include "viscontact/particles/domain/domain.hpp"

namespace viscontact::particles {
namespace {

RunFacts facts_of(int dimension, bool has_friction) {
  RunFacts run;
  run.dimension = dimension;
  run.has_friction = has_friction;
  return run;
}

CsvTable<ContactRow> contact_table(Output output, int dimension, bool has_friction) {
  return {columns_in(output, contact_columns(), facts_of(dimension, has_friction)), dimension};
}

std::string contact_rows(const Setting& setting, const State& state, std::span<const double>) {
  const auto table = contact_table(Output::kOverTime, state.particles.dimension,
                                   setting.laws.friction.has_value());
  std::string text;
  for (const auto& contact : contacts_of(setting, state))
    table.add(text, {state.particles, contact, state.time});
  return text;
}

/// The force on the second particle of the contact [M L/T^2].
Vector force_of(const CurrentContact& contact) {
  return contact.normal_force * contact.normal + contact.tangential_force;
}

/// Calls `visit` for each contact of the last step, and for each contact of the collisions in it
/// (State::impact_impulses), whose impulse is divided by the length of the step. The arguments are
/// the number of the first particle, or -1 - k for obstacle k; the mean force on the second
/// particle [M L/T^2]; and the branch [L], the vector to the centre of the second particle from
/// that of the first or from the nearest point of the obstacle.
template <class Visit>
void for_forces(const Setting& setting, const State& state, const Visit& visit) {
  assert(state.impact_impulses.empty() || state.earlier_step > 0);
  for (const auto& contact : contacts_of(setting, state))
    visit(contact.first, force_of(contact), contact.branch);
  for (const auto& impact : state.impact_impulses)
    visit(impact.first, (1 / state.earlier_step) * impact.impulse, impact.branch);
}

struct WallRow {
  double time;
  int wall;
  Vector force, point, velocity;
};

const std::vector<Column<WallRow>>& wall_columns() {
  static const std::vector<Column<WallRow>> columns = {
      column<&WallRow::time>({"time", "T"}),
      column<&WallRow::wall>({"wall", "", "number of the obstacle: -1, -2, ..."}),
      column<&WallRow::force>(
          {"force", "M L/T²",
           "mean force of all contacts on the obstacle in the last step, with the "
           "impulses of its impacts (`restitution`) over the length of the step"}),
      column<&WallRow::point>({"point", "L", "a point of the obstacle, of a circle the centre"}),
      column<&WallRow::velocity>({"velocity", "L/T", "that of this point"}),
  };
  return columns;
}

std::string wall_rows(const Setting& setting, const State& state, std::span<const double>) {
  const auto forces = wall_forces(setting, state);
  const auto obstacles = obstacles_of(setting, state.planes);
  const auto walls = obstacles.size() - setting.planes.size();
  const auto table = table_over_time(wall_columns(), state.particles.dimension);
  std::string text;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const Vector point = obstacles[k].at(state.time).point;
    Vector velocity = obstacles[k].surface_velocity(point, state.time);
    if (obstacles[k].load)
      velocity = velocity + state.planes[k - walls].velocity * obstacles[k].start.normal;
    table.add(text, {state.time, -1 - static_cast<int>(k), forces[k], point, velocity});
  }
  return text;
}

struct PlaneRow {
  double time;
  int wall;
  double displacement, velocity, load, contact_force;
};

const std::vector<Column<PlaneRow>>& plane_columns() {
  static const std::vector<Column<PlaneRow>> columns = {
      column<&PlaneRow::time>({"time", "T"}),
      column<&PlaneRow::wall>({"wall", "", "number of the plane, as in `walls.csv`"}),
      column<&PlaneRow::displacement>({"displacement", "L", "along the normal, since time 0"}),
      column<&PlaneRow::velocity>({"velocity", "L/T", "along the normal"}),
      column<&PlaneRow::load>({"load", "M L/T²", "mean over the last step"}),
      column<&PlaneRow::contact_force>(
          {"contact_force", "M L/T²", "sum of the normal forces of its contacts, a mean likewise"}),
  };
  return columns;
}

std::string plane_rows(const Setting& setting, const State& state, std::span<const double>) {
  const auto obstacles = obstacles_of(setting, state.planes);
  const auto walls = obstacles.size() - setting.planes.size();
  std::vector<double> pushes(obstacles.size());
  for_forces(setting, state, [&](std::int32_t first, const Vector& force, const Vector&) {
    if (first >= 0) return;
    const auto k = static_cast<std::size_t>(-1 - first);
    assert(k < pushes.size());
    pushes[k] += dot(force, obstacles[k].start.normal);
  });
  const auto table = table_over_time(plane_columns(), state.particles.dimension);
  std::string text;
  for (std::size_t k = walls; k < obstacles.size(); ++k) {
    if (!obstacles[k].load) continue;
    assert(k - walls < state.planes.size());
    const auto& motion = state.planes[k - walls];
    const auto& force = obstacles[k].load->force;
    const double load = state.earlier_step > 0
                            ? force.mean(state.time - state.earlier_step, state.time)[0]
                            : force.value(state.time)[0];
    table.add(text, {state.time, -1 - static_cast<int>(k), motion.displacement, motion.velocity,
                     load, pushes[k]});
  }
  return text;
}

struct StressRow {
  double time;
  Tensor stress;
};

const std::vector<Column<StressRow>>& stress_columns() {
  static const std::vector<Column<StressRow>> columns = {
      column<&StressRow::time>({"time", "T"}),
      column<&StressRow::stress>(
          {"stress", "M/(L T²), of discs without a fluid M/T²",
           "mean stress of the contacts in the last step, including its impacts, "
           "[(5.19)](physics.md#5-many-particles-particles)"}),
  };
  return columns;
}

std::string stress_row(const Setting& setting, const State& state, std::span<const double>) {
  std::string text;
  table_over_time(stress_columns(), state.particles.dimension)
      .add(text, {state.time, contact_stress(setting, state)});
  return text;
}

/// The ids are those of both particles.
struct ReboundRow {
  const Rebound& rebound;
  std::pair<std::int32_t, std::int32_t> ids;
};

const std::vector<Column<ReboundRow>>& rebound_columns() {
  static const std::vector<Column<ReboundRow>> columns = {
      column<ReboundRow>({"time", "T", "of the impact"},
                         [](const ReboundRow& row) { return row.rebound.time; }),
      column<ReboundRow>({"first", "", "`i` of contacts"},
                         [](const ReboundRow& row) { return row.ids.first; }),
      column<ReboundRow>({"second", "", "`j` of contacts"},
                         [](const ReboundRow& row) { return row.ids.second; }),
      column<ReboundRow>(
          {"approach_velocity", "L/T",
           "rate of the gap before the impact, < 0; in a fluid 0 if the contact does "
           "not close itself, but the impact of another contact presses on it"},
          [](const ReboundRow& row) { return row.rebound.approach_velocity; }),
      column<ReboundRow>({"solid_impulse", "M L/T",
                          "the impulse s that the solids took in the first phase of the impact"},
                         [](const ReboundRow& row) { return row.rebound.solid_impulse; }),
      column<ReboundRow>({"velocity", "L/T", "rate of the gap after the impact, >= 0"},
                         [](const ReboundRow& row) { return row.rebound.velocity; }),
  };
  return columns;
}

/// True if motion.csv has columns for the loads of particles whose motion is given.
bool has_loads(const Setting& setting) { return !setting.fluid && !setting.given_motions.empty(); }

std::string motion_table_rows(const Setting& setting, const State& state, std::span<const double>) {
  return motion_rows(state.time, state.particles,
                     has_loads(setting) ? &state.given_loads : nullptr);
}

}  // namespace

std::vector<Vector> wall_forces(const Setting& setting, const State& state) {
  std::vector<Vector> forces(obstacles_of(setting).size());
  for_forces(setting, state, [&](std::int32_t first, const Vector& force, const Vector&) {
    if (first >= 0) return;
    assert(-1 - first < std::ssize(forces));
    auto& sum = forces[static_cast<std::size_t>(-1 - first)];
    sum = sum - force;
  });
  return forces;
}

std::vector<double> contact_stress(const Setting& setting, const State& state) {
  const auto n = static_cast<std::size_t>(state.particles.dimension);
  std::vector<double> stress(n * n);
  for_forces(setting, state, [&](std::int32_t, const Vector& force, const Vector& branch) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) stress[i * n + j] -= force[i] * branch[j];
  });
  const auto obstacles = obstacles_of(setting, state.planes);
  const auto places = positions_of(obstacles, state.time);
  const double size = size_of_region(setting.domain, std::span(places).last(setting.planes.size()),
                                     state.particles.dimension);
  if (!(size > 0))
    throw Error(ErrorKind::kBadInput,
                "the planes bound no region at time {}, and a stress is that of a region "
                "(output.tables: \"stress\"); add a [domain], or change the motion of the planes",
                state.time);
  for (double& component : stress) component /= size;
  return stress;
}

std::string write_contacts(const Particles& particles, std::span<const CurrentContact> contacts,
                           bool has_friction) {
  const auto table = contact_table(Output::kAtEnd, particles.dimension, has_friction);
  auto text = fmt::format("# rows: {}\n{}", contacts.size(), table.header());
  for (const auto& contact : contacts) table.add(text, {particles, contact});
  return text;
}

std::string rebounds_header() { return table_over_time(rebound_columns(), 2).header(); }

std::string rebound_rows(const Particles& particles, std::span<const Rebound> rebounds) {
  const auto table = table_over_time(rebound_columns(), particles.dimension);
  std::string text;
  for (const auto& rebound : rebounds) {
    CurrentContact contact{};
    contact.first = rebound.first;
    contact.second = rebound.second;
    table.add(text, {rebound, ids_of(particles, contact)});
  }
  return text;
}

std::vector<ColumnTable> contact_file_tables() {
  return {contact_column_table(), column_table("`walls.csv`", wall_columns()),
          column_table("`stress.csv`", stress_columns()),
          column_table("`planes.csv`", plane_columns()),
          column_table("`rebounds.csv`", rebound_columns())};
}

std::vector<TimeTable> asked_tables(const Setting& setting, const Particles& particles,
                                    std::span<const std::string> names) {
  const int dimension = particles.dimension;
  const bool turn = particles.turn() || setting.fluid;  // all discs in a fluid turn
  const std::array tables = {
      TimeTable{"motion.csv", motion_header(dimension, turn, has_loads(setting)),
                motion_table_rows},
      TimeTable{
          "contacts.csv",
          contact_table(Output::kOverTime, dimension, setting.laws.friction.has_value()).header(),
          contact_rows},
      TimeTable{"walls.csv", table_over_time(wall_columns(), dimension).header(), wall_rows},
      TimeTable{"stress.csv", table_over_time(stress_columns(), dimension).header(), stress_row}};
  std::vector<TimeTable> asked;
  if (std::ranges::any_of(setting.planes,
                          [](const Plane& plane) { return plane.load.has_value(); }))
    asked.push_back(
        {kPlanesFile, table_over_time(plane_columns(), dimension).header(), plane_rows});
  for (std::size_t k = 0; k < tables.size(); ++k)
    if ((setting.fluid && k < 2) || std::ranges::find(names, kAskedTables[k]) != names.end())
      asked.push_back(tables[k]);
  return asked;
}

}  // namespace viscontact::particles
