// Closed loops of the shape of a swimmer, whose arms are polynomials of a parameter, and their
// displacement and energy as functions of the coefficients. A swimmer is a line of spheres; its
// shape is the list of its arms, the distances between the centres of neighbours.
// optimal_stroke.hpp uses this file to find the loop of least energy. Lengths, masses and times are
// in the units of the swimmer's fit. A loop outside the table throws Error(kBadInput). Sizes and
// numbers of polynomials are not checked. A change must keep the gradients equal to the derivatives
// of the quadrature sums, to round-off; the 24 additional points of the quadrature are a free
// choice, on which the last digits of results depend.
#pragma once

#include <Eigen/Core>

#include "viscontact/swimmer/shape_mechanics.hpp"
#include "viscontact/swimmer/stroke.hpp"

namespace viscontact::swimmer {

/// The loop of the arms x(s) = through + s (1 - s) sum_j c_j P_j(2 s - 1), where the parameter s
/// goes from 0 to 1, P_j are Legendre's polynomials, and c_j is column j of `coefficients` [L]. The
/// loop may have a corner at `through`.
struct PolynomialLoop {
  Eigen::VectorXd through;       ///< shape at which the loop begins and ends [L], for each arm
  Eigen::MatrixXd coefficients;  ///< [L], a row for each arm, at least one column
};

/// The values of s (1 - s) P_j(2 s - 1) and their first and second derivatives by s. Each member
/// has a number for each j from 0 to the number of functions less one.
struct LoopBasis {
  Eigen::VectorXd values,  ///< [1]
      slopes,              ///< first derivatives [1]
      second_slopes;       ///< second derivatives [1]
};
/// The first `count` > 0 functions of the basis at `s` from 0 to 1. Nothing is checked.
LoopBasis loop_basis(double s, Eigen::Index count);

/// The loop as a stroke of one part (StrokeLeg in stroke.hpp), run once in `period` [T] > 0 (not
/// checked) at a constant rate of s.
Stroke stroke_of(const PolynomialLoop& loop, double period);

/// The same loop with `count` polynomials, at least as many as it has (not checked); the
/// coefficients of the others are 0.
PolynomialLoop with_more_polynomials(const PolynomialLoop& loop, Eigen::Index count);

/// Energy and displacement of a loop that is run once at a constant rate of s, and their gradients.
/// A gradient has the derivative by each coefficient, in the order of PolynomialLoop::coefficients,
/// column by column.
struct LoopSums {
  /// Energy times period [M L^2/T], >= 0. It does not depend on the period, so that its value is
  /// that of the energy [M L^2/T^2] in a period of 1.
  double energy_times_period = 0;
  double displacement = 0;          ///< [L], > 0 towards the last sphere
  Eigen::VectorXd energy_gradient,  ///< gradient of energy_times_period [M L/T]
      displacement_gradient;        ///< gradient of the displacement [1]
};

/// Computes LoopSums by a quadrature with 2 n + 24 points for n polynomials.
class LoopFunctional {
 public:
  /// For loops with `polynomials` > 0 polynomials of each arm. The other functions must not be
  /// called with other loops (not checked). `swimmer` must outlive the object.
  LoopFunctional(const Swimmer& swimmer, Eigen::Index polynomials);

  /// True if the table of the swimmer's fit contains the shapes of the loop at all points of the
  /// quadrature.
  bool contains(const PolynomialLoop& loop) const;

  /// The displacement alone [L]. Throws Error(kBadInput) if the table does not contain the loop.
  double displacement(const PolynomialLoop& loop) const;

  /// The sums of the loop. Throws Error(kBadInput) if the table does not contain the loop.
  LoopSums operator()(const PolynomialLoop& loop) const;

  /// The Hessian, by the coefficients, of the integral of (dx/ds)^T G0 dx/ds over s for the
  /// constant symmetric matrix G0 = `metric` [M/T], with a row for each arm. The Hessian [M/T] has
  /// a row for each coefficient, in the order of LoopSums. The search for the optimal stroke scales
  /// the coefficients by it.
  Eigen::MatrixXd constant_metric_hessian(const Eigen::MatrixXd& metric) const;

 private:
  const Swimmer& swimmer_;
  Eigen::VectorXd points_, weights_;
  Eigen::MatrixXd values_, slopes_;  ///< a column for each point
};

/// The loop through shape(0) that approximates the given loop `shape(s)`, s from 0 to 1, best in
/// the sense of least squares, with `polynomials` > 0 polynomials of each arm (not checked).
PolynomialLoop project_loop(const std::function<Eigen::VectorXd(double s)>& shape,
                            Eigen::Index polynomials);

/// The residual of Euler and Lagrange's equation of the problem "least energy at a given
/// displacement" (docs/physics.md, equation (7.7)). It is the root mean square along the loop of
/// d/ds (2 Phi v - eta A) - grad_x (v.Phi v - eta A.v), divided by that of 2 Phi dv/ds [1], >= 0.
/// Here x are the arms, v = dx/ds, `eta` is the multiplier of the displacement [M L/T^2]
/// (OptimalStroke), and A and Phi are displacement_form and metric of ShapeMechanics. Throws
/// Error(kBadInput) if the table does not contain the loop. The second derivative of the arms must
/// not be 0 everywhere (not checked; the result then is NaN or infinite).
double euler_lagrange_residual(const Swimmer& swimmer, const PolynomialLoop& loop, double eta);

}  // namespace viscontact::swimmer
