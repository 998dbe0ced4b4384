// Packings to the accuracy "packing": what it promises, and what must hold at any accuracy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/particles/systems.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

struct Pile {
  double mu_s = 0.5, gamma_min = 0;
  FrictionMethod method = FrictionMethod::kConvex;
  double smallest = 0.7;  // radius; the largest is 1
};

Setting setting_of(const Pile& pile, int dimension) {
  Setting setting;
  setting.time_step = 0.05;
  setting.laws.film.gamma_min = pile.gamma_min;
  setting.laws.friction = FrictionLaw{pile.mu_s, pile.method};
  setting.solver = SolverSettings::for_packings();
  const auto down = static_cast<std::size_t>(dimension - 1);
  Vector normal{};
  normal[down] = 1;
  setting.gravity = -1 * normal;
  setting.planes = {plane_at_rest({}, normal)};
  for (std::size_t d = 0; d < down; ++d) {
    Vector side{};
    side[d] = 1;
    setting.planes.push_back(plane_at_rest({}, side));
    setting.planes.push_back(plane_at_rest(6 * side, -1 * side));
  }
  return setting;
}

/// Sixty particles on a lattice over the floor of a box of width 6, with random displacements.
State poured(const Pile& pile, int dimension) {
  Random random(11);
  State state = no_particles(dimension);
  const int columns = 3, layer = dimension == 2 ? columns : columns * columns;
  for (int k = 0; k < 60; ++k) {
    const auto jitter = [&] { return random.uniform(-0.05, 0.05); };
    const double radius = 0.9 * std::exp(random.uniform(std::log(pile.smallest), 0));
    Vector place{1 + 2.0 * (k % columns) + jitter()};
    if (dimension == 3) place[1] = 1 + 2.0 * (k % layer / columns) + jitter();
    place[static_cast<std::size_t>(dimension - 1)] = 1 + 2.0 * (k / layer) + jitter();
    add_particle(state, place, radius, std::pow(radius, dimension));
  }
  add_rotation(state.particles);
  return state;
}

/// The impulses of all contacts on each particle in the last step.
std::vector<Vector> impulses_on(const Setting& setting, const State& state) {
  std::vector<Vector> sums(state.particles.count());
  for (const auto& contact : contacts_of(setting, state)) {
    const Vector impulse =
        setting.time_step * (contact.normal_force * contact.normal + contact.tangential_force);
    if (contact.first >= 0) sums[index_of(contact.first)] = sums[index_of(contact.first)] - impulse;
    sums[index_of(contact.second)] = sums[index_of(contact.second)] + impulse;
  }
  return sums;
}

double energy_of(const Setting& setting, const Particles& p) {
  double energy = 0;
  for (std::size_t k = 0; k < p.count(); ++k) {
    energy +=
        p.masses[k] * (dot(p.velocity(k), p.velocity(k)) / 2 - dot(setting.gravity, p.position(k)));
    const std::size_t turns = turn_components(p.dimension);
    for (std::size_t i = 0; i < turns; ++i)
      energy += p.inertias[k] * p.angular_velocities[k * turns + i] *
                p.angular_velocities[k * turns + i] / 2;
  }
  return energy;
}

class Packing : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, Packing, ::testing::Values(2, 3));

TEST_P(Packing, KeepsItsPromisesInEveryStep) {
  std::vector<Pile> piles;
  for (const auto method : {FrictionMethod::kConvex, FrictionMethod::kCoulomb})
    for (const double mu_s : {0.0, 0.3, 1.0})
      for (const double gamma_min : {0.0, -0.1}) piles.push_back({mu_s, gamma_min, method});
  piles.push_back({0.5, 0, FrictionMethod::kConvex, 0.1});
  for (const auto& pile : piles) {
    SCOPED_TRACE(::testing::Message() << "mu_s " << pile.mu_s << ", gamma_min " << pile.gamma_min
                                      << ", smallest radius " << pile.smallest);
    const auto setting = setting_of(pile, GetParam());
    Simulation simulation(setting, poured(pile, GetParam()), 1);
    const auto& state = simulation.state();
    std::size_t most = 0;
    for (int n = 0; n < 300; ++n) {
      const auto before = state.particles;
      const auto report = simulation.step(100);
      most = std::max(most, report.contacts);
      EXPECT_TRUE(report.converged) << report.time;
      EXPECT_LE(report.largest_overlap, setting.solver.tolerance) << report.time;
      // Particles at rest may be out of balance by a thousandth of the mean load, below 10.
      const double error = 1e-3 * setting.time_step * 10;
      const auto& now = state.particles;
      const auto impulses = impulses_on(setting, state);
      const double rounding = 1e-12;
      for (std::size_t k = 0; k < now.count() && report.parts == 1; ++k) {
        const Vector given = now.masses[k] * (now.velocity(k) - before.velocity(k) -
                                              setting.time_step * setting.gravity);
        const bool rests = norm(now.velocity(k)) == 0;
        EXPECT_LE(norm(given - impulses[k]), rests ? error : rounding) << report.time << ", " << k;
      }
      EXPECT_LE(energy_of(setting, now), energy_of(setting, before) * (1 + 1e-12)) << report.time;
    }
    EXPECT_GT(most, 60U);
  }
}

}  // namespace
}  // namespace viscontact::particles
