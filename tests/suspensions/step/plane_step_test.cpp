// Steps beside planes: films, rolling and sliding, gravity and shear between walls.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/suspensions/spheres.hpp"
#include "viscontact/lubrication/plane_drag.hpp"

namespace viscontact::particles {
namespace {

/// One sphere of radius 1 beside the plane z = 0, without a flow.
Setting beside_plane(PairTerms pairs) {
  Setting setting;
  setting.planes.emplace_back().start = {{}, {0, 0, 1}};
  PairLubrication lubrication;
  lubrication.viscosity = 1;
  lubrication.pairs = pairs;
  lubrication.range = 50;
  setting.lubrication = lubrication;
  setting.added_torques.assign(3, 0);
  return setting;
}

double gap_of(const SuspensionSimulation& simulation) {
  return simulation.state().particles.position(0)[2] - 1;
}

TEST(StepBesideAPlane, OfAPressedSphereFollowsTheFilm) {
  // To leading order 6 pi mu a^2 dq/dt/q = -F: q = q_0 exp(-F t/(6 pi mu a^2)).
  auto setting = beside_plane(PairTerms::kNearContact);
  setting.lubrication->drag = 1e-8;
  const double force = 3, start = 1e-3;
  setting.added_forces = {0, 0, -force};
  setting.time_step = 0.5;
  SuspensionSimulation simulation(setting, spheres_at({{0, 0, 1 + start}}, {1}), 1);
  for (int n = 0; n < 8; ++n) EXPECT_TRUE(simulation.step(100).converged);
  EXPECT_NEAR(gap_of(simulation), start * std::exp(-force * 4 / (6 * M_PI)), 1e-7 * start);
  EXPECT_EQ(simulation.rheology().smallest_gap, gap_of(simulation));
}

TEST(StepBesideAPlane, OfASettlingSphereHasTheExactImpulse) {
  // The impulse of the force is that of the exact drag, 6 pi mu a^2 (Gamma(q_0) - Gamma(q)).
  const auto error_with = [](double h) {
    auto setting = beside_plane(PairTerms::kTables);
    setting.added_forces = {0, 0, -10};
    setting.time_step = h;
    SuspensionSimulation simulation(setting, spheres_at({{0, 0, 4}}, {1}), 1);
    while (simulation.step(30).parts > 0) continue;
    const double impulse = 6 * M_PI *
                           (lubrication::plane_drag_integral(3) -
                            lubrication::plane_drag_integral(gap_of(simulation)));
    EXPECT_LT(gap_of(simulation), 1e-4);
    return impulse / 300 - 1;
  };
  // Steps of 1 move the sphere by up to a third of its radius; the table has an error of 4e-6.
  EXPECT_NEAR(error_with(1), 0, 3e-4);
  EXPECT_NEAR(error_with(0.1), 0, 5e-6);
}

TEST(StepBesideAPlane, OfAContactRollsOrSlides) {
  // Pressed by 5 and pulled along the plane with drag alone: a sphere that rolls has the friction f
  // with v = w, 8 pi w = f and 6 pi v = pull - f, and one that slides has Coulomb's.
  const double press = 5, coefficient = 0.2;
  for (const double pull : {1.0, 4.0}) {
    auto setting = beside_plane(PairTerms::kNone);
    setting.laws.film.gamma_min = 0;
    setting.laws.friction = FrictionLaw{coefficient};
    setting.added_forces = {0, pull, -press};
    setting.time_step = 1e-3;
    SuspensionSimulation simulation(setting, spheres_at({{0, 0, 1}}, {1}), 1);
    for (int n = 0; n < 20; ++n) EXPECT_TRUE(simulation.step(1).converged);
    const double rolling = pull * 8 / 14, friction = std::min(rolling, coefficient * press);
    const auto& p = simulation.state().particles;
    EXPECT_NEAR(p.velocity(0)[1], (pull - friction) / (6 * M_PI), 1e-6);
    EXPECT_NEAR(p.angular_velocities[0], -friction / (8 * M_PI), 1e-6);
    EXPECT_NEAR(p.velocity(0)[2], 0, 1e-5);
    ASSERT_EQ(simulation.state().walls.size(), 1U);
    const auto& pair = simulation.state().walls[0];
    EXPECT_EQ(pair.first, -1);
    EXPECT_NEAR(pair.impulse, press * setting.time_step, 1e-7);
    const Vector on_sphere = simulation.state().memories.of(pair.memory).friction();
    EXPECT_NEAR(on_sphere[1], -friction * setting.time_step, 1e-7);
    EXPECT_NEAR(norm(on_sphere), friction * setting.time_step, 1e-7);
  }
}

/// Walls across y that move with the shear, periods along x and z.
struct Kind {
  StepKind of_pairs;
  double rate, weight;
  bool inertia;
};
constexpr double kLength = 8.5;

Setting between_walls(const Kind& kind) {
  auto setting = sheared_cube(kLength, 0, kind.of_pairs);
  setting.domain = BoxDomain{{0, 0, 0}, {kLength, kLength, kLength}, {true, false, true}};
  setting.lubrication->gradient[0][1] = kind.rate;
  setting.lubrication->inertia = kind.inertia;
  setting.gravity = {0, -kind.weight, 0};
  setting.time_step = 0.02;
  return setting;
}

const std::vector<Kind> kKinds{
    {{PairTerms::kTables, 0, 0, 0}, 1, 0, false},
    {{PairTerms::kTables, 0, 1e-2, 0.3}, 1, 10, false},
    {{PairTerms::kTables, 0, 1e-2, 0.3}, 1, 10, true},
    {{PairTerms::kNearContact, 1e-3, 0, 0}, 1, 3, false},
    {{PairTerms::kNearContact, 0, 1e-2, 0.3}, 0, 10, false},
    {{PairTerms::kNone, 0, 0, 0}, 1, 10, false},
    {{PairTerms::kNone, 0, 0, 0.3}, 1, 10, true},
};

/// Random spheres between the walls.
State start(std::size_t count = 20) {
  Random random(31);
  const auto radii = two_sizes(count);
  std::vector<Vector> places;
  for (int trials = 0; places.size() < radii.size(); ++trials) {
    if (trials % 5000 == 4999) places.clear();
    const double a = radii[places.size()];
    const Vector x{random.uniform(0, kLength), random.uniform(1.02 * a, kLength - 1.02 * a),
                   random.uniform(0, kLength)};
    bool is_free = true;
    for (std::size_t k = 0; k < places.size() && is_free; ++k) {
      Vector apart = x - places[k];
      for (const std::size_t d : {0U, 2U}) apart[d] -= kLength * std::round(apart[d] / kLength);
      is_free = norm(apart) >= 1.011 * (radii[k] + a);
    }
    if (is_free) places.push_back(x);
  }
  return spheres_at(places, radii);
}

TEST(StepBetweenWalls, LeavesNoOverlapAndBalancesThePowerOfForces) {
  for (const auto& kind : kKinds) {
    SCOPED_TRACE(&kind - kKinds.data());
    const auto setting = between_walls(kind);
    SuspensionSimulation simulation(setting, start(), 1);
    std::size_t touched_walls = 0;
    for (int n = 0; n < 60; ++n) {
      const auto report = simulation.step(10);
      EXPECT_TRUE(report.converged);
      const auto& state = simulation.state();
      const auto& p = state.particles;
      for (std::size_t k = 0; k < p.count(); ++k) {
        EXPECT_GT(p.position(k)[1] - p.radii[k] * (1 + kind.of_pairs.roughness), -1e-7);
        EXPECT_LT(p.position(k)[1] + p.radii[k] * (1 + kind.of_pairs.roughness), kLength + 1e-7);
      }
      EXPECT_GT(simulation.rheology().smallest_gap, kind.of_pairs.roughness - 1e-7);
      touched_walls = std::max(touched_walls, state.walls.size());
      const auto& rheology = simulation.rheology();
      EXPECT_GE(rheology.dissipation, 0);
      if (kind.inertia || kind.rate > 0) continue;
      double power = 0;
      for (std::size_t k = 0; k < p.count(); ++k)
        power += p.masses[k] * dot(setting.gravity, p.velocity(k));
      // The power of the forces has the errors of the velocities, 3e-9; seen: 4e-11.
      EXPECT_NEAR(power, rheology.dissipation, 3e-9 * rheology.dissipation);
    }
    EXPECT_EQ(touched_walls > 0,
              kind.of_pairs.pairs == PairTerms::kNone || kind.of_pairs.roughness > 0);
  }
}

TEST(StepBetweenWalls, BalancesTheEnergyOfSpheresWithInertia) {
  const auto setting = between_walls({{PairTerms::kTables, 0, 1e-2, 0.3}, 0, 10, true});
  SuspensionSimulation simulation(setting, start(), 1);
  for (int n = 0; n < 60; ++n) {
    const State before = simulation.state();
    EXPECT_TRUE(simulation.step(10).converged);
    const auto &p = simulation.state().particles, &last = before.particles;
    const double h = simulation.state().time - before.time;
    // With solids the step is implicit Euler's: forces and changes of momentum act on velocities at
    // its end.
    double power = 0, kinetic = 0;
    for (std::size_t k = 0; k < p.count(); ++k) {
      const Vector v = p.velocity(k), w = point_of(p.angular_velocities.data(), k, 3);
      power += p.masses[k] * dot(setting.gravity, v);
      kinetic += (p.masses[k] * dot(v, v - last.velocity(k)) +
                  p.inertias[k] * dot(w, w - point_of(last.angular_velocities.data(), k, 3))) /
                 h;
    }
    // The velocities have errors of 3e-9; seen: 6e-11.
    EXPECT_NEAR(power, simulation.rheology().dissipation + kinetic, 3e-9 * std::abs(power));
  }
}

TEST(StepBetweenWalls, IsContinuedFromAStateBitForBit) {
  for (const auto& kind : kKinds) {
    SCOPED_TRACE(&kind - kKinds.data());
    expect_continued(between_walls(kind), start(), 20, 8);
  }
}

TEST(StepBetweenWalls, SettlesOntoTheLowerWall) {
  // At the end the lower wall bears the weight of all spheres, and the upper one nothing.
  struct Pile {
    PairTerms pairs;
    double friction;
    std::size_t count;
  };
  for (const auto& [pairs, friction, count] :
       {Pile{PairTerms::kNone, 0, 20}, Pile{PairTerms::kTables, 0, 20},
        Pile{PairTerms::kTables, 0.5, 6}}) {
    auto setting = between_walls({{pairs, 0, 1e-2, friction}, 0, 20, false});
    setting.laws.film = {};
    setting.laws.film.gamma_min = 0;
    setting.time_step = 0.1;
    SuspensionSimulation simulation(setting, start(count), 1);
    while (simulation.step(80).parts > 0) continue;
    const auto& state = simulation.state();
    double weight = 0, borne = 0;
    for (const double mass : state.particles.masses) weight += 20 * mass;
    for (const auto& pair : state.walls) {
      EXPECT_EQ(pair.first, -1);
      borne += pair.impulse / state.earlier_step;
    }
    EXPECT_NEAR(borne, weight, 1e-5 * weight);
  }
}

TEST(StepBetweenWalls, LeavesASettledBedWithFrictionAtRest) {
  for (const auto& [pairs, has_inertia] :
       {std::pair(PairTerms::kNone, false), std::pair(PairTerms::kTables, false),
        std::pair(PairTerms::kTables, true)}) {
    SCOPED_TRACE(testing::Message() << static_cast<int>(pairs) << has_inertia);
    auto setting = between_walls({{pairs, 0, 1e-2, 0.5}, 0, 10, has_inertia});
    SuspensionSimulation simulation(setting, start(26), 1);
    int unsolved = 0;
    while (simulation.step(6).parts > 0) continue;
    for (;;) {
      const auto report = simulation.step(8);
      if (report.parts == 0) break;
      // A sphere that falls to another place may have a step in which Coulomb's law has no
      // solution.
      if (!report.converged) ++unsolved;
      const auto& p = simulation.state().particles;
      for (std::size_t k = 0; k < p.count(); ++k)
        EXPECT_GT(p.position(k)[1] - p.radii[k] * 1.01, -1e-7);
      EXPECT_GT(simulation.rheology().smallest_gap, 1e-2 - 1e-7);
    }
    EXPECT_LE(unsolved, 1);
    double weight = 0, borne = 0;
    const auto& state = simulation.state();
    for (const double mass : state.particles.masses) weight += 10 * mass;
    for (const auto& pair : state.walls)
      borne += (pair.first == -1 ? 1 : -1) * pair.impulse / state.earlier_step;
    // Spheres that still settle are borne by their drag, too.
    EXPECT_NEAR(borne, weight, 0.02 * weight);
  }
}

TEST(StepBetweenWalls, OfASettledLayerInAShearIsLifted) {
  // Films between spheres that pass each other push the layer up against its weight.
  const auto height_after = [](double rate) {
    auto setting = between_walls({{PairTerms::kTables, 0, 1e-2, 0}, 0, 20, false});
    setting.time_step = 0.2;
    SuspensionSimulation settling(setting, start(), 1);
    while (settling.step(10).parts > 0) continue;
    setting.lubrication->gradient[0][1] = rate;
    setting.time_step = 0.02 / std::max(rate, 1.0);
    State settled;
    settled.particles = settling.state().particles;
    SuspensionSimulation shearing(setting, settled, 1);
    while (shearing.step(3 / std::max(rate, 1.0)).parts > 0) continue;
    double sum = 0;
    for (std::size_t k = 0; k < 20; ++k) sum += shearing.state().particles.position(k)[1];
    return sum / 20;
  };
  // The mean heights after a strain of 3 are 2.01, 2.18 and 2.29.
  const double settled = height_after(0), slow = height_after(3), fast = height_after(30);
  EXPECT_GT(slow, settled + 0.02);
  EXPECT_GT(fast, slow + 0.02);
}

// Spheres beside a plane in a shear along it, without a box.
struct Scene {
  Setting setting;
  State state;
};

// Rounding errors of iterations, which ten steps multiply.
constexpr double kBar = 1e-9;

struct SceneKind {
  PairTerms pairs;
  bool has_inertia;
  double friction;
};

Scene scene(const SceneKind& kind) {
  const auto [pairs, has_inertia, friction] = kind;
  Scene scene{beside_plane(pairs), {}};
  auto& of = *scene.setting.lubrication;
  of.range = 1;
  of.roughness = 1e-2;
  of.inertia = has_inertia;
  of.gradient[0][2] = 2;
  if (friction > 0) scene.setting.laws.friction = FrictionLaw{friction};
  scene.setting.gravity = {0, 0, -100};
  if (pairs == PairTerms::kNone) {
    scene.setting.laws.film.viscosity = 1;
    scene.setting.laws.film.roughness = 5e-3;
  }
  scene.setting.time_step = 0.01;
  scene.setting.added_torques.clear();
  scene.state = spheres_at({{0, 0, 1.015}, {2.3, 0.2, 1.2}, {0.4, 2.5, 1.43}, {1.2, 1.2, 3.4}},
                           {1, 1, 1.4, 1});
  if (has_inertia)
    for (std::size_t k = 0; k < 4; ++k) scene.state.particles.velocities[3 * k] = 1;
  return scene;
}

std::vector<RelativeMotion> motions_after_steps(const Scene& of) {
  SuspensionSimulation simulation(of.setting, of.state, 1);
  for (int n = 0; n < 10; ++n) EXPECT_TRUE(simulation.step(1e300).converged);
  EXPECT_FALSE(simulation.state().walls.empty());
  std::vector<RelativeMotion> result;
  for (std::size_t k = 0; k < of.state.particles.count(); ++k)
    result.push_back(relative_motion(simulation, of.setting, k));
  return result;
}

class SceneBesideAPlane : public testing::TestWithParam<SceneKind> {
 protected:
  Scene here = scene(GetParam());
  std::vector<RelativeMotion> motions = motions_after_steps(here);
};

TEST_P(SceneBesideAPlane, IsTheSameTurnedAndShifted) {
  // The rows of a rotation, and a shift. A uniform flow would come with the shift, so that this is
  // along the plane and across the flow, or along the flow.
  const std::array<Vector, 3> turn{Vector{0.36, 0.48, -0.8}, {-0.8, 0.6, 0}, {0.48, 0.64, 0.6}};
  const auto turned = [&](const Vector& x) {
    return Vector{dot(turn[0], x), dot(turn[1], x), dot(turn[2], x)};
  };
  Scene there = here;
  const Vector shift = turned({3, -2, 0});
  auto& p = there.state.particles;
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector x = turned(here.state.particles.position(k)) + shift;
    const Vector v = turned(here.state.particles.velocity(k));
    std::ranges::copy(x, &p.positions[3 * k]);
    std::ranges::copy(v, &p.velocities[3 * k]);
  }
  there.setting.gravity = turned(here.setting.gravity);
  there.setting.planes[0].start = {shift, turned({0, 0, 1})};
  const Vector along = turned({2, 0, 0}), normal = turned({0, 0, 1});
  for (std::size_t i = 0; i < 3; ++i) there.setting.lubrication->gradient[i] = along[i] * normal;
  auto expected = motions;
  for (auto& motion : expected) {
    motion.along = turned(motion.along);
    motion.turn = turned(motion.turn);
  }
  EXPECT_LT(largest_difference(expected, motions_after_steps(there)), kBar);
}

TEST_P(SceneBesideAPlane, IsTheSameInUnitsOverTenDecades) {
  for (const auto& [length, time, mass] :
       {std::array{1e-5, 1e3, 1e-7}, std::array{1e5, 1e-2, 1e10}}) {
    Scene there = here;
    auto& of = *there.setting.lubrication;
    of.viscosity *= mass / (length * time);
    for (auto& row : of.gradient) row = (1 / time) * row;
    if (there.setting.laws.film.viscosity) {
      *there.setting.laws.film.viscosity *= mass / (length * time);
      *there.setting.laws.film.roughness *= length;
    }
    there.setting.gravity = (length / (time * time)) * there.setting.gravity;
    there.setting.time_step *= time;
    there.state = scaled(here.state, length);
    auto& p = there.state.particles;
    for (std::size_t k = 0; k < p.count(); ++k) {
      p.masses[k] = mass * here.state.particles.masses[k];
      p.inertias[k] = mass * length * length * here.state.particles.inertias[k];
      for (std::size_t d = 0; d < 3; ++d)
        p.velocities[3 * k + d] = length / time * here.state.particles.velocities[3 * k + d];
    }
    EXPECT_LT(largest_difference(motions, in_units(motions_after_steps(there), length, time)),
              kBar);
  }
}

TEST_P(SceneBesideAPlane, IsTheSameInAnotherOrder) {
  const std::vector<std::size_t> order{2, 0, 3, 1};
  Scene there = here;
  there.state = reordered(here.state, order);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t d = 0; d < 3; ++d)
      there.state.particles.velocities[3 * k + d] =
          here.state.particles.velocities[3 * order[k] + d];
  // A second plane far away changes nothing but the numbers of bodies.
  there.setting.planes.emplace_back().start = {{0, 0, 50}, {0, 0, -1}};
  there.setting.planes.back().velocity.pieces = {{1e300, {100, 0, 0}}};
  std::vector<RelativeMotion> expected;
  for (const auto k : order) expected.push_back(motions[k]);
  EXPECT_LT(largest_difference(expected, motions_after_steps(there)), kBar);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SceneBesideAPlane,
                         testing::Values(SceneKind{PairTerms::kTables, false, 0},
                                         SceneKind{PairTerms::kTables, true, 0},
                                         SceneKind{PairTerms::kTables, true, 0.3},
                                         SceneKind{PairTerms::kNearContact, false, 0},
                                         SceneKind{PairTerms::kNearContact, false, 0.3},
                                         SceneKind{PairTerms::kNone, false, 0},
                                         SceneKind{PairTerms::kNone, true, 0}));

}  // namespace
}  // namespace viscontact::particles
