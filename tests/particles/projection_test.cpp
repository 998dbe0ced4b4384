// The projection of a step against a dense solver that shares nothing with it.
#include "viscontact/particles/projection/projection.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "tests/particles/systems.hpp"

namespace viscontact::particles {
namespace {

/// x >= 0 of least |A x - b| (Lawson & Hanson 1974, "Solving least squares problems", chapter 23).
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const auto n = a.cols();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  std::vector<bool> passive(static_cast<std::size_t>(n), false);
  std::vector<Eigen::Index> set;
  const auto solve = [&] {
    Eigen::MatrixXd columns(a.rows(), static_cast<Eigen::Index>(set.size()));
    for (std::size_t k = 0; k < set.size(); ++k)
      columns.col(static_cast<Eigen::Index>(k)) = a.col(set[k]);
    return Eigen::VectorXd(columns.colPivHouseholderQr().solve(b));
  };
  const auto drop_from_set = [&](Eigen::Index c) {
    passive[static_cast<std::size_t>(c)] = false;
    std::erase(set, c);
    x[c] = 0;
  };
  for (int round = 0; round < 100 * static_cast<int>(n); ++round) {
    const Eigen::VectorXd downhill = a.transpose() * (b - a * x);
    Eigen::Index best = -1;
    double steepest = 1e-13;
    for (Eigen::Index c = 0; c < n; ++c)
      if (const double slope = downhill[c] / a.col(c).norm();
          !passive[static_cast<std::size_t>(c)] && slope > steepest) {
        steepest = slope;
        best = c;
      }
    if (best < 0) break;
    passive[static_cast<std::size_t>(best)] = true;
    set.push_back(best);
    for (;;) {
      const auto s = solve();
      double share = 1;
      for (std::size_t k = 0; k < set.size(); ++k)
        if (const double at = s[static_cast<Eigen::Index>(k)]; at <= 0)
          share = std::min(share, x[set[k]] / (x[set[k]] - at));
      std::vector<Eigen::Index> left;
      for (std::size_t k = 0; k < set.size(); ++k) {
        auto& value = x[set[k]];
        value += share * (s[static_cast<Eigen::Index>(k)] - value);
        if (share < 1 && value <= 1e-15 * (1 + x.lpNorm<Eigen::Infinity>())) left.push_back(set[k]);
      }
      if (left.empty()) break;
      for (const auto c : left) drop_from_set(c);
      if (set.empty()) break;
    }
  }
  return x;
}

/// A projection in dense matrices. With all films pulling as much as they have, gamma^n, the rest is a plain one: p = gamma^n + x, x >= 0,
/// y = y0 + h M^-1 G^T x the point nearest to y0 (in the norm of M/h) with D + G y >= 0.
struct DenseProblem {
  Eigen::MatrixXd g;       // G
  Eigen::VectorXd gap;     // D
  Eigen::VectorXd gamma;   // gamma^n
  Eigen::VectorXd weight;  // m/h, of each number of each body
  Eigen::VectorXd free;    // h u*

  Eigen::VectorXd displacements(const Eigen::VectorXd& impulses) const {
    return free + Eigen::VectorXd((g.transpose() * impulses).cwiseQuotient(weight));
  }
  Eigen::VectorXd gradient(const Eigen::VectorXd& impulses) const {
    return gap + g * displacements(impulses);
  }
  /// w of each contact: h/m_i + h/m_j.
  Eigen::VectorXd diagonal() const {
    return (g.cwiseAbs2() * weight.cwiseInverse().asDiagonal()).rowwise().sum();
  }
  /// 1/2 p^T W p + b^T p.
  double objective(const Eigen::VectorXd& p) const {
    return p.dot(gradient(p) + gradient(Eigen::VectorXd::Zero(p.size()))) / 2;
  }
};

/// The impulses; where they are not unique, some. Least distance programming (Lawson & Hanson, chapter 23).
Eigen::VectorXd solve(const DenseProblem& problem) {
  const Eigen::VectorXd root = problem.weight.cwiseSqrt();
  // |t|^2 least with E^T t >= f, t = root (y - y0).
  const Eigen::MatrixXd e =
      (problem.g * root.cwiseInverse().asDiagonal()).transpose();  // numbers x contacts
  const Eigen::VectorXd f = -problem.gradient(problem.gamma);
  // In units in which f is about 1, for the tolerances above.
  const double unit = std::max(1e-300, f.lpNorm<Eigen::Infinity>());
  Eigen::MatrixXd a(e.rows() + 1, e.cols());
  a << e, f.transpose() / unit;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(e.rows() + 1);
  b[e.rows()] = 1;
  const Eigen::VectorXd u = nonnegative_least_squares(a, b);
  const double rest = (b - a * u)[e.rows()];
  return problem.gamma + u * (unit / rest);
}

template <int D>
struct Problem {
  std::vector<Contact<D>> contacts;
  std::vector<double> displacements, mobilities;

  DenseProblem dense() const {
    const auto rows = static_cast<Eigen::Index>(contacts.size());
    const auto columns = static_cast<Eigen::Index>(displacements.size());
    DenseProblem result{Eigen::MatrixXd::Zero(rows, columns), Eigen::VectorXd(rows),
                        Eigen::VectorXd(rows), Eigen::VectorXd(columns),
                        Eigen::Map<const Eigen::VectorXd>(displacements.data(), columns)};
    for (Eigen::Index c = 0; c < rows; ++c) {
      const auto& contact = contacts[static_cast<std::size_t>(c)];
      result.gap[c] = contact.gap;
      result.gamma[c] = contact.gamma;
      for (int d = 0; d < D; ++d) {
        const double n = contact.normal[static_cast<std::size_t>(d)];
        if (contact.first >= 0) result.g(c, contact.first * D + d) = -n;
        result.g(c, contact.second * D + d) = n;
      }
    }
    for (Eigen::Index k = 0; k < columns; ++k)
      result.weight[k] = 1 / mobilities[static_cast<std::size_t>(k / D)];
    return result;
  }
};

/// Bodies thrown together by random normals, gaps >= 0 (staying is allowed), up to several contacts for each freedom.
template <int D>
Problem<D> random_problem(Random& random) {
  Problem<D> problem;
  const int bodies = random.integer(1, 10);
  const double masses = random.uniform(0, 1.5);
  for (int b = 0; b < bodies; ++b) {
    problem.mobilities.push_back(random.decades(-masses, masses));
    for (int d = 0; d < D; ++d) problem.displacements.push_back(random.uniform(-1, 1));
  }
  const int contacts = random.integer(1, 4 * bodies);
  for (int c = 0; c < contacts; ++c) {
    Contact<D> contact;
    contact.second = random.integer(0, bodies - 1);
    contact.first = random.integer(-1, bodies - 1);
    if (contact.first == contact.second) contact.first = -1;
    const Vector normal = random.direction(D);
    std::copy_n(normal.begin(), D, contact.normal.begin());
    contact.gap = random.chance(0.5) ? 0 : random.uniform(0, 0.5);
    contact.gamma = random.chance(0.5) ? 0 : -random.decades(-3, 1);
    contact.impulse = random.chance(0.5) ? 0 : random.uniform(contact.gamma, 1);
    problem.contacts.push_back(contact);
  }
  return problem;
}

template <int D>
SolverMethod<D> method_of(const SolverMethodRow& row) {
  if constexpr (D == 2)
    return row.discs;
  else
    return row.spheres;
}

struct Answer {
  Eigen::VectorXd impulses, displacements;
  SolverResult solved;
};

template <int D>
Answer answer_of(const SolverMethodRow& row, const Problem<D>& problem, double tolerance,
                 int threads = 1) {
  ThreadPool pool(threads);
  auto contacts = problem.contacts;
  for (auto& contact : contacts) contact.allowed = tolerance;
  ContactGraph<D> graph(contacts, problem.displacements, problem.mobilities, pool);
  ActiveSetFactor<D> factor;
  Answer answer;
  answer.solved = method_of<D>(row)(graph, 1'000'000, factor);
  std::vector<double> impulses(problem.contacts.size());
  graph.impulses(impulses);
  answer.impulses =
      Eigen::Map<Eigen::VectorXd>(impulses.data(), static_cast<Eigen::Index>(impulses.size()));
  answer.displacements = problem.dense().displacements(answer.impulses);
  return answer;
}

/// Of two near solutions p, q of one problem, |y_p - y_q|^2 in the norm of M/h is at most (p - q)^T (g_p - g_q), and the excess of the objective at p
/// at most g_p^T (p - q): with every contact within `tolerance` of its conditions, at most this.
double bound_by_convexity(const DenseProblem& problem, const Eigen::VectorXd& p,
                          const Eigen::VectorXd& q, double tolerance) {
  return tolerance * ((p - problem.gamma).cwiseAbs().sum() + (q - problem.gamma).cwiseAbs().sum() +
                      problem.gradient(p).cwiseQuotient(problem.diagonal()).lpNorm<1>());
}

double square_distance(const DenseProblem& problem, const Eigen::VectorXd& y,
                       const Eigen::VectorXd& other) {
  return (y - other).cwiseAbs2().dot(problem.weight);
}

// The dense solution's own rounding, in the problem's units of about 1, masses over three decades: seen is 2e-13.
constexpr double kDense = 1e-10;

template <int D>
void expect_all_methods_agree(const Problem<D>& problem) {
  constexpr double kTolerance = 1e-11;
  const auto dense = problem.dense();
  const auto exact = solve(dense);
  const auto exact_displacements = dense.displacements(exact);
  // The oracle first: conditions of the solution.
  const Eigen::VectorXd at_exact = dense.gradient(exact);
  for (Eigen::Index c = 0; c < exact.size(); ++c)
    ASSERT_NEAR(std::min(at_exact[c], dense.diagonal()[c] * (exact[c] - dense.gamma[c])), 0,
                kDense);
  for (const auto& row : kSolverMethods) {
    SCOPED_TRACE(std::string(row.name));
    const auto answer = answer_of(row, problem, kTolerance);
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
}

TEST(Projection, OfRandomDiscsIsThatOfADenseSolver) {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    expect_all_methods_agree(random_problem<2>(random));
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(Projection, OfRandomSpheresIsThatOfADenseSolver) {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    expect_all_methods_agree(random_problem<3>(random));
    if (::testing::Test::HasFailure()) return;
  }
}

/// A lattice of discs of radius 1, each touching its neighbours across and along, between floor and walls: contacts 2 n (n + 1) - n, freedoms 2 n^2.
Problem<2> packed_lattice(int side, Random& random) {
  Problem<2> problem;
  const auto contact = [&](int first, int second, std::array<double, 2> normal) {
    Contact<2> c;
    c.first = first;
    c.second = second;
    c.normal = normal;
    c.gamma = random.chance(0.3) ? -random.uniform(0, 1) : 0;
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
  return problem;
}

TEST(Projection, OfAPackingWithMoreContactsThanFreedomsHasOneVelocity) {
  Random random(3);
  for (const int side : {2, 4, 7}) {
    auto problem = packed_lattice(side, random);
    ASSERT_GT(problem.contacts.size(), problem.displacements.size());
    expect_all_methods_agree(problem);
  }
}

TEST(ActiveSetFactor, IsTheInverseBetweenContactsThatWereFreeAndStillAre) {
  Random random(7);
  ThreadPool pool(1);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const auto problem = random_problem<2>(random);
    const auto dense = problem.dense();
    ContactGraph<2> graph(problem.contacts, problem.displacements, problem.mobilities, pool);
    const auto choose_free = [&] {
      for (std::size_t c = 0; c < graph.count(); ++c)
        graph.z[c] = graph.bound[c] + (random.chance(0.7) ? 1 : 0);
    };
    choose_free();
    std::vector<Eigen::Index> made_of;
    for (std::size_t c = 0; c < graph.count(); ++c)
      if (graph.is_free(c)) made_of.push_back(static_cast<Eigen::Index>(c));
    ActiveSetFactor<2> factor;
    EXPECT_FALSE(factor.exists());
    std::vector<char> active(graph.count());
    for (std::size_t c = 0; c < graph.count(); ++c) active[c] = graph.is_free(c) ? 1 : 0;
    ASSERT_TRUE(factor.factorise(graph, active));
    ASSERT_TRUE(factor.exists());
    choose_free();

    const Eigen::MatrixXd half = dense.diagonal().cwiseSqrt().cwiseInverse().asDiagonal() *
                                 dense.g * dense.weight.cwiseSqrt().cwiseInverse().asDiagonal();
    Eigen::MatrixXd w = (half * half.transpose())(made_of, made_of);
    constexpr double kEpsilon = 1e-10;  // of the factor
    w.diagonal().array() += kEpsilon;
    std::vector<double> gradient(graph.count()), solved(graph.count());
    for (auto& g : gradient) g = random.uniform(-1, 1);
    const double product = factor.precondition(graph, gradient, solved);
    Eigen::VectorXd right(static_cast<Eigen::Index>(made_of.size()));
    for (Eigen::Index k = 0; k < right.size(); ++k) {
      const auto c = static_cast<std::size_t>(made_of[static_cast<std::size_t>(k)]);
      right[k] = graph.is_free(c) ? gradient[c] : 0;
    }
    const Eigen::VectorXd inverse = w.ldlt().solve(right);
    double expected_product = 0;
    auto expected = gradient;
    for (Eigen::Index k = 0; k < right.size(); ++k)
      expected[static_cast<std::size_t>(made_of[static_cast<std::size_t>(k)])] = inverse[k];
    // Rounding, times the condition of at most 10/epsilon.
    const double rounding =
        1e-15 * 10 / kEpsilon * std::max(1.0, inverse.lpNorm<Eigen::Infinity>());
    for (std::size_t c = 0; c < graph.count(); ++c) {
      if (!graph.is_free(c)) expected[c] = 0;
      EXPECT_NEAR(solved[c], expected[c], rounding) << c;
      expected_product += expected[c] * gradient[c];
    }
    EXPECT_NEAR(product, expected_product, static_cast<double>(graph.count()) * rounding);
  }
}

TEST(Projection, OfDuplicateContactsHasOneVelocityAndTheirImpulsesAddUp) {
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    SCOPED_TRACE(i);
    auto problem = random_problem<2>(random);
    const auto once = answer_of(kSolverMethods[0], problem, 1e-12);
    // Each contact in two halves.
    const auto contacts = problem.contacts.size();
    for (std::size_t c = 0; c < contacts; ++c) {
      problem.contacts[c].gamma /= 2;
      problem.contacts.push_back(problem.contacts[c]);
    }
    for (const auto& row : kSolverMethods) {
      const auto twice = answer_of(row, problem, 1e-12);
      // As above: the conditions to 1e-12, times the condition.
      EXPECT_LE((once.displacements - twice.displacements).lpNorm<Eigen::Infinity>(), 1e-7)
          << row.name;
    }
  }
}

TEST(Projection, HasVelocitiesThatDoNotDependOnTheGuess) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    auto problem = random_problem<3>(random);
    const auto dense = problem.dense();
    for (const auto& row : kSolverMethods) {
      const auto first = answer_of(row, problem, 1e-11);
      for (auto& contact : problem.contacts) contact.impulse = random.uniform(-20, 20);
      const auto second = answer_of(row, problem, 1e-11);
      EXPECT_LE(square_distance(dense, first.displacements, second.displacements),
                bound_by_convexity(dense, first.impulses, second.impulses, 2e-11))
          << row.name;
      EXPECT_LE((first.displacements - second.displacements).lpNorm<Eigen::Infinity>(), 1e-6)
          << row.name;
    }
  }
}

TEST(Projection, LeavesAConvergedGuessAsItIs) {
  Random random(6);
  for (int i = 0; i < 50; ++i) {
    auto problem = random_problem<2>(random);
    for (const auto& row : kSolverMethods) {
      const auto answer = answer_of(row, problem, 1e-9);
      auto again = problem;
      for (std::size_t c = 0; c < again.contacts.size(); ++c)
        again.contacts[c].impulse = answer.impulses[static_cast<Eigen::Index>(c)];
      // Twice the tolerance: the guess is rounded.
      EXPECT_EQ(answer_of(row, again, 2e-9).solved.iterations, 0) << row.name;
    }
  }
}

TEST(Projection, OfNoContactsIsDone) {
  for (const auto& row : kSolverMethods) {
    const Problem<2> problem{{}, {1, 2}, {1}};
    const auto answer = answer_of(row, problem, 1e-9);
    EXPECT_EQ(answer.solved.iterations, 0);
    EXPECT_EQ(answer.solved.residual, 0);
  }
}

TEST(Projection, ThatCannotBeSaysSo) {
  // Two planes that overlap at the disc: no displacement is on the free side of both.
  for (const auto& row : kSolverMethods) {
    Problem<2> problem{{}, {0, 0}, {1}};
    for (const double side : {1.0, -1.0}) {
      Contact<2> contact;
      contact.normal = {side, 0};
      contact.gap = -0.1;
      contact.allowed = 1e-6;
      problem.contacts.push_back(contact);
    }
    ThreadPool pool(1);
    ContactGraph<2> graph(problem.contacts, problem.displacements, problem.mobilities, pool);
    ActiveSetFactor<2> factor;
    const auto solved = row.discs(graph, 1000, factor);
    // In the middle each is violated by 0.1; nowhere both by less. The impulses are then about
    // 1e4 or more, of which the regularisation (1e-14) makes a gap.
    EXPECT_GE(solved.residual * 1e-6, 0.1 * (1 - 1e-6)) << row.name;
    EXPECT_LE(solved.iterations, 1003) << row.name;
    for (const double z : graph.z) EXPECT_TRUE(std::isfinite(z)) << row.name;
  }
}

}  // namespace
}  // namespace viscontact::particles
