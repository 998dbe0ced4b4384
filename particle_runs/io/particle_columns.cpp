// A new column of particles is a row of particle_columns().
#include "viscontact/particle_runs/io/particle_columns.hpp"

#include <algorithm>
#include <cassert>

#include "viscontact/immersed/fluid/fluid_solver.hpp"

namespace viscontact::particles {
namespace {

constexpr Condition kAsPoints{[](const RunFacts&) { return false; }, "the points"};
constexpr Condition kWithMass{[](const RunFacts& run) { return run.has_mass; },
                              "if a particle has a mass"};
constexpr Condition kDiscsTurn{
    [](const RunFacts& run) { return run.do_turn && run.dimension == 2; }, "if discs turn"};
constexpr Condition kSpheresTurn{
    [](const RunFacts& run) { return run.do_turn && run.dimension == 3; }, "if spheres turn"};
constexpr Condition kTurn{[](const RunFacts& run) { return run.do_turn && run.dimension > 1; },
                          "if particles turn"};
constexpr Condition kWithBodies{[](const RunFacts& run) { return run.has_bodies; }, "with bodies"};
constexpr Condition kDiscsInFluid{
    [](const RunFacts& run) { return run.is_in_fluid && run.dimension == 2; }, "discs in a fluid"};
constexpr Condition kWithSemiAxes{[](const RunFacts& run) { return run.has_semi_axes; },
                                  "with ellipses or plates"};
constexpr Condition kWithLoads{[](const RunFacts& run) { return run.has_given_loads; },
                               "with given motions, without a fluid"};
constexpr Condition kWithTorques{
    [](const RunFacts& run) { return run.has_given_loads && run.do_turn && run.dimension > 1; },
    "likewise, if particles turn"};

constexpr Presence except_over_time(const Condition& condition) {
  return {.at_end = condition, .over_time = kNever, .frames = condition, .python = condition};
}
constexpr Presence in_tables(const Condition& condition) {
  return {.at_end = condition, .over_time = condition, .frames = kNever, .python = condition};
}
constexpr Presence at_end(const Condition& condition) {
  return {.at_end = condition, .over_time = kNever, .frames = kNever, .python = condition};
}
constexpr Presence not_in_tables(const Condition& condition) {
  return {.at_end = kNever, .over_time = kNever, .frames = condition, .python = condition};
}
constexpr Presence everywhere(const Condition& condition) {
  return {.at_end = condition, .over_time = condition, .frames = condition, .python = condition};
}

/// The numbers of a particle in an array that has `count` for each; zeros of an empty array.
Vector numbers_at(std::span<const double> all, std::size_t k, std::size_t count) {
  Vector numbers{};
  if (!all.empty()) std::ranges::copy(all.subspan(k * count, count), numbers.begin());
  return numbers;
}

/// Of a disc in component 2.
Turn turn_of(const ParticleRow& row, std::span<const double> all) {
  if (row.particles.dimension == 2) return {{0, 0, numbers_at(all, row.k, 1)[0]}};
  return {numbers_at(all, row.k, 3)};
}

/// The components of a motion in the fluid, such as those of a force; none if they are not known.
std::optional<Vector> in_fluid(const ParticleRow& row,
                               std::span<const double> FluidForces::*values) {
  if (row.forces == nullptr || (row.forces->*values).empty()) return {};
  return numbers_at(row.forces->*values, row.k, motion_components(row.particles.dimension));
}
std::optional<double> component(const std::optional<Vector>& vector, std::size_t d) {
  return vector ? std::optional((*vector)[d]) : std::nullopt;
}

template <class Read>
Column<ParticleRow> of_particle(const Declaration& declaration, Read read) {
  return column<ParticleRow>(declaration, read);
}

std::vector<Column<ParticleRow>> make_particle_columns() {
  return {
      of_particle({"time", "T", "", only_over_time()},
                  [](const ParticleRow& row) { return row.time; }),
      of_particle({"id", "", "number of the particle, as in all files"},
                  [](const ParticleRow& row) { return row.particles.id(row.k); }),
      of_particle({"position", "L", "of the centre", {.frames = kAsPoints}, ""},
                  [](const ParticleRow& row) { return row.particles.position(row.k); }),
      of_particle({"velocity", "L/T", "of the centre", {}, "v"},
                  [](const ParticleRow& row) { return row.particles.velocity(row.k); }),
      of_particle(
          {"radius", "L", "half of the length of a plate, the larger semi-axis of an ellipse",
           except_over_time(kAlways)},
          [](const ParticleRow& row) { return row.particles.radii[row.k]; }),
      of_particle({"mass", "M", "", {.over_time = kNever, .frames = kWithMass}},
                  [](const ParticleRow& row) { return row.particles.masses[row.k]; }),
      of_particle({"angle", "", "in radians, counter-clockwise", everywhere(kDiscsTurn)},
                  [](const ParticleRow& row) { return row.particles.angles[row.k]; }),
      of_particle({"orientation", "", "the rotation since the start, w, x, y, z",
                   not_in_tables(kSpheresTurn)},
                  [](const ParticleRow& row) {
                    Quaternion q{};
                    std::copy_n(row.particles.orientations.begin() + std::ptrdiff_t(4 * row.k), 4,
                                q.begin());
                    return q;
                  }),
      of_particle(
          {"angular_velocity", "1/T", "radians in a unit of time", everywhere(kTurn)},
          [](const ParticleRow& row) { return turn_of(row, row.particles.angular_velocities); }),
      of_particle({"body", "", "number of the particle's [body](#bodies-and-links), -1: none",
                   not_in_tables(kWithBodies)},
                  [](const ParticleRow& row) { return row.particles.bodies.of_particle[row.k]; }),
      of_particle({"fluid_force", "M L/T²", "of the fluid on the particle", at_end(kInFluid)},
                  [](const ParticleRow& row) { return in_fluid(row, &FluidForces::values); }),
      of_particle(
          {"fluid_torque", "M L²/T²", "of the fluid on the particle", at_end(kDiscsInFluid)},
          [](const ParticleRow& row) { return component(in_fluid(row, &FluidForces::values), 2); }),
      of_particle(
          {"fluid_force_error_estimate", "M L/T²", "", at_end(kInFluid)},
          [](const ParticleRow& row) { return component(in_fluid(row, &FluidForces::errors), 0); }),
      of_particle(
          {"fluid_torque_error_estimate", "M L²/T²", "that of the force times the radius",
           at_end(kDiscsInFluid)},
          [](const ParticleRow& row) { return component(in_fluid(row, &FluidForces::errors), 2); }),
      of_particle(
          {"semi_axis_1", "L", "along the angle", at_end(kWithSemiAxes)},
          [](const ParticleRow& row) { return row.particles.shapes[row.k].semi_axes()[0]; }),
      of_particle(
          {"semi_axis_2", "L", "", at_end(kWithSemiAxes)},
          [](const ParticleRow& row) { return row.particles.shapes[row.k].semi_axes()[1]; }),
      of_particle(
          {"contact_force", "M L/T²",
           "mean force of all contacts, impacts and links in the last step on a particle whose "
           "motion is given; empty for others",
           in_tables(kWithLoads)},
          [](const ParticleRow& row) {
            return row.load ? std::optional(row.load->force) : std::nullopt;
          }),
      of_particle({"contact_torque", "M L²/T²", "the same about the centre of the particle",
                   in_tables(kWithTorques)},
                  [](const ParticleRow& row) {
                    return row.load ? std::optional(Turn{row.load->torque}) : std::nullopt;
                  }),
  };
}

}  // namespace

const std::vector<Column<ParticleRow>>& particle_columns() {
  static const auto columns = make_particle_columns();
  return columns;
}

RunFacts facts_of(const Particles& particles) {
  RunFacts run;
  run.dimension = particles.dimension;
  run.is_periodic = particles.cell.is_periodic();
  run.do_turn = particles.turn();
  run.has_mass = std::ranges::any_of(particles.masses, [](double mass) { return mass > 0; });
  run.has_bodies = !particles.bodies.empty();
  run.has_semi_axes = !particles.shapes.empty();
  return run;
}

std::vector<ParticleRow> rows_of(const Particles& particles, double time, const FluidForces* forces,
                                 std::span<const GivenParticleLoad> loads) {
  assert(std::ranges::is_sorted(loads, {}, &GivenParticleLoad::particle));
  std::vector<ParticleRow> rows;
  rows.reserve(particles.count());
  auto load = loads.begin();
  for (std::size_t k = 0; k < particles.count(); ++k) {
    rows.push_back({particles, k, time, forces});
    if (load == loads.end() || index_of(load->particle) != k) continue;
    rows.back().load = &*load;
    ++load;
  }
  return rows;
}

ColumnTable particle_column_table() {
  return column_table("particles", particle_columns(),
                      {{Output::kAtEnd, "`final_particles.csv`"},
                       {Output::kOverTime, "`motion.csv`"},
                       {Output::kFrames, "frames, HDF5"},
                       {Output::kPython, "Python"}});
}

}  // namespace viscontact::particles
