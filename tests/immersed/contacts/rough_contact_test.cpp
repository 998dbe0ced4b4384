// gamma_min of rough particles in a fluid, docs/physics.md (6.8): the film that gamma stands for
// begins at the threshold gap D_c and ends where the solids touch, at 2 s.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/lubrication/pairs/squeeze_film.hpp"
#include "viscontact/lubrication/plane_drag.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact_threshold.hpp"

namespace viscontact::particles {
namespace {

constexpr double kPi = std::numbers::pi;

/// When a pair was glued, and its lowest gamma.
struct Contact {
  double from = -1, to = -1, lowest_gamma = 0;
  void see(double time, double gamma) {
    if (!(gamma < 0)) return;
    if (from < 0) from = time;
    to = time;
    lowest_gamma = std::min(lowest_gamma, gamma);
  }
};

TEST(RoughContactInFluid, OfASphereIsThatOfTheThresholdModel) {
  // Both have R = k (1/q - ln(q)/5 + 0.97128) above D_c, which is that of a plane but for terms like
  // q ln q.
  const double mass = 20, viscosity = 3, k = 6 * kPi * viscosity, threshold = 0.1;
  constexpr double kConstant = 0.9712799310357215;
  const Resistance drag = [k](const Particles& p) -> Eigen::MatrixXd {
    const double q = p.positions[0] - 1;
    return Eigen::MatrixXd::Constant(1, 1, k * (1 / q - std::log(q) / 5 + kConstant));
  };
  lubrication::Fit fit;
  fit.basis = lubrication::kOwnTerms;
  fit.reference_velocity = -1;
  fit.viscosity = viscosity;
  fit.radius = 1;
  fit.gap_interval = {1e-200, 50};
  fit.terms = {{"1/q", k, 0}, {"ln q", -k / 5, 0}, {"1", k * kConstant, 0}};
  const lubrication::LubricationForce force(fit);
  for (const double h : {0.02, 0.01}) {
    reduced_model::Motion motion{mass, 1, 0, 4,
                                 reduced_model::ExternalForce({{2, -200}, {4, 200}})};
    motion.roughness = {0.005, 0.005};
    motion.set(reduced_model::kContactTimeStep, h);
    motion.set(reduced_model::kThresholdGap, threshold);
    const auto reduced = reduced_model::run_contact_model(
        motion, reduced_model::viscous_contact_threshold(motion, force));

    auto system = in_fluid(1, 10, h, threshold);
    add_particle(system.state, {2, 0, 0}, 1, mass);
    system.setting.forces[0] = {{{2, {-200, 0, 0}}, {4, {200, 0, 0}}}};
    system.setting.laws.film.viscosity = viscosity;
    system.setting.laws.film.roughness = 0.005;
    auto simulation = system.simulation(drag);
    Contact direct, expected;
    for (std::size_t row = 1; row < reduced.rows.size(); ++row) {
      simulation.step(4);
      direct.see(simulation.state().time, pair_of(simulation.state(), -2, 0).gamma);
      expected.see(reduced.rows[row].time, *reduced.rows[row].gamma);
    }
    // The solids touch at the film 2 s. From 0.01 to 0.1 the terms like q ln q add up to 1.2e-3.
    const double exact =
        lubrication::plane_drag_integral(0.01) - lubrication::plane_drag_integral(0.1);
    EXPECT_NEAR(direct.lowest_gamma, k * exact, 1e-10 * k);
    EXPECT_NEAR(direct.lowest_gamma, expected.lowest_gamma, 2e-3 * k);
    // A landing is of first order in the step, and each may be a row earlier or later.
    EXPECT_NEAR(direct.from, expected.from, 3 * h);
    EXPECT_NEAR(direct.to, expected.to, 3 * h);
  }
}

TEST(RoughContactInFluid, GammaMinIsWhereTheFilmIsTwiceTheRoughness) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const double mu = random.decades(-5, 5), r = random.decades(-5, 5);
    constexpr double kPlane = std::numeric_limits<double>::infinity();
    FilmLaw law;
    law.viscosity = mu;
    law.roughness = r * random.decades(-6, -2);
    for (const auto shape : {FilmShape::kSpheres, FilmShape::kDiscs}) {
      law.shape = shape;
      law.begins_at = 2 * *law.roughness * random.decades(0.1, 3);
      const double gamma = law.lowest_gamma(r, kPlane);
      const double gap = lubrication::gap_of_squeeze(squeeze_integral(shape), r, kPlane,
                                                     *law.begins_at, -gamma / mu);
      EXPECT_NEAR(gap / (2 * *law.roughness), 1, 1e-12);
      law.begins_at = 2 * *law.roughness;
      EXPECT_EQ(law.lowest_gamma(r, kPlane), 0);
      law.begins_at = *law.roughness;
      EXPECT_EQ(law.lowest_gamma(r, kPlane), 0);
    }
  }
}

/// gamma after discs were pushed to the floor, to each other and to a round wall, over the unit of
/// gamma. The units of length, mass per length and time are arguments.
std::array<double, 3> gammas(double length, double mass, double time) {
  const double viscosity = mass / time, weight = mass * length / (time * time);
  const auto at = [&](double x, double y) { return Vector{x * length, y * length, 0}; };
  const auto force = [&](double x, double y) { return Vector{x * weight, y * weight, 0}; };
  const auto rough = [&](Domain domain) {
    auto system = in_fluid(2, 8 * length, 0.01 * time, 0.05 * length);
    system.setting.domain = std::move(domain);
    system.setting.fluid->viscosity = 0.5 * viscosity;
    system.setting.laws.film.viscosity = 0.5 * viscosity;
    system.setting.laws.film.roughness = 0.005 * length;
    return system;
  };
  auto box = rough(BoxDomain{{0, 0}, {8 * length, 8 * length}});
  add_pushed(box, at(1, 1.06), length, mass, force(0, -300));
  add_pushed(box, at(4, 4), length, mass, force(300, 0));
  add_pushed(box, at(5.56, 4), 0.5 * length, mass, force(-300, 0));
  auto round = rough(DiscDomain{{}, 3 * length});
  add_pushed(round, at(0, -1.94), length, mass, force(0, -300));
  auto in_box = box.simulation(constant_drag(10 * viscosity));
  auto in_circle = round.simulation(constant_drag(10 * viscosity));
  run(in_box, 2 * time);
  run(in_circle, 2 * time);
  const double unit = mass * length / time;
  return {pair_of(in_box.state(), -3, 0).gamma / unit, pair_of(in_box.state(), 1, 2).gamma / unit,
          pair_of(in_circle.state(), -1, 0).gamma / unit};
}

TEST(RoughContactInFluid, OfDiscsHasTheirFilmInAnyUnits) {
  // At a floor, of discs of radii 1 and 0.5, and of a disc of radius 1 inside a circle of radius 3.
  const auto expected = [&](double neighbour) {
    return -0.5 * lubrication::disc_squeeze_integral(1, neighbour, 0.01, 0.05);
  };
  const auto expect_films = [&](const std::array<double, 3>& found) {
    EXPECT_NEAR(found[0] / expected(std::numeric_limits<double>::infinity()), 1, 1e-9);
    EXPECT_NEAR(found[1] / expected(0.5), 1, 1e-9);
    EXPECT_NEAR(found[2] / expected(-3), 1, 1e-9);
  };
  expect_films(gammas(1, 1, 1));
  Random random(6);
  for (int i = 0; i < 5; ++i)
    expect_films(gammas(random.decades(-5, 5), random.decades(-5, 5), random.decades(-5, 5)));
}

}  // namespace
}  // namespace viscontact::particles
