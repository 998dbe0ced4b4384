// One sphere and a plane are the reduced model's viscous contact.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/particles/systems.hpp"
#include "viscontact/reduced_model/models/contact/contact_model.hpp"

namespace viscontact::particles {
namespace {

struct Case {
  double mass, radius, gap, velocity, gamma_min, step, end;
  std::vector<reduced_model::ExternalForce::Piece> pieces;
};

Case random_case(Random& random) {
  Case c;
  c.mass = random.decades(-2, 2);
  c.radius = random.decades(-1, 1);
  c.gap = random.decades(-2, 0);
  c.velocity = random.uniform(-1, 1);
  c.step = random.chance(0.3) ? 0.01 : random.decades(-3, -1);
  c.end = random.uniform(3, 5);
  double until = 0;
  while (until < c.end)
    c.pieces.push_back({until += random.uniform(0.1, 1.5), c.mass * random.uniform(-3, 2)});
  c.gamma_min = random.chance(0.3)   ? 0
                : random.chance(0.5) ? -c.mass * random.uniform(0.1, 2)
                                     : -std::numeric_limits<double>::infinity();
  return c;
}

reduced_model::Trajectory by_reduced_model(const Case& c) {
  reduced_model::Motion motion{c.mass, c.gap, c.velocity, c.end,
                               reduced_model::ExternalForce(c.pieces)};
  motion.set(reduced_model::kContactTimeStep, c.step);
  // The model viscous_contact without the fit: contact at q = 0, gamma_min, no drag.
  return reduced_model::run_contact_model(motion, {.contact_gap = 0, .gamma_min = c.gamma_min});
}

/// The plane anywhere, at any slope; half of the force is weight.
struct Scene {
  Setting setting;
  State state;
};
Scene scene_of(const Case& c, int dimension, Random& random) {
  Scene scene{{}, no_particles(dimension)};
  auto& s = scene.setting;
  const Vector normal = random.direction(dimension);
  const Vector point = random.uniform(-1, 1) * random.direction(dimension);
  const double weight = c.mass * random.uniform(-1, 1);
  s.planes = {plane_at_rest(point, normal)};
  s.gravity = weight / c.mass * normal;
  for (const auto& piece : c.pieces)
    s.forces[0].pieces.push_back({piece.until, (piece.value - weight) * normal});
  if (std::isfinite(c.gamma_min)) s.laws.film.gamma_min = c.gamma_min;
  s.time_step = c.step;
  // As far as the gap's rounding, of coordinates of up to 12, allows.
  s.solver.tolerance = 1e-14 / c.radius;
  add_particle(scene.state, point + (c.radius + c.gap) * normal, c.radius, c.mass,
               c.velocity * normal);
  return scene;
}

/// `tolerance` of the gap, `of_velocity` of velocity and gamma/m.
void expect_same_motion(const Case& c, const Scene& scene, double tolerance, double of_velocity) {
  const auto reduced = by_reduced_model(c);
  Simulation simulation(scene.setting, scene.state, 1);
  std::size_t row = 0;
  run(simulation, c.end, [&](const StepReport&) {
    ++row;
    ASSERT_LT(row, reduced.rows.size());
    const auto& expected = reduced.rows[row];
    const auto& p = simulation.state().particles;
    const auto& normal = scene.setting.planes[0].start.normal;
    const double q = gap(scene.setting.planes[0].start, p.position(0), c.radius);
    ASSERT_NEAR(simulation.state().time, expected.time, 1e-6 * c.step);
    EXPECT_NEAR(q, expected.gap, tolerance * std::max(1.0, expected.gap)) << expected.time;
    EXPECT_NEAR(dot(p.velocity(0), normal), expected.velocity, of_velocity) << expected.time;
    EXPECT_NEAR(pair_of(simulation.state(), -1, 0).gamma / c.mass, *expected.gamma / c.mass,
                of_velocity)
        << expected.time;
  });
  EXPECT_EQ(row + 1, reduced.rows.size());
}

TEST(OneSphere, MovesAsTheReducedModelSays) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    auto c = random_case(random);
    c.radius = 1;
    c.step = random.uniform(0.05, 0.1);
    SCOPED_TRACE(::testing::Message()
                 << i << ": h = " << c.step << ", gamma_min = " << c.gamma_min);
    for (const int dimension : {2, 3})
      expect_same_motion(c, scene_of(c, dimension, random), 1e-12, 1e-12);
    if (HasFailure()) return;
  }
}

TEST(OneSphere, MovesAsTheReducedModelSaysWhateverTheStepAndTheRadius) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const auto c = random_case(random);
    SCOPED_TRACE(::testing::Message() << i << ": h = " << c.step << ", gamma_min = " << c.gamma_min
                                      << ", m = " << c.mass << ", r = " << c.radius);
    // In contact the gap is 0 to the solver's 1e-14, and the velocity to that over h; one that
    // leaves takes that along, 1e-11 of a gap in the end, and the step of its next impact has the
    // velocity -gap/h.
    const double of_gap = 1e-13 / c.step + 1e-12, of_velocity = of_gap / c.step;
    for (const int dimension : {2, 3})
      expect_same_motion(c, scene_of(c, dimension, random), of_gap, of_velocity);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace viscontact::particles
