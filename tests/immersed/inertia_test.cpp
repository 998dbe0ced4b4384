// Time stepping in a fluid with inertia, docs/physics.md (6.9), (6.10), whose flow a stand-in
// replaces by drag and an added mass: orders, also at jumps, and impulses.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"

namespace viscontact::particles {
namespace {

/// (added_mass + m) du/dt = f - R (u - u_driven): backward differences of the motions that were
/// kept.
class InertialStandIn : public FluidSolver {
 public:
  InertialStandIn(double drag, double added_mass) : drag_(drag), added_mass_(added_mass) {}

  void place(const FluidParticles& bodies) override {
    step_ = bodies.flow_step;
    count_ = bodies.particles->count();
    components_ = motion_components(bodies.particles->dimension);
    masses_.assign(step_.masses.begin(), step_.masses.end());
    driven_ = bodies.driven;
  }
  std::vector<double> velocities(std::span<const double> forces, bool driving) override {
    const double r = step_.order == 2 ? step_.length / step_.before : 0, h = step_.length;
    const double a0 = step_.order == 0 ? 0 : (1 + 2 * r) / (1 + r) / h;
    const double a1 = step_.order == 0 ? 0 : -(1 + r) / h, a2 = r * r / (1 + r) / h;
    // A driven particle drags the others along.
    std::vector<double> v(forces.size());
    for (std::size_t i = 0; i < v.size(); ++i) {
      const auto k = static_cast<std::int32_t>(i / components_);
      if (driven_.contains(k)) {
        v[i] = driving ? driven_.at(k)[i % components_] : 0;
        continue;
      }
      const double mass = masses_[i] + added_mass_;
      double right = forces[i];
      if (driving && step_.order > 0) right -= mass * (a1 * kept_[i] + a2 * kept_before_[i]);
      if (driving)
        for (const auto& [other, motion] : driven_) right += drag_ * motion[i % components_];
      v[i] = right / (a0 * mass + drag_);
    }
    return v;
  }
  FlowQuantities quantities() override { return {0, 0, std::vector<double>(count_ * components_)}; }
  double vary_penalty() override { return 0; }
  SecondMesh vary_mesh() override { return {}; }
  FlowField flow() override { return {}; }
  void keep_flow(bool /*at_rest*/, std::span<const double> motions) override {
    kept_before_ = kept_.empty() ? std::vector(motions.begin(), motions.end()) : kept_;
    kept_.assign(motions.begin(), motions.end());
  }
  std::size_t unknowns() const override { return 0; }

 private:
  double drag_, added_mass_;
  FlowStep step_;
  std::size_t count_ = 0, components_ = 1;
  std::vector<double> masses_, kept_, kept_before_;
  std::map<std::int32_t, std::array<double, 3>> driven_;
};

/// Spheres on an axis in a fluid without weight.
InFluid with_inertia(double h) {
  auto system = in_fluid(1, 100, h, 0.01);
  system.setting.fluid->density = 1e-9;
  return system;
}

FluidSimulation simulation_of(const InFluid& system, double drag = 0, double added_mass = 0) {
  return {system.setting, system.state, std::make_unique<InertialStandIn>(drag, added_mass)};
}

TEST(InertiaOfFluid, AFlowThatCannotBeKeptLeavesTheStateAsItWas) {
  class Failing : public InertialStandIn {
   public:
    Failing() : InertialStandIn(1, 0) {}
    void keep_flow(bool at_rest, std::span<const double> motions) override {
      if (++calls_ == 3) throw Error(ErrorKind::kExternalProgram, "the third flow is lost");
      InertialStandIn::keep_flow(at_rest, motions);
    }

   private:
    int calls_ = 0;
  };
  auto system = with_inertia(0.1);
  add_particle(system.state, {20, 0, 0}, 1, 1, {1, 0, 0});
  FluidSimulation simulation(system.setting, system.state, std::make_unique<Failing>());
  // The start and the second step keep a flow, the first step does not.
  EXPECT_EQ(simulation.step(0).parts, 0);
  EXPECT_EQ(simulation.step(1).parts, 1);
  simulation.step(1);
  const State before = simulation.state();
  EXPECT_THAT(failure(ErrorKind::kExternalProgram, [&] { simulation.step(1); }),
              Says("the third flow is lost"));
  EXPECT_EQ(simulation.state().particles.positions, before.particles.positions);
  EXPECT_EQ(simulation.state().particles.velocities, before.particles.velocities);
  EXPECT_EQ(simulation.state().time, before.time);
}

TEST(InertiaOfFluid, EachForceGivesItsWholeImpulse) {
  // A force of impulse 3 acts for a short time, which may begin at once or within a step.
  constexpr double kMass = 2, kImpulse = 3, kAdded = 0.5;
  for (const double from : {0.0, 0.03, 0.1, 0.149, 0.17, 0.2, 0.63}) {
    SCOPED_TRACE(from);
    for (const double length : {0.004, 0.1, 0.25}) {
      auto system = with_inertia(0.1);
      add_particle(system.state, {20, 0, 0}, 1, kMass);
      auto& pieces = system.setting.forces[0].pieces;
      if (from > 0) pieces.push_back({from, {}});
      pieces.push_back({from + length, {kImpulse / length, 0, 0}});
      auto simulation = simulation_of(system, 0, kAdded);
      run(simulation, 3);
      // Differences of second order forget a jump by a factor of 3 in each step.
      const auto& p = simulation.state().particles;
      const double u = kImpulse / (kMass + kAdded);
      EXPECT_NEAR(p.velocities[0], u, 1e-8);
      // A short force acts as if in the middle of its window, half a step away at most.
      EXPECT_NEAR(p.positions[0], 20 + u * (3 - from - length / 2), u * 0.05 + 1e-9);
    }
  }
}

/// The error of the value falls with h^2 from h to h/8.
void expect_order_2(const std::function<double(double h)>& value, double exact, double h) {
  const double coarse = std::abs(value(h) - exact), fine = std::abs(value(h / 8) - exact);
  EXPECT_GT(fine, 1e-12) << "rounding errors hide the order";
  EXPECT_GT(std::log(coarse / fine) / std::log(8), 1.8) << coarse << " " << fine;
}

constexpr double kMass = 2, kDrag = 3;

TEST(InertiaOfFluid, StepsAreOfSecondOrder) {
  // m u' = f - R u from u0.
  constexpr double kForce = -7, kStart = 4, kEnd = 0.8;
  const double rate = kDrag / kMass, limit = kForce / kDrag, decay = std::exp(-rate * kEnd);
  const auto at_end = [&](double h) {
    auto system = with_inertia(h);
    add_particle(system.state, {20, 0, 0}, 1, kMass, {kStart, 0, 0});
    system.setting.forces[0] = constant({kForce, 0, 0});
    auto simulation = simulation_of(system, kDrag);
    run(simulation, kEnd);
    return simulation.state().particles;
  };
  expect_order_2([&](double h) { return at_end(h).velocities[0]; },
                 limit + (kStart - limit) * decay, 0.04);
  expect_order_2([&](double h) { return at_end(h).positions[0]; },
                 20 + limit * kEnd + (kStart - limit) * (1 - decay) / rate, 0.04);
}

TEST(InertiaOfFluid, ABodyBesideADrivenOneWhoseMotionJumpsMovesWithSecondOrder) {
  // The given velocity is 5 until t = 0.377, then -2. Drag ties the free sphere to it.
  constexpr double kJump = 0.377, kEnd = 1.2;
  const double rate = kDrag / kMass;
  const double u1 = 5 * (1 - std::exp(-rate * kJump)), rest = kEnd - kJump;
  const double z1 = 20 + 5 * kJump - u1 / rate;
  const double z = z1 - 2 * rest + (u1 + 2) * (1 - std::exp(-rate * rest)) / rate;
  const auto error = [&](double h) {
    auto system = with_inertia(h);
    add_particle(system.state, {20, 0, 0}, 1, kMass);
    add_particle(system.state, {60, 0, 0}, 1, 0);
    system.setting.given_motions[1].velocity = {{{kJump, {5, 0, 0}}, {1e300, {-2, 0, 0}}}};
    auto simulation = simulation_of(system, kDrag);
    run(simulation, kEnd);
    // A driven particle moves as given, wherever its velocity jumps.
    EXPECT_NEAR(simulation.state().particles.positions[1], 60 + 5 * kJump - 2 * rest, 1e-10);
    return std::abs(simulation.state().particles.positions[0] - z);
  };
  // The place of the jump in its step changes with h, and the constant of the error with it.
  EXPECT_LT(error(0.01), error(0.1) / 30);
  EXPECT_LT(error(0.001), error(0.01) / 30);
}

TEST(InertiaOfFluid, AStepMayFollowAMuchShorterOne) {
  // Runs that end at odd times and go on take short steps between whole ones.
  constexpr double kForce = -7, kEnd = 2;
  const double rate = kDrag / kMass, limit = kForce / kDrag;
  const double z = 20 + limit * (kEnd - (1 - std::exp(-rate * kEnd)) / rate);
  for (const double rest : {0.4, 0.1, 1e-3, 1e-5}) {
    SCOPED_TRACE(rest);
    const auto error = [&](double h) {
      auto system = with_inertia(h);
      add_particle(system.state, {20, 0, 0}, 1, kMass);
      system.setting.forces[0] = constant({kForce, 0, 0});
      auto simulation = simulation_of(system, kDrag);
      for (const double end : {0.2 + rest * h, 0.8 + rest * h, 1.2, kEnd}) run(simulation, end);
      return std::abs(simulation.state().particles.positions[0] - z);
    };
    // Steps of one length have an error of 0.03 with h = 0.1.
    EXPECT_LT(error(0.1), 0.035);
    EXPECT_LT(error(0.0125), 0.035 / 50);
  }
}

double gamma_at_floor(const FluidSimulation& simulation) {
  return pair_of(simulation.state(), -2, 0).gamma;
}

class ImpactInFluid : public ::testing::TestWithParam<Coupling> {
 protected:
  /// A sphere of mass 2 that falls on the floor at the speed 1 from this distance to the contact.
  InFluid falling(double gap, double h) const {
    auto system = with_inertia(h);
    system.setting.fluid->coupling = GetParam();
    add_particle(system.state, {1.01 + gap, 0, 0}, 1, kMass, {-1, 0, 0});
    return system;
  }
};

TEST_P(ImpactInFluid, GivesItsWholeMomentumToGamma) {
  // In the first step, in the second one, and later.
  for (const double gap : {0.0, 0.02, 0.08, 0.1, 0.13, 0.37}) {
    SCOPED_TRACE(gap);
    const auto system = falling(gap, 0.1);
    auto simulation = simulation_of(system);
    run(simulation, 1);
    EXPECT_NEAR(gamma_at_floor(simulation), -kMass, 1e-9);
    EXPECT_NEAR(simulation.state().particles.positions[0], 1.01, 1e-9);
    EXPECT_NEAR(simulation.state().particles.velocities[0], 0, 1e-9);
  }
}

TEST_P(ImpactInFluid, GivesItsWholeMomentumToGammaInStepsOfAnyLength) {
  for (const double end : {0.203, 0.23, 0.25, 0.299}) {
    SCOPED_TRACE(end);
    // It arrives within the short step.
    const auto system = falling((0.2 + end) / 2, 0.1);
    auto simulation = simulation_of(system);
    run(simulation, end);
    run(simulation, 1);
    EXPECT_NEAR(gamma_at_floor(simulation), -kMass, 1e-9);
  }
}

TEST_P(ImpactInFluid, LetsAPullGiveBackWhatAShortStepHasTaken) {
  // A pull of 4 from t = 1 on gives the impulse 2 back until t = 1.5, also in short steps.
  auto system = falling(0.05, 0.1);
  system.setting.forces[0].pieces = {{1, {}}, {1e300, {4, 0, 0}}};
  auto simulation = simulation_of(system);
  for (const double end : {1.213, 1.25}) run(simulation, end);
  // Forces act on gamma up to the middle of the last step, or its beginning.
  EXPECT_NEAR(gamma_at_floor(simulation), -kMass + 4 * 0.25, 4 * 0.1);
  run(simulation, 2);
  EXPECT_EQ(gamma_at_floor(simulation), 0);
  const double since = 2 - 1.5;
  EXPECT_NEAR(simulation.state().particles.velocities[0], 2 * since, 2 * 0.1);
}

INSTANTIATE_TEST_SUITE_P(Couplings, ImpactInFluid,
                         ::testing::Values(Coupling::kConstrained, Coupling::kSplitting));

TEST(InertiaOfFluid, ALoadOnAContactIsInGammaOneStepLater) {
  constexpr double kLoad = 5;
  for (const double h : {0.1, 0.05}) {
    auto system = with_inertia(h);
    add_particle(system.state, {1.01, 0, 0}, 1, kMass);
    system.setting.forces[0] = constant({-kLoad, 0, 0});
    auto simulation = simulation_of(system);
    run(simulation, 1);
    EXPECT_NEAR(gamma_at_floor(simulation), -kLoad * (1 - h), 1e-9);
  }
}

}  // namespace
}  // namespace viscontact::particles
