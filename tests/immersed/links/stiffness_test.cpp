// Springs of all stiffnesses beside rigid bodies, hinges and arms, in a fluid with a given
// resistance and in steps of all lengths, against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"

namespace viscontact::particles {
namespace {

constexpr double kDrag = 2, kRelativeError = 1e-9;

/// Answers with errors of the size that those of FreeFEM have.
class RoundedFluid : public StandInFluid {
 public:
  using StandInFluid::StandInFluid;
  std::vector<double> velocities(std::span<const double> forces, bool driving) override {
    auto velocities = StandInFluid::velocities(forces, driving);
    for (auto& v : velocities) v *= 1 + kRelativeError * std::sin(++answers_);
    return velocities;
  }

 private:
  double answers_ = 0;
};

/// State::link_forces after one step.
std::vector<double> forces_after_step(const InFluid& system) {
  FluidSimulation simulation(system.setting, system.state,
                             std::make_unique<RoundedFluid>(constant_drag(kDrag)));
  simulation.step(system.setting.time_step);
  return simulation.state().link_forces;
}

/// Three discs of drag kDrag on a line, the first two of which are a body.
InFluid body_and_disc(double h) {
  auto system = in_fluid(2, 100, h, 0.01);
  for (const double x : {49.0, 51.0, 55.0}) add_pushed(system, {x, 50, 0}, 0.5, 0, {});
  auto& p = system.state.particles;
  p.angles.assign(3, 0);
  p.angular_velocities.assign(3, 0);
  add_rigid_body(p, {{0, 1}});
  return system;
}

/// Of a spring with z = h stiffness (A S A^T), docs/physics.md (6.7).
double theta_of(double z) { return (1 + z) / (2 + z); }

template <class Check>
void for_steps_and_stiffnesses(const Check& check) {
  for (double h = 1e-9; h < 2; h *= std::sqrt(1000))
    for (double k = 1e-12; k < 2e12; k *= 100) {
      SCOPED_TRACE(testing::Message() << "h = " << h << ", k = " << k);
      check(h, k);
    }
}

// The errors of the answers enter the forces a few times.
constexpr double kAllowed = 100 * kRelativeError;

TEST(Stiffness, OfATorsionSpringOnAHingedBody) {
  for_steps_and_stiffnesses([](double h, double k) {
    auto system = body_and_disc(h);
    Hinge hinge;
    hinge.body = 0;
    hinge.at = {48.8, 50.1, 0};
    hinge.point = {0, hinge.at - Vector{50, 50, 0}};
    hinge.stiffness = k;
    hinge.rest_angle = 0.5;
    system.setting.links.hinges = {hinge};
    const auto forces = forces_after_step(system);
    // About the hinge, the discs resist with kDrag each, and with kDrag times the squared distance.
    const double first = 0.04 + 0.01, second = 2.2 * 2.2 + 0.01;
    const double resistance = kDrag * (2 + first + second);
    const double theta = theta_of(h * k / kDrag);
    const double torque = 0.5 * k / (1 + k * theta * h / resistance);
    // The hinge carries the drag of the centre of the body.
    const double spin = torque / resistance;
    const Vector force{2 * kDrag * spin * 0.1, 2 * kDrag * spin * 1.2, 0};
    EXPECT_NEAR(forces[2], torque, kAllowed * torque);
    EXPECT_NEAR(forces[0], force[0], kAllowed * norm(force));
    EXPECT_NEAR(forces[1], force[1], kAllowed * norm(force));
  });
}

TEST(Stiffness, OfASpringOnABody) {
  for_steps_and_stiffnesses([](double h, double k) {
    auto system = body_and_disc(h);
    system.setting.links.springs = {{1, 2, k, 3}};
    const double theta = theta_of(h * k * 2 / kDrag), mobility = 1.5 / kDrag;
    const double force = -k / (1 + k * theta * h * mobility);
    EXPECT_NEAR(forces_after_step(system)[0], force, -kAllowed * force);
  });
}

/// An arm beside the spring leaves it no motion but its own.
TEST(Stiffness, OfASpringBesideAnArm) {
  for_steps_and_stiffnesses([](double h, double k) {
    auto system = body_and_disc(h);
    constexpr double kRate = 0.3;
    system.setting.links.springs = {{1, 2, k, 3}};
    system.setting.links.arms = {{1, 2, PiecewiseLinearLength{{{0, 4}, {10, 4 + 10 * kRate}}}}};
    const auto forces = forces_after_step(system);
    const double theta = theta_of(h * k * 2 / kDrag), mobility = 1.5 / kDrag;
    const double of_spring = -k * (1 + theta * h * kRate);
    EXPECT_NEAR(forces[0], of_spring, -kAllowed * of_spring);
    // The length of the arm is known to rounding errors, and its rate to those over the step.
    const double of_rate = kRate + 4e-16 * 4 / h;
    EXPECT_NEAR(forces[1], kRate / mobility - of_spring,
                kAllowed * (of_rate / mobility - of_spring) + 4e-16 * 8 / h / mobility);
  });
}

/// Two springs side by side share the motion, and may push against each other.
TEST(Stiffness, OfTwoSpringsSideBySide) {
  for_steps_and_stiffnesses([](double h, double k) {
    for (const double other : {1e-3, 1.0, 1e3}) {
      auto system = body_and_disc(h);
      system.setting.links.springs = {{1, 2, k, 3}, {2, 1, other, 4.5}};
      const double mobility = 1.5 / kDrag;
      const double first = k * theta_of(h * k * 2 / kDrag) * h,
                   second = other * theta_of(h * other * 2 / kDrag) * h;
      // The forces at rest, -k and other/2, without the rate that both add, in which they cancel.
      const double together = 1 + mobility * (first + second), at_rest = 0.5 * other;
      const double of_first =
          -(k * (1 + mobility * second) + at_rest * mobility * first) / together;
      const double of_second =
          (at_rest * (1 + mobility * first) + k * mobility * second) / together;
      const auto forces = forces_after_step(system);
      const double largest = std::max(-of_first, of_second);
      EXPECT_NEAR(forces[0], of_first, kAllowed * largest);
      EXPECT_NEAR(forces[1], of_second, kAllowed * largest);
    }
  });
}

}  // namespace
}  // namespace viscontact::particles
