// Pairs that are hit again and again, also several times in a step, against the closed form of a
// ball that bounces, docs/physics.md (5.16).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "tests/contact_dynamics/impacts/scene.hpp"
#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {
namespace {

// Velocities fall by e_d, and bounces end when a flight would be shorter than a twentieth of the
// step. After each impact the gap is 0 but for a rounding error, whose sign must not matter. On a
// plane that turns, the impacts are found by bisection.

enum class Partner { kPlane, kTurningPlane, kRoundWall, kParticle };

/// A ball that falls on its partner from rest at the gap 1 with the acceleration 1.
struct Bounces {
  Scheme scheme = Scheme::kLeapfrog;
  double dry = 0.9, step = 0.02;

  /// The speed of the first impact. The path of the default scheme begins with half a step's load.
  double first_speed() const {
    return std::sqrt(2 + (scheme == Scheme::kEuler ? step * step / 4 : 0));
  }
  /// The times of all impacts until `end`.
  std::vector<double> times(double end) const {
    std::vector<double> impacts;
    double speed = first_speed();
    double time = speed - (scheme == Scheme::kEuler ? step / 2 : 0);
    while (2 * dry * speed >= step / 20 && time < end) {
      impacts.push_back(time);
      speed *= dry;
      time += 2 * speed;
    }
    return impacts;
  }
};

/// A scene of `Bounces` with units, directions and an order of particles of its own. Beside the
/// ball it has its partner, or a particle that floats far above.
struct Ball {
  Scene scene;
  double time;  // the unit of time
};

Ball ball_of(const Bounces& bounces, Partner partner, int dimension, double decades,
             Random& random) {
  const double length = random.decades(-decades, decades), mass = random.decades(-decades, decades),
               time = random.decades(-decades, decades);
  const Vector n = random.direction(dimension);
  const Vector place = (10 * length * random.uniform(0, 1)) * random.direction(dimension);
  Ball ball{{no_particles(dimension), {}}, time};
  auto& [state, setting] = ball.scene;
  const double acceleration = length / (time * time);
  const bool is_first = random.chance(0.5);
  const auto add_other = [&] {
    if (partner == Partner::kParticle)
      add_particle(state, place - length * n, length, 3 * mass);
    else
      add_particle(state, place + (9 * length) * n, length, mass);
  };
  if (!is_first) add_other();
  add_particle(state, place + (1.5 * length) * n, length / 2, mass);
  if (is_first) add_other();
  if (partner == Partner::kParticle) {
    // Forces press both onto each other.
    const double force = acceleration / (1 / mass + 1 / (3 * mass));
    setting.forces[is_first ? 0 : 1] = constant(-force * n);
    setting.forces[is_first ? 1 : 0] = constant(force * n);
  } else {
    setting.gravity = -acceleration * n;
    setting.forces[is_first ? 1 : 0] = constant(mass * acceleration * n);
    setting.planes = {plane_at_rest(place, n)};
    if (partner == Partner::kRoundWall)
      setting.planes[0].start = {place + (7 * length) * n, {}, 7 * length};
    setting.planes[0].pivot = place;
    // The whole turn is within the tolerance of the times below. This plane is decided as one that
    // turns; RepeatedImpactsAtAPlane has planes that turn far.
    if (partner == Partner::kTurningPlane)
      setting.planes[0].angular_velocity = {0, 0, 1e-15 / time};
  }
  set_rebounds_without_film(setting, bounces.dry, bounces.step * time);
  setting.scheme = bounces.scheme;
  return ball;
}

void expect_closed_form(const Bounces& bounces, Partner partner, int dimension, double end,
                        double decades, Random& random) {
  const auto ball = ball_of(bounces, partner, dimension, decades, random);
  const auto& p = ball.scene.state.particles;
  const double length = std::max(p.radii[0], p.radii[1]);
  Simulation simulation(ball.scene.setting, ball.scene.state, 1);
  const auto rebounds = rebounds_until(end * ball.time, simulation);
  const auto times = bounces.times(end);
  ASSERT_EQ(rebounds.size(), times.size())
      << "partner " << static_cast<int>(partner) << " step " << bounces.step << " e_d "
      << bounces.dry << " units " << length << " " << ball.time;
  double speed = bounces.first_speed();
  for (std::size_t k = 0; k < times.size(); ++k) {
    // Errors of 1e-15 of positions near 10 give errors of 1e-9 after a hundred impacts on a round
    // partner, which multiply errors of the direction.
    EXPECT_NEAR(rebounds[k].time / ball.time, times[k], 1e-8) << k;
    EXPECT_NEAR(rebounds[k].approach_velocity * ball.time / length, -speed, 1e-8) << k;
    speed *= bounces.dry;
  }
}

class RepeatedImpacts : public ::testing::TestWithParam<std::pair<int, Partner>> {};
INSTANTIATE_TEST_SUITE_P(
    Partners, RepeatedImpacts,
    ::testing::Values(std::pair(2, Partner::kPlane), std::pair(3, Partner::kPlane),
                      std::pair(2, Partner::kTurningPlane), std::pair(2, Partner::kRoundWall),
                      std::pair(2, Partner::kParticle), std::pair(3, Partner::kParticle)));

TEST_P(RepeatedImpacts, EndWhenAFlightWouldBeShorterThanATwentiethOfTheStep) {
  const auto [dimension, partner] = GetParam();
  Random random(7);
  for (const auto scheme : {Scheme::kEuler, Scheme::kLeapfrog})
    for (const double dry : {0.3, 0.8, 0.9})
      for (const double step : {0.1, 0.02, 0.001})
        for (const double decades : {0.0, 5.0, 5.0, 5.0})
          expect_closed_form({scheme, dry, step}, partner, dimension,
                             1.1 * std::sqrt(2) * (1 + dry) / (1 - dry), decades, random);
}

TEST_P(RepeatedImpacts, OfFlightsMuchShorterThanAStepWithoutLossGoOn) {
  // With e_d = 1 each flight takes 2 sqrt(2), which is a fifth or a fifteenth of the step. A round
  // partner multiplies errors of the direction in each impact, so that the ball leaves it sooner or
  // later.
  const auto [dimension, partner] = GetParam();
  const double end = partner == Partner::kParticle ? 30 : 1000;
  Random random(8);
  for (const double step : {14.0, 42.0})
    for (const double decades : {0.0, 5.0})
      expect_closed_form({Scheme::kLeapfrog, 1, step}, partner, dimension, end, decades, random);
}

TEST(RepeatedImpactsOfDiscs, ThatTurnAroundEachOtherDoNotDependOnTheStep) {
  // A disc leaps over a heavy one. Its parabolas are exact at each step, so that all steps, of
  // which the longest has several impacts, give the same impacts.
  std::vector<Rebound> shortest;
  for (const double step : {1.0 / 512, 1.0 / 16, 0.5}) {
    Scene scene{no_particles(2), {}};
    add_particle(scene.state, {0, 0, 0}, 10, 1e30);
    add_particle(scene.state, {0, 11.001, 0}, 1, 1, {0.3, 0, 0});
    scene.setting.forces[1] = constant({0, -1, 0});
    scene.setting.scheme = Scheme::kLeapfrog;
    set_rebounds_without_film(scene.setting, 1, step);
    Simulation simulation(scene.setting, scene.state, 1);
    const auto rebounds = rebounds_until(2, simulation);
    if (shortest.empty()) shortest = rebounds;
    ASSERT_GT(rebounds.size(), 10U);
    ASSERT_EQ(rebounds.size(), shortest.size()) << step;
    // Errors of the normal grow with each impact on a round partner.
    for (std::size_t k = 0; k < rebounds.size(); ++k)
      EXPECT_NEAR(rebounds[k].time, shortest[k].time, 1e-8) << step << " " << k;
  }
}

TEST(RepeatedImpactsOfDiscs, ThatComeBackToARoundPartnerInALongStepAreHit) {
  // A disc has left a heavy one tangentially at 45 degrees below its top, with v^2 = (1 + excess) g
  // R cos(45 degrees), and flies up. With the centre of the heavy disc as origin, x^2 - R^2 = t^2
  // (v^2 - g R c - v g c t + g^2 t^2/4) with c = cos(45 degrees), which is 0 again at `hit`.
  constexpr double kR = 2, kG = 1, kBegin = 0.05;  // the simulation begins at the time kBegin
  const double c = std::sqrt(0.5);
  Random random(11);
  for (const double excess : {0.3, 0.5, 0.7})
    for (const double step : {1.0 / 64, 1.0, 2.0}) {
      const double v = std::sqrt((1 + excess) * kG * kR * c);
      const double hit = 2 / kG * (v * c - std::sqrt(v * c * v * c - (v * v - kG * kR * c)));
      const Vector up = random.direction(2), right{up[1], -up[0], 0}, pull = -kG * up;
      const Vector velocity = (v * c) * (up + right);
      Scene scene{no_particles(2), {}};
      add_particle(scene.state, {}, 1, 1e30);
      add_particle(scene.state,
                   (kR * c) * (up - right) + kBegin * velocity + (kBegin * kBegin / 2) * pull, 1, 1,
                   velocity + kBegin * pull);
      scene.setting.forces[1] = constant(pull);
      scene.setting.scheme = Scheme::kLeapfrog;
      set_rebounds_without_film(scene.setting, 1, step);
      Simulation simulation(scene.setting, scene.state, 1);
      const auto rebounds = rebounds_until(2, simulation);
      ASSERT_FALSE(rebounds.empty()) << excess << " " << step;
      // Rounding errors of the gap, of 1e-16, over its rate of about 0.1.
      EXPECT_NEAR(rebounds[0].time, hit - kBegin, 1e-13) << excess << " " << step;
    }
}

TEST(RepeatedImpactsOfDiscs, ThatComeBackWithoutAFlightDoNotDependOnRoundingErrors) {
  // The first disc hits the second one, and the film keeps them together or nearly so. The second
  // one hits the heavy third one, which touches it, and comes back to the first one with a gap of
  // 0.
  Random random(10);
  for (int k = 0; k < 1000; ++k) {
    const double angle = random.uniform(-1, 1), speed = random.uniform(1, 10),
                 first = random.uniform(0.5, 1), third = random.uniform(0.5, 1),
                 gap = random.uniform(0.01, 0.05), pull = random.uniform(0, 1);
    std::vector<Rebound> one;
    for (int frame = 0; frame < 3; ++frame) {
      const Vector n = random.direction(2), across{-n[1], n[0], 0},
                   place = random.uniform(0, 5) * random.direction(2);
      Scene scene{no_particles(2), {}};
      add_particle(scene.state, place - (1 + first + gap) * n, first, 1, speed * n);
      add_particle(scene.state, place, 1, 1);
      add_particle(scene.state,
                   place + (1 + third) * (std::cos(angle) * n + std::sin(angle) * across), third,
                   1e6);
      // Accelerations that differ by rounding errors.
      scene.setting.gravity = pull * (0.6 * n + 0.8 * across);
      scene.setting.laws.film.gamma_min = -0.2 * speed;
      scene.setting.laws.restitution.coefficient = 0.5;
      scene.setting.time_step = 0.1;
      Simulation simulation(scene.setting, scene.state, 1);
      simulation.step(1);
      const auto& rebounds = simulation.rebounds();
      if (frame == 0) one.assign(rebounds.begin(), rebounds.end());
      ASSERT_EQ(rebounds.size(), one.size()) << k;
      for (std::size_t i = 0; i < one.size(); ++i)
        EXPECT_NEAR(rebounds[i].approach_velocity, one[i].approach_velocity, 1e-8) << k << " " << i;
    }
  }
}

/// Impacts of a ball of radius 1/2 that falls, with the acceleration 1, on a plane through the
/// origin that turns about it: the next zero of the gap after each impact, by small steps and
/// bisection, until the flight would be shorter than a twentieth of `step`.
std::vector<Rebound> impacts_on_turning_plane(Vector x, Vector v, double omega, double dry,
                                              double step, double end) {
  const Vector pull{0, -1, 0}, spin{0, 0, omega};
  const auto normal = [&](double t) {
    return Vector{-std::sin(omega * t), std::cos(omega * t), 0};
  };
  double begin = 0;  // time at which x and v are the place and the velocity
  const auto place = [&](double t) {
    return x + (t - begin) * v + ((t - begin) * (t - begin) / 2) * pull;
  };
  const auto gap = [&](double t) { return dot(normal(t), place(t)) - 0.5; };
  std::vector<Rebound> impacts;
  const double small = step / 200;
  for (double t = small; t < end; t += small) {
    if (gap(t) > 0) continue;
    double low = t - small, high = t;
    for (int n = 0; n < 60; ++n) (gap((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
    const Vector n = normal(high), at = place(high), flies = v + (high - begin) * pull;
    const double rate = dot(n, flies - cross(spin, at - 0.5 * n));
    // The second derivative of the gap by differences, whose errors are 1e-7.
    constexpr double kD = 1e-4;
    const double pulls = (gap(high + kD) - 2 * gap(high) + gap(high - kD)) / (kD * kD);
    if (-rate <= 0.05 * step * -pulls / (2 * dry)) break;
    impacts.push_back({high, -1, 0, rate, 0, -dry * rate});
    begin = high;
    x = at;
    v = flies - ((1 + dry) * rate) * n;
    t = high;
  }
  return impacts;
}

TEST(RepeatedImpactsAtAPlane, ThatTurnsFollowItsMotion) {
  // A plane that turns against the ball, and one that turns away from it.
  for (const auto& [omega, lever] : {std::pair(0.4, 2.0), std::pair(-0.2, 0.5)})
    for (const double dry : {0.7, 0.8})
      for (const double step : {0.005, 0.02, 0.1, 0.5}) {
        constexpr double kEnd = 4;
        const Vector place{lever, 0.6, 0};
        const auto expected = impacts_on_turning_plane(place, {}, omega, dry, step, kEnd);
        Scene scene{no_particles(2), {}};
        add_particle(scene.state, place, 0.5, 1);
        scene.setting.planes = {plane_at_rest({}, {0, 1, 0})};
        scene.setting.planes[0].angular_velocity = {0, 0, omega};
        scene.setting.gravity = {0, -1, 0};
        scene.setting.scheme = Scheme::kLeapfrog;
        set_rebounds_without_film(scene.setting, dry, step);
        Simulation simulation(scene.setting, scene.state, 1);
        const auto rebounds = rebounds_until(kEnd, simulation);
        EXPECT_GT(expected.size(), 2U);
        ASSERT_EQ(rebounds.size(), expected.size()) << omega << " " << dry << " " << step;
        for (std::size_t k = 0; k < expected.size(); ++k) {
          // Rounding errors of the gap, of 1e-15, over the least rates, of about 1e-4.
          EXPECT_NEAR(rebounds[k].time, expected[k].time, 1e-10) << k;
          EXPECT_NEAR(rebounds[k].approach_velocity, expected[k].approach_velocity, 1e-10) << k;
        }
      }
}

TEST(RepeatedImpactsOfDiscs, OfAImpactAtTheEndOfAStepGoOnInTheNextStep) {
  // The first impact, at v = 1 and t = 1, is at the end of a step but for rounding errors. The next
  // flight, of 0.6, lasts less than the step.
  Random random(9);
  for (int k = 0; k < 50; ++k) {
    const Vector n = random.direction(2);
    Scene scene{no_particles(2), {}};
    add_particle(scene.state, 1.5 * n, 1, 1);
    scene.setting.planes = {plane_at_rest({}, n)};
    scene.setting.gravity = -1.0 * n;
    scene.setting.scheme = Scheme::kLeapfrog;
    set_rebounds_without_film(scene.setting, 0.3, 1);
    Simulation simulation(scene.setting, scene.state, 1);
    const auto rebounds = rebounds_until(3, simulation);
    ASSERT_EQ(rebounds.size(), 3U) << k;
    // Times that differ by 1e-9 of the step count as equal (kSameTime in impacts.cpp), so that a
    // impact beyond the end of a step by less is moved to the end.
    EXPECT_NEAR(rebounds[0].time, 1, 1e-9);
    EXPECT_NEAR(rebounds[1].time, 1.6, 1e-9);
    EXPECT_NEAR(rebounds[2].time, 1.78, 1e-9);
  }
}

}  // namespace
}  // namespace viscontact::particles
