// The projection of a step against a dense solver that shares nothing with it.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "tests/common/random.hpp"
#include "tests/contact_solver/dense_problem.hpp"
#include "tests/contact_solver/random_problem.hpp"
#include "viscontact/contact_solver/problem/mass_dual_problem.hpp"

namespace viscontact::contact_solver {
namespace {

struct Answer {
  Eigen::VectorXd impulses, displacements;
  SolverResult solved;
};

template <int D>
Answer answer_of(const Problem<D>& problem, double tolerance, int threads = 1) {
  ThreadPool pool(threads);
  auto contacts = problem.contacts;
  for (auto& contact : contacts) contact.bounds.allowed = tolerance;
  MassDualProblem<D> dual(contacts, problem.displacements, problem.mobilities, pool);
  FreeSetFactor<D> factor;
  Answer answer;
  answer.solved = solve_dual_problem(dual, 1'000'000, factor);
  std::vector<double> impulses(problem.contacts.size());
  for (std::size_t c = 0; c < impulses.size(); ++c) impulses[c] = dual.impulse(c);
  answer.impulses =
      Eigen::Map<Eigen::VectorXd>(impulses.data(), static_cast<Eigen::Index>(impulses.size()));
  answer.displacements = problem.dense().displacements(answer.impulses);
  return answer;
}

/// Of two near solutions p, q of one problem, |y_p - y_q|^2 in the norm of M/h is at most (p - q)^T
/// (g_p - g_q), and the excess of the objective at p at most g_p^T (p - q): with every contact
/// within `tolerance` of its conditions, at most this.
double bound_by_convexity(const DenseProblem& problem, const Eigen::VectorXd& p,
                          const Eigen::VectorXd& q, double tolerance) {
  return tolerance * ((p - problem.gamma).cwiseAbs().sum() + (q - problem.gamma).cwiseAbs().sum() +
                      problem.gradient(p).cwiseQuotient(problem.diagonal()).lpNorm<1>());
}

double square_distance(const DenseProblem& problem, const Eigen::VectorXd& y,
                       const Eigen::VectorXd& other) {
  return (y - other).cwiseAbs2().dot(problem.weight);
}

// The dense solution's own rounding, in the problem's units of about 1, masses over three decades:
// seen is 2e-13.
constexpr double kDense = 1e-10;

template <int D>
void expect_the_dense_solution(const Problem<D>& problem) {
  constexpr double kTolerance = 1e-11;
  const auto dense = problem.dense();
  const auto exact = solve(dense);
  const auto exact_displacements = dense.displacements(exact);
  // The oracle first: conditions of the solution.
  const Eigen::VectorXd at_exact = dense.gradient(exact);
  for (Eigen::Index c = 0; c < exact.size(); ++c)
    ASSERT_NEAR(std::min(at_exact[c], dense.diagonal()[c] * (exact[c] - dense.gamma[c])), 0,
                kDense);
  const auto answer = answer_of(problem, kTolerance);
  EXPECT_LE(answer.solved.residual, 1);
  EXPECT_LT(answer.solved.iterations, 1'000'000);
  // What it says is what it is.
  const Eigen::VectorXd gradient = dense.gradient(answer.impulses);
  double largest = 0;
  for (Eigen::Index c = 0; c < exact.size(); ++c) {
    EXPECT_GE(answer.impulses[c], dense.gamma[c] * (1 + 1e-15));
    const double room = dense.diagonal()[c] * (answer.impulses[c] - dense.gamma[c]);
    largest = std::max(largest, std::abs(std::min(gradient[c], room)));
  }
  EXPECT_NEAR(largest, answer.solved.residual * kTolerance,
              1e-13 * (1 + answer.impulses.cwiseAbs().sum()));
  const double bound = bound_by_convexity(dense, answer.impulses, exact, kTolerance + kDense);
  EXPECT_LE(square_distance(dense, answer.displacements, exact_displacements), bound);
  EXPECT_NEAR(dense.objective(answer.impulses), dense.objective(exact), bound);
  // Much closer than that bound, where nothing is degenerate: all but rounding times the condition.
  EXPECT_LE(square_distance(dense, answer.displacements, exact_displacements), 1e-12);
  // The gap between primal and dual: p - gamma^n times what the contacts are open.
  EXPECT_NEAR((answer.impulses - dense.gamma).dot(gradient), 0, bound);
}

TEST(Projection, OfRandomDiscsIsThatOfADenseSolver) {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    expect_the_dense_solution(random_problem<2>(random));
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(Projection, OfRandomSpheresIsThatOfADenseSolver) {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    expect_the_dense_solution(random_problem<3>(random));
    if (::testing::Test::HasFailure()) return;
  }
}

/// A lattice of discs of radius 1, each touching its neighbours across and along, between floor and
/// walls: contacts 2 n (n + 1) - n, degrees of freedom 2 n^2.
Problem<2> packed_lattice(int side, Random& random) {
  Problem<2> problem;
  const auto contact = [&](int first, int second, std::array<double, 2> normal) {
    GapRow<2> c;
    c.first = first;
    c.second = second;
    c.normal = normal;
    c.bounds.lowest = random.chance(0.3) ? -random.uniform(0, 1) : 0;
    problem.contacts.push_back(c);
  };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const int k = y * side + x;
      problem.mobilities.push_back(random.uniform(0.5, 2));
      problem.displacements.insert(problem.displacements.end(),
                                   {random.uniform(-0.5, 0.5), random.uniform(-1, 0)});
      contact(x == 0 ? -1 : k - 1, k, {1, 0});
      contact(y == 0 ? -1 : k - side, k, {0, 1});
      if (x == side - 1) contact(-1, k, {-1, 0});
      // Twice the same, as two films beside each other would be: no numbers tell their shares.
      if (x > 0 && y > 0) contact(k - side - 1, k, {std::sqrt(0.5), std::sqrt(0.5)});
    }
  problem.set_w();
  return problem;
}

TEST(Projection, OfAPackingWithMoreContactsThanDegreesOfFreedomHasOneVelocity) {
  Random random(3);
  for (const int side : {2, 4, 7}) {
    auto problem = packed_lattice(side, random);
    ASSERT_GT(problem.contacts.size(), problem.displacements.size());
    expect_the_dense_solution(problem);
  }
}

TEST(Projection, OfDuplicateContactsHasOneVelocityAndTheirImpulsesAddUp) {
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    SCOPED_TRACE(i);
    auto problem = random_problem<2>(random);
    const auto once = answer_of(problem, 1e-12);
    // Each contact in two halves.
    const auto contacts = problem.contacts.size();
    for (std::size_t c = 0; c < contacts; ++c) {
      problem.contacts[c].bounds.lowest /= 2;
      problem.contacts.push_back(problem.contacts[c]);
    }
    const auto twice = answer_of(problem, 1e-12);
    // As above: the conditions to 1e-12, times the condition.
    EXPECT_LE((once.displacements - twice.displacements).lpNorm<Eigen::Infinity>(), 1e-7);
  }
}

TEST(Projection, HasVelocitiesThatDoNotDependOnTheGuess) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    auto problem = random_problem<3>(random);
    const auto dense = problem.dense();
    const auto first = answer_of(problem, 1e-11);
    for (auto& contact : problem.contacts) contact.bounds.impulse = random.uniform(-20, 20);
    const auto second = answer_of(problem, 1e-11);
    EXPECT_LE(square_distance(dense, first.displacements, second.displacements),
              bound_by_convexity(dense, first.impulses, second.impulses, 2e-11));
    EXPECT_LE((first.displacements - second.displacements).lpNorm<Eigen::Infinity>(), 1e-6);
  }
}

TEST(Projection, LeavesAConvergedGuessAsItIs) {
  Random random(6);
  for (int i = 0; i < 50; ++i) {
    auto problem = random_problem<2>(random);
    const auto answer = answer_of(problem, 1e-9);
    auto again = problem;
    for (std::size_t c = 0; c < again.contacts.size(); ++c)
      again.contacts[c].bounds.impulse = answer.impulses[static_cast<Eigen::Index>(c)];
    // Twice the tolerance: the guess is rounded.
    EXPECT_EQ(answer_of(again, 2e-9).solved.iterations, 0);
  }
}

TEST(Projection, OfNoContactsIsDone) {
  const Problem<2> problem{{}, {1, 2}, {1}};
  const auto answer = answer_of(problem, 1e-9);
  EXPECT_EQ(answer.solved.iterations, 0);
  EXPECT_EQ(answer.solved.residual, 0);
}

TEST(Projection, ThatCannotBeSaysSo) {
  // Two planes that overlap at the disc: no displacement is on the free side of both.
  Problem<2> problem{{}, {0, 0}, {1}};
  for (const double side : {1.0, -1.0}) {
    GapRow<2> contact;
    contact.normal = {side, 0};
    contact.gap = -0.1;
    contact.bounds.allowed = 1e-6;
    problem.contacts.push_back(contact);
  }
  problem.set_w();
  ThreadPool pool(1);
  MassDualProblem<2> dual(problem.contacts, problem.displacements, problem.mobilities, pool);
  FreeSetFactor<2> factor;
  const auto solved = solve_dual_problem(dual, 1000, factor);
  // In the middle each is violated by 0.1; nowhere both by less. The impulses are then about
  // 1e4 or more, of which the regularisation (1e-14) makes a gap.
  EXPECT_GE(solved.residual * 1e-6, 0.1 * (1 - 1e-6));
  EXPECT_LE(solved.iterations, 1003);
  for (const double z : dual.z) EXPECT_TRUE(std::isfinite(z));
}

}  // namespace
}  // namespace viscontact::contact_solver
