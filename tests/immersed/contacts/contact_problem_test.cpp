// The contact problem of a step in a fluid says whether it is solved.
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "viscontact/immersed/contacts/fluid_contacts.hpp"

namespace viscontact::particles {
namespace {

/// A row of discs of radius 1 that touch and move towards its middle, each with the drag 1.
struct Row {
  explicit Row(std::size_t count) : free(2 * count) {
    for (std::size_t k = 0; k < count; ++k)
      free[2 * k] = static_cast<double>(count) / 2 - static_cast<double>(k);
  }
  /// With `skew` each force also moves the disc in front of it, and those behind it backwards.
  bool solve(int max_iterations, double skew = 0) {
    SolverSettings settings;
    settings.max_iterations = max_iterations;
    const Mobility mobility = [skew](std::span<const double> forces) {
      std::vector<double> v(forces.begin(), forces.end());
      for (std::size_t i = 2; i < v.size(); ++i) {
        v[i] += skew * forces[i - 2];
        v[i - 2] -= skew * forces[i];
      }
      return v;
    };
    ContactConditions conditions{free, 0.1, {2}, settings, 1, 0};
    conditions.is_symmetric = skew == 0;
    ContactProblem problem(conditions, mobility);
    for (std::size_t k = 0; k + 1 < free.size() / 2; ++k) {
      Contact<2> contact;
      contact.first = static_cast<std::int32_t>(k);
      contact.second = contact.first + 1;
      contact.normal = {1, 0};
      problem.add(contact);
    }
    const bool is_solved = problem.solve(false);
    for (const auto& contact : problem.contacts()) impulses.push_back(contact.impulse);
    velocities = problem.velocities();
    return is_solved;
  }
  std::vector<double> free, impulses, velocities;
};

TEST(ContactProblem, SaysWhetherItIsSolved) {
  // 60 contacts are more than the 24 of the dense matrix. The ends of the row know of each other
  // after as many products as there are contacts, so that 8 cannot do.
  EXPECT_TRUE(Row(61).solve(10000));
  EXPECT_FALSE(Row(61).solve(8));
  EXPECT_TRUE(Row(5).solve(10000));
}

TEST(ContactProblem, IsSolvedInAFluidThatCarriesForcesAlong) {
  // 60 contacts would be solved by conjugate gradients if W were symmetric.
  for (const std::size_t count : {5U, 61U})
    for (const double skew : {0.02, 0.2}) {
      SCOPED_TRACE(::testing::Message() << count << " discs, " << skew);
      Row row(count);
      ASSERT_TRUE(row.solve(10000, skew));
      for (std::size_t k = 1; k < count; ++k)
        EXPECT_NEAR(row.velocities[2 * k], row.velocities[0], 1e-8 * static_cast<double>(count));
    }
}

// Two pairs far from each other: what the fluid carries along is little, and yet it is much for the
// pair with the small impulse.
TEST(ContactProblem, CountsWhatALargeImpulseDoesToASmallOne) {
  const std::vector<double> free = {1e6, 0, 0, 0, 1, 0, 0, 0};
  constexpr double kSkew = 1e-8;
  const Mobility mobility = [](std::span<const double> forces) {
    std::vector<double> v(forces.begin(), forces.end());
    v[4] += kSkew * forces[2];
    v[2] -= kSkew * forces[4];
    return v;
  };
  const SolverSettings settings;
  ContactConditions conditions{free, 0.1, {2}, settings, 1, 0};
  conditions.is_symmetric = false;
  ContactProblem problem(conditions, mobility);
  for (const std::int32_t first : {0, 2}) {
    Contact<2> contact;
    contact.first = first;
    contact.second = first + 1;
    contact.normal = {1, 0};
    problem.add(contact);
  }
  ASSERT_TRUE(problem.solve(false));
  // Equal velocities of both discs of a pair: p = h (v_1 - v_2)/2 with the velocities without the
  // impulses of the own pair.
  EXPECT_NEAR(problem.contacts()[0].impulse, 0.1 * 1e6 / 2, 1e-2);
  const double solid_load = kSkew * problem.contacts()[0].impulse / 0.1;
  EXPECT_NEAR(problem.contacts()[1].impulse, 0.1 * (1 + solid_load) / 2, 1e-8);
}

TEST(ContactProblem, HasTheImpulsesThatMakeAllVelocitiesEqual) {
  for (const std::size_t count : {5U, 61U}) {
    Row row(count);
    ASSERT_TRUE(row.solve(10000));
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_NEAR(row.velocities[2 * k], 0.5, 1e-9);
      // The first k discs push the others with what they lose: h times the sum of free velocities -
      // 1/2.
      sum += 0.1 * (row.free[2 * k] - 0.5);
      if (k + 1 == count) break;
      EXPECT_NEAR(row.impulses[k], sum, 1e-8 * static_cast<double>(count));
    }
  }
}

}  // namespace
}  // namespace viscontact::particles
