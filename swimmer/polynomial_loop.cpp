// All three quadratures have 2 n + 24 points for n polynomials.
#include "viscontact/swimmer/polynomial_loop.hpp"

#include <cassert>
#include <cmath>

#include "viscontact/common/matrices/decompositions.hpp"

namespace viscontact::swimmer {
namespace {

using Eigen::Index;

/// The arms [L] where the polynomials have the values `basis`.
Eigen::VectorXd shape_at(const PolynomialLoop& loop, const Eigen::VectorXd& basis) {
  return loop.through + loop.coefficients * basis;
}

}  // namespace

LoopBasis loop_basis(double s, Index count) {
  assert(count > 0);
  // Legendre's polynomials P_j(y) by the three-term recurrence, and their derivatives by s from
  // P'_{j+1} = P'_{j-1} + (2j + 1) P_j and dy/ds = 2.
  const double y = 2 * s - 1;
  Eigen::VectorXd p(count), dp(count), ddp(count);
  for (Index j = 0; j < count; ++j) {
    const auto n = static_cast<double>(j);
    p[j] = j == 0 ? 1 : j == 1 ? y : ((2 * n - 1) * y * p[j - 1] - (n - 1) * p[j - 2]) / n;
    dp[j] = (j < 2 ? 0 : dp[j - 2]) + (j == 0 ? 0 : 2 * (2 * n - 1) * p[j - 1]);
    ddp[j] = (j < 2 ? 0 : ddp[j - 2]) + (j == 0 ? 0 : 2 * (2 * n - 1) * dp[j - 1]);
  }
  const double bubble = s * (1 - s);
  return {bubble * p, bubble * dp - y * p, bubble * ddp - 2 * y * dp - 2 * p};
}

Stroke stroke_of(const PolynomialLoop& loop, double period) {
  assert(period > 0);
  return {
      period,
      {{0, period, [=](double time) {
          const auto basis = loop_basis(time / period, loop.coefficients.cols());
          return ArmState{shape_at(loop, basis.values), loop.coefficients * basis.slopes / period};
        }}}};
}

PolynomialLoop with_more_polynomials(const PolynomialLoop& loop, Index count) {
  assert(count >= loop.coefficients.cols());
  PolynomialLoop longer{loop.through, Eigen::MatrixXd::Zero(loop.coefficients.rows(), count)};
  longer.coefficients.leftCols(loop.coefficients.cols()) = loop.coefficients;
  return longer;
}

LoopFunctional::LoopFunctional(const Swimmer& swimmer, Index polynomials) : swimmer_(swimmer) {
  assert(polynomials > 0);
  // The rule is exact for polynomials of a degree below twice its number of points. The integrands
  // are not polynomials but analytic functions of a loop, whose degree is `polynomials` + 1; the 24
  // additional points make their error small.
  const auto rule = gauss_rule(static_cast<int>(2 * polynomials + 24));
  points_ = rule.points;
  weights_ = rule.weights;
  values_.resize(polynomials, points_.size());
  slopes_.resize(polynomials, points_.size());
  for (Index q = 0; q < points_.size(); ++q) {
    const auto basis = loop_basis(points_[q], polynomials);
    values_.col(q) = basis.values;
    slopes_.col(q) = basis.slopes;
  }
}

bool LoopFunctional::contains(const PolynomialLoop& loop) const {
  assert(loop.coefficients.cols() == values_.rows());
  for (Index q = 0; q < points_.size(); ++q)
    if (!swimmer_.contains(shape_at(loop, values_.col(q)))) return false;
  return true;
}

double LoopFunctional::displacement(const PolynomialLoop& loop) const {
  assert(loop.coefficients.cols() == values_.rows());
  double sum = 0;
  for (Index q = 0; q < points_.size(); ++q) {
    const auto mechanics = swimmer_.at(shape_at(loop, values_.col(q)));
    sum += weights_[q] * mechanics.displacement_form.dot(loop.coefficients * slopes_.col(q));
  }
  return sum;
}

LoopSums LoopFunctional::operator()(const PolynomialLoop& loop) const {
  const auto& c = loop.coefficients;
  assert(c.cols() == values_.rows());
  Eigen::MatrixXd energy_gradient = Eigen::MatrixXd::Zero(c.rows(), c.cols());
  Eigen::MatrixXd displacement_gradient = energy_gradient;
  LoopSums sums;
  for (Index q = 0; q < points_.size(); ++q) {
    const auto mechanics = swimmer_.at(shape_at(loop, values_.col(q)), true);
    const Eigen::VectorXd rate = c * slopes_.col(q);
    const Eigen::VectorXd impulse = mechanics.metric * rate;
    sums.energy_times_period += weights_[q] * rate.dot(impulse);
    sums.displacement += weights_[q] * mechanics.displacement_form.dot(rate);
    Eigen::VectorXd energy_slope(c.rows()), displacement_slope(c.rows());
    for (Index k = 0; k < c.rows(); ++k) {
      const auto arm = static_cast<std::size_t>(k);
      energy_slope[k] = rate.dot(mechanics.metric_slopes[arm] * rate);
      displacement_slope[k] = mechanics.displacement_form_slopes[arm].dot(rate);
    }
    energy_gradient += weights_[q] * (2 * impulse * slopes_.col(q).transpose() +
                                      energy_slope * values_.col(q).transpose());
    displacement_gradient +=
        weights_[q] * (mechanics.displacement_form.transpose() * slopes_.col(q).transpose() +
                       displacement_slope * values_.col(q).transpose());
  }
  sums.energy_gradient = energy_gradient.reshaped();
  sums.displacement_gradient = displacement_gradient.reshaped();
  return sums;
}

Eigen::MatrixXd LoopFunctional::constant_metric_hessian(const Eigen::MatrixXd& metric) const {
  const Eigen::MatrixXd stiffness = slopes_ * weights_.asDiagonal() * slopes_.transpose();
  const Index arms = metric.rows(), count = stiffness.rows();
  Eigen::MatrixXd hessian(arms * count, arms * count);
  for (Index i = 0; i < count; ++i)
    for (Index j = 0; j < count; ++j)
      hessian.block(i * arms, j * arms, arms, arms) = 2 * stiffness(i, j) * metric;
  return hessian;
}

PolynomialLoop project_loop(const std::function<Eigen::VectorXd(double s)>& shape,
                            Index polynomials) {
  assert(polynomials > 0);
  const auto rule = gauss_rule(static_cast<int>(2 * polynomials + 24));
  const Eigen::VectorXd through = shape(0);
  Eigen::MatrixXd basis(rule.points.size(), polynomials);
  Eigen::MatrixXd target(rule.points.size(), through.size());
  for (Index q = 0; q < rule.points.size(); ++q) {
    const double root = std::sqrt(rule.weights[q]);
    basis.row(q) = root * loop_basis(rule.points[q], polynomials).values.transpose();
    target.row(q) = root * (shape(rule.points[q]) - through).transpose();
  }
  return {through, basis.householderQr().solve(target).transpose()};
}

double euler_lagrange_residual(const Swimmer& swimmer, const PolynomialLoop& loop, double eta) {
  const auto& c = loop.coefficients;
  const auto rule = gauss_rule(static_cast<int>(2 * c.cols() + 24));
  double left_over = 0, scale = 0;
  for (Index q = 0; q < rule.points.size(); ++q) {
    const auto basis = loop_basis(rule.points[q], c.cols());
    const auto mechanics = swimmer.at(shape_at(loop, basis.values), true);
    const Eigen::VectorXd rate = c * basis.slopes, acceleration = c * basis.second_slopes;
    const Eigen::VectorXd inertial = 2 * mechanics.metric * acceleration;
    Eigen::VectorXd rest = inertial;
    for (Index k = 0; k < rate.size(); ++k) {
      const auto& metric_slope = mechanics.metric_slopes[static_cast<std::size_t>(k)];
      const auto& form_slope = mechanics.displacement_form_slopes[static_cast<std::size_t>(k)];
      rest += 2 * rate[k] * metric_slope * rate - eta * rate[k] * form_slope.transpose();
      rest[k] += eta * form_slope.dot(rate) - rate.dot(metric_slope * rate);
    }
    left_over += rule.weights[q] * rest.squaredNorm();
    scale += rule.weights[q] * inertial.squaredNorm();
  }
  return std::sqrt(left_over / scale);
}

}  // namespace viscontact::swimmer
