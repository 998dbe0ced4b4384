// Restitution of many particles against closed forms: (4.13) for one particle, Newton's cradle, the
// dry ball that comes to rest, and what every impact must keep.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "tests/contact_dynamics/impacts/scene.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/particles/state/particles.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

class Restitution : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, Restitution, ::testing::Values(2, 3));

TEST_P(Restitution, OfOneParticleIsThatOfTheClosedForm) {
  constexpr double kDry = 0.97;
  int kept = 0;
  for (const double stokes : {1.0, 5.0, 9.3, 9.4, 27.0, 152.0, 1000.0})
    for (const double gap : {0.1, 1.0, 10.0})
      for (const double step : {0.1, 0.0137, 0.001}) {
        auto scene = flying(GetParam(), stokes, gap, kDry, step * gap);
        Simulation simulation(scene.setting, scene.state, 1);
        std::vector<Rebound> rebounds;
        run(simulation, 2 * gap, [&](const StepReport& report) {
          EXPECT_TRUE(report.converged);
          rebounds.insert(rebounds.end(), simulation.rebounds().begin(),
                          simulation.rebounds().end());
        });
        const double solid = stokes - std::log(100.0);
        const double e = kDry - (1 + kDry) * std::log(100.0) / stokes;
        const double velocity = simulation.state().particles.velocity(0)[1];
        EXPECT_NEAR(velocity, std::max(e, 0.0), 1e-10) << stokes << " " << gap << " " << step;
        const double gamma = pair_of(simulation.state(), -1, 0).gamma;
        if (e > 0) {
          EXPECT_EQ(gamma, 0);
          // It left at the time of the impact, not at the end of a step.
          EXPECT_NEAR(simulation.state().particles.position(0)[1],
                      1 + e * (simulation.state().time - gap), 1e-10 * (1 + gap));
        } else if (solid > 0) {
          ++kept;
          EXPECT_NEAR(gamma, -std::log(100.0) + kDry * solid, 1e-10);
        } else {
          EXPECT_NEAR(gamma, -stokes, 1e-10);
        }
        if (solid <= 0) {
          EXPECT_TRUE(rebounds.empty());
          continue;
        }
        ASSERT_EQ(rebounds.size(), 1U);
        EXPECT_EQ(rebounds[0].first, -1);
        EXPECT_NEAR(rebounds[0].time, gap, 1e-10 * gap);
        EXPECT_NEAR(rebounds[0].approach_velocity, -1, 1e-12);
        EXPECT_NEAR(rebounds[0].solid_impulse, solid, 1e-10 * stokes);
        EXPECT_NEAR(rebounds[0].velocity, std::max(e, 0.0), 1e-10);
      }
  EXPECT_GT(kept, 0);
}

TEST_P(Restitution, OfADryBallThatFallsEndsWhenTheSumOfItsFlightsDoes) {
  for (const auto scheme : {Scheme::kEuler, Scheme::kLeapfrog})
    for (const double dry : {0.5, 0.9}) {
      Scene scene{no_particles(GetParam()), {}};
      add_particle(scene.state, {0, 2, 0}, 1, 3);
      scene.setting.planes = {plane_at_rest({}, {0, 1, 0})};
      scene.setting.gravity = {0, -2, 0};
      set_rebounds_without_film(scene.setting, dry, 1e-3);
      scene.setting.scheme = scheme;
      Simulation simulation(scene.setting, scene.state, 1);
      const double stops = std::sqrt(2 * 1.0 / 2) * (1 + dry) / (1 - dry);
      double last = 0, highest = 0;
      std::vector<double> heights;
      run(simulation, 1.2 * stops, [&](const StepReport& report) {
        // It stops when its last flight ends.
        for (const auto& rebound : simulation.rebounds())
          last = rebound.time + 2 * rebound.velocity / 2;
        if (!simulation.rebounds().empty()) {
          heights.push_back(highest);
          highest = 0;
        }
        highest = std::max(highest, simulation.state().particles.position(0)[1] - 1);
        EXPECT_LT(report.iterations, 1000);
      });
      // The flights that are left out take half a step, and the first one is ahead by half a step.
      EXPECT_NEAR(last, stops, 1.1e-3) << dry;
      // Heights fall by e_d^2 with each rebound; the apex lies between two steps.
      ASSERT_GT(heights.size(), 3U);
      EXPECT_NEAR(heights[1], dry * dry, 2e-3);
      EXPECT_NEAR(heights[2], std::pow(dry, 4), 4e-3);
      // It rests without chatter: no velocity beyond that of one step's load.
      EXPECT_NEAR(simulation.state().particles.position(0)[1], 1, 1e-6);
      EXPECT_LE(std::abs(simulation.state().particles.velocity(0)[1]), 1.01e-3);
    }
}

TEST_P(Restitution, OfABallWithoutForcesIsExactWhereverTheStepsLie) {
  // Numbers without a pattern: the gap, the speed, the step, the units and the direction of the
  // plane.
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const double length = random.decades(-5, 5), mass = random.decades(-5, 5);
    const double gap = length * random.decades(-2, 1), speed = length * random.decades(-3, 3);
    const Vector normal = random.direction(GetParam());
    Scene scene{no_particles(GetParam()), {}};
    add_particle(scene.state, (length + gap) * normal, length, mass, -speed * normal);
    scene.setting.planes = {plane_at_rest({}, normal)};
    set_rebounds_without_film(scene.setting, 0.7, random.decades(-2, 0.5) * gap / speed);
    Simulation simulation(scene.setting, scene.state, 1);
    const double end = 2.3 * gap / speed;
    run(simulation, end);
    const auto& p = simulation.state().particles;
    EXPECT_NEAR(dot(p.velocity(0), normal) / speed, 0.7, 1e-10) << i;
    EXPECT_NEAR((dot(p.position(0), normal) - length) / gap, 0.7 * 1.3, 1e-9 * (1 + length / gap))
        << i;
  }
}

TEST_P(Restitution, DoesNotDependOnTheUnits) {
  // Three unequal particles that do not turn, in units of 1 and far away from it.
  std::vector<double> ends;
  for (const double length : {1.0, 1e-20, 1e20})
    for (const double mass : {1.0, 1e-30, 1e30}) {
      Scene scene{no_particles(GetParam()), {}};
      add_particle(scene.state, {0, 0, 0}, length, mass, {length, 0, 0});
      add_particle(scene.state, {3 * length, 0.5 * length, 0}, length, 3 * mass);
      add_particle(scene.state, {8 * length, length, 0}, length, mass);
      set_rebounds_without_film(scene.setting, 0.9, 0.3);
      Simulation simulation(scene.setting, scene.state, 1);
      EXPECT_EQ(rebounds_until(9, simulation).size(), 2U) << length << " " << mass;
      ends.push_back(simulation.state().particles.velocity(2)[0] / length);
      EXPECT_NEAR(ends.back(), ends.front(), 1e-10);
    }
}

TEST_P(Restitution, LeavesAParticleInItsFilmThatIsAtRestAndConverges) {
  // What rounding leaves of its velocity falls in each step until its square is no number any more.
  for (int i = 0; i < 30; ++i) {
    auto scene = flying(GetParam(), 5 * std::pow(1.03, i), 1, 0.97, 0.1);
    scene.setting.laws.film.gamma_min = -1e6;
    Simulation simulation(scene.setting, scene.state, 1);
    run(simulation, 4, [&](const StepReport& report) {
      EXPECT_TRUE(report.converged) << i << " " << report.time << " " << report.impulse_residual;
      EXPECT_LE(report.iterations, 100) << i << " " << report.time;
    });
  }
}

TEST_P(Restitution, LetsNoParticlePassThroughAFilm) {
  // The centres would pass each other in the first step; the film keeps both together.
  Scene scene{no_particles(GetParam()), {}};
  add_particle(scene.state, {0, 0, 0}, 1, 1, {3.9, 0, 0});
  add_particle(scene.state, {2.5, 0, 0}, 1, 1);
  scene.setting.laws.film.gamma_min = -100;
  scene.setting.laws.restitution.coefficient = 1;
  scene.setting.time_step = 1;
  Simulation simulation(scene.setting, scene.state, 1);
  run(simulation, 4);
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_NEAR(simulation.state().particles.velocity(k)[0], 1.95, 1e-9);
}

TEST_P(Restitution, PassesAImpactOnThroughTouchingParticles) {
  // Of five equal particles that touch, as many leave as arrive (Newton's cradle).
  for (const int arrive : {1, 2, 3})
    for (const double between : {0.0, 1e-3}) {
      Scene scene{no_particles(GetParam()), {}};
      for (int k = 0; k < 5; ++k) {
        const bool flies = k < arrive;
        add_particle(scene.state, {2 * k + k * between - (flies ? 0.5 : 0), 0, 0}, 1, 1,
                     {flies ? 1.0 : 0.0, 0, 0});
      }
      set_rebounds_without_film(scene.setting, 1, 0.07);
      Simulation simulation(scene.setting, scene.state, 1);
      run(simulation, 2);
      for (int k = 0; k < 5; ++k)
        EXPECT_NEAR(simulation.state().particles.velocity(static_cast<std::size_t>(k))[0],
                    k >= 5 - arrive ? 1 : 0, 1e-9)
            << arrive << " " << between << " " << k;
    }
}

/// Discs or spheres that fly about in a box of walls without gravity.
Scene gas(int dimension, std::size_t count, double friction, double dry, double gamma_min) {
  Random random(11);
  const double width = dimension == 2 ? 3 * std::sqrt(double(count)) : 3 * std::cbrt(double(count));
  Scene scene;
  scene.state = random_cloud(
      dimension, count, width, [&] { return random.uniform(0.5, 1); }, random);
  auto& p = scene.state.particles;
  if (friction > 0) add_rotation(p);
  for (auto& v : p.velocities) v = random.uniform(-1, 1);
  scene.setting.laws.film.gamma_min = gamma_min;
  if (friction > 0) scene.setting.laws.friction = FrictionLaw{friction};
  scene.setting.laws.restitution.coefficient = dry;
  scene.setting.time_step = 0.05;
  return scene;
}

double energy(const Particles& p) {
  double sum = kinetic_energy(p);
  const auto turns = turn_components(p.dimension);
  for (std::size_t k = 0; k < p.angular_velocities.size(); ++k)
    sum += p.inertias[k / turns] * p.angular_velocities[k] * p.angular_velocities[k] / 2;
  return sum;
}

TEST_P(Restitution, KeepsMomentumAndNeverAddsEnergy) {
  for (const double friction : {0.0, 0.3})
    for (const double gamma_min : {0.0, -0.1})
      for (const double dry : {0.9, 1.0}) {
        const bool is_large = GetParam() == 2 && friction > 0 && gamma_min < 0 && dry < 1;
        auto scene = gas(GetParam(), is_large ? 300 : 100, friction, dry, gamma_min);
        // Towards each other, so that many meet at once.
        auto& p = scene.state.particles;
        for (std::size_t k = 0; k < p.velocities.size(); ++k)
          p.velocities[k] -= 0.3 * p.positions[k];
        Simulation simulation(scene.setting, scene.state, 1);
        const Vector before = momentum(p);
        double last = energy(p), scale = 0;
        for (std::size_t k = 0; k < p.count(); ++k) scale += p.masses[k] * norm(p.velocity(k));
        std::size_t rebounds = 0;
        run(simulation, 8, [&](const StepReport& report) {
          EXPECT_TRUE(report.converged) << report.residual;
          EXPECT_LE(report.largest_overlap, 1e-6);
          rebounds += simulation.rebounds().size();
          const double now = energy(simulation.state().particles);
          EXPECT_LE(now, last * (1 + 1e-9)) << report.time << " friction " << friction
                                            << " gamma_min " << gamma_min << " e " << dry;
          last = now;
        });
        EXPECT_GT(rebounds, p.count());
        EXPECT_LE(norm(momentum(simulation.state().particles) - before), 1e-12 * scale);
      }
}

TEST_P(Restitution, DoesNotDependOnTheOrderOfTheParticles) {
  auto scene = gas(GetParam(), 30, 0.3, 0.8, -0.05);
  auto& p = scene.state.particles;
  for (std::size_t k = 0; k < p.velocities.size(); ++k) p.velocities[k] -= 0.3 * p.positions[k];
  scene.setting.solver.tolerance = 1e-13;
  auto other = scene;
  std::vector<std::size_t> order(p.count());
  std::iota(order.begin(), order.end(), 0U);
  std::reverse(order.begin(), order.end());
  std::swap(order[3], order[20]);
  const auto d = static_cast<std::size_t>(GetParam());
  for (std::size_t k = 0; k < order.size(); ++k) {
    auto& q = other.state.particles;
    q.radii[k] = p.radii[order[k]];
    q.masses[k] = p.masses[order[k]];
    q.inertias[k] = p.inertias[order[k]];
    for (std::size_t i = 0; i < d; ++i) {
      q.positions[k * d + i] = p.positions[order[k] * d + i];
      q.velocities[k * d + i] = p.velocities[order[k] * d + i];
    }
  }
  Simulation one(scene.setting, scene.state, 1), two(other.setting, other.state, 1);
  run(one, 4);
  run(two, 4);
  // Rounding errors grow by the ratio of flight and radius in each collision, of which a particle
  // has about five.
  for (std::size_t k = 0; k < order.size(); ++k)
    EXPECT_LE(norm(two.state().particles.position(k) - one.state().particles.position(order[k])),
              1e-8);
}

TEST_P(Restitution, OfThePileAtRestIsNoChatter) {
  // A column of three rests on the plane; nothing hits it.
  Scene scene{no_particles(GetParam()), {}};
  for (int k = 0; k < 3; ++k) add_particle(scene.state, {0, 1.0 + 2 * k, 0}, 1, 1);
  scene.setting.planes = {plane_at_rest({}, {0, 1, 0})};
  scene.setting.gravity = {0, -10, 0};
  set_rebounds_without_film(scene.setting, 0.9, 0.01);
  Simulation simulation(scene.setting, scene.state, 1);
  EXPECT_TRUE(rebounds_until(2, simulation).empty());
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(simulation.state().particles.position(k)[1], 1.0 + 2.0 * double(k), 1e-6);
}

TEST(RestitutionOfDiscs, OfAHeavyOneAndALightOneAtAWallCountsTo314) {
  // Galperin's count of the impacts between masses 10000 : 1 and a wall.
  for (const double step : {0.01, 0.05, 0.3}) {
    Scene scene{no_particles(2), {}};
    add_particle(scene.state, {10, 0, 0}, 1, 10000, {-1, 0, 0});
    add_particle(scene.state, {4, 0, 0}, 1, 1);
    scene.setting.planes = {plane_at_rest({}, {1, 0, 0})};
    set_rebounds_without_film(scene.setting, 1, step);
    Simulation simulation(scene.setting, scene.state, 1);
    std::size_t impacts = 0;
    run(simulation, 40, [&](const StepReport&) { impacts += simulation.rebounds().size(); });
    EXPECT_EQ(impacts, 314U) << step;
    EXPECT_NEAR(energy(simulation.state().particles), 5000, 1e-6);
  }
}

TEST(RestitutionOfDiscs, TakesTheImpulseOfTheWholeImpactForFriction) {
  // A disc without spin hits a plane obliquely. It slides through the impact if |v_t| > 3 mu (1 +
  // e) |v_n|, and loses mu (1 + e) |v_n|; else it rolls after it, with 2/3 of its tangential
  // velocity.
  for (const double slip : {0.3, 5.0}) {
    Scene scene{no_particles(2), {}};
    add_particle(scene.state, {0, 1.5, 0}, 1, 2, {slip, -1, 0});
    add_rotation(scene.state.particles);
    scene.setting.planes = {plane_at_rest({}, {0, 1, 0})};
    scene.setting.laws.film.gamma_min = 0;
    scene.setting.laws.friction = FrictionLaw{0.3};
    scene.setting.laws.restitution.coefficient = 0.8;
    scene.setting.time_step = 0.3;
    Simulation simulation(scene.setting, scene.state, 1);
    run(simulation, 1.5);
    const auto& p = simulation.state().particles;
    const bool slides = slip > 3 * 0.3 * 1.8;
    EXPECT_NEAR(p.velocity(0)[1], 0.8, 1e-12);
    EXPECT_NEAR(p.velocity(0)[0], slides ? slip - 0.3 * 1.8 : slip * 2 / 3, 1e-10);
    EXPECT_NEAR(p.angular_velocities[0], slides ? -2 * 0.3 * 1.8 : -slip * 2 / 3, 1e-10);
  }
}

TEST(RestitutionOfDiscs, OfAStepThatIsRefusedLeavesTheState) {
  // Two planes close on two discs that have no room between them.
  Scene scene{no_particles(2), {}};
  add_particle(scene.state, {0, 1.5, 0}, 1, 1, {0, -1, 0});
  add_particle(scene.state, {0, 3.6, 0}, 1, 1, {0, -2, 0});
  scene.setting.planes = {plane_at_rest({}, {0, 1, 0}), plane_at_rest({0, 6, 0}, {0, -1, 0})};
  scene.setting.planes[1].velocity = {{{1, {}}, {1e300, {0, -2, 0}}}};
  scene.setting.laws.film.gamma_min = -0.1;
  scene.setting.laws.restitution.coefficient = 0.5;
  scene.setting.time_step = 0.5;
  scene.setting.solver.max_iterations = 200;
  Simulation simulation(scene.setting, scene.state, 1);
  bool is_refused = false;
  for (int n = 0; n < 20 && !is_refused; ++n) {
    const auto before = simulation.state();
    try {
      simulation.step(100);
    } catch (const Error& error) {
      is_refused = true;
      EXPECT_THAT(error.what(), ::testing::HasSubstr("would overlap by"));
      const auto& after = simulation.state();
      EXPECT_EQ(after.particles.positions, before.particles.positions);
      EXPECT_EQ(after.particles.velocities, before.particles.velocities);
      const auto remembered = [](const State& state) {
        std::vector<Pair> pairs;
        for (const auto* list : {&state.pairs, &state.walls})
          for (const auto& pair : *list)
            if (pair.gamma < 0 || pair.impulse != 0) pairs.push_back(pair);
        return pairs;
      };
      EXPECT_EQ(remembered(after), remembered(before));
      EXPECT_TRUE(simulation.rebounds().empty());
    }
  }
  EXPECT_TRUE(is_refused);
}

}  // namespace
}  // namespace viscontact::particles
