// Writes contacts and their forces as CSV tables, in the units of the case: gaps are in [L], gamma
// and impulses in [M L/T], and forces in [M L/T^2]. Gamma, impulses and forces are per length for
// discs in a fluid. The stress is in [M/(L T^2)] for spheres in space, spheres on an axis and discs
// in a fluid, and in [M/T^2] for discs without a fluid. contact_file.hpp has all columns. i and j
// are the ids of two particles; for a contact with an obstacle i is the id of the particle, and j
// is -1, -2, ... for the first, second obstacle. Nothing is checked or thrown; without a domain the
// stress is divided by 0. A change must keep the names and the order of the columns, which
// docs/file-formats.md states and users' scripts read. Used by case/ and run/.
#include "viscontact/particles/io/contact_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/particles/domain/bounded_region.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/io/particle_file.hpp"

namespace viscontact::particles {
namespace {

/// One letter for each axis; for particles on an axis only z.
std::string_view axes_of(int dimension) {
  return dimension == 1 ? "z"
                        : std::string_view("xyz").substr(0, static_cast<std::size_t>(dimension));
}

/// Names of the columns of a vector. Each is a comma, `begin` and an axis, as in
/// ",force_x,force_y".
std::string components(std::string_view begin, int dimension) {
  std::string text;
  for (const char axis : axes_of(dimension)) text += fmt::format(",{}{}", begin, axis);
  return text;
}

/// Adds the components of a vector, each after a comma.
void add(std::string& text, const Vector& x, int dimension) {
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
    (text += ',') += format_number(x[d]);
}

/// Names of the columns of the contact force, of the history variables of the contact laws
/// (kMemoryFields), and of the force that the solids bear, which follow the columns of gamma, minus
/// the impulse that the film of a contact has absorbed.
std::string force_columns(int dimension, bool has_friction) {
  auto text = ",normal_force" + (dimension == 1 ? "" : components("tangential_force_", dimension));
  for (const auto& field : kMemoryFields)
    if (field.is_shown) (text += ',') += field.name;
  return text + (has_friction ? ",solid_force" : "");
}

/// Adds the fields of the columns of force_columns() and a line break: the normal force, > 0 if it
/// pushes, the friction on j (or, at an obstacle, on i), the history variables, and the part of the
/// normal force that the solids bear; forces are in [M L/T^2].
void add_forces(std::string& text, const CurrentContact& contact, int dimension,
                bool has_friction) {
  (text += ',') += format_number(contact.normal_force);
  if (dimension > 1) add(text, contact.tangential_force, dimension);
  for (const double number : contact.shown) (text += ',') += format_number(number);
  if (has_friction) (text += ',') += format_number(contact.solid_force);
  text += '\n';
}

/// The rows of contacts.csv, one for each contact: time,i,j,gap,gamma and the columns of
/// force_columns().
std::string contact_rows(const Setting& setting, const State& state, std::span<const double>) {
  std::string text;
  for (const auto& contact : contacts_of(setting, state)) {
    const auto [i, j] = ids_of(state.particles, contact);
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{}", format_number(state.time), i, j,
                   format_number(contact.gap), format_number(contact.gamma));
    add_forces(text, contact, state.particles.dimension, setting.laws.friction.has_value());
  }
  return text;
}

/// The force of a contact on its second particle [M L/T^2].
Vector force_of(const CurrentContact& contact) {
  return contact.normal_force * contact.normal + contact.tangential_force;
}

/// Calls `visit` for each contact of the last step, and for each contact of the collisions in it
/// (State::blows), whose impulse is divided by the length of the step. The arguments are the number
/// of the first particle, or -1 - k for obstacle k; the mean force on the second particle [M
/// L/T^2]; and the branch [L], the vector to the centre of the second particle from that of the
/// first or from the nearest point of the obstacle.
template <class Visit>
void for_forces(const Setting& setting, const State& state, const Visit& visit) {
  for (const auto& contact : contacts_of(setting, state))
    visit(contact.first, force_of(contact), contact.branch);
  for (const auto& blow : state.blows)
    visit(blow.first, (1 / state.earlier_step) * blow.impulse, blow.branch);
}

/// The rows of walls.csv: time, the number of the obstacle (-1, -2, ...), the components of the
/// mean force of all contacts on it in the last step [M L/T^2], and those of its point [L] and of
/// the velocity of this point [L/T].
std::string wall_rows(const Setting& setting, const State& state, std::span<const double>) {
  const auto forces = wall_forces(setting, state);
  const auto obstacles = obstacles_of(setting, state.planes);
  const auto walls = obstacles.size() - setting.planes.size();
  std::string text;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    text += fmt::format("{},{}", format_number(state.time), -1 - static_cast<int>(k));
    add(text, forces[k], state.particles.dimension);
    const Vector point = obstacles[k].at(state.time).point;
    add(text, point, state.particles.dimension);
    Vector velocity = obstacles[k].surface_velocity(point, state.time);
    if (obstacles[k].load)
      velocity = velocity + state.planes[k - walls].velocity * obstacles[k].start.normal;
    add(text, velocity, state.particles.dimension);
    text += '\n';
  }
  return text;
}

/// The rows of planes.csv, one for each plane under a load.
std::string plane_rows(const Setting& setting, const State& state, std::span<const double>) {
  const auto obstacles = obstacles_of(setting, state.planes);
  const auto walls = obstacles.size() - setting.planes.size();
  std::vector<double> pushes(obstacles.size());
  for_forces(setting, state, [&](std::int32_t first, const Vector& force, const Vector&) {
    if (first >= 0) return;
    const auto k = static_cast<std::size_t>(-1 - first);
    pushes[k] += dot(force, obstacles[k].start.normal);
  });
  std::string text;
  for (std::size_t k = walls; k < obstacles.size(); ++k) {
    if (!obstacles[k].load) continue;
    const auto& motion = state.planes[k - walls];
    const auto& force = obstacles[k].load->force;
    const double load = state.earlier_step > 0
                            ? force.mean(state.time - state.earlier_step, state.time)[0]
                            : force.value(state.time)[0];
    text += fmt::format("{},{}", format_number(state.time), -1 - static_cast<int>(k));
    for (const double number : {motion.displacement, motion.velocity, load, pushes[k]})
      (text += ',') += format_number(number);
    text += '\n';
  }
  return text;
}

/// The row of stress.csv: time and the components of the stress, xx, xy, ..., row by row. Component
/// ij is minus the sum of force i times branch j over all contacts, divided by the area or volume
/// of the region between walls and planes, docs/physics.md (5.19).
std::string stress_row(const Setting& setting, const State& state, std::span<const double>) {
  auto text = format_number(state.time);
  for (const double component : contact_stress(setting, state))
    (text += ',') += format_number(component);
  return text + "\n";
}

/// True if motion.csv has columns for the loads of particles whose motion is given.
bool has_loads(const Setting& setting) { return !setting.fluid && !setting.given_motions.empty(); }

/// The rows of motion.csv (particle_file.hpp).
std::string motion_table_rows(const Setting& setting, const State& state, std::span<const double>) {
  return motion_rows(state.time, state.particles,
                     has_loads(setting) ? &state.given_loads : nullptr);
}

}  // namespace

std::vector<Vector> wall_forces(const Setting& setting, const State& state) {
  std::vector<Vector> forces(obstacles_of(setting).size());
  for_forces(setting, state, [&](std::int32_t first, const Vector& force, const Vector&) {
    if (first >= 0) return;
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

/// A table with a row for each contact: i,j,gap,gamma,gamma_error and the columns of
/// force_columns(). gamma_error [M L/T], >= 0, is an estimate of the error of gamma.
std::string write_contacts(const Particles& particles, std::span<const CurrentContact> contacts,
                           bool has_friction) {
  auto text = fmt::format("# rows: {}\ni,j,gap,gamma,gamma_error{}\n", contacts.size(),
                          force_columns(particles.dimension, has_friction));
  for (const auto& contact : contacts) {
    const auto [i, j] = ids_of(particles, contact);
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{}", i, j, format_number(contact.gap),
                   format_number(contact.gamma), format_number(contact.gamma_error));
    add_forces(text, contact, particles.dimension, has_friction);
  }
  return text;
}

/// The rows of rebounds.csv: time [T], i and j, velocity of the approach [L/T], impulse of the
/// solids in the compression [M L/T], and the velocity after the collision [L/T].
std::string rebound_rows(const Particles& particles, std::span<const Rebound> rebounds) {
  std::string text;
  for (const auto& rebound : rebounds) {
    CurrentContact contact{};
    contact.first = rebound.first;
    contact.second = rebound.second;
    const auto [first, second] = ids_of(particles, contact);
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{}\n", format_number(rebound.time),
                   first, second, format_number(rebound.approach_velocity),
                   format_number(rebound.solid_impulse), format_number(rebound.velocity));
  }
  return text;
}

/// The tables whose names are in `names`; in a fluid motion.csv and contacts.csv always. `tables`
/// must have the order of kAskedTables. Names that are not known are ignored.
std::vector<TimeTable> asked_tables(const Setting& setting, const Particles& particles,
                                    std::span<const std::string> names) {
  const int dimension = particles.dimension;
  const bool turn = particles.turn() || setting.fluid;  // all discs in a fluid turn
  std::string stress;
  for (const char i : axes_of(dimension))
    for (const char j : axes_of(dimension)) stress += fmt::format(",stress_{}{}", i, j);
  const std::array tables = {
      TimeTable{"motion.csv", motion_header(dimension, turn, has_loads(setting)),
                motion_table_rows},
      TimeTable{
          "contacts.csv",
          "time,i,j,gap,gamma" + force_columns(dimension, setting.laws.friction.has_value()) + "\n",
          contact_rows},
      TimeTable{"walls.csv",
                "time,wall" + components("force_", dimension) + components("point_", dimension) +
                    components("velocity_", dimension) + "\n",
                wall_rows},
      TimeTable{"stress.csv", "time" + stress + "\n", stress_row}};
  std::vector<TimeTable> asked;
  if (std::ranges::any_of(setting.planes,
                          [](const Plane& plane) { return plane.load.has_value(); }))
    asked.push_back({kPlanesFile, kPlanesHeader, plane_rows});
  for (std::size_t k = 0; k < tables.size(); ++k)
    if ((setting.fluid && k < 2) || std::ranges::find(names, kAskedTables[k]) != names.end())
      asked.push_back(tables[k]);
  return asked;
}

}  // namespace viscontact::particles
