// The barycentric formula in each variable.
#include "viscontact/swimmer/resistance/tensor_polynomial.hpp"

#include <cassert>
#include <cmath>

namespace viscontact::swimmer {
namespace {

/// The matrix that maps the values at the nodes to the derivatives at the nodes (Berrut & Trefethen
/// 2004, section 9.3). `weights` are barycentric_weights(nodes).
Eigen::MatrixXd differentiation_matrix(const Eigen::VectorXd& nodes,
                                       const Eigen::VectorXd& weights) {
  const auto count = nodes.size();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      if (i != j) {
        matrix(i, j) = weights[j] / weights[i] / (nodes[i] - nodes[j]);
        matrix(i, i) -= matrix(i, j);
      }
  return matrix;
}

/// The values at x, one for each node, of the polynomials that are 1 at this node and 0 at all
/// other nodes.
Eigen::VectorXd basis_at(double x, const Eigen::VectorXd& nodes, const Eigen::VectorXd& weights) {
  Eigen::VectorXd basis(nodes.size());
  for (Eigen::Index i = 0; i < nodes.size(); ++i) {
    if (x == nodes[i]) return Eigen::VectorXd::Unit(nodes.size(), i);
    basis[i] = weights[i] / (x - nodes[i]);
  }
  return basis / basis.sum();
}

/// The derivatives by variable k, at all combinations of nodes, of the polynomial with these
/// `values` at them. `matrix` is the differentiation matrix of variable k.
Eigen::MatrixXd derivative_by(std::size_t k, const std::vector<Eigen::VectorXd>& nodes,
                              const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& values) {
  // A combination of nodes has the number (outer * nodes[k].size() + i) * inner + rest.
  Eigen::Index inner = 1;
  for (std::size_t later = k + 1; later < nodes.size(); ++later) inner *= nodes[later].size();
  const auto count = nodes[k].size();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(values.rows(), values.cols());
  for (Eigen::Index column = 0; column < values.cols(); ++column) {
    const auto i = column / inner % count;
    for (Eigen::Index j = 0; j < count; ++j)
      result.col(column) += matrix(i, j) * values.col(column + (j - i) * inner);
  }
  return result;
}

}  // namespace

Eigen::VectorXd barycentric_weights(const Eigen::VectorXd& nodes) {
  assert(nodes.size() > 0);
  // With logarithms the products do not underflow if there are many nodes.
  Eigen::VectorXd logarithms = Eigen::VectorXd::Zero(nodes.size()), signs = logarithms;
  for (Eigen::Index j = 0; j < nodes.size(); ++j) {
    signs[j] = 1;
    for (Eigen::Index i = 0; i < nodes.size(); ++i)
      if (i != j) {
        logarithms[j] -= std::log(std::abs(nodes[j] - nodes[i]));
        if (nodes[j] < nodes[i]) signs[j] = -signs[j];
      }
  }
  return signs.array() * (logarithms.array() - logarithms.maxCoeff()).exp();
}

TensorPolynomial::TensorPolynomial(const std::vector<Eigen::VectorXd>& nodes,
                                   const Eigen::MatrixXd& values)
    : nodes_(nodes), size_(values.rows()) {
  const auto variables = static_cast<Eigen::Index>(nodes.size());
  values_.resize(size_ * (1 + variables), values.cols());
  values_.topRows(size_) = values;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    weights_.push_back(barycentric_weights(nodes[k]));
    values_.middleRows(size_ * (1 + static_cast<Eigen::Index>(k)), size_) =
        derivative_by(k, nodes, differentiation_matrix(nodes[k], weights_[k]), values);
  }
}

Eigen::MatrixXd TensorPolynomial::operator()(std::span<const double> point) const {
  assert(point.size() == nodes_.size());
  Eigen::VectorXd basis = Eigen::VectorXd::Ones(1);
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto factor = basis_at(point[k], nodes_[k], weights_[k]);
    Eigen::MatrixXd product = factor * basis.transpose();  // its columns, one after the other
    basis = product.reshaped();
  }
  const Eigen::VectorXd all = values_ * basis;
  return all.reshaped(size_, static_cast<Eigen::Index>(nodes_.size()) + 1);
}

}  // namespace viscontact::swimmer
