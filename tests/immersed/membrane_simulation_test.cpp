// Time stepping of membranes in a stand-in for the fluid: regularised Stokeslets in unbounded shear
// flow (Cortez 2001, SIAM J. Sci. Comput. 23, 1204), whose flow is free of divergence.
#include "viscontact/immersed/membrane_simulation.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "tests/common/failure.hpp"
#include "viscontact/membranes/membrane_curve.hpp"
#include "viscontact/membranes/membrane_motion.hpp"
#include "viscontact/membranes/membrane_shape.hpp"

namespace viscontact::particles {
namespace {

/// Velocities of points under forces on them, smeared out over a length of 0.3 mean distances from
/// a centre, in the flow (shear y + strain x, -strain y).
class Stokeslets : public FluidSolver {
 public:
  Stokeslets(double shear, double smear, double strain = 0)
      : shear_(shear), smear_(smear), strain_(strain) {}
  void place(const FluidParticles& bodies) override { positions_ = bodies.particles->positions; }
  std::vector<double> velocities(std::span<const double> forces, bool driving) override {
    const std::size_t n = positions_.size() / 2;
    std::vector<double> velocities(3 * n);
    for (std::size_t i = 0; i < n; ++i) {
      if (driving) {
        velocities[3 * i] = shear_ * positions_[2 * i + 1] + strain_ * positions_[2 * i];
        velocities[3 * i + 1] = -strain_ * positions_[2 * i + 1];
      }
      for (std::size_t j = 0; j < n; ++j) {
        const double dx = positions_[2 * i] - positions_[2 * j],
                     dy = positions_[2 * i + 1] - positions_[2 * j + 1];
        const double e = smear_, r = std::sqrt(dx * dx + dy * dy + e * e);
        // The constant makes up for the wall far away that a flow in the plane needs.
        const double along = 4 - std::log(r + e) + e * (r + 2 * e) / ((r + e) * r);
        const double across = (r + 2 * e) / ((r + e) * (r + e) * r);
        const double fx = forces[3 * j], fy = forces[3 * j + 1], dot = dx * fx + dy * fy;
        velocities[3 * i] += (along * fx + across * dot * dx) / (4 * std::numbers::pi);
        velocities[3 * i + 1] += (along * fy + across * dot * dy) / (4 * std::numbers::pi);
      }
    }
    return velocities;
  }
  FlowQuantities quantities() override { return {}; }
  double vary_penalty() override { return 0; }
  SecondMesh vary_mesh() override { return {}; }
  FlowField flow() override { return {}; }
  std::size_t unknowns() const override { return 0; }

 private:
  double shear_, smear_, strain_;
  std::vector<double> positions_;
};

struct Vesicle {
  double shear = 1, rigidity = 1, reduced_area = 0.8, size = 1;
  int beads = 24;
  double strain = 0;
  double x = 0;  ///< of the centre of a box around the vesicle; 0: there is no box

  MembraneSimulation simulation(double time_step, const State* from = nullptr) const {
    Setting setting;
    setting.time_step = time_step;
    setting.fluid.emplace();
    Membrane membrane;
    membrane.set_beads(0, beads);
    membrane.bending_rigidity = rigidity;
    membrane.perimeter = 7 * size;
    membrane.area = reduced_area * 49 * size * size / (4 * std::numbers::pi);
    setting.fluid->membranes = {membrane};
    if (x != 0) setting.domain = BoxDomain{{x - 4, -4}, {x + 4, 4}};
    State state;
    if (from != nullptr) {
      state = *from;
    } else {
      auto& p = state.particles;
      p.positions = *ellipse_of(membrane, {x + 0.1 * size, 0, 0}, 0.9);
      p.velocities.resize(p.positions.size());
      p.radii.assign(static_cast<std::size_t>(beads), 0.01 * size);
      p.masses.resize(p.radii.size());
    }
    return {setting, state, std::make_unique<Stokeslets>(shear, 0.3 * size, strain)};
  }
  MembraneMeasures measures(const MembraneSimulation& simulation) const {
    Membrane membrane;
    membrane.set_beads(0, beads);
    const auto& p = simulation.state().particles;
    return measure(membrane, p);
  }
};

double energy_of(const MembraneSimulation& simulation) {
  const auto& x = simulation.state().particles.positions;
  const auto n = static_cast<Eigen::Index>(x.size() / 2);
  Eigen::VectorXd positions(2 * n);
  for (Eigen::Index k = 0; k < n; ++k) {
    positions(k) = x[static_cast<std::size_t>(2 * k)];
    positions(n + k) = x[static_cast<std::size_t>(2 * k + 1)];
  }
  return MembraneCurve(static_cast<int>(n)).bending_energy(positions);
}

// Ten turns of the membrane: area and perimeter are exact to rounding, not to 1e-3.
TEST(MembraneSimulation, KeepsAreaAndPerimeter) {
  const Vesicle vesicle;
  auto simulation = vesicle.simulation(0.25);
  constexpr double kEnd = 200;
  while (simulation.state().time < kEnd) simulation.step(kEnd);
  EXPECT_EQ(simulation.step(kEnd).parts, 0);
  const auto measures = vesicle.measures(simulation);
  EXPECT_LT(-kEnd * measures.tank_treading_frequency, 15);
  EXPECT_GT(-kEnd * measures.tank_treading_frequency, 10);
  EXPECT_NEAR(measures.perimeter / 7, 1, 1e-11);
  EXPECT_NEAR(measures.area / (0.8 * 49 / (4 * std::numbers::pi)), 1, 1e-11);
}

TEST(MembraneSimulation, WithoutAFlowTheEnergyFalls) {
  const Vesicle vesicle{.shear = 0, .reduced_area = 0.6};
  auto simulation = vesicle.simulation(0.05);
  double energy = energy_of(simulation);
  const double first = energy;
  for (int step = 0; step < 40; ++step) {
    simulation.step(2);
    const double next = energy_of(simulation);
    // The energy becomes steady up to rounding errors.
    EXPECT_LT(next, energy * (1 + 1e-12));
    energy = next;
  }
  EXPECT_LT(energy, 0.99 * first);
}

TEST(MembraneSimulation, StepsAreOfSecondOrder) {
  const Vesicle vesicle{.rigidity = 0.1};
  const auto inclination = [&](int steps) {
    auto simulation = vesicle.simulation(1.0 / steps);
    for (int step = 0; step < steps; ++step) simulation.step(1);
    return vesicle.measures(simulation).inclination;
  };
  const double a = inclination(50), b = inclination(100), c = inclination(200);
  // Half the step divides the error by 4, but for terms of third order.
  EXPECT_NEAR((a - b) / (b - c), 4, 0.8);
}

// The shortest waves relax 1e5 times within a step: the implicit step is stable, and the shape is
// that of least energy, which the membrane takes without a flow.
TEST(MembraneSimulation, StiffMembranesAreStable) {
  auto stiff = Vesicle{.rigidity = 100}.simulation(0.1),
       still = Vesicle{.shear = 0}.simulation(0.5);
  while (stiff.state().time < 5) stiff.step(5);
  while (still.state().time < 100) still.step(100);
  // The flow, a hundredth of the bending force, and the time step bend it a little.
  EXPECT_NEAR(energy_of(stiff) / energy_of(still), 1, 1e-3);
}

// A straining flow pulls the membrane. Its tension does not make beads vibrate across it in steps
// of 1e-3 to 1 times the elastic time: viscosity and bending rigidity are 1 and 1/10, and the
// radius is 1, so that waves of the length of the perimeter relax in about the time 10.
TEST(MembraneSimulation, TensionDoesNotLimitTheStep) {
  const auto energies = [](double step, double end) {
    auto simulation = Vesicle{.shear = 0, .rigidity = 0.1, .strain = 0.1}.simulation(step);
    std::vector<double> result;
    while (simulation.state().time < end * (1 - 1e-9)) {
      simulation.step(end);
      result.push_back(energy_of(simulation));
    }
    return result;
  };
  const double steady = energies(1, 60).back();
  for (const double step : {0.1, 3.0, 10.0}) {
    const auto found = energies(step, 60);
    EXPECT_NEAR(found.back() / steady, 1, 1e-3) << step;
  }
  // A bead that vibrated would bend the membrane more with each step.
  const auto early = energies(0.01, 2);
  for (std::size_t k = 2; k < early.size(); ++k) EXPECT_LT(early[k], early[k - 1]) << k;
}

TEST(MembraneSimulation, UnitsDoNotMatter) {
  const Vesicle one, other{.shear = 1e3, .rigidity = 1e3 * 1e-15, .size = 1e-5};
  auto first = one.simulation(0.1), second = other.simulation(1e-4);
  // The constant of the stand-in depends on the unit of length, but no force acts on the whole.
  for (int step = 0; step < 10; ++step) {
    first.step(1);
    second.step(1e-3);
  }
  EXPECT_NEAR(other.measures(second).inclination, one.measures(first).inclination, 1e-6);
  EXPECT_NEAR(other.measures(second).membrane_speed / 1e-2, one.measures(first).membrane_speed,
              1e-6);
}

TEST(MembraneSimulation, ContinuesBitForBit) {
  const Vesicle vesicle;
  auto whole = vesicle.simulation(0.1), part = vesicle.simulation(0.1);
  for (int step = 0; step < 4; ++step) part.step(1);
  const State between = part.state();
  auto rest = vesicle.simulation(0.1, &between);
  while (whole.state().time < 1 - 1e-9) whole.step(1);
  while (rest.state().time < 1 - 1e-9) rest.step(1);
  EXPECT_EQ(whole.state().particles.positions, rest.state().particles.positions);
  EXPECT_EQ(whole.state().particles.velocities, rest.state().particles.velocities);
}

// The stand-in's linear flow does not depend on x.
TEST(MembraneSimulation, FarFromTheOriginMovesAsNearIt) {
  // Positions are rounded to 1.5e-8 there. Bending forces take this rounding times the fourth power
  // of the number of beads over 2, about 2e4.
  constexpr double kFar = 1e8;
  const Vesicle near, far{.x = kFar};
  auto first = near.simulation(0.1), second = far.simulation(0.1);
  for (int step = 0; step < 5; ++step) {
    first.step(1);
    second.step(1);
  }
  const State between = second.state();
  auto continued = far.simulation(0.1, &between);
  for (int step = 0; step < 5; ++step) {
    first.step(1);
    continued.step(1);
  }
  const auto measures = near.measures(first), found = far.measures(continued);
  EXPECT_NEAR(found.x - kFar, measures.x, 1e-6);
  EXPECT_NEAR(found.y, measures.y, 1e-6);
  EXPECT_NEAR(found.area, measures.area, 1e-6);
  EXPECT_NEAR(found.perimeter, measures.perimeter, 1e-6);
  EXPECT_NEAR(found.inclination, measures.inclination, 1e-5);
  EXPECT_NEAR(found.membrane_speed, measures.membrane_speed, 1e-4);
}

TEST(MembraneSimulation, DoesNotContinueWithAnotherShape) {
  Vesicle vesicle;
  auto simulation = vesicle.simulation(0.1);
  simulation.step(1);
  const State between = simulation.state();
  vesicle.reduced_area += 0.05;
  EXPECT_THAT(bad_input([&] { vesicle.simulation(0.1, &between); }), Names("membrane 0", "7"));
}

// The loads are far larger than the forces of the membrane.
TEST(Membranes, TheResponseIsTheDerivativeOfAStepWithLoads) {
  constexpr Eigen::Index kBeads = 16;
  constexpr double kTime = 2e-5, kSmall = 0.01;
  Membrane membrane;
  membrane.set_beads(0, kBeads);
  membrane.perimeter = 7;
  membrane.area = 0.7 * 49 / (4 * std::numbers::pi);
  const Membranes membranes({&membrane, 1});
  Particles p;
  p.positions = *ellipse_of(membrane, {}, 0.4);
  Stokeslets fluid(1, 0.3);
  fluid.place({&p, {}, {}, {}});
  std::vector<double> unit(3 * kBeads);
  const Eigen::VectorXd from = membranes.places(p.positions, {});
  FluidAnswer answer{membranes.from_particles(fluid.velocities(unit, true), 3),
                     Eigen::MatrixXd(2 * kBeads, 2 * kBeads)};
  Eigen::VectorXd loads(2 * kBeads), small = Eigen::VectorXd::Zero(2 * kBeads);
  for (Eigen::Index k = 0; k < kBeads; ++k) {
    for (Eigen::Index d = 0; d < 2; ++d) {
      const auto at = static_cast<std::size_t>(3 * k + d);
      unit[at] = 1;
      answer.mobility.col(d * kBeads + k) =
          membranes.from_particles(fluid.velocities(unit, false), 3);
      unit[at] = 0;
    }
    const double angle = kTwoPi * static_cast<double>(k) / kBeads;
    loads(k) = 50 * std::sin(2 * angle);
    loads(kBeads + k) = 80 * std::cos(angle);
  }
  small(3) = 1;
  const auto step = [&](double share, Eigen::VectorXd& positions) {
    positions = from;
    return membranes.step(from, kTime, answer, loads + share * small, positions);
  };
  Eigen::VectorXd positions, changed;
  const auto motion = step(0, positions);
  const auto more = step(kSmall, changed), less = step(-kSmall, changed);
  const Eigen::VectorXd forces = (more.flow_forces - less.flow_forces) / (2 * kSmall) - small;
  const Eigen::VectorXd moved = kTime * (more.velocities - less.velocities) / (2 * kSmall);
  const auto response =
      membranes.response(kTime, answer, loads, motion, positions, kTime * answer.mobility * small);
  // At the end of a step the beads are moved a little, to make lengths and areas exact, so that the
  // response belongs to slightly other places (8e-6). With the loads in the condition for the
  // pressure the difference would be 1e-4.
  EXPECT_LT((response.forces - forces).norm(), 2e-5 * forces.norm());
  EXPECT_LT((response.positions - moved).norm(), 2e-5 * moved.norm());
}

/// Two vesicles, one above the other, that a straining flow presses together, and the floor of a
/// box.
struct Pressed {
  Setting setting;
  State state;

  Pressed() {
    setting.time_step = 0.05;
    setting.domain = BoxDomain{{-10, -3.5}, {10, 10}, {}};
    auto& fluid = setting.fluid.emplace();
    fluid.threshold_gap = 0.1;
    auto& p = state.particles;
    for (const double y : {1.3, -1.3}) {
      Membrane membrane;
      membrane.set_beads(static_cast<std::int32_t>(p.count()), 20);
      membrane.perimeter = 6.6;
      membrane.area = 0.9 * 6.6 * 6.6 / (4 * std::numbers::pi);
      const auto places = *ellipse_of(membrane, {y > 0 ? 0.02 : 0, y, 0}, 0);
      p.positions.insert(p.positions.end(), places.begin(), places.end());
      p.radii.resize(p.radii.size() + places.size() / 2, 0.14);
      fluid.membranes.push_back(membrane);
    }
    p.velocities.resize(p.positions.size());
    p.masses.resize(p.radii.size());
  }
  MembraneSimulation simulation(double strain) const {
    return {setting, state, std::make_unique<Stokeslets>(0, 0.3, strain)};
  }
};

/// The smallest gap of beads of both membranes.
double gap_between(const State& state) {
  double least = 1e300;
  const auto& p = state.particles;
  for (std::size_t i = 0; i < 20; ++i)
    for (std::size_t j = 20; j < 40; ++j)
      least = std::min(least, norm(p.position(i) - p.position(j)) - p.radii[i] - p.radii[j]);
  return least;
}

// The gap stays at the threshold up to what the beads turn about each other in a step; pulled, they
// stay until the pull has given back what the push has brought in.
TEST(MembraneSimulation, MembranesMakeViscousContact) {
  Pressed pressed;
  pressed.setting.fluid->threshold_gap = 0.35;
  auto simulation = pressed.simulation(1);
  std::size_t contacts = 0;
  while (simulation.state().time < 1.5) {
    const auto report = simulation.step(1.5);
    contacts = std::max(contacts, report.contacts);
    EXPECT_TRUE(report.converged);
    EXPECT_GT(gap_between(simulation.state()), 0.35 - 2e-3);
  }
  EXPECT_GE(contacts, 2U);
  double gamma = 0;
  for (const auto& pair : simulation.state().pairs) gamma += pair.gamma;
  EXPECT_LT(gamma, -0.1);
  Pressed released = pressed;
  released.state = simulation.state();
  auto pulled = released.simulation(-1);
  pulled.step(1.55);
  EXPECT_NEAR(gap_between(pulled.state()), 0.35, 2e-3);
  const auto free = [&] {
    for (const auto& pair : pulled.state().pairs)
      if (pair.gamma < 0) return false;
    return true;
  };
  while (!free() && pulled.state().time < 10) pulled.step(10);
  EXPECT_TRUE(free());
  EXPECT_GT(pulled.state().time, 1.7);
}

TEST(MembraneSimulation, MembranesMakeContactWithWalls) {
  Pressed falling;
  for (std::size_t k = 1; k < falling.state.particles.positions.size(); k += 2)
    falling.state.particles.positions[k] -= 1;
  // The upper one is far away.
  for (std::size_t k = 1; k < 40; k += 2) falling.state.particles.positions[k] += 5;
  auto simulation = falling.simulation(-1);
  std::size_t contacts = 0;
  while (simulation.state().time < 0.6)
    contacts = std::max(contacts, simulation.step(0.6).contacts);
  EXPECT_GE(contacts, 1U);
  double lowest = 1e300;
  for (std::size_t k = 20; k < 40; ++k)
    lowest = std::min(lowest, simulation.state().particles.position(k)[1] - 0.14 + 3.5);
  EXPECT_NEAR(lowest, 0.1, 2e-3);
}

}  // namespace
}  // namespace viscontact::particles
