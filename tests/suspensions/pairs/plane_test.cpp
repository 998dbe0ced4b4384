// Spheres beside planes, at one instant: exact velocities, and limits.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/common/failure.hpp"
#include "tests/suspensions/spheres.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/lubrication/pairs/pair_resistance.hpp"
#include "viscontact/suspensions/pairs/pair_terms.hpp"

namespace viscontact::particles {
namespace {

using lubrication::kPairComponents;

/// Spheres beside a plane with this unit normal through the origin; the fluid is at rest.
Setting beside_plane(const Vector& normal, PairTerms pairs) {
  Setting setting;
  setting.planes.emplace_back().start = {{}, normal};
  PairLubrication lubrication;
  lubrication.viscosity = 1;
  lubrication.pairs = pairs;
  lubrication.range = 10;
  setting.lubrication = lubrication;
  return setting;
}

/// A unit vector and two others across it.
struct Axes {
  Vector n, s, t;
};
const std::vector<Axes> kAxesOfPlanes{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
                                      {{0.6, 0, 0.8}, {0.8, 0, -0.6}, {0, 1, 0}}};

struct ExactModes {
  double gap, squeeze, slide_force, slide_torque, roll_force, roll_torque, spin;
};
// data/reference/sphere_plane.csv and sphere_plane_modes.csv.
const std::vector<ExactModes> kExact{
    {0.01, 101.8961723746134888708, 3.422532966365639731984, 0.2765174026634164636995,
     0.368689870217888618266, 2.24079764936849426827, 1.183243899689389434787},
    {0.1, 11.45915720340955722964, 2.26430303538802853408, 0.08876334417411304706635,
     0.1183511255654840627551, 1.45485121001698263527, 1.11706475294528522769}};

TEST(SphereBesideAPlane, MovesAsInTheExactModes) {
  // Of two radii and viscosities, beside planes in two directions, by a force and a torque.
  for (const auto& exact : kExact)
    for (const auto& [n, s, t] : kAxesOfPlanes)
      for (const double radius : {1.0, 3.0}) {
        const double mu = 1 / radius;
        auto setting = beside_plane(n, PairTerms::kTables);
        setting.lubrication->viscosity = mu;
        const Vector force = -2.0 * n + 3.0 * s, torque = radius * (5.0 * t + 4.0 * n);
        setting.added_forces.assign(force.begin(), force.end());
        setting.added_torques.assign(torque.begin(), torque.end());
        SuspensionSimulation simulation(setting,
                                        spheres_at({(radius * (1 + exact.gap)) * n}, {radius}), 1);
        simulation.solve_instant();
        const auto& p = simulation.state().particles;
        const Vector v = p.velocity(0), w = point_of(p.angular_velocities.data(), 0, 3);
        const double unit = M_PI * mu * radius;
        // t = n x s, so that with z = n and x = s the axis y is t.
        const double a = 6 * unit * exact.slide_force, b = -6 * unit * radius * exact.roll_force;
        const double c = -8 * unit * radius * exact.slide_torque,
                     d = 8 * unit * radius * radius * exact.roll_torque;
        const double slide = dot(force, s), roll = dot(torque, t), determinant = a * d - b * c;
        // The tables of planes have errors of 4e-6.
        const double bar = 2e-5;
        EXPECT_NEAR(dot(v, n), -2 / (6 * unit * exact.squeeze), bar * 2 / (6 * unit));
        EXPECT_NEAR(dot(v, s), (d * slide - b * roll) / determinant, bar / unit);
        EXPECT_NEAR(radius * dot(w, t), radius * (a * roll - c * slide) / determinant, bar / unit);
        EXPECT_NEAR(dot(w, n), 4 * radius / (8 * unit * radius * radius * exact.spin), bar / unit);
        EXPECT_NEAR(dot(v, t), 0, 1e-10);
        EXPECT_NEAR(dot(w, s), 0, 1e-10);
      }
}

TEST(SphereBesideAPlane, MovesInAShearAsGoldmanCoxAndBrenner) {
  // Their second paper (1967), Table 2: the velocity of a free sphere over that of the flow at its
  // centre. h is the distance of the centre over the radius.
  struct Row {
    double h, velocity;
  };
  for (const auto& [h, velocity] : {Row{std::cosh(1.0), 0.92185}, Row{std::cosh(0.5), 0.76692},
                                    Row{std::cosh(0.3), 0.65375}, Row{std::cosh(0.1), 0.47861}})
    for (const auto& [n, s, t] : kAxesOfPlanes) {
      auto setting = beside_plane(n, PairTerms::kTables);
      const double rate = 2;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          setting.lubrication->gradient[i][j] = rate * s[i] * n[j];
      SuspensionSimulation simulation(setting, spheres_at({h * n}, {1}), 1);
      simulation.solve_instant();
      const auto& p = simulation.state().particles;
      // Their table has errors of up to 1.5e-4, as that of the force by a slide (data/reference).
      EXPECT_NEAR(dot(p.velocity(0), s) / (rate * h), velocity, 2e-4) << h;
      EXPECT_NEAR(dot(p.velocity(0), n), 0, 1e-10);
    }
}

TEST(SphereBesideAPlane, HasTheStressOfTheExactMatrix) {
  // The stresslet of a free sphere in a shear, with the dissipation as its power.
  for (const double gap : {1e-3, 0.2, 3.0})
    for (const double radius : {1.0, 0.5}) {
      auto setting = beside_plane({0, 1, 0}, PairTerms::kTables);
      setting.domain = BoxDomain{{0, 0, 0}, {50, 50, 50}, {true, false, true}};
      setting.planes.clear();
      auto& of = *setting.lubrication;
      of.gradient[0][1] = 2;
      const double height = (1 + gap) * radius;
      SuspensionSimulation simulation(setting, spheres_at({{0, height, 0}}, {radius}), 1);
      const auto rheology = simulation.solve_instant();
      // z is from the sphere to the plane, so that with x along the flow E_xz = -1 and the angular
      // velocity of the flow about y is 1 less than that.
      const auto k = lubrication::pair_resistance(radius, std::numeric_limits<double>::infinity(),
                                                  gap * radius, 1);
      const auto at = [&](std::size_t i, std::size_t j) { return k[i * kPairComponents + j]; };
      const double e = -std::sqrt(2.0);
      const double a = at(0, 0), b = at(0, 4), d = at(4, 4), f = -at(0, 7) * e, t = -at(4, 7) * e;
      const double v = (d * f - b * t) / (a * d - b * b), w = (a * t - b * f) / (a * d - b * b);
      const double power = e * (at(7, 0) * v + at(7, 4) * w + at(7, 7) * e);
      EXPECT_NEAR((rheology.viscosity - 1) * 4 * 50 * 50 * 50, power, 1e-9 * power);
      EXPECT_NEAR(simulation.state().particles.velocity(0)[0] - 2 * height, v, 1e-9);
      EXPECT_NEAR(simulation.state().particles.angular_velocities[2] + 1, w, 1e-9);
    }
}

TEST(SphereBesideAPlane, IsTheLimitOfALargeSphere) {
  for (const double gap : {1e-3, 0.1}) {
    // The large sphere stays where it is, but for a millionth of the velocities.
    const double large = 1e6;
    const auto motion_of = [&](bool has_plane) {
      auto setting = beside_plane({0, 0, 1}, PairTerms::kTables);
      auto places = std::vector<Vector>{{0, 0, 1 + gap}, {0, 0, -large}};
      auto radii = std::vector<double>{1, large};
      if (has_plane) {
        places.pop_back();
        radii.pop_back();
      } else {
        setting.planes.clear();
      }
      setting.added_forces.assign(3 * radii.size(), 0);
      setting.added_torques = setting.added_forces;
      setting.added_forces[0] = 1;
      setting.added_forces[2] = 2;
      setting.added_torques[1] = 3;
      SuspensionSimulation simulation(setting, spheres_at(places, radii), 1);
      simulation.solve_instant();
      const auto& p = simulation.state().particles;
      return std::array{p.velocity(0)[0], p.velocity(0)[2], p.angular_velocities[1]};
    };
    const auto plane = motion_of(true), sphere = motion_of(false);
    // Entries of such pairs have errors of 5e-4, and the motion of the large sphere is 1e-3 of the
    // slowest velocity.
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(plane[i], sphere[i], 1.5e-3 * plane[i]);
  }
}

TEST(SphereBesideAPlane, HasTheTermsNearContactOfTheExactOnes) {
  // Both differ by what stays bounded, so that their slopes in the logarithm of the gap are equal
  // but for terms of the gap.
  const auto table = [](double gap) {
    return suspensions::table_plane_terms(1, 2, gap, 0, nullptr);
  };
  const auto leading = [](double gap) {
    return suspensions::near_contact_plane_terms(1, 2, gap, 0);
  };
  const auto slopes = [](const auto& terms) {
    const auto at = [&](double q) {
      const auto of = terms(2 * q);
      return std::array{of.turn_first,        of.turn_mixed,         of.turn_second,
                        of.strain_turn_first, of.strain_turn_second, of.stress_transverse};
    };
    auto slope = at(1e-6);
    const auto other = at(1e-5);
    for (std::size_t i = 0; i < slope.size(); ++i) slope[i] -= other[i];
    return slope;
  };
  const auto exact = slopes(table);
  const auto near = slopes(leading);
  for (std::size_t i = 0; i < exact.size(); ++i)
    EXPECT_NEAR(near[i], exact[i], 1e-3 * std::abs(exact[0]));
  const auto exact_film = table(2e-6), film = leading(2e-6);
  // The next term is the gap times its logarithm, 1.4e-5.
  EXPECT_NEAR(film.squeeze, exact_film.squeeze, 1e-4 * film.squeeze);
  EXPECT_NEAR(film.strain_squeeze, exact_film.strain_squeeze, 1e-4 * film.strain_squeeze);
  EXPECT_NEAR(film.stress_axial, exact_film.stress_axial, 1e-4 * film.stress_axial);
}

TEST(SphereBesideAPlane, RefusesFlowsThatDoNotStickToThePlane) {
  const auto refused = [](Setting setting) {
    const auto state = spheres_at({{1, 2, 3}}, {1});
    EXPECT_THROW(SuspensionSimulation(setting, state, 1).solve_instant(), Error);
  };
  auto setting = beside_plane({0, 0, 1}, PairTerms::kTables);
  EXPECT_NO_THROW(SuspensionSimulation(setting, spheres_at({{1, 2, 3}}, {1}), 1).solve_instant());
  auto strained = setting;  // goes through the plane
  strained.lubrication->gradient[2][2] = 1;
  strained.lubrication->gradient[0][0] = -1;
  refused(strained);
  auto along = setting;  // changes along the plane
  along.lubrication->gradient[0][1] = 1;
  refused(along);
  auto moving = setting;  // the fluid is at rest
  moving.planes[0].velocity.pieces = {{1e10, {1, 0, 0}}};
  refused(moving);
  auto other = moving;  // the plane z = 1 in the shear u_x = z moves with velocity 1, not with 1.01
  other.planes[0].start.point = {7, 8, 1};
  other.lubrication->gradient[0][2] = 1;
  EXPECT_NO_THROW(SuspensionSimulation(other, spheres_at({{1, 2, 3}}, {1}), 1).solve_instant());
  other.lubrication->gradient[0][2] = 1.01;
  refused(other);
  auto turning = setting;
  turning.planes[0].angular_velocity = {0, 0, 1};
  refused(turning);
  auto loaded = setting;
  loaded.planes[0].load = PlaneLoad{{}, 1};
  refused(loaded);
  auto rising = setting;
  rising.planes[0].velocity.pieces = {{1e10, {0, 0, 1}}};
  refused(rising);
}

}  // namespace
}  // namespace viscontact::particles
