// Many discs that settle in a fluid: the solver of the projection finds their impulses by products
// with the mobility of the fluid.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/immersed/contacts/fluid_contacts.hpp"
#include "viscontact/particles/contact/contact.hpp"

namespace viscontact::particles {
namespace {

/// Drag of each disc, and of the films between close discs, which resist to their squeezing.
Eigen::MatrixXd drag_of_packing(const Particles& p) {
  const auto size = static_cast<Eigen::Index>(3 * p.count());
  Eigen::MatrixXd drag = 12.0 * Eigen::MatrixXd::Identity(size, size);
  for (std::int32_t i = 0; index_of(i) < p.count(); ++i)
    for (std::int32_t j = i + 1; index_of(j) < p.count(); ++j) {
      const auto contact = contact_of<2>(p, Pair{i, j}, std::span<const PlanePosition>());
      if (contact.gap > 1) continue;
      // Jeffrey & Onishi 1981 give a film between cylinders the resistance ~ gap^(-3/2).
      const double film = 5 * std::pow(std::max(contact.gap, 0.02), -1.5);
      for (Eigen::Index a = 0; a < 2; ++a)
        for (Eigen::Index b = 0; b < 2; ++b) {
          const double entry = film * contact.normal[static_cast<std::size_t>(a)] *
                               contact.normal[static_cast<std::size_t>(b)];
          drag(3 * i + a, 3 * i + b) += entry;
          drag(3 * j + a, 3 * j + b) += entry;
          drag(3 * i + a, 3 * j + b) -= entry;
          drag(3 * j + a, 3 * i + b) -= entry;
        }
    }
  return drag;
}

/// Discs on a lattice that is disturbed, in a box, each with the weight 5.
InFluid discs_in_box(int rows, int columns, double mass) {
  auto system = in_fluid(2, 2.2 * columns, 0.02, 0.05);
  Random random(17);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      add_pushed(system,
                 {2.2 * (column + 0.5) + random.uniform(-0.04, 0.04),
                  1.1 + 2.2 * row + random.uniform(-0.04, 0.04), 0},
                 random.uniform(0.85, 1), mass, {0, -5, 0});
  return system;
}

TEST(PackedDiscs, SettleAndTheFloorCarriesTheirWeight) {
  for (const double mass : {0.0, 1.0}) {
    auto system = discs_in_box(8, 8, mass);
    auto simulation = system.simulation(drag_of_packing);
    std::size_t contacts = 0;
    for (int step = 0; step < 300; ++step) {
      const auto report = simulation.step(1e9);
      EXPECT_TRUE(report.converged) << step << " " << report.impulse_residual;
      EXPECT_LT(report.residual, 1e-6);
      contacts = std::max(contacts, report.contacts);
    }
    EXPECT_GT(contacts, kMostDenseContacts);
    if (mass > 0) continue;
    // The floor carries their weight, and only drag can carry a part of it.
    double solid_load = 0, drag = 0;
    for (const auto& wall : simulation.state().walls)
      if (wall.first == -3) solid_load += wall.impulse / 0.02;
    for (std::size_t k = 0; k < 64; ++k) drag += simulation.fluid_forces()[3 * k + 1];
    EXPECT_NEAR(solid_load + drag, 64 * 5, 1e-6 * 64 * 5);
  }
}

}  // namespace
}  // namespace viscontact::particles
