// Random problems with friction against the conditions that their solutions obey, docs/physics.md
// (5.7) and (5.9), in the plane and in space.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "tests/contact_solver/random_constraints.hpp"
#include "viscontact/contact_solver/constraint_solver.hpp"
#include "viscontact/contact_solver/methods/interior_points.hpp"

namespace viscontact::contact_solver {
namespace {

// Residuals are allowed up to this part of the size of the problem. It is far above rounding errors
// of masses in the ratio 1e4.
constexpr double kAllowed = 1e-9;
// A residual bounds what is missing from each condition but for a factor that depends on mu_s,
// which is at most (1 + mu_s)^2 < 10.
constexpr double kTolerance = 10 * kAllowed;

template <int D>
void allow(ConstraintProblem<D>& problem) {
  const double size = size_of(problem);
  for (auto& block : problem.blocks) block.allowed = block.allowed_slip = kAllowed * size;
}

/// Checks each condition of (5.4), (5.7) and (5.9) by itself.
template <int D>
void expect_solved(const ConstraintProblem<D>& problem, const std::vector<double>& impulses,
                   double tolerance) {
  const auto y = motions<D>(problem, impulses);
  const auto w = row_mobilities<D>(problem);
  const double size = size_of(problem), length = tolerance * size;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    SCOPED_TRACE(b);
    const auto& block = problem.blocks[b];
    std::vector<double> v, p;
    for (std::size_t k = 0; k < block.rows; ++k) {
      v.push_back(problem.rows[block.row + k].offset + problem.product(block.row + k, y));
      p.push_back(impulses[block.row + k]);
    }
    if (!block.is_contact) {
      for (std::size_t k = 0; k < block.rows; ++k)
        EXPECT_NEAR(v[k] + block.compliance * p[k], 0, length);
      continue;
    }
    const double impulse = length / w[block.row];
    EXPECT_GE(v[0], -length);
    EXPECT_GE(p[0], block.lowest - impulse);
    if (block.rows == 1) {
      if (v[0] > length) {
        EXPECT_NEAR(p[0], block.lowest, impulse);
      }
      continue;
    }
    const double slip = D == 3 ? std::hypot(v[1], v[2]) : std::abs(v[1]);
    const double rubbing = D == 3 ? std::hypot(p[1], p[2]) : std::abs(p[1]);
    const double bound = block.is_in_cone() ? block.friction * p[0] : block.bound(p[0]);
    EXPECT_LE(rubbing, bound + impulse);
    const bool is_loaded = block.is_in_cone() && p[0] > impulse;
    if (v[0] > length && !block.is_in_cone()) {
      EXPECT_NEAR(p[0], block.lowest, impulse);
    }
    if (is_loaded) {
      EXPECT_NEAR(v[0], block.friction * slip, length);
    }
    if (slip > length && bound > block.friction * impulse) {
      // Friction is at its bound, and against the slip.
      EXPECT_NEAR(rubbing, bound, impulse);
      for (std::size_t k = 1; k < block.rows; ++k)
        EXPECT_NEAR(p[k], -bound * v[k] / slip, impulse + bound * length / slip);
    }
  }
  // No impulse does work.
  std::vector<Motion<D>> free;
  for (const auto& unit : problem.units) free.push_back(unit.free);
  EXPECT_LE(square_of(problem, y), (1 + tolerance) * square_of(problem, free));
}

template <int D>
void solve_random_problems(bool is_convex, bool has_films) {
  for_each_random_constraints(has_films, [&](const RandomConstraints& what, unsigned seed) {
    SCOPED_TRACE(seed);
    auto problem = random_constraints<D>(what, {}, seed);
    if (is_convex) make_convex(problem, {}, seed);
    allow(problem);
    const auto solution = solve_constraints(problem, 10000);
    EXPECT_LE(solution.result.residual, 1);
    expect_solved(problem, problem.impulses, kTolerance);
  });
}

TEST(Residuals, AreAtLeastTheRoundingErrorsOfTheImpulses) {
  // The gap -0.1 is lost in the impulse 1e18, from which a residual subtracts it over the mobility.
  const double w[2] = {1, 3}, v[2] = {-0.1, 0}, p[2] = {1e18, 0};
  ConstraintBlock block;
  block.rows = 2;
  block.friction = 0.5;
  for (const auto bound : {FrictionBound::kCone, FrictionBound::kCoulomb, FrictionBound::kGiven}) {
    block.friction_bound = bound;
    block.given_load = 1e18;
    EXPECT_GE(residual_of(block, v, p, w).normal, 0.1);
    const double tangential[2] = {1e18, -4e17}, none[2] = {0, 0};
    EXPECT_GE(residual_of(block, none, tangential, w).tangential, 100);
  }
  block.is_contact = false;
  EXPECT_GE(residual_of(block, v, p, w).normal, 100);
}

TEST(RandomConstraintProblems, ObeyCoulombsLawInThePlane) {
  solve_random_problems<2>(false, false);
}
TEST(RandomConstraintProblems, ObeyCoulombsLawInSpace) { solve_random_problems<3>(false, false); }
TEST(RandomConstraintProblems, ObeyCoulombsLawWithFilms) { solve_random_problems<2>(false, true); }
TEST(RandomConstraintProblems, ObeyTheRelaxationInThePlane) {
  solve_random_problems<2>(true, false);
}
TEST(RandomConstraintProblems, ObeyTheRelaxationInSpace) { solve_random_problems<3>(true, false); }
TEST(RandomConstraintProblems, ObeyGivenLoadsInThePlane) { solve_random_problems<2>(true, true); }
TEST(RandomConstraintProblems, ObeyGivenLoadsInSpace) { solve_random_problems<3>(true, true); }

/// Solves to this part of the size of the problem.
template <int D>
void solve_redundant_problems(double accuracy) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    RandomConstraints what;
    what.contacts = 24;
    what.friction = 0.05 * seed;
    what.has_links = seed % 2 == 0;
    what.has_films = seed % 3 == 0;
    auto problem = random_constraints<D>(what, {}, seed);
    make_convex(problem, {}, seed);
    const auto w = row_mobilities<D>(problem);
    UnitMatrix<D> matrix(problem, true);
    InteriorPoints<D> interior(problem, w, matrix);
    // The method is known for 10 to 40 iterations, whatever the problem is.
    EXPECT_LE(interior.solve(accuracy, 100), 40);
    // A residual bounds what is missing from a condition but for a factor below 10, as above.
    expect_solved(problem, interior.impulses(), 10 * accuracy);
  }
}
TEST(InteriorPointsOfFriction, SolveRedundantProblemsInThePlane) {
  solve_redundant_problems<2>(1e-8);
}
/// Most problems of spheres need no higher accuracy, see ConvexTuning in convex_ladder.cpp.
TEST(InteriorPointsOfFriction, SolveRedundantProblemsInSpace) { solve_redundant_problems<3>(1e-6); }

/// Films that pull, and nothing else: without their impulses nothing moves, and the guess is wrong.
TEST(InteriorPointsOfFriction, BeginWithTheImpulsesOfTheFilms) {
  ConstraintProblem<2> problem;
  const std::array<double, 2> rest{};
  const double turn = 0;
  problem.units = {unit_of_particle<2>(1, 2, rest.data(), &turn),
                   unit_of_particle<2>(1, 2, rest.data(), &turn)};
  // One gap is closed, the other one stays open by 0.1 with the whole impulse of its film.
  for (const int unit : {0, 1}) {
    ConstraintBlock block;
    block.row = problem.rows.size();
    block.lowest = -0.3;
    problem.blocks.push_back(block);
    const std::vector<RowPart<2>> parts{{unit, displacement_row<2>({1, 0, 0}, {})}};
    problem.add_row(unit == 0 ? 0 : 0.4, parts, 5);
  }
  problem.is_convex = true;
  const auto w = row_mobilities<2>(problem);
  UnitMatrix<2> matrix(problem, true);
  InteriorPoints<2> interior(problem, w, matrix);
  interior.solve(1e-9, 100);
  EXPECT_NEAR(interior.impulses()[0], 0, 1e-8);
  EXPECT_NEAR(interior.impulses()[1], -0.3, 1e-8);
}

/// Numbers that overflowed before: all residuals are no numbers.
TEST(ConstraintSolver, ReturnsAnIterateWithoutResiduals) {
  RandomConstraints what;
  what.has_links = true;
  auto problem = random_constraints<3>(what, {}, 1);
  allow(problem);
  auto convex = problem;
  make_convex(convex, {}, 1);
  for (auto* one : {&problem, &convex}) {
    for (auto& row : one->rows) row.offset = std::numeric_limits<double>::quiet_NaN();
    const auto solution = solve_constraints(*one, 1000);
    EXPECT_GT(solution.result.residual, 1);
    EXPECT_EQ(solution.motions.size(), one->units.size());
    EXPECT_EQ(solution.residuals.size(), one->blocks.size());
    EXPECT_EQ(one->impulses.size(), one->rows.size());
  }
}

/// Two rows that no motion satisfies, and a contact with friction.
TEST(ConstraintSolver, EndsWhereNothingIsGained) {
  RandomConstraints what;
  what.has_links = true;
  auto problem = random_constraints<2>(what, {}, 1);
  add_contradicting_links(problem);
  allow(problem);
  auto convex = problem;
  make_convex(convex, {}, 1);
  for (auto* one : {&problem, &convex}) {
    const auto solution = solve_constraints(*one, 1000000);
    EXPECT_GT(solution.result.residual, 1);
    EXPECT_LT(solution.result.iterations, 10000);
  }
}

/// Iterations that end far from the solution, as those of a rough solution do, whose loads decide
/// the friction of films.
TEST(InteriorPointsOfFriction, DoNotDependOnTheChoiceOfTheTangents) {
  constexpr double kRough = 1e-2;
  for (const bool has_films : {false, true})
    for (unsigned seed = 1; seed <= 10; ++seed) {
      SCOPED_TRACE(seed);
      RandomConstraints what;
      what.has_films = has_films;
      auto problem = random_constraints<3>(what, {}, seed);
      make_convex(problem, {}, seed);
      auto turned = problem;
      const double c = std::cos(seed), s = std::sin(seed);
      for (const auto& block : problem.blocks) {
        if (!block.is_contact || block.rows < 3) continue;
        const std::size_t first = block.row + 1, second = block.row + 2;
        const auto a = problem.parts_of(first), b = problem.parts_of(second);
        for (std::size_t part = 0; part < a.size(); ++part)
          for (std::size_t k = 0; k < 6; ++k) {
            const double x = a[part].coefficients[k], y = b[part].coefficients[k];
            turned.parts[turned.rows[first].first_part + part].coefficients[k] = c * x + s * y;
            turned.parts[turned.rows[second].first_part + part].coefficients[k] = c * y - s * x;
          }
        const double x = problem.rows[first].offset, y = problem.rows[second].offset;
        turned.rows[first].offset = c * x + s * y;
        turned.rows[second].offset = c * y - s * x;
      }
      const auto loads = [&](const ConstraintProblem<3>& of) {
        const auto w = row_mobilities<3>(of);
        UnitMatrix<3> matrix(of, true);
        InteriorPoints<3> interior(of, w, matrix);
        interior.solve(kRough, 100);
        return interior.impulses();
      };
      const auto expected = loads(problem), other = loads(turned);
      // The tolerance is for rounding errors. When the size of the start depended on the
      // tangents, the loads differed by up to 8e-5.
      const double largest = *std::ranges::max_element(expected);
      for (const auto& block : problem.blocks)
        EXPECT_NEAR(other[block.row], expected[block.row], 1e-9 * largest);
    }
}

TEST(InteriorPointsOfFriction, MotionsAreTheSameInAllUnitsAndOrders) {
  Random random(3);
  RandomConstraints what;
  what.contacts = 24;
  what.largest_mass_ratio = 10;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    auto plain = random_constraints<3>(what, {}, seed);
    make_convex(plain, {}, seed);
    allow(plain);
    auto turned = plain;
    std::ranges::reverse(turned.blocks);
    const auto decades = [&] { return random.decades(-5, 5); };
    const ProblemUnits in{decades(), decades(), decades()};
    auto scaled = random_constraints<3>(what, in, seed);
    make_convex(scaled, in, seed);
    allow(scaled);
    const auto expected = solve_constraints(plain, 10000).motions;
    const auto reversed = solve_constraints(turned, 10000).motions;
    const auto other = solve_constraints(scaled, 10000).motions;
    // Motions are unique. They are the minimum of a quadratic function, along which residuals of
    // 1e-9 allow about their root times the ratio of the masses' roots where contacts are
    // redundant.
    constexpr double kUnique = 1e-3;
    for (std::size_t u = 0; u < expected.size(); ++u)
      for (std::size_t k = 0; k < 6; ++k) {
        EXPECT_NEAR(reversed[u][k], expected[u][k], kUnique);
        EXPECT_NEAR(other[u][k] / (k < 3 ? in.length : 1), expected[u][k], kUnique);
      }
  }
}

}  // namespace
}  // namespace viscontact::contact_solver
