// The path of smoothed problems to a solution with Coulomb's law, docs/physics.md (5.20): its end
// against the conditions of the law and closed forms, and what must not matter.
#include "viscontact/contact_solver/methods/coulomb_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/contact_solver/random_constraints.hpp"

namespace viscontact::contact_solver {
namespace {

// Violations at the end of a path over the size of the problem, as coulomb_ladder.cpp asks.
constexpr double kAccuracy = 1e-7;
constexpr int kMost = 2000;

/// The impulses at the end of path number `number`.
template <int D>
std::vector<double> end_of_path(const ConstraintProblem<D>& problem, int number = 0) {
  const auto w = row_mobilities<D>(problem);
  UnitMatrix<D> matrix(problem, false);
  CoulombPath<D> path(problem, w, matrix);
  EXPECT_LT(path.follow(number, kAccuracy, kMost), kMost);
  return path.impulses();
}

/// The largest residual of a block over the size of the problem.
template <int D>
double largest_residual(ConstraintProblem<D> problem, const std::vector<double>& impulses) {
  problem.impulses = impulses;
  const auto y = motions<D>(problem, impulses);
  double largest = 0;
  for (const auto& block : problem.blocks) {
    const auto residual = residual_after<D>(problem, block, y);
    largest = std::max({largest, residual.normal, residual.tangential});
  }
  return largest / size_of(problem);
}

template <int D>
void follow_paths_of_random_problems(int number) {
  for (const bool has_films : {false, true})
    for_each_random_constraints(has_films, [&](const RandomConstraints& what, unsigned seed) {
      SCOPED_TRACE(seed);
      const auto problem = random_constraints<D>(what, {}, seed);
      // Products are the square of kAccuracy but for factors up to 300, the smoothing over kNear.
      // Where neither factor of a product is large, errors are the root of it, which a bound of
      // friction multiplies by up to mu_s.
      EXPECT_LE(largest_residual(problem, end_of_path(problem, number)), 1e3 * kAccuracy);
    });
}
TEST(CoulombPath, EndsAtASolutionInThePlane) {
  for (int number = 0; number < CoulombPath<2>::kPaths; ++number)
    follow_paths_of_random_problems<2>(number);
}
TEST(CoulombPath, EndsAtASolutionInSpace) { follow_paths_of_random_problems<3>(0); }

/// A disc of radius and mass 1 with h = 1 on a floor, which moves into it at 1 and along it at
/// `along`. The film of the contact absorbs the impulse `capacity`.
ConstraintProblem<2> disc_on_a_floor(double along, double friction, double capacity) {
  ConstraintProblem<2> problem;
  const std::array<double, 2> moves{along, -1};
  const double turn = 0;
  problem.units = {unit_of_particle<2>(1, 2, moves.data(), &turn)};
  ConstraintBlock block;
  block.rows = 2;
  block.friction = friction;
  block.lowest = -0.25;
  block.capacity = capacity;
  problem.blocks = {block};
  for (const Vector& direction : {Vector{0, 1, 0}, Vector{1, 0, 0}}) {
    const std::vector<RowPart<2>> parts{{0, displacement_row<2>(direction, {0, -1, 0})}};
    problem.add_row(0, parts, 7);
  }
  return problem;
}

TEST(CoulombPath, FindsSlidingAndRollingOfADisc) {
  for (const double capacity : {0.0, 0.3, 2.0}) {
    SCOPED_TRACE(capacity);
    // The disc rolls after the impulse 1/3 of its velocity along the floor, if friction can give
    // it.
    const double load = std::max(1 - capacity, 0.0);
    for (const double along : {0.5, 3.0})
      for (const double friction : {0.3, 2.0}) {
        const auto impulses = end_of_path(disc_on_a_floor(along, friction, capacity));
        EXPECT_NEAR(impulses[0], 1, 1e-5);
        EXPECT_NEAR(impulses[1], -std::min(friction * load, along / 3), 1e-5);
      }
  }
}

TEST(CoulombPath, GivesAFilmThatPullsNoFriction) {
  auto problem = disc_on_a_floor(3, 0.5, 0);
  problem.rows[0].offset = 1.1;
  const auto pulled = end_of_path(problem);
  EXPECT_NEAR(pulled[0], -0.1, 1e-6);
  EXPECT_NEAR(pulled[1], 0, 1e-6);
  problem.rows[0].offset = 1.5;
  const auto open = end_of_path(problem);
  EXPECT_EQ(open[0], -0.25);
  EXPECT_EQ(open[1], 0);
}

/// Two contacts that are the same share their load, whatever the guess is.
TEST(CoulombPath, DividesTheLoadOfEqualContactsEqually) {
  auto problem = disc_on_a_floor(3, 0.3, 0);
  auto second = problem.blocks[0];
  second.row = 2;
  problem.blocks.push_back(second);
  for (const std::size_t r : {0, 1}) {
    const std::vector<RowPart<2>> parts(problem.parts_of(r).begin(), problem.parts_of(r).end());
    problem.add_row(0, parts, 0);
  }
  const auto impulses = end_of_path(problem);
  for (const std::size_t r : {0, 1}) EXPECT_NEAR(impulses[r], impulses[r + 2], 1e-12);
  EXPECT_NEAR(impulses[0] + impulses[2], 1, 1e-5);
  EXPECT_NEAR(impulses[1] + impulses[3], -0.3, 1e-5);
}

/// In an impact the lowest impulse may be one that the solids carry, with which the contact opens.
TEST(CoulombPath, GivesAImpactThatOpensAContactItsFriction) {
  auto problem = disc_on_a_floor(3, 0.5, 0.5);
  problem.blocks[0].lowest = 1.5;
  const auto impulses = end_of_path(problem);
  EXPECT_NEAR(impulses[0], 1.5, 1e-12);
  EXPECT_NEAR(impulses[1], -0.5, 1e-5);
}

/// A sphere that slides along (0.6, 0.8): friction 0.5 against it.
TEST(CoulombPath, FindsTheDirectionOfFrictionInSpace) {
  ConstraintProblem<3> problem;
  const std::array<double, 3> moves{3 * 0.6, 3 * 0.8, -1}, turn{};
  problem.units = {unit_of_particle<3>(1, 2.5, moves.data(), turn.data())};
  ConstraintBlock block;
  block.rows = 3;
  block.friction = 0.5;
  problem.blocks = {block};
  for (const Vector& direction : {Vector{0, 0, 1}, Vector{1, 0, 0}, Vector{0, 1, 0}}) {
    const std::vector<RowPart<3>> parts{{0, displacement_row<3>(direction, {0, 0, -1})}};
    problem.add_row(0, parts, 0);
  }
  const auto impulses = end_of_path(problem);
  EXPECT_NEAR(impulses[0], 1, 1e-5);
  EXPECT_NEAR(impulses[1], -0.5 * 0.6, 1e-5);
  EXPECT_NEAR(impulses[2], -0.5 * 0.8, 1e-5);
}

TEST(CoulombPath, EndsWhereLinksContradictEachOther) {
  auto problem = disc_on_a_floor(3, 0.5, 0);
  add_contradicting_links(problem);
  for (const double impulse : end_of_path(problem)) EXPECT_TRUE(std::isfinite(impulse));
}

TEST(CoulombPath, StaysAtRest) {
  auto problem = disc_on_a_floor(0, 0.3, 0);
  problem.units[0].free = {};
  problem.blocks[0].lowest = 0;
  for (const double impulse : end_of_path(problem)) EXPECT_EQ(impulse, 0);
}

/// Impulses of redundant contacts are not unique, but the path is, so that its end is, too.
template <int D>
void expect_same_ends() {
  Random random(5);
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    RandomConstraints what;
    what.contacts = 12;
    what.largest_mass_ratio = 10;
    what.has_films = seed % 2 == 0;
    const auto plain = random_constraints<D>(what, {}, seed);
    const auto decades = [&] { return random.decades(-5, 5); };
    const ProblemUnits in{decades(), decades(), decades()};
    const auto scaled = random_constraints<D>(what, in, seed);
    auto reversed = plain;
    std::ranges::reverse(reversed.blocks);
    for (double& impulse : reversed.impulses) impulse = random.uniform(-1, 1);
    const auto expected = end_of_path(plain);
    const auto of_scaled = end_of_path(scaled), of_reversed = end_of_path(reversed);
    double largest = 0;
    for (const double impulse : expected) largest = std::max(largest, std::abs(impulse));
    // Lengths of steps may differ after rounding errors, and with them the value of tau at the end.
    const double error = 1e-5 * largest;
    for (std::size_t r = 0; r < expected.size(); ++r) {
      EXPECT_NEAR(of_scaled[r] / (in.mass * in.length / in.time), expected[r], error);
      EXPECT_NEAR(of_reversed[r], expected[r], error);
    }
  }
}
TEST(CoulombPath, DependsOnNoUnitsOrderAndGuessInThePlane) { expect_same_ends<2>(); }
TEST(CoulombPath, DependsOnNoUnitsOrderAndGuessInSpace) { expect_same_ends<3>(); }

}  // namespace
}  // namespace viscontact::contact_solver
