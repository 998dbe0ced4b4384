// Closed loops of a swimmer's arms that are polynomials of a parameter s, with their displacement
// and energy as functions of the coefficients.
#pragma once

#include <Eigen/Core>

#include "viscontact/swimmer/shape_mechanics.hpp"
#include "viscontact/swimmer/stroke.hpp"

namespace viscontact::swimmer {

/// The loop of the arms x(s) = through + s (1 - s) sum_j c_j P_j(2 s - 1), where the parameter s
/// goes from 0 to 1, P_j are Legendre's polynomials, and c_j is column j of `coefficients` [L]. The
/// loop may have a corner at `through`.
struct PolynomialLoop {
  Eigen::VectorXd through;       ///< shape at which the loop begins and ends [L]
  Eigen::MatrixXd coefficients;  ///< [L], a row for each arm, at least one column
};

/// The values of s (1 - s) P_j(2 s - 1) for j = 0, 1, ... and their derivatives by s, all [1].
struct LoopBasis {
  Eigen::VectorXd values, slopes, second_slopes;
};
/// The first `count` functions of the basis at `s` from 0 to 1.
LoopBasis loop_basis(double s, Eigen::Index count);

/// The loop as a stroke of one leg, run once in `period` [T] at a constant rate of s.
Stroke stroke_of(const PolynomialLoop& loop, double period);

/// The same loop with `count` polynomials, at least as many as it has; the coefficients of the
/// others are 0.
PolynomialLoop with_more_polynomials(const PolynomialLoop& loop, Eigen::Index count);

/// Energy and displacement of a loop that is run once at a constant rate of s, and their gradients.
/// A gradient has the derivative by each coefficient, in the order of PolynomialLoop::coefficients,
/// column by column.
struct LoopSums {
  /// Energy times period [M L^2/T], >= 0. It does not depend on the period, so that its value is
  /// that of the energy [M L^2/T^2] in a period of 1.
  double energy_times_period = 0;
  double displacement = 0;  ///< [L], > 0 towards the last sphere
  Eigen::VectorXd energy_gradient, displacement_gradient;
};

/// Computes LoopSums by a quadrature with 2 n + 24 points for n polynomials. The gradients are the
/// derivatives of the quadrature sums to round-off.
class LoopFunctional {
 public:
  /// For loops with `polynomials` > 0 polynomials of each arm. `swimmer` must outlive the object.
  LoopFunctional(const Swimmer& swimmer, Eigen::Index polynomials);

  /// True if the table of the swimmer's fit contains the shapes of the loop at all points of the
  /// quadrature.
  bool contains(const PolynomialLoop& loop) const;

  /// The displacement alone [L]. Throws Error(kBadInput) if the table does not contain the loop.
  double displacement(const PolynomialLoop& loop) const;

  /// The sums of the loop. Throws Error(kBadInput) if the table does not contain the loop.
  LoopSums operator()(const PolynomialLoop& loop) const;

  /// The Hessian [M/T] of the integral of (dx/ds)^T G0 dx/ds over s by the coefficients, in the
  /// order of LoopSums, for the constant symmetric matrix G0 = `metric` [M/T]. The search for the
  /// optimal stroke scales the coefficients by it.
  Eigen::MatrixXd constant_metric_hessian(const Eigen::MatrixXd& metric) const;

 private:
  const Swimmer& swimmer_;
  Eigen::VectorXd points_, weights_;
  Eigen::MatrixXd values_, slopes_;  ///< a column for each point
};

/// The loop through shape(0) that approximates the given loop `shape(s)`, s from 0 to 1, best in
/// the sense of least squares, with `polynomials` polynomials of each arm.
PolynomialLoop project_loop(const std::function<Eigen::VectorXd(double s)>& shape,
                            Eigen::Index polynomials);

/// The residual of Euler and Lagrange's equation of the problem "least energy at a given
/// displacement" (docs/physics.md (7.7)): the root mean square along the loop of d/ds (2 Phi v -
/// eta A) - grad_x (v.Phi v - eta A.v), divided by that of 2 Phi dv/ds [1]. Here x are the arms, v
/// = dx/ds, `eta` is the multiplier of the displacement [M L/T^2] (OptimalStroke), and A and Phi
/// are displacement_form and metric of ShapeMechanics. Throws Error(kBadInput) if the table does
/// not contain the loop. It is NaN or infinite if the second derivative of the arms is 0
/// everywhere.
double euler_lagrange_residual(const Swimmer& swimmer, const PolynomialLoop& loop, double eta);

}  // namespace viscontact::swimmer
