// Polynomials of several variables that interpolate values on a grid, with their derivatives.
// resistance_fit.hpp and swimmer/fit use them to fit resistance matrices. Numbers have any
// dimension. Nothing is checked or thrown: sizes that do not fit together give undefined results. A
// change must keep that the polynomial has exactly the given values at the nodes.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace viscontact::swimmer {

/// The barycentric weights w_j = 1 / prod_{i != j} (t_j - t_i) of the nodes t_j, one for each node,
/// scaled so that the largest size of a weight is 1 (Berrut & Trefethen 2004, SIAM Review 46, 501,
/// equation (3.2)). There must be at least one node, and all nodes must differ (not checked).
Eigen::VectorXd barycentric_weights(const Eigen::VectorXd& nodes);

/// The polynomial that has given vectors as values at all combinations of the nodes of each
/// variable. Its degree in a variable is one less than the number of that variable's nodes.
class TensorPolynomial {
 public:
  /// `nodes[k]` are the nodes of variable k, at least one, all different. `values` has a column for
  /// each combination of nodes, of which the last variable changes fastest, and a row for each
  /// component of the vectors.
  TensorPolynomial(const std::vector<Eigen::VectorXd>& nodes, const Eigen::MatrixXd& values);

  /// The polynomial at a point, which has a number for each variable. Column 0 of the result has
  /// the values, and column 1 + k their derivatives by variable k. Outside the nodes the polynomial
  /// is extrapolated.
  Eigen::MatrixXd operator()(std::span<const double> point) const;

 private:
  std::vector<Eigen::VectorXd> nodes_, weights_;
  /// The values and, below them, the derivatives by each variable, at all combinations of nodes.
  Eigen::MatrixXd values_;
  Eigen::Index size_ = 0;  ///< number of values
};

}  // namespace viscontact::swimmer
