// Polynomials of several variables that interpolate values on a grid, with their derivatives.
// resistance_fit.hpp uses them. Numbers have any dimension; nothing is checked or thrown. A change
// must keep that the values at the nodes are met exactly.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace viscontact::swimmer {

/// Barycentric weights of nodes: w_j = 1 / prod_{i != j} (t_j - t_i), scaled so that the largest is
/// 1 (Berrut & Trefethen 2004, SIAM Review 46, 501, equation (3.2)), one for each node. The nodes
/// must differ.
Eigen::VectorXd barycentric_weights(const Eigen::VectorXd& nodes);

/// The polynomial that has given vectors as values at all combinations of the nodes of each
/// variable. Its degree in a variable is one less than the number of that variable's nodes.
class TensorPolynomial {
 public:
  /// `nodes[k]` are the nodes of variable k. A column of `values` belongs to each combination of
  /// nodes; the last variable changes fastest.
  TensorPolynomial(const std::vector<Eigen::VectorXd>& nodes, const Eigen::MatrixXd& values);

  /// The values at a point, which has a number for each variable, in column 0; their derivatives by
  /// variable k in column 1 + k.
  Eigen::MatrixXd operator()(std::span<const double> point) const;

 private:
  std::vector<Eigen::VectorXd> nodes_, weights_;
  /// The values and, below them, the derivatives by each variable, at all combinations of nodes.
  Eigen::MatrixXd values_;
  Eigen::Index size_ = 0;  ///< number of values
};

}  // namespace viscontact::swimmer
