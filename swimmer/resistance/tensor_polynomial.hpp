// Polynomials of several variables that interpolate values on a grid, with their derivatives.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace viscontact::swimmer {

/// The barycentric weights w_j = 1 / prod_{i != j} (t_j - t_i) of the nodes t_j, which all differ,
/// scaled so that the largest size of a weight is 1 (Berrut & Trefethen 2004, SIAM Review 46, 501,
/// equation (3.2)).
Eigen::VectorXd barycentric_weights(const Eigen::VectorXd& nodes);

/// The polynomial that has given vectors as values at all combinations of the nodes of each
/// variable. Its degree in a variable is one less than the number of that variable's nodes.
class TensorPolynomial {
 public:
  /// `nodes[k]` are the nodes of variable k, all different. `values` has a column for each
  /// combination of nodes, of which the last variable changes fastest, and a row for each component
  /// of the vectors.
  TensorPolynomial(const std::vector<Eigen::VectorXd>& nodes, const Eigen::MatrixXd& values);

  /// The polynomial at a point, which has a number for each variable; it is extrapolated outside
  /// the nodes. Column 0 of the result has the values, exactly those given at the nodes, and column
  /// 1 + k their derivatives by variable k.
  Eigen::MatrixXd operator()(std::span<const double> point) const;

 private:
  std::vector<Eigen::VectorXd> nodes_, weights_;
  /// The values and, below them, the derivatives by each variable, at all combinations of nodes.
  Eigen::MatrixXd values_;
  Eigen::Index size_ = 0;
};

}  // namespace viscontact::swimmer
