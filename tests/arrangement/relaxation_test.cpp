// Overlaps that vanish by the descent of their energy, and particles that jam.
#include "viscontact/arrangement/relaxation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "viscontact/arrangement/arrangement.hpp"

namespace viscontact::particles {
namespace {

constexpr int kManySteps = 20000;

struct Scene {
  Domain domain;
  std::vector<double> radii;  // falling
  double gap = 0;
  std::vector<PlanePosition> planes{};
  std::vector<FixedParticle> fixed{};
};

std::vector<Places> places_of(const Scene& scene) {
  std::vector<Places> all;
  for (const double radius : scene.radii)
    all.emplace_back(scene.domain, scene.planes, radius + scene.gap);
  return all;
}

/// The particles at uniformly random places.
PlacedParticles random_particles(const Scene& scene, const std::vector<Places>& places) {
  PlacedParticles placed(places, scene.radii, scene.gap, scene.fixed);
  SplitMix64 random(1);
  for (std::size_t k = 0; k < scene.radii.size(); ++k) placed.add(placed.places(k).random(random));
  return placed;
}

/// `large` radii of 1.4 units and `small` radii of one unit [L].
std::vector<double> two_sizes(std::size_t large, std::size_t small, double unit) {
  std::vector<double> radii(large, 1.4 * unit);
  radii.resize(large + small, unit);
  return radii;
}

/// A periodic square or cube with its lower corner at two units, of which these particles take
/// this fraction.
BoxDomain box_of(const std::vector<double>& radii, std::size_t dimension, double fraction,
                 double unit) {
  const double size =
      size_of({.radii = radii, .smallest_gap = 0, .seed = 1}, static_cast<int>(dimension)) /
      fraction;
  const double length = dimension == 2 ? std::sqrt(size) : std::cbrt(size);
  BoxDomain box;
  for (std::size_t d = 0; d < dimension; ++d) {
    box.from[d] = 2 * unit;
    box.to[d] = 2 * unit + length;
    box.periodic[d] = true;
  }
  return box;
}

/// The smallest gap between all, also to fixed particles, walls and planes.
double smallest_gap(const Scene& scene, const std::vector<Vector>& x) {
  const auto periods = periods_of(scene.domain);
  const auto distance = [&](const Vector& a, const Vector& b) {
    Vector apart = a - b;
    for (std::size_t d = 0; d < 3; ++d)
      if (periods[d] > 0) apart[d] = std::remainder(apart[d], periods[d]);
    return std::hypot(apart[0], apart[1], apart[2]);
  };
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      gap = std::min(gap, distance(x[i], x[j]) - scene.radii[i] - scene.radii[j]);
    for (const auto& fixed : scene.fixed)
      gap = std::min(gap, distance(x[i], fixed.centre) - scene.radii[i] - fixed.radius);
    for (const auto& plane : scene.planes)
      gap = std::min(gap, dot(plane.normal, x[i] - plane.point) - scene.radii[i]);
    if (const auto* disc = std::get_if<DiscDomain>(&scene.domain))
      gap = std::min(gap, disc->radius - scene.radii[i] -
                              std::hypot(x[i][0] - disc->centre[0], x[i][1] - disc->centre[1]));
    if (const auto* box = std::get_if<BoxDomain>(&scene.domain))
      for (std::size_t d = 0; d < box->dimension(); ++d)
        if (!box->periodic[d])
          gap = std::min({gap, x[i][d] - box->from[d] - scene.radii[i],
                          box->to[d] - x[i][d] - scene.radii[i]});
  }
  return gap;
}

/// Expects that random particles get their gaps. 1e-12 radii exceed the rounding errors of places
/// in boxes of 20 radii.
void expect_gaps(const Scene& scene) {
  const auto places = places_of(scene);
  auto placed = random_particles(scene, places);
  ASSERT_LT(smallest_gap(scene, placed.centres()), 0);
  EXPECT_TRUE(relax(placed, kManySteps).is_free);
  EXPECT_GE(smallest_gap(scene, placed.centres()), scene.gap - 1e-12 * scene.radii.back());
}

TEST(Relaxation, OfSpheresOfTwoSizesReaches062InUnitsOverDecades) {
  for (const double unit : {1e-90, 1e-6, 1.0, 1e90}) {
    const auto radii = two_sizes(107, 293, unit);  // half of the volume each
    expect_gaps({box_of(radii, 3, 0.62, unit), radii});
  }
}

TEST(Relaxation, OfEqualSpheresReaches062) {
  const std::vector<double> radii(400, 1.0);
  expect_gaps({box_of(radii, 3, 0.62, 1), radii});
}

TEST(Relaxation, OfDiscsOfTwoSizesReaches082) {
  const auto radii = two_sizes(135, 265, 1);
  expect_gaps({box_of(radii, 2, 0.82, 1), radii});
}

TEST(Relaxation, KeepsGapsToWallsPlanesAndFixedParticles) {
  const std::vector<double> radii(150, 1.0);
  auto box = box_of(radii, 2, 0.7, 1);
  box.periodic[1] = false;
  expect_gaps({box, radii, 0.02});
  expect_gaps({DiscDomain{{3, -1}, std::sqrt(150 / 0.75)}, radii, 0.02});
  const double above = box.from[1] + 2;
  expect_gaps({box, radii, 0.01, {{{0, above}, {0, 1}}, {{box.from[0], box.to[1] - 1}, {0, -1}}}});
  expect_gaps({box, radii, 0.01, {}, {{{7, 7}, 2.0}, {{12, 7}, 0.5}}});
  const std::vector<double> spheres(200, 1.0);
  auto cube = box_of(spheres, 3, 0.5, 1);
  cube.periodic = {true, false, false};
  expect_gaps({cube, spheres, 0.01});
}

TEST(Relaxation, OfVeryDifferentSizesIsFreeOfOverlaps) {
  std::vector<double> radii = {5, 5, 4, 3, 3, 3};
  radii.resize(400, 1.0);
  expect_gaps({box_of(radii, 3, 0.6, 1), radii});
}

TEST(Relaxation, StopsWhenParticlesAreJammed) {
  const auto radii = two_sizes(54, 146, 1);
  const Scene scene{box_of(radii, 3, 0.68, 1), radii};
  const auto places = places_of(scene);
  auto placed = random_particles(scene, places);
  const auto result = relax(placed, kManySteps);
  EXPECT_FALSE(result.is_free);
  EXPECT_LT(result.steps, kManySteps);
  // Random packings of spheres take 0.64 to 0.65: diameters would have to be smaller by the cube
  // root of 0.65/0.68, 1.5 %, and the mean overlap is of this size.
  EXPECT_GT(result.overlap, 0.005);
  EXPECT_LT(result.overlap, 0.03);
}

}  // namespace
}  // namespace viscontact::particles
