// The same motion from another side, under other names, in a mirror, and by any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <vector>

#include "tests/particles/systems.hpp"
#include "viscontact/common/system/thread_pool.hpp"

namespace viscontact::particles {
namespace {

struct Scene {
  State state;
  Setting setting;
};

/// Thirty particles of radii 1:4 fall into a corner of three planes, one of which moves.
Scene falling(int dimension) {
  Random random(7);
  Scene scene;
  scene.state = random_cloud(
      dimension, 30, dimension == 2 ? 9.0 : 5.0, [&] { return random.uniform(0.25, 1); }, random);
  scene.setting.gravity = {-0.3, -1, dimension == 3 ? -0.2 : 0.0};
  scene.setting.planes = {plane_at_rest({0, -8, 0}, {0, 1, 0}),
                          plane_at_rest({-8, 0, 0}, {1, 0, 0})};
  if (dimension == 3) scene.setting.planes.push_back(plane_at_rest({0, 0, -8}, {0, 0, 1}));
  scene.setting.planes[0].velocity = {{{1, {0, 0.5, 0}}, {10, {0.1, 0, 0}}}};
  scene.setting.planes[0].angular_velocity = {0, 0, 0.02};
  scene.setting.laws.film.gamma_min = -1;
  scene.setting.forces[3] = {{{1.234, {5, -1, 0}}, {9, {-2, 3, 0}}}};
  scene.setting.time_step = 0.05;
  scene.setting.solver.tolerance = 1e-13;
  scene.setting.solver.max_iterations = 100'000;
  return scene;
}

State after(const Scene& scene, double end) {
  Simulation simulation(scene.setting, scene.state, 1);
  std::size_t glued = 0;
  run(simulation, end, [&](const StepReport& report) {
    EXPECT_TRUE(report.converged) << report.time << ": " << report.residual;
    glued = std::max(glued, report.glued);
  });
  EXPECT_GT(glued, scene.state.particles.count());
  return simulation.state();
}

// Residuals of 1e-13 (lengths) and rounding become differences of impulses times the packing's
// condition, 1e3, and contacts multiply them as they go: over 120 steps of falling and settling
// 7e-12 is seen (relabelled), 0 in the mirror.
constexpr double kSame = 1e-9;

/// Every vector of the scene by `map`, which is linear and keeps lengths; angular velocities are
/// times `sign`, -1 of a mirror.
Scene mapped(const Scene& scene, const std::function<Vector(const Vector&)>& map, double sign) {
  Scene result = scene;
  auto& p = result.state.particles;
  const auto numbers = static_cast<std::size_t>(p.dimension);
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector x = map(scene.state.particles.position(k));
    std::copy_n(x.begin(), numbers, &p.positions[k * numbers]);
  }
  auto& s = result.setting;
  s.gravity = map(s.gravity);
  for (auto& [particle, force] : s.forces)
    for (auto& piece : force.pieces) piece.value = map(piece.value);
  for (auto& plane : s.planes) {
    plane.start = {map(plane.start.point), map(plane.start.normal)};
    plane.angular_velocity = sign * map(plane.angular_velocity);
    plane.pivot = map(plane.pivot);
    for (auto& piece : plane.velocity.pieces) piece.value = map(piece.value);
  }
  return result;
}

void expect_mapped(const Scene& scene, const std::function<Vector(const Vector&)>& map,
                   double sign) {
  const auto one = after(scene, 6), other = after(mapped(scene, map, sign), 6);
  for (std::size_t k = 0; k < one.particles.count(); ++k)
    EXPECT_LE(norm(map(one.particles.position(k)) - other.particles.position(k)), kSame) << k;
}

class Invariance : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, Invariance, ::testing::Values(2, 3));

TEST_P(Invariance, UnderRotation) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  expect_mapped(
      falling(GetParam()),
      [&](const Vector& v) {
        return Vector{c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]};
      },
      1);
}

TEST_P(Invariance, UnderMirror) {
  expect_mapped(
      falling(GetParam()),
      [](const Vector& v) {
        return Vector{-v[0], v[1], v[2]};
      },
      -1);
}

TEST_P(Invariance, UnderRelabelling) {
  const auto scene = falling(GetParam());
  const auto& p = scene.state.particles;
  std::vector<std::size_t> order(p.count());
  std::iota(order.begin(), order.end(), 0U);
  std::mt19937_64 generator(3);
  std::ranges::shuffle(order, generator);
  Scene other = scene;
  other.state = no_particles(GetParam());
  other.setting.forces.clear();
  for (std::size_t k = 0; k < order.size(); ++k) {
    add_particle(other.state, p.position(order[k]), p.radii[order[k]], p.masses[order[k]]);
    if (const auto force = scene.setting.forces.find(static_cast<std::int32_t>(order[k]));
        force != scene.setting.forces.end())
      other.setting.forces[static_cast<std::int32_t>(k)] = force->second;
  }
  std::swap(other.setting.planes[0], other.setting.planes[1]);
  const auto one = after(scene, 6), renamed = after(other, 6);
  for (std::size_t k = 0; k < order.size(); ++k)
    EXPECT_LE(norm(one.particles.position(order[k]) - renamed.particles.position(k)), kSame) << k;
}

/// A lattice whose particles all touch, more than a block of contacts, is pushed together from one
/// side, jerked from below, and pulled.
Scene big_lattice(int dimension) {
  Scene scene;
  scene.state = no_particles(dimension);
  const int side = dimension == 2 ? 100 : 20, layers = dimension == 2 ? 1 : side;
  Random random(9);
  for (int z = 0; z < layers; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        add_particle(scene.state, {2.0 * x, 2.0 * y, 2.0 * z}, 1, random.uniform(0.5, 2),
                     0.1 * random.direction(dimension));
  auto piston = plane_at_rest({-1, 0, 0}, {1, 0, 0});
  piston.velocity = {{{0.06, {1, 0, 0}}, {1, {-1, 0, 0}}}};
  scene.setting.planes = {piston, plane_at_rest({0, -1, 0}, {0, 1, 0}),
                          plane_at_rest({2.0 * side, 0, 0}, {-1, 0, 0})};
  scene.setting.gravity = {0, -1, 0};
  scene.setting.laws.film.gamma_min = -0.5;
  scene.setting.time_step = 0.02;
  scene.setting.solver.max_iterations = 25;
  return scene;
}

TEST_P(Invariance, ThreadsDoNotChangeABit) {
  auto scene = big_lattice(GetParam());
  std::vector<State> results;
  for (const int threads : {1, 2, 5}) {
    Simulation simulation(scene.setting, scene.state, threads);
    std::size_t contacts = 0;
    for (int n = 0; n < 5; ++n) contacts = std::max(contacts, simulation.step(1).contacts);
    EXPECT_GT(contacts, ThreadPool::kBlock);
    results.push_back(simulation.state());
  }
  for (const auto& result : results) {
    EXPECT_TRUE(result.particles.positions == results[0].particles.positions);
    EXPECT_TRUE(result.particles.velocities == results[0].particles.velocities);
    EXPECT_TRUE(result.pairs == results[0].pairs);
    EXPECT_TRUE(result.walls == results[0].walls);
    EXPECT_TRUE(result.skins == results[0].skins);
  }
}

}  // namespace
}  // namespace viscontact::particles
