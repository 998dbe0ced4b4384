// The bound of friction by the load of the solids.
#include "viscontact/contact_solver/problem/contact_conditions.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

namespace viscontact::contact_solver {
namespace {

TEST(LoadOfSolids, IsWhatTheFilmDoesNotTake) {
  EXPECT_EQ(load_of_solids(3, 2), 1);
  EXPECT_EQ(load_of_solids(2, 3), 0);
  EXPECT_EQ(load_of_solids(-1, 0), 0);
  EXPECT_EQ(load_of_solids(5, std::numeric_limits<double>::infinity()), 0);
}

TEST(FrictionCone, HasTheNearestPoint) {
  // Compared with a search over the cone, in the norm w_n p_s^2 + w_t |p_t|^2.
  const double mu = 0.6;
  for (const auto& [w_n, w_t] : {std::pair(1.0, 1.0), std::pair(2.0, 0.3), std::pair(0.1, 4.0)})
    for (const double p_s : {-2.0, -0.5, 0.0, 1.0, 3.0})
      for (const double p_t : {0.0, 0.2, 1.0, 4.0}) {
        const auto cone = FrictionCone::nearest(mu, p_s, p_t, w_n, w_t);
        const auto distance = [&](double load, double tangential) {
          return w_n * (load - p_s) * (load - p_s) + w_t * (tangential - p_t) * (tangential - p_t);
        };
        const double found = distance(cone.load, cone.tangential * p_t);
        EXPECT_LE(cone.tangential * p_t, mu * cone.load * (1 + 1e-15));
        EXPECT_EQ(cone.part, cone.load == 0 && (p_t > 0 || p_s < 0) ? FrictionCone::Part::kApex
                             : cone.tangential == 1                 ? FrictionCone::Part::kInside
                                                                    : FrictionCone::Part::kSurface);
        for (int i = 0; i <= 500; ++i)
          for (int k = 0; k <= 20; ++k) {
            const double load = 0.01 * i;
            EXPECT_LE(found, distance(load, mu * load * k / 20) * (1 + 1e-12) + 1e-12);
          }
      }
}

}  // namespace
}  // namespace viscontact::contact_solver
