// contact_file.hpp has the columns.
#include "viscontact/particle_runs/io/contact_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <iterator>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/particle_runs/io/particle_file.hpp"
#include "viscontact/particles/domain/bounded_region.hpp"
#include "viscontact/particles/domain/domain.hpp"

namespace viscontact::particles {
namespace {

/// One letter for each axis; for particles on an axis only z.
std::string_view axes_of(int dimension) {
  return dimension == 1 ? "z"
                        : std::string_view("xyz").substr(0, static_cast<std::size_t>(dimension));
}

/// Each name is a comma, `begin` and an axis, as in ",force_x,force_y".
std::string components(std::string_view begin, int dimension) {
  std::string text;
  for (const char axis : axes_of(dimension)) text += fmt::format(",{}{}", begin, axis);
  return text;
}

void add(std::string& text, const Vector& x, int dimension) {
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
    (text += ',') += format_number(x[d]);
}

/// The columns of write_contacts() that follow those of gamma.
std::string force_columns(int dimension, bool has_friction) {
  auto text = ",normal_force" + (dimension == 1 ? "" : components("tangential_force_", dimension));
  for (const auto& field : kMemoryFields)
    if (field.is_shown) (text += ',') += field.name;
  return text + (has_friction ? ",solid_force" : "");
}

/// Adds the fields of force_columns() and a line break.
void add_forces(std::string& text, const CurrentContact& contact, int dimension,
                bool has_friction) {
  (text += ',') += format_number(contact.normal_force);
  if (dimension > 1) add(text, contact.tangential_force, dimension);
  for (const double number : contact.shown) (text += ',') += format_number(number);
  if (has_friction) (text += ',') += format_number(contact.solid_force);
  text += '\n';
}

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

/// The force on the second particle of the contact [M L/T^2].
Vector force_of(const CurrentContact& contact) {
  return contact.normal_force * contact.normal + contact.tangential_force;
}

/// Calls `visit` for each contact of the last step, and for each contact of the collisions in it
/// (State::impacts), whose impulse is divided by the length of the step. The arguments are the
/// number of the first particle, or -1 - k for obstacle k; the mean force on the second particle [M
/// L/T^2]; and the branch [L], the vector to the centre of the second particle from that of the
/// first or from the nearest point of the obstacle.
template <class Visit>
void for_forces(const Setting& setting, const State& state, const Visit& visit) {
  assert(state.impacts.empty() || state.earlier_step > 0);
  for (const auto& contact : contacts_of(setting, state))
    visit(contact.first, force_of(contact), contact.branch);
  for (const auto& impact : state.impacts)
    visit(impact.first, (1 / state.earlier_step) * impact.impulse, impact.branch);
}

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
  std::string text;
  for (std::size_t k = walls; k < obstacles.size(); ++k) {
    if (!obstacles[k].load) continue;
    assert(k - walls < state.planes.size());
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

std::string stress_row(const Setting& setting, const State& state, std::span<const double>) {
  auto text = format_number(state.time);
  for (const double component : contact_stress(setting, state))
    (text += ',') += format_number(component);
  return text + "\n";
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
