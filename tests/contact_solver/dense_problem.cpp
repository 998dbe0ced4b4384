#include "tests/contact_solver/dense_problem.hpp"

#include <algorithm>
#include <vector>

namespace viscontact::contact_solver {
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

}  // namespace

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

}  // namespace viscontact::contact_solver
