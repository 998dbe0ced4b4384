// Membranes without a fluid: their geometry against differences and closed forms, and their motion
// against conservation laws and shapes of least energy.
#include "viscontact/membranes/necklace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/constraint_rows/link_rows.hpp"
#include "viscontact/membranes/membrane_motion.hpp"
#include "viscontact/membranes/membrane_shape.hpp"

namespace viscontact::particles {
namespace {

constexpr double kPi = std::numbers::pi;

/// A necklace of 20 beads, in units of length and time in which a bead has the mass 0.1.
struct Scene {
  double length = 1, time = 1;
  double reduced_area = 0.8, rigidity = 1, viscosity = 0, angle = 0.3;
  std::int32_t beads = 20;
  Vector centre{0.1, 0.2, 0}, velocity{}, gravity{};
  bool keeps_area = true;
  Setting setting{};
  State state = no_particles(2);

  void make(double time_step) {
    Membrane membrane;
    const auto first = static_cast<std::int32_t>(state.particles.count());
    membrane.set_beads(first, beads);
    membrane.perimeter = 6.6 * length;
    membrane.area = reduced_area * 6.6 * 6.6 * length * length / (4 * kPi);
    membrane.lengths.assign(index_of(beads), membrane.perimeter / beads);
    membrane.bending_rigidity = rigidity * length * length * length / (time * time);
    membrane.bending_viscosity = viscosity * length * length * length / time;
    membrane.keeps_area = keeps_area;
    const auto places = *ellipse_of(membrane, length * centre, angle);
    for (std::size_t k = 0; k < index_of(beads); ++k)
      add_particle(state, {places[2 * k], places[2 * k + 1], 0}, 3.3 * length / beads, 0.1,
                   (length / time) * velocity);
    state.particles.angles.clear();
    state.particles.angular_velocities.clear();
    state.particles.inertias.clear();
    add_rotation(state.particles);
    setting.links.membranes.push_back(membrane);
    setting.time_step = time_step * time;
    setting.gravity = (length / (time * time)) * gravity;
    setting.laws.film.gamma_min = 0;
  }
  const Membrane& membrane() const { return setting.links.membranes.front(); }
};

/// Momentum, and angular momentum about the origin [M L/T, M L^2/T].
Vector momenta(const Particles& p) {
  Vector sum{};
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector x = p.position(k), u = p.velocity(k);
    sum = sum + p.masses[k] * Vector{u[0], u[1], x[0] * u[1] - x[1] * u[0]};
    sum[2] += p.inertias[k] * p.angular_velocities[k];
  }
  return sum;
}

double bending_energy_of(const Membrane& membrane, const Particles& p) {
  return membrane.bending_rigidity *
         bending_energy(necklace_of(membrane, p), Eigen::Map<const Eigen::VectorXd>(
                                                      membrane.lengths.data(), membrane.count()));
}

double energy_of(const Membrane& membrane, const Particles& p) {
  double sum = bending_energy_of(membrane, p);
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector u = p.velocity(k);
    sum += (p.masses[k] * dot(u, u) + p.inertias[k] * std::pow(p.angular_velocities[k], 2)) / 2;
  }
  return sum;
}

/// A necklace without symmetry, at which no derivative is 0 by chance.
Scene crooked() {
  Scene scene;
  scene.make(0.01);
  auto& p = scene.state.particles;
  for (std::size_t i = 0; i < p.positions.size(); ++i)
    p.positions[i] += 0.03 * std::sin(1.7 * static_cast<double>(i * i));
  return scene;
}

// The geometry of a regular polygon with N corners on a circle of radius R.
TEST(Necklace, MeasuresARegularPolygon) {
  constexpr Eigen::Index n = 17;
  const double r = 1.3;
  Eigen::VectorXd necklace(2 * n);
  for (Eigen::Index k = 0; k < n; ++k) {
    necklace(k) = 5 + r * std::cos(2 * kPi * static_cast<double>(k) / n);
    necklace(n + k) = -3 + r * std::sin(2 * kPi * static_cast<double>(k) / n);
  }
  const double side = 2 * r * std::sin(kPi / n), turn = 2 * kPi / n;
  EXPECT_NEAR(area_of(necklace), n * r * r * std::sin(turn) / 2, 1e-12);
  EXPECT_NEAR(distances_of(necklace).maxCoeff(), side, 1e-12);
  EXPECT_NEAR(turns_of(necklace).minCoeff(), turn, 1e-12);
  EXPECT_NEAR(bending_energy(necklace, distances_of(necklace)), n * turn * turn / (2 * side),
              1e-12);
}

// Rows are the derivatives of what they measure, and the bending springs together the gradient of
// the energy: differences of 1e-6 have errors of 1e-12 and of the rounding over 1e-6.
TEST(Necklace, RowsAreDerivatives) {
  auto scene = crooked();
  auto& p = scene.state.particles;
  const auto equations = membrane_equations(scene.membrane(), p, {0.01, 0.01, 0.01});
  ASSERT_EQ(equations.size(), Links::forces_of_membrane(scene.membrane()));
  constexpr double kStep = 1e-6;
  std::vector<double> force(p.positions.size());
  for (const auto& one : equations) {
    const auto& row = one.rows.front();
    for (const auto& part : row.parts)
      for (std::size_t d = 0; d < 2; ++d)
        if (one.kind == LinkEquations::Kind::kBend)
          force[2 * index_of(part.particle) + d] +=
              row.stiffness * row.extension * part.direction[d];
    if (one.is_spring()) continue;
    for (std::size_t i = 0; i < row.parts.size(); ++i)
      for (std::size_t d = 0; d < 3; ++d) {
        if (row.parts[i].is_turn != (d == 2)) continue;
        std::array<double, 2> values{};
        for (std::size_t side = 0; side < 2; ++side) {
          std::vector<UnitMotion> motions(row.parts.size());
          auto& changed = d == 2 ? motions[i].turn : motions[i].displacement;
          changed[d] = side == 0 ? -kStep : kStep;
          values[side] = membrane_value_after(one, scene.membrane(), p, motions);
        }
        EXPECT_NEAR((values[1] - values[0]) / (2 * kStep), row.parts[i].direction[d], 1e-8);
      }
  }
  for (std::size_t i = 0; i < p.positions.size(); ++i) {
    auto moved = p;
    moved.positions[i] += kStep;
    const double above = bending_energy_of(scene.membrane(), moved);
    moved.positions[i] -= 2 * kStep;
    EXPECT_NEAR((above - bending_energy_of(scene.membrane(), moved)) / (2 * kStep), force[i],
                1e-7 * bending_energy_of(scene.membrane(), p));
  }
}

// A free necklace far from its equilibrium swings: no force acts from outside, and nothing damps.
TEST(Necklace, KeepsMomentaLengthsAndArea) {
  Scene scene;
  scene.velocity = {1, 0.5, 0};
  scene.make(0.01);
  for (std::size_t k = 0; k < 5; ++k) scene.state.particles.velocities[2 * k] += 0.3;
  Simulation simulation(scene.setting, scene.state, 1);
  const Vector before = momenta(scene.state.particles);
  run(simulation, 2, expect_converged);
  const auto& p = simulation.state().particles;
  EXPECT_NEAR(norm(momenta(p) - before), 0, 1e-9 * norm(before));
  EXPECT_NEAR(area_of(necklace_of(scene.membrane(), p)), scene.membrane().area, 1e-9);
  const auto distances = distances_of(necklace_of(scene.membrane(), p));
  EXPECT_NEAR(distances.maxCoeff(), 6.6 / 20, 1e-9);
  EXPECT_NEAR(distances.minCoeff(), 6.6 / 20, 1e-9);
  // Each bead turns with the line between its neighbours, (8.10), at the places where the step
  // began: those of its end differ by the step times the rate.
  double fastest = 0, largest = 0;
  for (std::int32_t k = 0; k < scene.membrane().count(); ++k) {
    const auto before_it = index_of(scene.membrane().bead(k - 1)),
               after_it = index_of(scene.membrane().bead(k + 1));
    const Vector chord = p.position(after_it) - p.position(before_it);
    const double rate =
        cross(chord, p.velocity(after_it) - p.velocity(before_it))[2] / dot(chord, chord);
    fastest = std::max(fastest, std::abs(rate));
    largest = std::max(largest,
                       std::abs(p.angular_velocities[index_of(scene.membrane().bead(k))] - rate));
  }
  EXPECT_GT(fastest, 0.1);
  EXPECT_LT(largest, 0.05 * fastest);
}

// A ring of the radius R, the mass rho per length, the rigidity B and the bending viscosity eta
// swings in the mode cos(2 theta) with the frequency omega and decays with the rate gamma,
//   omega^2 = B m^2 (m^2 - 1)^2/(rho R^4 (m^2 + 1)), m = 2,   2 gamma = eta omega^2/B
// (Love 1927, art. 293, for an inextensible ring; a ring whose natural curvature is 0 has the same
// energy up to a constant, because its turns add up to 2 pi). A polygon of 40 beads differs by
// 1/40^2 times a number of order 10.
TEST(Necklace, SwingsAndDecaysAsARing) {
  constexpr double kRadius = 6.6 / (2 * kPi), kAmplitude = 0.01, kViscosity = 0.05, kModes = 2;
  Scene scene;
  scene.beads = 40;
  scene.viscosity = kViscosity;
  scene.keeps_area = false;
  scene.make(0.01);
  auto& p = scene.state.particles;
  const auto angle_of = [](std::size_t k) { return 2 * kPi * static_cast<double>(k) / 40; };
  for (std::size_t k = 0; k < 40; ++k) {
    const double angle = angle_of(k), outward = kAmplitude * std::cos(kModes * angle),
                 along = -kAmplitude / kModes * std::sin(kModes * angle);
    p.positions[2 * k] = (kRadius + outward) * std::cos(angle) - along * std::sin(angle);
    p.positions[2 * k + 1] = (kRadius + outward) * std::sin(angle) + along * std::cos(angle);
    p.inertias[k] = 1e-9;  // the ring has no inertia of turning
  }
  auto& membrane = scene.setting.links.membranes.front();
  const Eigen::VectorXd distances = distances_of(necklace_of(membrane, p));
  membrane.lengths.assign(distances.begin(), distances.end());
  membrane.perimeter = distances.sum();
  Simulation simulation(scene.setting, scene.state, 1);
  const double density = 0.1 * 40 / 6.6;
  const double square = 4 * 9 / (density * std::pow(kRadius, 4) * 5),
               decay = kViscosity * square / 2;
  const double frequency = std::sqrt(square - decay * decay);
  for (const double periods : {0.25, 0.5, 0.75, 1.0}) {
    run(simulation, std::round(periods * 2 * kPi / frequency / 0.01) * 0.01, expect_converged);
    const auto& now = simulation.state().particles;
    double amplitude = 0;
    for (std::size_t k = 0; k < 40; ++k)
      amplitude += 2.0 / 40 * (norm(now.position(k)) - kRadius) * std::cos(kModes * angle_of(k));
    const double t = simulation.state().time;
    const double expected = kAmplitude * std::exp(-decay * t) *
                            (std::cos(frequency * t) + decay / frequency * std::sin(frequency * t));
    EXPECT_NEAR(amplitude, expected, 0.03 * kAmplitude) << periods;
  }
}

TEST(Necklace, HasALargestArea) {
  // A regular polygon; a triangle of the sides 3, 4, 5, whose circle has its centre on a side; and
  // an obtuse triangle, whose circle has it outside.
  const std::vector<double> regular(7, 0.3), right = {3, 4, 5}, obtuse = {2, 3, 4.5};
  EXPECT_NEAR(largest_area(regular), 7 * 0.09 / (4 * std::tan(kPi / 7)), 1e-12);
  EXPECT_NEAR(largest_area(right), 6, 1e-12);
  EXPECT_NEAR(largest_area(obtuse), std::sqrt(4.75 * 2.75 * 1.75 * 0.25), 1e-12);
}

// Newmark's method does not damp; the energy swings by an amount of the order of the step.
TEST(Necklace, KeepsItsEnergyToTheOrderOfTheStep) {
  std::vector<double> errors;
  for (const double h : {0.01, 0.005}) {
    Scene scene;
    scene.make(h);
    Simulation simulation(scene.setting, scene.state, 1);
    const double before = energy_of(scene.membrane(), scene.state.particles);
    double largest = 0;
    run(simulation, 2, [&](const StepReport&) {
      largest = std::max(
          largest,
          std::abs(energy_of(scene.membrane(), simulation.state().particles) / before - 1));
    });
    errors.push_back(largest);
  }
  EXPECT_LT(errors[0], 0.05);
  EXPECT_LT(errors[1], 0.7 * errors[0]);
}

// Bending viscosity leads to the shape of least energy. The trigonometric curve of membranes in a
// fluid, relaxed by steps in which a force moves its bead alone, is another discretisation of it;
// polygons approach it as 1/N^2.
TEST(Necklace, RelaxesToTheShapeOfLeastEnergy) {
  Membrane smooth;
  smooth.set_beads(0, 48);
  smooth.perimeter = 6.6;
  smooth.area = 0.8 * 6.6 * 6.6 / (4 * kPi);
  const std::vector<Membrane> one = {smooth};
  const Membranes membranes(one);
  const auto start = *ellipse_of(smooth, {}, 0);
  Eigen::VectorXd positions = membranes.places(start, {});
  const FluidAnswer answer{Eigen::VectorXd::Zero(96), Eigen::MatrixXd::Identity(96, 96)};
  for (int step = 0; step < 40; ++step) {
    const Eigen::VectorXd from = positions;
    membranes.step(from, 0.5, answer, Eigen::VectorXd::Zero(96), positions);
  }
  const double least = MembraneCurve(48).bending_energy(positions);
  std::vector<double> errors;
  for (const std::int32_t beads : {16, 32}) {
    Scene scene;
    scene.beads = beads;
    scene.viscosity = 1;
    scene.make(0.1);
    Simulation simulation(scene.setting, scene.state, 1);
    run(simulation, 40, expect_converged);
    const auto& p = simulation.state().particles;
    EXPECT_LT(measure(scene.membrane(), p).membrane_speed, 1e-6);
    errors.push_back(bending_energy_of(scene.membrane(), p) / least - 1);
  }
  EXPECT_LT(std::abs(errors[1]), 0.02);
  EXPECT_NEAR(errors[0] / errors[1], 4, 1);
  // Without the condition of the area the shape of least energy is the regular polygon.
  Scene open;
  open.viscosity = 1;
  open.keeps_area = false;
  open.make(0.1);
  Simulation simulation(open.setting, open.state, 1);
  run(simulation, 40, expect_converged);
  EXPECT_NEAR(bending_energy_of(open.membrane(), simulation.state().particles),
              std::pow(2 * kPi, 2) / (2 * 6.6), 1e-6);
}

// The same necklace in other units, with its beads counted from another one or in the other sense,
// and rotated.
TEST(Necklace, UnitsOrderAndRotationDoNotMatter) {
  Scene one;
  one.velocity = {0.5, 0, 0};
  one.make(0.01);
  Simulation first(one.setting, one.state, 1);
  run(first, 0.5, expect_converged);
  const auto reference = measure(one.membrane(), first.state().particles);
  Random random(7);
  for (int n = 0; n < 3; ++n) {
    Scene other = {.length = random.decades(-6, 6), .time = random.decades(-6, 6)};
    other.velocity = one.velocity;
    other.make(0.01);
    Simulation second(other.setting, other.state, 1);
    run(second, 0.5 * other.time, expect_converged);
    const auto measures = measure(other.membrane(), second.state().particles);
    EXPECT_NEAR(measures.inclination, reference.inclination, 1e-7);
    EXPECT_NEAR(measures.membrane_speed * other.time / other.length, reference.membrane_speed,
                1e-7);
    EXPECT_NEAR(measures.x / other.length, reference.x, 1e-9);
  }
  Scene turned;
  turned.angle += 0.7;
  turned.centre = {0.1 * std::cos(0.7) - 0.2 * std::sin(0.7),
                   0.1 * std::sin(0.7) + 0.2 * std::cos(0.7), 0};
  turned.velocity = {0.5 * std::cos(0.7), 0.5 * std::sin(0.7), 0};
  turned.make(0.01);
  auto& beads = turned.setting.links.membranes.front().beads;
  std::ranges::rotate(beads, beads.begin() + 6);
  Simulation rotated(turned.setting, turned.state, 1);
  run(rotated, 0.5, expect_converged);
  const auto measures = measure(turned.membrane(), rotated.state().particles);
  EXPECT_NEAR(std::remainder(measures.inclination - reference.inclination - 0.7, kPi), 0, 1e-7);
  EXPECT_NEAR(measures.membrane_speed, reference.membrane_speed, 1e-7);
  EXPECT_NEAR(measures.x, reference.x * std::cos(0.7) - reference.y * std::sin(0.7), 1e-8);
}

/// A necklace with its centre at this height above a floor, under gravity, with a bending
/// viscosity.
Scene above_a_floor(double height, double viscosity) {
  Scene scene;
  scene.gravity = {0, -1, 0};
  scene.viscosity = viscosity;
  scene.centre = {0, height, 0};
  scene.make(0.01);
  scene.setting.planes.push_back(plane_at_rest({}, {0, 1, 0}));
  return scene;
}

// A vesicle lands on a floor and comes to rest: the floor carries its weight, and it is as long and
// as large as before.
TEST(Necklace, RestsOnAFloor) {
  const auto scene = above_a_floor(1.4, 0.3);
  Simulation simulation(scene.setting, scene.state, 1);
  run(simulation, 12, expect_converged);
  const auto& p = simulation.state().particles;
  double impulse = 0;
  for (const auto& wall : simulation.state().walls) impulse += wall.impulse;
  EXPECT_NEAR(impulse / 0.01, 20 * 0.1, 1e-4);
  EXPECT_NEAR(area_of(necklace_of(scene.membrane(), p)), scene.membrane().area, 1e-9);
  EXPECT_NEAR(distances_of(necklace_of(scene.membrane(), p)).sum(), 6.6, 1e-9);
}

// A limp necklace that two planes press flat: beads of its two sides meet and do not overlap,
// though neighbours, which touch, make no contact.
TEST(Necklace, ItsTwoSidesMakeContact) {
  Scene scene;
  scene.rigidity = 0;
  scene.keeps_area = false;
  scene.angle = 0;
  scene.centre = {};
  scene.make(0.01);
  scene.setting.planes = {plane_at_rest({0, -1, 0}, {0, 1, 0}),
                          plane_at_rest({0, 1, 0}, {0, -1, 0})};
  for (auto& plane : scene.setting.planes) plane.velocity = constant(-0.35 * plane.start.point);
  Simulation simulation(scene.setting, scene.state, 1);
  run(simulation, 1.9, expect_converged);
  const auto& p = simulation.state().particles;
  double least = 1e300;
  int touching = 0;
  for (std::int32_t i = 0; i < 20; ++i)
    for (std::int32_t j = i + 2; j < 20; ++j) {
      if (i == 0 && j == 19) continue;
      least = std::min(least, pair_gap(simulation.state(), i, j));
      if (pair_gap(simulation.state(), i, j) < 1e-6) ++touching;
    }
  EXPECT_GT(least, -1e-6);
  EXPECT_GE(touching, 2);
  for (const auto& pair : simulation.state().pairs)
    EXPECT_FALSE(p.are_joined(pair.first, pair.second));
}

// With friction a nearly round necklace rolls down an incline without sliding: its membrane runs
// with the speed of its centre, clockwise.
TEST(Necklace, RollsLikeATrack) {
  Scene scene;
  scene.gravity = {0.5, -0.8, 0};
  scene.reduced_area = 0.95;
  scene.viscosity = 0.1;
  scene.centre = {0, 1.3, 0};
  scene.make(0.01);
  scene.setting.laws.friction = FrictionLaw{.coefficient = 0.6};
  scene.setting.planes.push_back(plane_at_rest({}, {0, 1, 0}));
  Simulation simulation(scene.setting, scene.state, 1);
  run(simulation, 3);
  const auto& p = simulation.state().particles;
  const auto measures = measure(scene.membrane(), p);
  const double speed = momenta(p)[0] / (20 * 0.1);
  EXPECT_GT(speed, 0.3);
  EXPECT_NEAR(measures.membrane_speed / speed, 1, 0.1);
  double spin = 0;
  for (const double w : p.angular_velocities) spin += w / 20;
  EXPECT_LT(spin, -0.2 * speed);
}

TEST(Necklace, ContinuesBitForBit) {
  const auto scene = above_a_floor(1.1, 0.1);
  Simulation whole(scene.setting, scene.state, 1), part(scene.setting, scene.state, 1);
  run(part, 0.4);
  Simulation rest(scene.setting, part.state(), 1);
  run(whole, 0.8);
  run(rest, 0.8);
  EXPECT_EQ(whole.state().particles.positions, rest.state().particles.positions);
  EXPECT_EQ(whole.state().particles.angular_velocities, rest.state().particles.angular_velocities);
  EXPECT_EQ(whole.state().link_forces, rest.state().link_forces);
  EXPECT_EQ(whole.state().walls, rest.state().walls);
}

TEST(Necklace, DoesNotContinueWithAnotherShape) {
  Scene scene;
  scene.make(0.01);
  Simulation simulation(scene.setting, scene.state, 1);
  simulation.step(0.01);
  auto other = scene.setting;
  other.links.membranes.front().area *= 1.01;
  EXPECT_THAT(bad_input([&] { Simulation(other, simulation.state(), 1); }),
              Names("membrane 0", "6.6"));
}

}  // namespace
}  // namespace viscontact::particles
