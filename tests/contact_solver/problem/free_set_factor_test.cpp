// The factor of W between free contacts against a dense inverse.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "tests/common/random.hpp"
#include "tests/contact_solver/dense_problem.hpp"
#include "tests/contact_solver/random_problem.hpp"
#include "viscontact/contact_solver/methods/active_set_newton.hpp"
#include "viscontact/contact_solver/problem/mass_dual_problem.hpp"

namespace viscontact::contact_solver {
namespace {

TEST(FreeSetFactor, IsTheInverseBetweenContactsThatWereFreeAndStillAre) {
  Random random(7);
  ThreadPool pool(1);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const auto problem = random_problem<2>(random);
    const auto dense = problem.dense();
    MassDualProblem<2> dual(problem.contacts, problem.displacements, problem.mobilities, pool);
    const auto choose_free = [&] {
      for (std::size_t c = 0; c < dual.count(); ++c)
        dual.z[c] = dual.bound[c] + (random.chance(0.7) ? 1 : 0);
    };
    choose_free();
    std::vector<Eigen::Index> made_of;
    for (std::size_t c = 0; c < dual.count(); ++c)
      if (dual.is_free(c)) made_of.push_back(static_cast<Eigen::Index>(c));
    FreeSetFactor<2> factor;
    EXPECT_FALSE(factor.exists());
    std::vector<char> active(dual.count());
    for (std::size_t c = 0; c < dual.count(); ++c) active[c] = dual.is_free(c) ? 1 : 0;
    ASSERT_TRUE(factor.factorise(dual, active));
    ASSERT_TRUE(factor.exists());
    choose_free();

    const Eigen::MatrixXd half = dense.diagonal().cwiseSqrt().cwiseInverse().asDiagonal() *
                                 dense.g * dense.weight.cwiseSqrt().cwiseInverse().asDiagonal();
    Eigen::MatrixXd w = (half * half.transpose())(made_of, made_of);
    constexpr double kEpsilon = 1e-10;  // of the factor
    w.diagonal().array() += kEpsilon;
    std::vector<double> gradient(dual.count()), solved(dual.count());
    for (auto& g : gradient) g = random.uniform(-1, 1);
    const double product = factor.precondition(dual, gradient, solved);
    Eigen::VectorXd right(static_cast<Eigen::Index>(made_of.size()));
    for (Eigen::Index k = 0; k < right.size(); ++k) {
      const auto c = static_cast<std::size_t>(made_of[static_cast<std::size_t>(k)]);
      right[k] = dual.is_free(c) ? gradient[c] : 0;
    }
    const Eigen::VectorXd inverse = w.ldlt().solve(right);
    double expected_product = 0;
    auto expected = gradient;
    for (Eigen::Index k = 0; k < right.size(); ++k)
      expected[static_cast<std::size_t>(made_of[static_cast<std::size_t>(k)])] = inverse[k];
    // Rounding, times the condition of at most 10/epsilon.
    const double rounding =
        1e-15 * 10 / kEpsilon * std::max(1.0, inverse.lpNorm<Eigen::Infinity>());
    for (std::size_t c = 0; c < dual.count(); ++c) {
      if (!dual.is_free(c)) expected[c] = 0;
      EXPECT_NEAR(solved[c], expected[c], rounding) << c;
      expected_product += expected[c] * gradient[c];
    }
    EXPECT_NEAR(product, expected_product, static_cast<double>(dual.count()) * rounding);
  }
}

TEST(DualSolver, DoesNotCountAProblemWithANumberThatIsNoneAsSolved) {
  Random random(11);
  ThreadPool pool(1);
  for (int i = 0; i < 40; ++i) {
    const auto problem = random_problem<2>(random);
    if (problem.contacts.empty()) continue;
    const auto with_nan = [&] {
      MassDualProblem<2> dual(problem.contacts, problem.displacements, problem.mobilities, pool);
      const int last = static_cast<int>(dual.count()) - 1;
      dual.linear_term[static_cast<std::size_t>(random.integer(0, last))] =
          std::numeric_limits<double>::quiet_NaN();
      return dual;
    };
    FreeSetFactor<2> factor, of_newton;
    auto dual = with_nan();
    const auto solved = solve_dual_problem(dual, 1000, factor);
    EXPECT_FALSE(solved.residual <= 1) << i;
    EXPECT_LT(solved.iterations, 100) << i;
    auto other = with_nan();
    EXPECT_FALSE(active_set_newton(other, of_newton, 10).residual <= 1) << i;
  }
}

}  // namespace
}  // namespace viscontact::contact_solver
