// A swimmer made of spheres on a line that changes its arms, the distances between the centres of
// neighbours, in a fluid without inertia (Najafi & Golestanian 2004, Phys. Rev. E 69, 062901;
// Alouges, DeSimone & Lefebvre 2008, J. Nonlinear Sci. 18, 277; physics.md, section 7). Lengths,
// masses and times are in the units of the fit. Strokes (swim.hpp) and the search for the best one
// (optimal_stroke.hpp) use it. A shape outside the table throws Error(kBadInput). A change must
// keep that the total force is 0, and that metric_slopes and displacement_form_slopes are the
// derivatives.
//
// x_k is the arm between spheres k and k + 1. With the resistance matrix R(x), the spheres move at
// U_i = V + sum_k B_ik dx_k/dt, where V is the velocity of the middle sphere. The total force
// vanishes, sum_ij R_ij U_j = 0, so that
//
//   V = sum_k A_k(x) dx_k/dt,   power = sum_kl Phi_kl(x) dx_k/dt dx_l/dt.
//
// B_ik is 1 if arm k is between the middle sphere and a sphere i with a larger number, -1 if it is
// between the middle sphere and a sphere i with a smaller number, else 0. The displacement of a
// closed stroke is the integral of A along its loop, and does not depend on the velocity at which
// the loop is run.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "viscontact/swimmer/resistance/resistance_fit.hpp"

namespace viscontact::swimmer {

/// What determines the motion and the power at one shape: A, Phi and R.
struct ShapeMechanics {
  Eigen::RowVectorXd displacement_form;  ///< A [1]: velocity of the middle sphere per arm velocity
  Eigen::MatrixXd metric;                ///< Phi [M/T], symmetric and positive definite
  /// U = motion * dx/dt: velocities of all spheres per arm velocity [1], a row for each sphere and
  /// a column for each arm; A and Phi have a column for each arm.
  Eigen::MatrixXd motion;
  Eigen::MatrixXd resistance;  ///< R [M/T], symmetric and positive definite
  /// sum_ij R_ij [M/T], > 0: the drag of the swimmer with fixed arms per velocity.
  double towing_resistance = 0;
  // Derivatives by each arm, in their order; empty if they were not asked for.
  std::vector<Eigen::RowVectorXd> displacement_form_slopes;  ///< dA/dx_k [1/L]
  std::vector<Eigen::MatrixXd> metric_slopes;                ///< dPhi/dx_k [M/(L T)]
};

/// Index of the middle sphere, from 0; of an even number of spheres, the first of the two. There is
/// at least one sphere (not checked).
inline std::size_t middle_sphere(std::size_t spheres) { return (spheres - 1) / 2; }

/// The mechanics of a swimmer as a function of its shape.
class Swimmer {
 public:
  /// The swimmer of the spheres of `fit`, which need not outlive the object.
  explicit Swimmer(const ResistanceFit& fit) : resistance_(fit) {}

  /// Number of arms, one less than there are spheres.
  Eigen::Index arms() const { return static_cast<Eigen::Index>(radii().size()) - 1; }
  /// The radii of the spheres along the line [L], > 0.
  const std::vector<double>& radii() const { return resistance_.radii(); }

  /// The smallest and the largest length of arm k, from 0, in the table [L], > 0. Throws
  /// std::out_of_range if there is no arm k.
  std::array<double, 2> arm_interval(Eigen::Index k) const;

  /// True if the table contains the shape with these arms [L], arms() numbers (not checked).
  bool contains(const Eigen::VectorXd& arms) const;

  /// The mechanics at a shape, with derivatives if `with_slopes`. Throws Error(kBadInput) if the
  /// table does not contain the shape.
  ShapeMechanics at(const Eigen::VectorXd& arms, bool with_slopes = false) const;

 private:
  std::vector<double> gaps_of(const Eigen::VectorXd& arms) const;

  FittedResistance resistance_;
};

/// dA_2/dx_1 - dA_1/dx_2 [1/L] at a shape of a swimmer with two arms: the displacement of a small
/// loop, counter-clockwise in (x_1, x_2), over its area. Throws Error(kBadInput) if the table does
/// not contain the shape. That there are two arms is not checked.
double displacement_curl(const Swimmer& swimmer, const Eigen::VectorXd& arms);

}  // namespace viscontact::swimmer
