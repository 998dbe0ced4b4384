// The convex methods of friction, docs/physics.md (5.9) and (5.17), against closed forms, and
// packings in which every step must converge and the energy must fall.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include "tests/particles/systems.hpp"

namespace viscontact::particles {
namespace {

/// Lengths, masses and times of a case are multiplied by these.
struct Units {
  double length = 1, mass = 1, time = 1;
};

Setting convex_setting(double h, double mu_s, double gamma_min = 0) {
  Setting setting;
  setting.time_step = h;
  setting.laws.film.gamma_min = gamma_min;
  setting.laws.friction = FrictionLaw{mu_s, FrictionMethod::kConvex};
  return setting;
}

/// Two discs or spheres of mass 1 and radius 0.5; the second one flies at the first one and spins.
State two_particles(int dimension, const Units& in) {
  State state = no_particles(dimension);
  add_particle(state, {}, 0.5 * in.length, in.mass, {});
  add_particle(state, in.length * Vector{0.3, 1.6, 0}, 0.5 * in.length, in.mass,
               in.length / in.time * Vector{0.2, -1, 0});
  add_rotation(state.particles);
  auto& spins = state.particles.angular_velocities;
  spins[dimension == 3 ? 5 : 1] = 3 / in.time;
  return state;
}

double spin(const State& state, std::size_t k) {
  return state.particles.angular_velocities[state.particles.dimension == 3 ? 3 * k + 2 : k];
}

/// Normal and tangential impulse of a contact.
struct Impulses {
  double normal = 0, tangential = 0;
};

/// The impulses of the next step. A contact takes part if it had an impulse in the step before
/// (`touched`), or if its gap would close without it. Its impulses minimise w_n p_n^2/2 + g p_n +
/// w_t p_t^2/2 + v p_t over |p_t| <= mu_s p_n, where g and v are the gap and the slip without them.
/// The minimum is where both become 0 if that is allowed. Otherwise it is on the surface of the
/// cone, p_t = -+ mu_s p_n.
Impulses closed_form(const State& state, double h, double mu_s, bool touched) {
  const auto& p = state.particles;
  const Vector apart = p.position(1) - p.position(0);
  const Vector normal = (1 / norm(apart)) * apart;
  const Vector tangent{-normal[1], normal[0], 0};
  const Vector relative = p.velocity(1) - p.velocity(0);
  const double mass = p.masses[0], inertia = p.inertias[0], arm = norm(apart) / 2;
  const double gap = norm(apart) - p.radii[0] - p.radii[1] + h * dot(normal, relative);
  const double slip = h * (dot(tangent, relative) - arm * (spin(state, 0) + spin(state, 1)));
  if (gap >= 0 && !touched) return {};
  const double w_n = 2 * h / mass, w_t = 2 * h * (1 / mass + arm * arm / inertia);
  const Impulses sticking{-gap / w_n, -slip / w_t};
  if (std::abs(sticking.tangential) <= mu_s * sticking.normal) return sticking;
  const double load = (mu_s * std::abs(slip) - gap) / (w_n + mu_s * mu_s * w_t);
  if (load <= 0) return {};
  return {load, -std::copysign(mu_s * load, slip)};
}

class ConvexFriction : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, ConvexFriction, ::testing::Values(2, 3));

TEST_P(ConvexFriction, ACollisionHasTheImpulsesOfTheClosedForm) {
  // A fixed point with the slip of the step before converges only if mu_s^2 w_t/w_n < 1, that is
  // mu_s < 0.577 for discs and 0.535 for spheres.
  for (const double mu_s : {0.05, 0.5, 0.6, 2.0}) {
    SCOPED_TRACE(mu_s);
    const double h = 0.01;
    Simulation simulation(convex_setting(h, mu_s), two_particles(GetParam(), {}), 1);
    bool collided = false, touched = false;
    for (int step = 0; step < 100; ++step) {
      const State before = simulation.state();
      const auto expected = closed_form(before, h, mu_s, touched);
      const auto report = simulation.step(1);
      EXPECT_TRUE(report.converged) << step;
      EXPECT_LE(report.iterations, 200) << step;
      const Vector apart = before.particles.position(1) - before.particles.position(0);
      const Vector normal = (1 / norm(apart)) * apart;
      const Vector given = before.particles.masses[1] * (simulation.state().particles.velocity(1) -
                                                         before.particles.velocity(1));
      // Gaps are solved to impulse_tolerance, 1e-10, of the impulses at work, which are about 1.
      // Slips are solved to tolerance/2 mean radii, which is 2.5e-7/w_t = 5e-6 of the impulse.
      EXPECT_NEAR(dot(normal, given), expected.normal, 1e-5) << step;
      EXPECT_NEAR(dot({-normal[1], normal[0], 0}, given), expected.tangential, 1e-5) << step;
      touched = expected.normal > 0;
      collided |= expected.normal > 0.1;
    }
    EXPECT_TRUE(collided);
  }
}

TEST_P(ConvexFriction, ACollisionIsTheSameInAllUnits) {
  const double h = 0.01, mu_s = 0.6;
  for (const double gamma_min : {0.0, -0.2}) {
    const auto end_of = [&](const Units& in) {
      const double of_film = gamma_min * in.mass * in.length / in.time;
      Simulation simulation(convex_setting(h * in.time, mu_s, of_film),
                            two_particles(GetParam(), in), 1);
      for (int step = 0; step < 100; ++step) EXPECT_TRUE(simulation.step(in.time).converged);
      return simulation.state();
    };
    const State plain = end_of({});
    Random random(3);
    for (int trial = 0; trial < 20; ++trial) {
      const auto decades = [&] { return random.decades(-5, 5); };
      const Units in{decades(), decades(), decades()};
      const State scaled = end_of(in);
      const Vector apart =
          (1 / in.length) * scaled.particles.position(1) - plain.particles.position(1);
      // Rounding of 100 steps; the iterations are the same but for it. With films a solution may
      // end an iteration earlier, and slips are solved to 2.5e-7 mean radii, which is 5e-6 of the
      // impulse of friction.
      const double tolerance = gamma_min == 0 ? 1e-11 : 1e-5;
      EXPECT_LT(norm(apart), tolerance);
      EXPECT_NEAR(spin(scaled, 1) * in.time, spin(plain, 1), tolerance);
    }
  }
}

/// A particle of mass 1 and radius 0.5 that touches the floor y = 0.
State on_floor(int dimension, const Vector& velocity, double height) {
  State state = no_particles(dimension);
  add_particle(state, {0, 0.5 + height, 0}, 0.5, 1, velocity);
  add_rotation(state.particles);
  return state;
}

TEST_P(ConvexFriction, ALandingWithAFilmIsThatOfCoulombsLaw) {
  // The film takes 0.5 of the impulse 1, so that friction takes 0.3 * 0.5 of the velocity, whatever
  // the step is. The contact stays closed, and its film used up.
  for (double h = 0.2; h > 1e-3; h /= 2) {
    SCOPED_TRACE(h);
    auto setting = convex_setting(h, 0.3, -0.5);
    setting.planes = {plane_at_rest({}, {0, 1, 0})};
    Simulation simulation(setting, on_floor(GetParam(), {2, -1, 0}, 0.1), 1);
    run(simulation, 0.5, [](const StepReport& report) { EXPECT_TRUE(report.converged); });
    const auto& state = simulation.state();
    // Impulses are solved to 1e-10 of those at work, and those of friction to their bounds.
    EXPECT_NEAR(state.particles.velocity(0)[0], 1.85, 1e-9);
    EXPECT_NEAR(state.particles.velocity(0)[1], 0, 1e-9);
    EXPECT_NEAR(state.particles.position(0)[1], 0.5, 1e-9);
    ASSERT_EQ(state.walls.size(), 1U);
    EXPECT_NEAR(state.walls[0].gamma, -0.5, 1e-9);
  }
}

TEST_P(ConvexFriction, AFilmOnAnInclineGivesWayAsInCoulombsLaw) {
  // Sliding ends at t_g (1 + tan(alpha)/((1 + m r^2/I) mu_s - tan(alpha))) with t_g =
  // -gamma_min/(m g cos(alpha)). From then on the particle rolls, and its velocity is that of
  // sliding at this time.
  const double mu = 0.3, alpha = 0.3, gamma_min = -2, g = 9.81;
  const double inertia = GetParam() == 3 ? 0.4 : 0.5;
  const double t_g = -gamma_min / (g * std::cos(alpha)), end = 1;
  const double rolls = t_g * (1 + std::tan(alpha) / ((1 + 1 / inertia) * mu - std::tan(alpha)));
  const double slides = g * (std::sin(alpha) - mu * std::cos(alpha));
  const double expected = g * std::sin(alpha) * t_g + slides * (rolls - t_g) +
                          g * std::sin(alpha) / (1 + inertia) * (end - rolls);
  for (const double h : {0.02, 0.01, 0.005}) {
    auto setting = convex_setting(h, mu, gamma_min);
    setting.planes = {plane_at_rest({}, {0, 1, 0})};
    setting.gravity = {g * std::sin(alpha), -g * std::cos(alpha), 0};
    Simulation simulation(setting, on_floor(GetParam(), {}, 0), 1);
    run(simulation, end, [](const StepReport& report) { EXPECT_TRUE(report.converged); });
    // Each step has the impulses of its forces, so that the velocity does not depend on the step.
    // Slips are solved to 5e-7 mean radii in a step.
    EXPECT_NEAR(simulation.state().particles.velocity(0)[0], expected, 1e-6) << h;
  }
}

/// Forty particles in a box, in a given order, with the numbers of their states.
struct Box {
  Setting setting;
  State state;
};
Box box_of_forty(int dimension, double mu_s, double gamma_min, bool is_reversed = false) {
  Random random(5);
  const double half = dimension == 3 ? 2.5 : 4.5;
  State drawn = random_cloud(
      dimension, 40, half - 0.6, [] { return 0.5; }, random);
  auto& p = drawn.particles;
  add_rotation(p);
  for (auto& w : p.angular_velocities) w = random.uniform(-3, 3);
  Box box{convex_setting(0.01, mu_s, gamma_min), drawn};
  if (is_reversed) {
    const auto turns = static_cast<std::size_t>(dimension == 3 ? 3 : 1);
    const auto d = static_cast<std::size_t>(dimension);
    auto& q = box.state.particles;
    for (std::size_t k = 0; k < p.count(); ++k) {
      const std::size_t of = p.count() - 1 - k;
      std::copy_n(&p.positions[of * d], d, &q.positions[k * d]);
      std::copy_n(&p.velocities[of * d], d, &q.velocities[k * d]);
      std::copy_n(&p.angular_velocities[of * turns], turns, &q.angular_velocities[k * turns]);
      q.masses[k] = p.masses[of];
      q.inertias[k] = p.inertias[of];
      q.radii[k] = p.radii[of];
    }
  }
  box.setting.gravity = {0, -1, 0};
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
    for (const double side : {-1.0, 1.0}) {
      Vector point{}, normal{};
      point[d] = -side * half;
      normal[d] = side;
      box.setting.planes.push_back(plane_at_rest(point, normal));
    }
  return box;
}

/// Kinetic and potential energy, with the gravity (0, -1, 0).
double energy_of(const Particles& p) {
  double energy = kinetic_energy(p);
  const std::size_t turns = p.dimension == 3 ? 3 : 1;
  for (std::size_t k = 0; k < p.count(); ++k) {
    energy += p.masses[k] * p.position(k)[1];
    for (std::size_t d = 0; d < turns; ++d)
      energy += p.inertias[k] * p.angular_velocities[k * turns + d] *
                p.angular_velocities[k * turns + d] / 2;
  }
  return energy;
}

TEST_P(ConvexFriction, TheEnergyOfABoxWithFilmsNeverGrows) {
  auto box = box_of_forty(GetParam(), 0.5, -0.5);
  Simulation simulation(box.setting, box.state, 1);
  // In the first step walls push out the particles that overlap them.
  simulation.step(1);
  double before = energy_of(simulation.state().particles);
  const double first = before;
  run(simulation, GetParam() == 2 ? 4 : 2, [&](const StepReport& report) {
    EXPECT_TRUE(report.converged) << report.time;
    const double after = energy_of(simulation.state().particles);
    // Gravity alone takes h^2/2 for each mass in a step, which is more than what rounding errors
    // and gaps of 5e-7 mean radii can add.
    EXPECT_LT(after, before) << report.time;
    before = after;
  });
  EXPECT_LT(before, first - 2);  // there were collisions
}

TEST_P(ConvexFriction, ABoxWithFilmsDoesNotDependOnTheOrderOfItsParticles) {
  // Collisions multiply differences of rounding, with Coulomb's law by 1e11 until t = 2.5. Until
  // t = 2 there are 38 contacts of the discs.
  const auto end_of = [&](bool is_reversed) {
    auto box = box_of_forty(GetParam(), 0.5, -0.5, is_reversed);
    Simulation simulation(box.setting, box.state, 1);
    run(simulation, 2, [](const StepReport& report) { EXPECT_TRUE(report.converged); });
    return simulation.state().particles;
  };
  const auto plain = end_of(false), reversed = end_of(true);
  for (std::size_t k = 0; k < plain.count(); ++k) {
    const Vector apart = plain.position(k) - reversed.position(plain.count() - 1 - k);
    EXPECT_LT(norm(apart), 1e-6) << k;
  }
}

TEST_P(ConvexFriction, ABoxOfBodiesWithFilmsIsTheSameInAllUnits) {
  // Four bodies of two particles fall into a box. When each repetition of a solution took the loads
  // anew, rounding errors decided how often the step was solved, and in space ends
  // differed by 1e-3.
  const auto end_of = [&](const Units& in, std::uint64_t seed) {
    const double velocity = in.length / in.time;
    auto setting = convex_setting(0.02 * in.time, 1, -0.1 * in.mass * velocity);
    setting.gravity = velocity / in.time * Vector{0, -0.1, 0};
    const double width = 5.4 * in.length;
    setting.planes = {plane_at_rest({}, {0, 1, 0}), plane_at_rest({}, {1, 0, 0}),
                      plane_at_rest({width, 0, 0}, {-1, 0, 0})};
    if (GetParam() == 3) {
      setting.planes.push_back(plane_at_rest({}, {0, 0, 1}));
      setting.planes.push_back(plane_at_rest({0, 0, width}, {0, 0, -1}));
    }
    State state = no_particles(GetParam());
    Random random(seed);
    std::vector<RigidBodyRequest> bodies;
    for (std::int32_t k = 0; k < 4; ++k) {
      const Vector centre{1.2 + 2.2 * (k % 2), 1.2 + 2.2 * (k / 2), 1.2 + 2.2 * (k % 2)};
      const Vector arm = 0.45 * random.direction(GetParam()), speed = random.direction(GetParam());
      for (const double end : {-1, 1})
        add_particle(state, in.length * (centre + end * arm), 0.45 * in.length, 0.4 * in.mass,
                     velocity * speed);
      bodies.push_back({{2 * k, 2 * k + 1}});
    }
    add_rotation(state.particles);
    for (auto& body : bodies) add_rigid_body(state.particles, body);
    Simulation simulation(setting, state, 1);
    run(simulation, 3 * in.time,
        [](const StepReport& report) { EXPECT_TRUE(report.converged) << report.time; });
    return simulation.state().particles;
  };
  const Units other{3.7, 21, 0.13};
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    const auto here = end_of({}, seed), there = end_of(other, seed);
    for (std::size_t k = 0; k < here.count(); ++k)
      EXPECT_LT(norm(here.position(k) - 1 / other.length * there.position(k)), 1e-6) << seed;
  }
}

TEST(ConvexFrictionInThePlane, JammedDiscsThatComeToRestInTheirFilmsStaySolved) {
  // Without gravity the impulses of these discs fall to 1e-20, below the rounding errors of the
  // solutions. Where the allowed residual followed them, step 63 took 10 000 iterations and failed.
  auto setting = convex_setting(0.05, 2, -0.05);
  setting.planes = {plane_at_rest({}, {0, 1, 0}),
                    plane_at_rest({7.6000000000000005, 0, 0}, {-1, 0, 0})};
  State state = no_particles(2);
  add_particle(state, {1.1750041938624998, 1.160191853748688, 0}, 0.6342612654274337,
               0.6966952508026194, {0.3286303518315518, 0.8234531773064461, 0});
  add_particle(state, {5.550719315214006, 1.1589703026469138, 0}, 0.7216446436812546,
               1.0318273362135186, {0.34082714006722203, -0.6221598068086756, 0});
  add_particle(state, {1.2458073927691957, 3.3734047477219007, 0}, 0.8264670045676656,
               0.7363745201495588, {0.04347350160534775, 0.3328221837722507, 0});
  add_particle(state, {3.416335902186731, 3.361799340752725, 0}, 0.7875664405432389,
               1.1186660621521807, {1.308722199530807, -0.5260042239078433, 0});
  add_rotation(state.particles);
  Simulation simulation(setting, state, 1);
  run(simulation, 4,
      [](const StepReport& report) { EXPECT_TRUE(report.converged) << report.time; });
}

TEST_P(ConvexFriction, EveryStepOfABodyThatFallsIntoACornerConverges) {
  // A body of three particles turns as it falls on two walls, so that corrections for its finite
  // turns change the loads. With films, loads bound the friction. In space, 13 to 24 of the 60
  // steps failed with each film and each mu_s when each correction took the loads of the solution
  // before.
  const int dimension = GetParam();
  for (const double mu_s : {0.5, 1.0, 2.0})
    for (const double gamma_min : {-2.0, -0.5, 0.0}) {
      SCOPED_TRACE(mu_s);
      SCOPED_TRACE(gamma_min);
      State state = no_particles(dimension);
      for (std::size_t k = 0; k < 3; ++k) {
        const double angle = 0.3 + 2 * std::numbers::pi * static_cast<double>(k) / 3;
        const double depth = 0.3 * static_cast<double>(k);
        add_particle(state, {2.5 + 1.2 * std::cos(angle), 2.5 + 1.2 * std::sin(angle), depth}, 1,
                     3 + 2 * static_cast<double>(k), {-1, -1.5, 0.4});
      }
      add_rotation(state.particles);
      add_rigid_body(state.particles, {{0, 1, 2}});
      auto setting = convex_setting(0.01, mu_s, gamma_min);
      setting.gravity = {-4, -3, 1};
      setting.planes = {plane_at_rest({}, {1, 0, 0}), plane_at_rest({}, {0, 1, 0})};
      Simulation simulation(setting, state, 1);
      run(simulation, 0.6, [](const StepReport& report) {
        EXPECT_TRUE(report.converged) << report.time;
        EXPECT_FALSE(report.has_given_loads) << report.time;
      });
      EXPECT_EQ(simulation.state().walls.size(), 2U);
    }
}

TEST_P(ConvexFriction, EveryStepOfABodyInAWedgeOfMovingWallsConverges) {
  // The walls move downwards along themselves. For mu_s > 1 the relaxation turns the body so far in
  // a step that corrections for finite turns do not converge. Friction then has given loads.
  // Without them the speed grew to 88, and a step ended with an opening of 0.8.
  for (const double mu_s : {1.5, 2.0}) {
    SCOPED_TRACE(mu_s);
    auto setting = convex_setting(0.02, mu_s);
    setting.gravity = {0, -1, 0};
    const Vector sides[] = {{-std::cos(0.6), std::sin(0.6), 0}, {std::cos(0.6), std::sin(0.6), 0}};
    for (const auto& side : sides) {
      setting.planes.push_back(plane_at_rest({}, side));
      setting.planes.back().velocity =
          constant({std::copysign(0.5 * side[1], side[0]), -0.5 * std::abs(side[0]), 0});
    }
    // Both particles of the body touch a wall: side (center -+ arm) = 0.5.
    const Vector arm{0.5 * std::cos(2.6), 0.5 * std::sin(2.6), 0};
    const double left = 0.5 + dot(sides[0], arm), right = 0.5 - dot(sides[1], arm);
    const Vector centre{(right - left) / (2 * sides[1][0]), (right + left) / (2 * sides[1][1]), 0};
    State state = no_particles(GetParam());
    for (const double end : {-1, 1}) add_particle(state, centre + end * arm, 0.5, 0.5);
    add_rotation(state.particles);
    add_rigid_body(state.particles, {{0, 1}});
    Simulation simulation(setting, state, 1);
    int with_given_loads = 0;
    run(simulation, 1, [&](const StepReport& report) {
      EXPECT_TRUE(report.converged) << report.time;
      with_given_loads += report.has_given_loads ? 1 : 0;
      if (report.has_given_loads) {
        EXPECT_NE(report.solver_stages.find("given_loads:"), std::string::npos);
      }
      // The openings of the relaxation push the body out at up to 20 times the speed 0.5 of the
      // walls.
      EXPECT_LT(norm(simulation.state().particles.velocity(0)), 15) << report.time;
    });
    EXPECT_GT(with_given_loads, 0);
  }
}

TEST_P(ConvexFriction, AFilmAbsorbsSmallImpulsesFarFromTheOrigin) {
  // In a step a force moves the particles by 1e-10, less than the last place of their coordinates.
  // The film absorbs its impulse, and as much is needed to pull the particles apart.
  constexpr double kForce = 1e-6, kFar = 1e6;
  constexpr int kSteps = 20;
  auto setting = convex_setting(0.01, 0.5, -1);
  State state = no_particles(GetParam());
  for (const double side : {-1, 1}) add_particle(state, {kFar + side, 0, 0}, 1, 1);
  add_rotation(state.particles);
  setting.forces[0] = constant({kForce, 0, 0});
  setting.forces[1] = constant({-kForce, 0, 0});
  Simulation simulation(setting, state, 1);
  take_steps(simulation, kSteps);
  const double impulse = kSteps * setting.time_step * kForce;
  EXPECT_NEAR(pair_of(simulation.state(), 0, 1).gamma, -impulse, 1e-9 * impulse);
}

TEST_P(ConvexFriction, AParticleThatSlidesAlongAPlaneWithoutLoadIsNotLifted) {
  // The relaxation lifts a contact that takes part and slides. Whether the free motion closes a gap
  // by a rounding error must not decide that.
  for (const double downwards : {-1e-17, 0.0, 1e-17}) {
    auto setting = convex_setting(0.01, 0.5);
    setting.planes = {plane_at_rest({}, {0, 1, 0})};
    State state = no_particles(GetParam());
    add_particle(state, {0, 0.5, 0}, 0.5, 1, {1, -downwards, 0});
    add_rotation(state.particles);
    Simulation simulation(setting, state, 1);
    run(simulation, 0.1, [&](const StepReport& report) {
      EXPECT_TRUE(report.converged);
      EXPECT_EQ(simulation.state().particles.velocity(0)[0], 1) << report.time;
    });
  }
}

TEST_P(ConvexFriction, AParticleThatABeltDrivesIntoACornerIsHeldWhereTheRelaxationHasNoSolution) {
  // The belt moves towards the wall at the speed 1. For mu_s > 1 no motion satisfies (5.9), because
  // slipping along one surface demands a larger opening of the other one. Friction then has the
  // loads of (5.17), and the particle stays in the corner. Without these loads, impulses grew to
  // 1e18, and the particle overlapped the wall by 6e-3. The loads are those without friction, m g h
  // at the belt and 0 at the wall. Friction at first turns the particle by mu_s g h r m/I in a
  // step.
  const double h = 0.01, g = 1, inertia = GetParam() == 3 ? 0.4 : 0.5;
  for (const double mu_s : {1.1, 1.5, 2.0}) {
    SCOPED_TRACE(mu_s);
    auto setting = convex_setting(h, mu_s);
    setting.gravity = {0, -g, 0};
    setting.planes = {plane_at_rest({}, {0, 1, 0}), plane_at_rest({}, {1, 0, 0})};
    setting.planes[0].velocity = constant({-1, 0, 0});
    State state = no_particles(GetParam());
    add_particle(state, {1, 1, 0}, 1, 1);
    add_rotation(state.particles);
    Simulation simulation(setting, state, 1);
    for (int step = 1; step <= 5; ++step) {
      simulation.step(1);
      EXPECT_NEAR(spin(simulation.state(), 0), -step * mu_s * g * h / inertia, 1e-9);
    }
    int with_given_loads = 0;
    run(simulation, 1, [&](const StepReport& report) {
      EXPECT_TRUE(report.converged) << report.time;
      with_given_loads += report.has_given_loads ? 1 : 0;
      const Vector at = simulation.state().particles.position(0);
      // The tolerance of gaps is 1e-6 mean radii.
      EXPECT_GE(std::min(at[0], at[1]), 1 - 1e-6) << report.time;
    });
    EXPECT_LT(norm(simulation.state().particles.velocity(0)), 1);
    EXPECT_GT(with_given_loads, 0);
  }
}

TEST_P(ConvexFriction, ALandingAtAnySpeedHasTheFrictionOfItsLoad) {
  // Friction takes 0.3 of the part of the impulse that the film does not take. Loads of a rough
  // solution would not do: it is accurate to 1e-2 of the largest motion without impulses, which may
  // be that of the slip, and it is the guess if a motion is below 5e-4 mean radii.
  const double h = 0.01, mu = 0.3;
  for (const double along : {2.0, 50.0, 200.0})
    for (const double down : {1.0, 0.02}) {
      SCOPED_TRACE(along);
      SCOPED_TRACE(down);
      auto setting = convex_setting(h, mu, -down / 2);
      setting.planes = {plane_at_rest({}, {0, 1, 0})};
      State state = no_particles(GetParam());
      add_particle(state, {0, 1, 0}, 1, 1, {along, -down, 0});
      add_rotation(state.particles);
      Simulation simulation(setting, state, 1);
      run(simulation, 5 * h, [](const StepReport& report) { EXPECT_TRUE(report.converged); });
      const double lost = along - simulation.state().particles.velocity(0)[0];
      EXPECT_NEAR(lost, mu * down / 2, 1e-6 * along);
    }
}

TEST_P(ConvexFriction, AParticleThatMeetsABodyLateInAStepHasCoulombsFriction) {
  // The particle slides down an incline and meets a rigid body of two particles, which the first
  // rough solution does not contain. In a group with a body the loads of the first solution always
  // bound the friction of the second one. With the load that the particle had in the first rough
  // solution its spin would be wrong by 3 to 14 %.
  const auto spin_after = [](int dimension, FrictionMethod method, double mass, double distance) {
    auto setting = convex_setting(0.1, 0.1, -0.01);
    setting.laws.friction->method = method;
    const double half = 0.25 * std::numbers::sqrt2;  // of the particle's centre along each axis
    setting.planes = {plane_at_rest({}, {2 * half, 2 * half, 0})};
    State state = no_particles(dimension);
    add_particle(state, {half, half, 0}, 0.5, 1, {0, -1, 0});
    for (const double x : {1.0, 2.0})
      add_particle(state, {half + x + distance, half, 0}, 0.5, mass);
    add_rotation(state.particles);
    add_rigid_body(state.particles, {{1, 2}});
    Simulation simulation(setting, state, 1);
    EXPECT_TRUE(simulation.step(1).converged);
    return spin(simulation.state(), 0);
  };
  for (const double mass : {1.0, 5.0})
    for (const double distance : {0.02, 0.03}) {
      const auto of = [&](FrictionMethod method) {
        return spin_after(GetParam(), method, mass, distance);
      };
      const double expected = of(FrictionMethod::kCoulomb);
      // The loads of the first of two solutions are those of the second one but for 1e-3.
      EXPECT_NEAR(of(FrictionMethod::kConvex), expected, 2e-3 * std::abs(expected));
    }
}

/// A lattice of particles with gaps, `columns` wide and 3 high, that falls on the plane y = 0 and
/// runs together, at this speed.
void add_heap(State& state, double x, int columns, double speed) {
  for (int k = 0; k < 3 * columns; ++k) {
    const int column = k % columns, row = k / columns;
    add_particle(state, {x + 1.05 * column + 0.1 * row, 0.52 + 1.02 * row, 0}, 0.5,
                 1 + 0.1 * column, speed * Vector{1.0 - column, -1, 0.1 * row});
  }
}

/// A particle that a belt, which moves at the speed -1, drives into a corner. Friction locks it.
void add_locked_particle(State& state, Setting& setting, double corner) {
  setting.planes[0].velocity = constant({-1, 0, 0});
  setting.planes.push_back(plane_at_rest({corner, 0, 0}, {1, 0, 0}));
  add_particle(state, {corner + 0.5, 0.5, 0}, 0.5, 1);
}

TEST_P(ConvexFriction, AGroupOfParticlesDoesNotFeelAnotherOneFarAwayWithEitherLaw) {
  // Groups shared the accuracy of interior points, the order of sweeps, the number of iterations
  // and of rough solutions, whose loads bound the friction of films, and given loads where one
  // group had no solution. Then the positions of the first group changed by up to 0.1.
  for (const auto method : {FrictionMethod::kConvex, FrictionMethod::kCoulomb})
    for (const bool is_fast : {false, true})
      for (const double gamma_min : {-0.3, 0.0}) {
        SCOPED_TRACE(method == FrictionMethod::kConvex);
        SCOPED_TRACE(is_fast);
        SCOPED_TRACE(gamma_min);
        auto setting = convex_setting(0.01, 1.5, gamma_min);
        setting.laws.friction->method = method;
        setting.gravity = {0, -1, 0};
        setting.planes = {plane_at_rest({}, {0, 1, 0})};
        State alone = no_particles(GetParam()), both = no_particles(GetParam());
        for (auto* state : {&alone, &both}) add_heap(*state, 0, 3, 1);
        if (is_fast)
          add_heap(both, 1000, 6, 5);
        else
          add_locked_particle(both, setting, -500);
        for (auto* state : {&alone, &both}) add_rotation(state->particles);
        Simulation one(setting, alone, 1), two(setting, both, 1);
        bool is_locked = false;
        run(two, 0.5, [&](const StepReport& report) {
          EXPECT_FALSE(one.step(0.5).has_given_loads);
          is_locked |= report.has_given_loads;
          const auto& of_one = one.state().particles;
          const auto& of_two = two.state().particles;
          for (std::size_t k = 0; k < of_one.count(); ++k)
            EXPECT_LT(norm(of_two.position(k) - of_one.position(k)), 1e-9) << report.time;
        });
        if (method == FrictionMethod::kConvex) {
          EXPECT_EQ(is_locked, !is_fast && gamma_min == 0);
        }
      }
}

TEST_P(ConvexFriction, EveryStepOfABoxOfFortyParticlesConverges) {
  for (const double gamma_min : {0.0, -0.2})
    for (const double mu_s : {0.3, 0.6, 1.2}) {
      SCOPED_TRACE(gamma_min);
      SCOPED_TRACE(mu_s);
      const auto box = box_of_forty(GetParam(), mu_s, gamma_min);
      Simulation simulation(box.setting, box.state, 1);
      std::size_t most = 0;
      run(simulation, 3, [&](const StepReport& report) {
        EXPECT_TRUE(report.converged) << report.time;
        most = std::max(most, static_cast<std::size_t>(report.contacts));
      });
      EXPECT_GT(most, 30U);  // the particles lie on each other
    }
}

}  // namespace
}  // namespace viscontact::particles
