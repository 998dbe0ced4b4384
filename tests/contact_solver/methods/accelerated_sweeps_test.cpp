// Accelerated sweeps against the exact methods, on random contacts of round particles.
#include "viscontact/contact_solver/methods/accelerated_sweeps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/contact_solver/random_constraints.hpp"
#include "viscontact/contact_solver/constraint_solver.hpp"

namespace viscontact::contact_solver {
namespace {

template <class Dimension>
class AcceleratedSweepsTest : public ::testing::Test {};
template <int D>
struct Dimension {
  static constexpr int kNumber = D;
};
using Dimensions = ::testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(AcceleratedSweepsTest, Dimensions);

/// The same problem as a convex one, with cones or, if it has films, with given loads.
template <int D>
ConstraintProblem<D> convex(ConstraintProblem<D> problem, double allowed) {
  problem.is_convex = problem.keeps_loads = true;
  for (auto& block : problem.blocks) {
    block.allowed = block.allowed_slip = allowed;
    block.friction_bound = block.has_film() ? FrictionBound::kGiven : FrictionBound::kCone;
    block.given_load = block.has_film() ? 0.3 : 0;
  }
  return problem;
}

/// The largest difference of two motions in the norm of the masses, in which a convex problem has
/// one solution.
template <int D>
double difference(const ConstraintProblem<D>& problem, const std::vector<Motion<D>>& a,
                  const std::vector<Motion<D>>& b) {
  double square = 0;
  for (std::size_t u = 0; u < a.size(); ++u) {
    Motion<D> apart;
    for (std::size_t k = 0; k < apart.size(); ++k) apart[k] = a[u][k] - b[u][k];
    const auto impulse = problem.units[u].impulse_of(apart);
    for (std::size_t k = 0; k < apart.size(); ++k) square += apart[k] * impulse[k];
  }
  return std::sqrt(square);
}

TYPED_TEST(AcceleratedSweepsTest, SolveConvexProblemsAsInteriorPointsDo) {
  constexpr int kDimension = TypeParam::kNumber;
  int problems = 0, by_sweeps = 0;
  for (const bool has_films : {false, true})
    for_each_random_constraints(has_films, [&](RandomConstraints what, unsigned seed) {
      if (what.has_links) return;
      what.is_round = true;
      const auto random = random_constraints<kDimension>(what, {}, seed);
      auto problem = convex(random, 1e-7), exact = convex(random, 1e-9);
      const auto solved = solve_constraints(problem, 100000, ConstraintStart::kAcceleratedSweeps);
      const auto expected = solve_constraints(exact, 100000);
      EXPECT_LE(solved.result.residual, 1) << seed;
      EXPECT_LE(expected.result.residual, 1) << seed;
      // Residuals of 1e-7 and impulses of about 1 leave an energy of up to 1e-7 undecided.
      EXPECT_LE(difference(problem, solved.motions, expected.motions), 1e-3) << seed;
      ++problems;
      by_sweeps += solved.result.stages.has(Stage::kInteriorPoints) ? 0 : 1;
    });
  // Masses in the ratio 1e4 and a tolerance as small as this are hard for sweeps.
  EXPECT_GE(by_sweeps, 0.8 * problems);
}

TYPED_TEST(AcceleratedSweepsTest, AreNotForOtherBlocks) {
  constexpr int kDimension = TypeParam::kNumber;
  RandomConstraints what;
  const auto is_solvable = [](auto problem) {
    return AcceleratedSweeps<kDimension>::of(problem, row_mobilities(problem)).has_value();
  };
  what.is_round = true;
  EXPECT_TRUE(is_solvable(random_constraints<kDimension>(what, {}, 1)));
  what.is_round = false;
  EXPECT_FALSE(is_solvable(random_constraints<kDimension>(what, {}, 1)));
  what.is_round = what.has_links = true;
  EXPECT_FALSE(is_solvable(random_constraints<kDimension>(what, {}, 1)));
  if constexpr (kDimension == 3) {
    what.has_links = false;
    auto problem = random_constraints<3>(what, {}, 1);
    problem.units[0].turn_mobility[4] *= 2;
    EXPECT_FALSE(is_solvable(problem));
  }
}

/// A unit without an arm, which moves by (0, -1, slip) over a floor at this distance.
ConstraintProblem<3> unit_over_a_floor(double gap, double slip) {
  ConstraintProblem<3> problem;
  const std::array<double, 3> moves{slip, -1, 0}, turn{};
  problem.units = {unit_of_particle<3>(1, 1, moves.data(), turn.data())};
  ConstraintBlock block;
  block.rows = 3;
  block.friction = 0.5;
  block.allowed = block.allowed_slip = 1e-9;
  block.friction_bound = FrictionBound::kCone;
  block.is_optional = true;
  problem.blocks = {block};
  const std::array<Vector, 3> directions{Vector{0, 1, 0}, Vector{1, 0, 0}, Vector{0, 0, 1}};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<RowPart<3>, 1> parts{{{0, displacement_row<3>(directions[k], {})}}};
    problem.add_row(k == 0 ? gap : 0, parts, 0);
  }
  problem.is_convex = true;
  return problem;
}

TEST(AcceleratedSweeps, LeaveAnOptionalContactAloneUnlessItsGapCloses) {
  auto open = unit_over_a_floor(1.5, 4);
  const auto stays = solve_constraints(open, 1000, ConstraintStart::kAcceleratedSweeps);
  EXPECT_LE(stays.result.residual, 1);
  EXPECT_EQ(stays.result.iterations, 0);
  EXPECT_EQ(open.impulses, (std::vector<double>{0, 0, 0}));
  // (5.9) demands a gap of 0.5 times the slip of a contact that takes part: p_t = -p_n/2 slows the
  // slip, and 1.5 - 1 + p_n = (4 - p_n/2)/2 gives p_n = 1.2.
  auto taking_part = unit_over_a_floor(1.5, 4);
  taking_part.blocks[0].is_optional = false;
  const auto pushed = solve_constraints(taking_part, 1000, ConstraintStart::kAcceleratedSweeps);
  EXPECT_LE(pushed.result.residual, 1);
  EXPECT_NEAR(taking_part.impulses[0], 1.2, 1e-8);
  EXPECT_NEAR(taking_part.impulses[1], -0.6, 1e-8);
  // Where the gap closes, an optional contact is like any other.
  for (const bool is_optional : {true, false}) {
    auto closing = unit_over_a_floor(0.5, 4);
    closing.blocks[0].is_optional = is_optional;
    EXPECT_LE(solve_constraints(closing, 1000, ConstraintStart::kAcceleratedSweeps).result.residual,
              1);
    EXPECT_NEAR(closing.impulses[0], 2, 1e-8);
    EXPECT_NEAR(closing.impulses[1], -1, 1e-8);
  }
}

TEST(AcceleratedSweeps, ForgetTheFrictionOfAnOptionalContactWithoutALoad) {
  auto open = unit_over_a_floor(1.5, 4);
  open.impulses[1] = -0.3;
  const auto solved = solve_constraints(open, 1000, ConstraintStart::kAcceleratedSweeps);
  EXPECT_LE(solved.result.residual, 1);
  EXPECT_EQ(open.impulses, (std::vector<double>{0, 0, 0}));
}

TEST(AcceleratedSweeps, LeaveOptionalContactsAloneWhereTheyCannotSolve) {
  auto open = unit_over_a_floor(1.5, 4);
  open.units[0].turn_mobility[4] *= 2;
  const auto solved = solve_constraints(open, 1000, ConstraintStart::kAcceleratedSweeps);
  EXPECT_LE(solved.result.residual, 1);
  EXPECT_FALSE(solved.result.stages.has(Stage::kAcceleratedSweeps));
  EXPECT_EQ(open.impulses[0], 0);
}

TYPED_TEST(AcceleratedSweepsTest, SolveProblemsWithCoulombsLaw) {
  constexpr int kDimension = TypeParam::kNumber;
  int problems = 0, by_sweeps = 0;
  for_each_random_constraints(true, [&](RandomConstraints what, unsigned seed) {
    if (what.has_links || what.friction > 0.5) return;
    what.is_round = true;
    auto problem = random_constraints<kDimension>(what, {}, seed);
    for (auto& block : problem.blocks) block.allowed = block.allowed_slip = 1e-6;
    const auto solved = solve_constraints(problem, 100000, ConstraintStart::kAcceleratedSweeps);
    EXPECT_LE(solved.result.residual, 1) << seed;
    ++problems;
    by_sweeps += solved.result.stages.has(Stage::kProximalSteps) ? 0 : 1;
  });
  EXPECT_GE(by_sweeps, 0.7 * problems);
}

TYPED_TEST(AcceleratedSweepsTest, LeaveOtherProblemsToPlainSweeps) {
  RandomConstraints what;
  auto problem = random_constraints<TypeParam::kNumber>(what, {}, 1);
  for (auto& block : problem.blocks) block.allowed = block.allowed_slip = 1e-6;
  const auto solved = solve_constraints(problem, 1000, ConstraintStart::kAcceleratedSweeps);
  EXPECT_TRUE(solved.result.stages.has(Stage::kSweeps));
  EXPECT_FALSE(solved.result.stages.has(Stage::kAcceleratedSweeps));
}

TEST(AcceleratedSweeps, BeginAtTheGuess) {
  auto problem = unit_over_a_floor(0.5, 4);
  ASSERT_LE(solve_constraints(problem, 1000, ConstraintStart::kAcceleratedSweeps).result.residual,
            1);
  EXPECT_EQ(solve_constraints(problem, 1000, ConstraintStart::kAcceleratedSweeps).result.iterations,
            0);
}

}  // namespace
}  // namespace viscontact::contact_solver
