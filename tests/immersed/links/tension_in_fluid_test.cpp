// Chains of links and films, and bodies, that are pulled in a fluid with a given resistance,
// docs/physics.md (6.15): motions across the pull decay, and pendulums move as closed forms say.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"

namespace viscontact::particles {
namespace {

ArmLength fixed_length(double length) { return PiecewiseLinearLength{{{0, length}}}; }

enum class Kind { kArms, kSprings, kFilms };

/// A disc that is fixed, one below it that is `aside` and a third one that a force pulls down, at
/// the distance `apart` from each other.
struct Chain {
  Kind kind = Kind::kArms;
  double h = 0.1, apart = 1.5, aside = 0.05, force = 1000, drag = 2, mass = 0;
  bool has_inertia = false;  // of the fluid, which has no weight
  Coupling coupling = Coupling::kConstrained;
  // Units; that of the weight is a mass per length.
  double length = 1, time = 1, weight = 1;

  double stiffness() const { return 1e6 * weight / (time * time); }
  InFluid system() const {
    const double mu = weight / time;
    auto made = in_fluid(2, 100 * length, h * time, 0.01 * length);
    made.setting.fluid->viscosity = mu;
    if (has_inertia) made.setting.fluid->density = 1e-12;
    made.setting.fluid->coupling = coupling;
    const double radius = kind == Kind::kFilms ? apart / 2 - 0.005 : 0.1;
    const Vector top{50, 50, 0};
    const double down = std::sqrt(apart * apart - aside * aside);
    const std::vector<Vector> at{top, top + Vector{aside, -down, 0}, top + Vector{0, -2 * down, 0}};
    for (std::size_t k = 0; k < 3; ++k)
      add_pushed(made, length * at[k], radius * length, mass * weight,
                 {0, k == 2 ? -force * weight * length / (time * time) : 0, 0});
    auto& p = made.state.particles;
    p.angles.assign(3, 0);
    p.angular_velocities.assign(3, 0);
    if (mass > 0)
      p.inertias.assign(3, round_shape(2, radius).inertia(mass) * weight * length * length);
    made.setting.given_motions[0] = {};
    auto& links = made.setting.links;
    for (std::int32_t k = 0; k < 2; ++k) {
      if (kind == Kind::kArms) links.arms.push_back({k, k + 1, fixed_length(apart * length)});
      if (kind == Kind::kSprings)
        links.springs.push_back({k, k + 1, stiffness(), apart * length - force * length / 1e6});
      if (kind == Kind::kFilms) {
        Pair pair{k, k + 1};
        pair.gamma = -1e9 * weight * length / time;
        made.state.pairs.push_back(pair);
      }
    }
    return made;
  }
  Resistance resistance() const { return constant_drag(drag * weight / time); }
};

/// Distances of the middle disc from the line of the chain, in the length of the chain, after each
/// of `steps` steps. The chain must not contract by more than what was slack.
std::vector<double> asides(const Chain& chain, int steps) {
  auto system = chain.system();
  auto simulation = system.simulation(chain.resistance());
  std::vector<double> result{chain.aside};
  for (int n = 1; n <= steps; ++n) {
    const auto report = simulation.step(1e9 * chain.time);
    EXPECT_TRUE(report.converged) << n;
    const auto& p = simulation.state().particles;
    result.push_back(p.position(1)[0] / chain.length - 50);
    const double bottom = 50 - p.position(2)[1] / chain.length;
    // What the motion across the chain lengthens the links by to second order, twice, is regained
    // in the next steps.
    EXPECT_NEAR(bottom, 2 * chain.apart, 5 * chain.aside * chain.aside) << n;
  }
  return result;
}

TEST(TensionInFluid, AMotionAcrossAMasslessChainDecaysMonotonicallyAtEveryStep) {
  for (const auto kind : {Kind::kArms, Kind::kSprings, Kind::kFilms})
    for (const double h : {1e-5, 1e-3, 3e-3, 0.01, 0.05, 1.0, 100.0}) {
      SCOPED_TRACE(::testing::Message() << static_cast<int>(kind) << " " << h);
      const Chain chain{.kind = kind, .h = h};
      const auto x = asides(chain, 12);
      // The slower one of both modes of the chain decays at this rate. Rounding and the tolerance
      // of lengths, 1e-6 radii, leave some 1e-7.
      const double rate = (3 - std::sqrt(5.0)) / 2 * chain.force / chain.apart / chain.drag;
      for (std::size_t n = 1; n < x.size(); ++n) {
        // Where one step turns the links to the line of the pull, the correction of their lengths
        // moves the disc by the second order of the turn.
        EXPECT_LE(std::abs(x[n]), x[0] / (1 + rate * h / 4) + 0.2 * chain.aside * chain.aside) << n;
        EXPECT_LE(x[n], std::max(x[n - 1], 0.0) + 1e-6) << n;
        EXPECT_GE(x[n], -0.2 * chain.aside * chain.aside) << n;
      }
      EXPECT_LT(x.back(), 1e-6 + chain.aside * std::pow(1 + rate * h, -11.0));
    }
}

TEST(TensionInFluid, UnitsDoNotMatter) {
  const auto x = asides({.kind = Kind::kSprings, .h = 0.004}, 6);
  for (const double unit : {1e-5, 1e5}) {
    const auto scaled = asides(
        {.kind = Kind::kSprings, .h = 0.004, .length = unit, .time = unit, .weight = 1 / unit}, 6);
    for (std::size_t n = 0; n < x.size(); ++n) EXPECT_NEAR(scaled[n], x[n], 1e-7);
  }
}

TEST(TensionInFluid, AMotionAcrossAChainOfMassesDoesNotGrowAtAnyStep) {
  for (const bool has_inertia : {false, true})
    for (const auto kind : {Kind::kArms, Kind::kSprings})
      for (const double drag : {1e-6, 1.0}) {
        const double period =
            2 * std::numbers::pi / std::sqrt(1000 * 2 / 1.5);  // of the middle disc alone
        for (const double share : {1e-3, 0.05, 0.2, 0.35, 0.5, 1.0}) {
          SCOPED_TRACE(::testing::Message() << has_inertia << " " << static_cast<int>(kind) << " "
                                            << drag << " " << share);
          const Chain chain{.kind = kind,
                            .h = share * period,
                            .aside = 0.01,
                            .drag = drag,
                            .mass = 1,
                            .has_inertia = has_inertia};
          for (const double x : asides(chain, 60)) EXPECT_LE(std::abs(x), 1.1 * chain.aside);
        }
      }
}

/// The angle of a disc without mass from the line of the force on it at the time `end`, on an arm
/// or a stiff spring of length 1.5 about a fixed disc. Its rate is -force/(drag length) sin(angle).
double angle_of_pendulum(Kind kind, double h, double end) {
  constexpr double kLength = 1.5, kForce = 3, kDrag = 2, kStart = 1.2;
  auto system = in_fluid(2, 100, h, 0.01);
  system.setting.fluid->viscosity = kDrag / (4 * std::numbers::pi);
  add_pushed(system, {50, 50, 0}, 0.1, 0, {});
  add_pushed(system, {50 + kLength * std::sin(kStart), 50 - kLength * std::cos(kStart), 0}, 0.1, 0,
             {0, -kForce, 0});
  system.setting.given_motions[0] = {};
  if (kind == Kind::kArms)
    system.setting.links.arms = {{0, 1, fixed_length(kLength)}};
  else
    system.setting.links.springs = {{0, 1, 1e7, kLength}};
  auto simulation = system.simulation(constant_drag(kDrag));
  run(simulation, end);
  const auto& p = simulation.state().particles;
  const double angle = std::atan2(p.position(1)[0] - 50, 50 - p.position(1)[1]);
  const double exact =
      2 * std::atan(std::tan(kStart / 2) * std::exp(-kForce * end / (kDrag * kLength)));
  return angle - exact;
}

TEST(TensionInFluid, APendulumWithoutMassIsOfSecondOrderWithAndWithoutTheTurningRow) {
  // The row acts in steps of 0.1 and more. An arm in steps of 0.0125 has no row.
  for (const auto kind : {Kind::kArms, Kind::kSprings}) {
    const double coarse = angle_of_pendulum(kind, 0.4, 2), fine = angle_of_pendulum(kind, 0.1, 2);
    EXPECT_LT(std::abs(coarse), 0.02);
    EXPECT_LT(std::abs(fine), std::abs(coarse) / 10);
  }
  EXPECT_LT(std::abs(angle_of_pendulum(Kind::kArms, 0.0125, 2)), 1e-5);
}

TEST(TensionInFluid, ABodyOnAHingeThatIsPulledTurnsToTheForceAtEveryStep) {
  for (const double mass : {0.0, 1.0})
    for (const bool has_inertia : {false, true})
      for (const double h : {1e-3, 0.01, 0.1, 1.0}) {
        if (has_inertia && mass == 0) continue;
        SCOPED_TRACE(::testing::Message() << mass << " " << has_inertia << " " << h);
        auto system = in_fluid(2, 100, h, 0.01);
        if (has_inertia) system.setting.fluid->density = 1e-12;
        const double start = 0.1, length = 2;
        const Vector hinge_at{50, 50, 0};
        add_pushed(system, hinge_at, 0.5, mass, {});
        add_pushed(system,
                   hinge_at + Vector{length * std::sin(start), -length * std::cos(start), 0}, 0.5,
                   mass, {0, -1000, 0});
        auto& p = system.state.particles;
        p.angles.assign(2, 0);
        p.angular_velocities.assign(2, 0);
        p.inertias.assign(2, round_shape(2, 0.5).inertia(mass));
        add_rigid_body(p, {{0, 1}});
        system.setting.links.hinges = {hinge_of_body(p, hinge_at)};
        auto simulation = system.simulation(constant_drag(2));
        double largest = 0;
        for (int n = 0; n < 60; ++n) {
          simulation.step(1e9);
          const auto& q = simulation.state().particles;
          largest =
              std::max(largest, std::abs(std::atan2(q.position(1)[0] - 50, 50 - q.position(1)[1])));
          if (mass == 0) {
            // One implicit step of sin(angle) ends beyond 0 by tan(angle) - angle.
            EXPECT_GE(q.position(1)[0] - 50, -length * std::pow(start, 3) / 2) << n;
          }
        }
        EXPECT_LE(largest, 1.02 * start);
      }
}

TEST(TensionInFluid, TheWorksOfPullingArmsAddUpToTheDissipation) {
  // Two arms at an angle shorten by a third in steps in which they turn visibly.
  const double h = 0.5, end = 2;
  auto system = in_fluid(2, 100, h, 0.01);
  system.setting.fluid->viscosity = 2 / (4 * std::numbers::pi);
  for (const Vector& at : {Vector{48, 50, 0}, Vector{50, 49, 0}, Vector{52, 50, 0}})
    add_pushed(system, at, 0.1, 0, {});
  auto& p = system.state.particles;
  p.angles.assign(3, 0);
  p.angular_velocities.assign(3, 0);
  const double length = std::sqrt(5.0);
  const ArmLength shrinks = PiecewiseLinearLength{{{0, length}, {end, length - 1.4}}};
  system.setting.links.arms = {{0, 1, shrinks}, {1, 2, shrinks}};
  auto simulation = system.simulation(constant_drag(2));
  double work = 0, dissipated = 0;
  while (simulation.state().time < end - h / 2) {
    dissipated += h * simulation.step(end).fluid.dissipation;
    for (const double power : simulation.state().arm_powers) work += h * power;
  }
  EXPECT_GT(work, 1);
  EXPECT_NEAR(work, dissipated, 1e-9 * work);
}

/// StepReport::buckling of the first step of a disc that stands on an arm or a spring above a fixed
/// disc, at the distance 1.5, and is pushed down with 3.
double buckling_of_standing(Kind kind, double h, double mass, double density, double push = 3) {
  auto system = in_fluid(2, 100, h, 0.01);
  constexpr double kDrag = 2, kLength = 1.5;
  system.setting.fluid->viscosity = kDrag / (4 * std::numbers::pi);
  system.setting.fluid->density = density;
  add_pushed(system, {50, 50, 0}, 0.1, 0, {});
  add_pushed(system, {50, 50 + kLength, 0}, 0.1, mass, {0, -push, 0});
  auto& p = system.state.particles;
  p.angles.assign(2, 0);
  p.angular_velocities.assign(2, 0);
  if (mass > 0) p.inertias.assign(2, round_shape(2, 0.1).inertia(mass));
  system.setting.given_motions[0] = {};
  if (kind == Kind::kArms)
    system.setting.links.arms = {{0, 1, fixed_length(kLength)}};
  else
    // The spring has the force of the push from the start.
    system.setting.links.springs = {{0, 1, 1e3, kLength + push / 1e3}};
  auto simulation = system.simulation(constant_drag(kDrag));
  // The first step of a fluid with inertia has the forces of half of it.
  if (density > 0) simulation.step(1e9);
  return simulation.step(1e9).buckling;
}

TEST(TensionInFluid, ADiscThatStandsOnALinkBucklesByItsForceOverTheDrag) {
  // Across the arm the disc moves away at the rate force/(length drag) of its distance. A spring
  // gives way by 1e-3 in a long step.
  for (const auto kind : {Kind::kArms, Kind::kSprings})
    for (const double h : {0.01, 0.5, 5.0})
      EXPECT_NEAR(buckling_of_standing(kind, h, 0, 0) / (h * 3 / 1.5 / 2), 1, 1e-2) << h;
  EXPECT_NEAR(buckling_of_standing(Kind::kArms, 5, 0, 0), 5, 1e-6);
  // A mass of which the drag resists less than the inertia in a step: z = h^2 force/(length mass).
  EXPECT_NEAR(buckling_of_standing(Kind::kArms, 0.1, 100, 0), 0.01 * 3 / 1.5 / 100, 1e-6);
  EXPECT_NEAR(buckling_of_standing(Kind::kArms, 0.1, 100, 1e-12), 0.01 * 3 / 1.5 / 100, 1e-6);
  EXPECT_EQ(buckling_of_standing(Kind::kArms, 5, 0, 0, -3), 0) << "it is pulled";
}

/// A plate that hangs on a fixed disc by a film at its end, nearly along the force that pulls it
/// down. `tilts` are its angles from this direction after each step.
struct HangingPlate {
  double h = 0.01;
  double buckling = 0;  // the largest of a step
  std::vector<double> tilts{};

  void hang(int steps) {
    constexpr double kHalf = 1, kEnd = 0.1, kDrag = 2, kTilt = 0.02;
    auto system = in_fluid(2, 100, h, 0.01);
    auto& fluid = *system.setting.fluid;
    fluid.viscosity = kDrag / (4 * std::numbers::pi);
    const double gap = 0.009, down = 0.2 + gap + kHalf - kEnd;
    add_pushed(system, {50, 50, 0}, 0.1, 0, {});
    add_pushed(system, {50 + down * std::sin(kTilt), 50 - down * std::cos(kTilt), 0}, kHalf, 0,
               {0, -10, 0});
    auto& p = system.state.particles;
    p.angles = {0, kTilt - std::numbers::pi / 2};
    p.angular_velocities.assign(2, 0);
    p.shapes = {Shape::disc(0.1), Shape::plate(kHalf, kEnd)};
    system.setting.given_motions[0] = {};
    Pair pair{0, 1};
    pair.gamma = -1e9;
    system.state.pairs.push_back(pair);
    auto simulation = system.simulation(constant_drag(kDrag));
    for (int n = 0; n < steps; ++n) {
      buckling = std::max(buckling, simulation.step(1e9).buckling);
      tilts.push_back(simulation.state().particles.angles[1] + std::numbers::pi / 2);
    }
  }
};

TEST(TensionInFluid, FilmsOfPlatesThatVibrateWithAGrowingAmplitudeAreCounted) {
  // (6.15) with the pull 10, the drags 2 of a motion and of a turn of the plate, the arm 0.9 of its
  // end, and the distance 0.2 + the gap of the spines.
  const auto half_of_z = [](double h) { return h * 10 * ((1 + 0.81) / 2 / 0.21 + 0.9 / 2) / 2; };
  for (const double h : {0.01, 0.04}) {
    HangingPlate plate{.h = h};
    plate.hang(60);
    // The first step pulls the film from the gap 0.009 to 0.01.
    EXPECT_NEAR(plate.buckling / half_of_z(h), 1, 0.06);
    EXPECT_LT(plate.buckling, 1);
    EXPECT_LT(std::abs(plate.tilts.back()), 0.01);
  }
  HangingPlate plate{.h = 0.05};
  plate.hang(60);
  EXPECT_GT(half_of_z(0.05), 1);
  EXPECT_GT(plate.buckling, 1);
  EXPECT_GT(std::abs(plate.tilts.back()), 1);
}

/// Largest distance of the middle disc from the line of a chain of masses in 60 steps with
/// Coupling::kSplitting, over that at the start. `buckling` is that of the second step.
double growth_with_splitting(Kind kind, double share, bool has_inertia, double& buckling) {
  const double period = 2 * std::numbers::pi / std::sqrt(1000 * 2 / 1.5);
  const Chain chain{.kind = kind,
                    .h = share * period,
                    .aside = 0.01,
                    .drag = 1e-6,
                    .mass = 1,
                    .has_inertia = has_inertia,
                    .coupling = Coupling::kSplitting};
  auto system = chain.system();
  auto simulation = system.simulation(chain.resistance());
  double largest = 0;
  for (int n = 0; n < 60; ++n) {
    const double now = simulation.step(1e9).buckling;
    if (n == 1) buckling = now;
    largest = std::max(largest, std::abs(simulation.state().particles.position(1)[0] - 50));
  }
  return largest / chain.aside;
}

TEST(TensionInFluid, WithSplittingLinksAreStableAndFilmsThatAreNotAreCounted) {
  double buckling = 0;
  for (const bool has_inertia : {false, true}) {
    for (const double share : {1e-3, 0.05, 0.2, 0.35, 0.5, 1.0})
      for (const auto kind : {Kind::kArms, Kind::kSprings}) {
        EXPECT_LE(growth_with_splitting(kind, share, has_inertia, buckling), 1.1) << share;
        EXPECT_EQ(buckling, 0) << share;
      }
    // z is the sum of h^2 T/(l m) over the films at the ends of the lower film: three of them.
    EXPECT_LE(growth_with_splitting(Kind::kFilms, 0.1, has_inertia, buckling), 1.1);
    EXPECT_NEAR(buckling, 3 * std::pow(0.2 * std::numbers::pi, 2) / 2 / 2, 0.02);
    EXPECT_GT(growth_with_splitting(Kind::kFilms, 0.35, has_inertia, buckling), 10);
    EXPECT_GT(buckling, 1);
  }
}

TEST(TensionInFluid, ARunThatIsContinuedGivesTheSameBits) {
  for (const auto kind : {Kind::kArms, Kind::kSprings, Kind::kFilms})
    for (const double mass : {0.0, 1.0}) {
      const Chain chain{.kind = kind, .h = 0.02, .mass = mass};
      auto whole = chain.system();
      auto simulation = whole.simulation(chain.resistance());
      for (int n = 0; n < 3; ++n) simulation.step(1e9);
      auto rest = chain.system();
      rest.state = simulation.state();
      auto continued = rest.simulation(chain.resistance());
      for (int n = 0; n < 3; ++n) {
        simulation.step(1e9);
        continued.step(1e9);
        EXPECT_EQ(simulation.state().particles.positions, continued.state().particles.positions);
        EXPECT_EQ(simulation.state().link_forces, continued.state().link_forces);
      }
    }
}

}  // namespace
}  // namespace viscontact::particles
