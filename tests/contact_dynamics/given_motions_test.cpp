// Particles whose motion is given, and planes under a load, without a fluid: closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "tests/common/failure.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/particle_runs/io/contact_file.hpp"
#include "viscontact/particle_runs/io/restart.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

// Impulses are computed to 1e-10 of those at work; a chain of a few contacts adds their errors.
constexpr double kImpulses = 1e-9;

FrictionLaw friction(double coefficient, FrictionMethod method) {
  FrictionLaw law;
  law.coefficient = coefficient;
  law.method = method;
  return law;
}

/// The ways in which a step is solved: 0 without friction, 1 with Coulomb's law, 2 with the convex
/// relaxation.
void solve_by(int way, Setting& setting, State& state) {
  setting.laws.film.gamma_min = 0;
  if (way == 0) return;
  setting.laws.friction =
      friction(0.3, way == 1 ? FrictionMethod::kCoulomb : FrictionMethod::kConvex);
  add_rotation(state.particles);
}

Plane loaded_plane(const Vector& point, const Vector& normal, double force, double mass) {
  auto plane = plane_at_rest(point, normal);
  plane.load = PlaneLoad{constant({force, 0, 0}), mass};
  return plane;
}

/// A plane at rest through the origin with the normal `up`, a column of `count` particles on it,
/// and a plane on top of them that the force `force` presses down. `unit` multiplies lengths,
/// `heavy` masses, `slow` times.
struct Piston {
  int dimension = 2, count = 1, way = 0;
  Vector up{0, 1, 0};
  double unit = 1, heavy = 1, slow = 1, force = 2, mass = 3, gap = 0, step = 0.01;
  bool is_reversed = false;

  double force_unit() const { return heavy * unit / (slow * slow); }
  Setting setting() const {
    Setting setting;
    setting.time_step = step * slow;
    const double top = unit * (2.0 * count + gap);
    setting.planes = {plane_at_rest({}, up),
                      loaded_plane(top * up, -1.0 * up, force * force_unit(), heavy * mass)};
    return setting;
  }
  State state() const {
    State state = no_particles(dimension);
    for (int k = 0; k < count; ++k) {
      const int place = is_reversed ? count - 1 - k : k;
      add_particle(state, unit * (2.0 * place + 1) * up, unit, heavy * (1 + 0.5 * place));
    }
    return state;
  }
};

/// The force of the contacts on the plane under the load along its normal.
double push_on_piston(const Setting& setting, const State& state) {
  return dot(wall_forces(setting, state).back(), -1.0 * setting.planes.back().start.normal);
}

TEST(LoadedPlane, RestsOnAColumnWithTheForceThatIsGiven) {
  const Vector tilted2 = {-std::sin(0.7), std::cos(0.7), 0};
  const Vector tilted3 = {0.48, 0.6, 0.64};
  for (const int way : {0, 1, 2})
    for (auto piston : {Piston{}, Piston{.count = 5}, Piston{.dimension = 3, .count = 3},
                        Piston{.count = 4, .up = tilted2, .is_reversed = true},
                        Piston{.dimension = 3, .count = 2, .up = tilted3},
                        Piston{.count = 3, .unit = 1e-5, .heavy = 1e-12, .slow = 1e3},
                        Piston{.count = 2, .unit = 1e6, .heavy = 1e9, .slow = 1e-4},
                        Piston{.count = 3, .mass = 1e-6}, Piston{.count = 3, .mass = 1e3}}) {
      piston.way = way;
      SCOPED_TRACE(testing::Message() << way << ' ' << piston.dimension << ' ' << piston.count
                                      << ' ' << piston.unit << ' ' << piston.mass);
      auto setting = piston.setting();
      auto state = piston.state();
      solve_by(way, setting, state);
      Simulation simulation(setting, state, 1);
      take_steps(simulation, 5);
      const double force = piston.force * piston.force_unit();
      const auto forces = wall_forces(setting, simulation.state());
      for (const int plane : {0, 1})
        EXPECT_NEAR(norm(forces[static_cast<std::size_t>(plane)]) / force, 1, kImpulses);
      const auto& motion = simulation.state().planes.back();
      EXPECT_NEAR(motion.displacement / piston.unit, 0, 1e-9);
    }
}

TEST(LoadedPlane, FallsOnADiscAndStops) {
  // Before it meets the disc, it has the acceleration F/m. Afterwards momentum is that of F alone,
  // less what the floor takes.
  for (const int way : {0, 1, 2})
    for (const double step : {0.02, 0.01}) {
      Piston piston{.way = way, .gap = 0.5, .step = step};
      auto setting = piston.setting();
      auto state = piston.state();
      solve_by(way, setting, state);
      Simulation simulation(setting, state, 1);
      double before = 0, fastest = 0;
      bool has_landed = false;
      run(simulation, 2, [&](const StepReport& report) {
        EXPECT_TRUE(report.converged);
        EXPECT_LE(report.largest_overlap, setting.solver.tolerance);
        const auto& now = simulation.state();
        const double velocity = now.planes.back().velocity;
        // m dV/dt = F - N in each step.
        const double push = push_on_piston(setting, now);
        EXPECT_NEAR(piston.mass * (velocity - before) / step, piston.force - push,
                    kImpulses * std::max(push, piston.force))
            << report.time;
        before = velocity;
        fastest = std::max(fastest, velocity);
        has_landed = has_landed || push > 0;
      });
      EXPECT_TRUE(has_landed);
      // v^2 = 2 (F/m) s; the last step before the landing ends up to v h before it.
      const double landing = std::sqrt(2 * piston.force / piston.mass * piston.gap);
      EXPECT_NEAR(fastest, landing, 2 * piston.force / piston.mass * step);
      EXPECT_NEAR(simulation.state().planes.back().displacement, piston.gap, 1e-6);
      EXPECT_NEAR(push_on_piston(setting, simulation.state()), piston.force, kImpulses);
    }
}

TEST(LoadedPlane, MovesWithAParticleThatIsPushedAgainstIt) {
  // A disc of mass m, pushed up by f, carries the plane of mass M under F < f: both move with
  // (f - F)/(m + M), and the contact bears F + M a.
  for (const int way : {0, 1, 2}) {
    auto setting = Piston{}.setting();
    auto state = Piston{}.state();
    solve_by(way, setting, state);
    setting.forces[0] = constant({0, 7, 0});
    Simulation simulation(setting, state, 1);
    take_steps(simulation, 20);
    const double a = (7 - 2) / (1 + 3.0);
    EXPECT_NEAR(simulation.state().planes[1].velocity, -a * 0.2, kImpulses);
    EXPECT_NEAR(push_on_piston(setting, simulation.state()), 2 + 3 * a, 10 * kImpulses);
    EXPECT_NEAR(simulation.state().particles.velocity(0)[1], a * 0.2, kImpulses);
  }
}

TEST(LoadedPlane, FollowsALoadThatDependsOnTime) {
  auto setting = Piston{}.setting();
  auto state = Piston{}.state();
  setting.laws.film.gamma_min = 0;
  setting.planes[1].load->force = {{{0.1, {2, 0, 0}}, {0.2, {-1, 0, 0}}, {9, {4, 0, 0}}}};
  Simulation simulation(setting, state, 1);
  run(simulation, 0.1);
  EXPECT_NEAR(push_on_piston(setting, simulation.state()), 2, kImpulses);
  run(simulation, 0.2);
  EXPECT_EQ(push_on_piston(setting, simulation.state()), 0);
  EXPECT_NEAR(simulation.state().planes[1].velocity, -0.1 / 3, 1e-12);
  run(simulation, 1);
  EXPECT_NEAR(push_on_piston(setting, simulation.state()), 4, 4 * kImpulses);
}

TEST(LoadedPlane, OfTheLeapfrogIsOfSecondOrder) {
  // F/m (t^2/2) exactly, as for a particle.
  auto setting = Piston{.gap = 100}.setting();
  setting.scheme = Scheme::kLeapfrog;
  setting.laws.film.gamma_min = 0;
  Simulation simulation(setting, Piston{}.state(), 1);
  run(simulation, 1);
  EXPECT_NEAR(simulation.state().planes[1].displacement, 2.0 / 3 / 2, 1e-12);
}

TEST(LoadedPlane, DragsParticlesAlongByItsOwnMotionAlongItself) {
  // The plane moves along itself at 1. Its friction mu F accelerates the disc, which slides on it
  // and rolls on the floor, and the floor bears F.
  auto setting = Piston{.force = 2}.setting();
  auto state = Piston{}.state();
  solve_by(1, setting, state);
  setting.planes[1].velocity = constant({1, 0, 0});
  Simulation simulation(setting, state, 1);
  take_steps(simulation, 10);
  // Rolling on the floor: (m + I/r^2) a = 2 mu F, with I = m r^2/2 and the friction at the height
  // 2 r, until the top of the disc has the velocity 1.
  const double a = 2 * 0.3 * 2 / 1.5;
  EXPECT_NEAR(simulation.state().particles.velocity(0)[0], a * 0.1, 1e-6);
  take_steps(simulation, 200);
  EXPECT_NEAR(simulation.state().particles.velocity(0)[0], 0.5, 1e-6);
  EXPECT_NEAR(push_on_piston(setting, simulation.state()), 2, 1e-8);
}

TEST(LoadedPlane, WithFilmsTakesTheImpulseOfThePull) {
  // The film of the disc absorbs F t; a pull then needs the same time to free the plane.
  for (const int way : {0, 1, 2}) {
    auto setting = Piston{}.setting();
    auto state = Piston{}.state();
    solve_by(way, setting, state);
    setting.laws.film.gamma_min = -10;
    setting.planes[1].load->force = {{{1, {2, 0, 0}}, {9, {-4, 0, 0}}}};
    Simulation simulation(setting, state, 1);
    run(simulation, 1);
    EXPECT_NEAR(pair_of(simulation.state(), -2, 0).gamma, -2, 1e-8);
    run(simulation, 1.49);
    EXPECT_NEAR(simulation.state().planes[1].displacement, 0, 1e-6);
    run(simulation, 2);
    // Free since 1.5: the velocity is -4/3 times 0.5.
    EXPECT_NEAR(simulation.state().planes[1].velocity, -4.0 / 3 * 0.5, 1e-6);
  }
}

/// A row of discs along x from 0 on, at distances of 2; the first one is driven at `speed`.
struct Row {
  Setting setting;
  State state = no_particles(2);
  Row(int way, double speed, int count) {
    setting.time_step = 0.01;
    for (int k = 0; k <= count; ++k) add_particle(state, {2.0 * k, 0, 0}, 1, 1.0 + k);
    setting.given_motions[0].velocity = constant({speed, 0, 0});
    solve_by(way, setting, state);
  }
};

TEST(LoadedPlane, RestsOnADrivenParticleAndRubsOnIt) {
  for (const int dimension : {2, 3})
    for (const int way : {0, 1, 2}) {
      SCOPED_TRACE(testing::Message() << dimension << ' ' << way);
      Piston piston{.dimension = dimension, .way = way};
      auto setting = piston.setting();
      auto state = piston.state();
      solve_by(way, setting, state);
      setting.given_motions[0] = {constant({0.5, 0, 0}), {}};
      state.particles.masses[0] = 0;
      Simulation simulation(setting, state, 1);
      run(simulation, 0.1, [&](const StepReport& report) {
        EXPECT_TRUE(report.converged);
        EXPECT_LE(report.largest_overlap, setting.solver.tolerance);
      });
      EXPECT_NEAR(push_on_piston(setting, simulation.state()), piston.force, kImpulses);
      // The plane holds the particle back by Coulomb's friction.
      const auto on_plane = wall_forces(setting, simulation.state()).back();
      EXPECT_NEAR(on_plane[0], way == 0 ? 0 : 0.3 * piston.force, kImpulses);
    }
}

TEST(GivenMotion, PushesARowWithTheForcesOnIt) {
  for (const int way : {0, 1, 2}) {
    Row row(way, 0.5, 3);
    for (const int k : {1, 2, 3}) row.setting.forces[k] = constant({-1.0 * k, 0, 0});
    Simulation simulation(row.setting, row.state, 1);
    take_steps(simulation, 50);
    const auto& state = simulation.state();
    ASSERT_EQ(state.given_loads.size(), 1U);
    EXPECT_NEAR(state.given_loads[0].force[0], -6, kImpulses * 6);
    EXPECT_NEAR(state.given_loads[0].force[1], 0, kImpulses);
    for (const std::size_t k : {0U, 1U, 2U, 3U})
      EXPECT_NEAR(state.particles.velocity(k)[0], 0.5, 1e-9);
    EXPECT_NEAR(state.particles.position(0)[0], 0.25, 1e-12);
    // In the first step the row gets the momentum 9 times 0.5.
    Simulation again(row.setting, row.state, 1);
    take_steps(again, 1);
    EXPECT_NEAR(again.state().given_loads[0].force[0], -(9 * 0.5 / 0.01 + 6), 1e-6);
  }
}

TEST(GivenMotion, OfEitherNumberOfAPairIsTheSame) {
  // The driven particle comes last, so that it is the second of its pair.
  for (const int way : {0, 1, 2})
    for (const int dimension : {2, 3}) {
      Setting setting;
      setting.time_step = 0.01;
      State state = no_particles(dimension);
      add_particle(state, {2, 0, 0}, 1, 2);
      add_particle(state, {0, 0, 0}, 1, 1);
      setting.given_motions[1].velocity = constant({0.5, 0, 0});
      setting.forces[0] = constant({-3, 0, 0});
      solve_by(way, setting, state);
      Simulation simulation(setting, state, 1);
      take_steps(simulation, 20);
      EXPECT_NEAR(simulation.state().given_loads[0].force[0], -3, 3 * kImpulses);
      EXPECT_NEAR(simulation.state().particles.velocity(0)[0], 0.5, 1e-9);
    }
}

TEST(GivenMotion, TurnsAnotherDiscByItsFriction) {
  // A disc turns at its place; the other one is pressed on it by N = 2.
  Setting setting;
  setting.time_step = 0.01;
  State state = no_particles(2);
  add_particle(state, {0, 0, 0}, 1, 1);
  add_particle(state, {2, 0, 0}, 1, 1);
  setting.given_motions[0].angular_velocity = constant({0, 0, 3});
  setting.forces[1] = constant({-2, 0, 0});
  solve_by(1, setting, state);
  Simulation simulation(setting, state, 1);
  take_steps(simulation, 1);
  // Slipping: the friction mu N = 0.6 acts at the contact in +y, with the torque -0.6 on the disc.
  EXPECT_NEAR(simulation.state().given_loads[0].force[1], -0.6, 1e-6);
  EXPECT_NEAR(simulation.state().given_loads[0].torque[2], -0.6, 1e-6);
  EXPECT_NEAR(simulation.state().particles.velocity(1)[1], 0.6 * 0.01, 1e-8);
  EXPECT_NEAR(simulation.state().particles.angular_velocities[1], -0.6 * 0.01 / 0.5, 1e-8);
  EXPECT_DOUBLE_EQ(simulation.state().particles.angular_velocities[0], 3);
}

TEST(GivenMotion, OfAFixedParticleBearsWhatTheMassOnItsLinkIsAccelerated) {
  // A step of a fifth of the period, in which the link is a spring across its line.
  for (const bool is_arm : {false, true}) {
    Setting setting;
    setting.time_step = 0.7;
    setting.gravity = {0, -10, 0};
    setting.given_motions[0];
    State state = no_particles(2);
    add_particle(state, {0, 0, 0}, 0.1, 1);
    add_particle(state, {1.8, -2.4, 0}, 0.1, 2);
    add_rotation(state.particles);
    if (is_arm)
      setting.links.arms = {{0, 1, PiecewiseLinearLength{{{0, 3}}}}};
    else
      setting.links.springs = {{0, 1, 100, 2.8}};
    Simulation simulation(setting, state, 1);
    for (int n = 0; n < 10; ++n) {
      const Vector before = simulation.state().particles.velocity(1);
      const auto report = simulation.step(100);
      const Vector gained = 2 * (simulation.state().particles.velocity(1) - before);
      const Vector from_link = 1 / 0.7 * gained - 2 * setting.gravity;
      // In the parts of a divided step the velocity changes from step to step of other lengths.
      if (report.parts > 1) continue;
      EXPECT_LE(norm(simulation.state().given_loads[0].force + from_link), 1e-7 * norm(from_link))
          << is_arm << " " << n;
    }
  }
}

TEST(GivenMotion, OfAFixedParticleHoldsSpringsAndArms) {
  for (const bool is_arm : {false, true}) {
    Setting setting;
    setting.time_step = 0.01;
    State state = no_particles(2);
    add_particle(state, {0, 0, 0}, 0.5, 1);
    add_particle(state, {0, -3, 0}, 0.5, 2);
    setting.gravity = {0, -10, 0};
    setting.given_motions[0];
    if (is_arm) {
      Arm arm;
      arm.first = 0;
      arm.second = 1;
      arm.length = PiecewiseLinearLength{{{0, 3}}};
      setting.links.arms.push_back(arm);
    } else {
      Spring spring;
      spring.first = 0;
      spring.second = 1;
      spring.length = 3 - 20.0 / 100;
      spring.stiffness = 100;
      setting.links.springs.push_back(spring);
    }
    add_rotation(state.particles);
    Simulation simulation(setting, state, 1);
    take_steps(simulation, 20);
    EXPECT_NEAR(simulation.state().given_loads[0].force[1], -20, 1e-6) << is_arm;
    EXPECT_NEAR(simulation.state().particles.position(1)[1], -3, 1e-6);
    EXPECT_EQ(simulation.state().particles.position(0)[1], 0);
  }
}

TEST(GivenMotion, ThatMeetsAnotherIsAnErrorThatNamesBoth) {
  Row row(0, 1, 1);
  row.state.particles.positions[2] = 3;
  row.setting.given_motions[1];
  Simulation simulation(row.setting, row.state, 1);
  EXPECT_THAT(failure(ErrorKind::kNotConverged, [&] { run(simulation, 2); }),
              Names("particles 0 and 1"));
  EXPECT_NEAR(simulation.state().time, 1, 0.02);
}

TEST(GivenMotion, MayOverlapAnotherAtTheSameVelocity) {
  Row row(1, 1, 2);
  row.state.particles.positions = {0, 0, 1.5, 0, 10, 0};
  row.setting.given_motions[1].velocity = constant({1, 0, 0});
  Simulation simulation(row.setting, row.state, 1);
  take_steps(simulation, 100);
  EXPECT_NEAR(simulation.state().particles.position(1)[0], 2.5, 1e-12);
}

TEST(GivenMotion, OfTouchingParticlesMakesNoContactInAChain) {
  // A driven disc closes a chain of gaps in one step, and the chain nearly reaches two touching
  // discs that are driven at the same velocity.
  for (const int way : {0, 1, 2}) {
    Row row(way, 1, 7);
    for (int k = 1; k < 8; ++k)
      row.state.particles.positions[static_cast<std::size_t>(2 * k)] =
          2.001 * std::min(k, 5) + (k > 5 ? 2.005 + 2 * (k - 6) : 0);
    for (const int k : {6, 7}) row.setting.given_motions[k].velocity = constant({1, 0, 0});
    Simulation simulation(row.setting, row.state, 1);
    take_steps(simulation, 20);
    for (std::size_t k = 0; k < 8; ++k)
      EXPECT_NEAR(simulation.state().particles.velocity(k)[0], 1, 1e-9);
    EXPECT_EQ(simulation.state().given_loads[2].force[0], 0);
  }
}

TEST(GivenMotion, ReboundsAreThoseOfAMovingWall) {
  // v' = 2 V - v for e = 1, and the load has the impulse of the impact over the step.
  for (const int way : {0, 1}) {
    Row row(way, 0.5, 1);
    row.state.particles.positions[2] = 3.2;
    row.state.particles.velocities[2] = -1;
    row.setting.laws.restitution.coefficient = 1;
    Simulation simulation(row.setting, row.state, 1);
    double impulse = 0;
    run(simulation, 2,
        [&](const StepReport&) { impulse += 0.01 * simulation.state().given_loads[0].force[0]; });
    EXPECT_NEAR(simulation.state().particles.velocity(1)[0], 2, 1e-9);
    EXPECT_NEAR(impulse, -2 * 3, 1e-8);
  }
}

TEST(LoadedPlane, OfARestartMovesBitForBit) {
  for (const int way : {0, 1, 2}) {
    auto setting = Piston{.count = 3, .gap = 0.1}.setting();
    auto state = Piston{.count = 3}.state();
    solve_by(way, setting, state);
    setting.given_motions[0].velocity = constant({0.1, 0, 0});
    Simulation whole(setting, state, 1);
    take_steps(whole, 15);
    const auto text = write_restart(whole.state());
    const auto file = testing::TempDir() + "loaded_plane_restart.bin";
    std::FILE* out = std::fopen(file.c_str(), "wb");
    std::fwrite(text.data(), 1, text.size(), out);
    std::fclose(out);
    Simulation rest(setting, read_restart(file), 1);
    take_steps(whole, 40);
    take_steps(rest, 40);
    EXPECT_EQ(whole.state().planes, rest.state().planes);
    EXPECT_EQ(whole.state().particles.positions, rest.state().particles.positions);
    EXPECT_EQ(whole.state().given_loads[0].force, rest.state().given_loads[0].force);
    std::remove(file.c_str());
  }
}

}  // namespace
}  // namespace viscontact::particles
