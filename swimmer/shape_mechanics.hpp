// The mechanics of spheres on a line that change their distances, in a fluid without inertia
// (docs/physics.md, section 7).
#pragma once

#include <Eigen/Core>
#include <cassert>
#include <vector>

#include "viscontact/swimmer/resistance/resistance_fit.hpp"

namespace viscontact::swimmer {

/// The quantities that determine the motion and the power at one shape, which is the list of all
/// arms (Najafi & Golestanian 2004, Phys. Rev. E 69, 062901; Alouges, DeSimone & Lefebvre 2008, J.
/// Nonlinear Sci. 18, 277). Arm x_k is the distance of the centres of spheres k and k + 1. R_ij(x)
/// [M/T] is the force of sphere i on the fluid per velocity of sphere j. The velocity of sphere i
/// is U_i = V + sum_k B_ik dx_k/dt, where V is the velocity of the middle sphere, and the total
/// force vanishes, sum_ij R_ij U_j = 0. Therefore
///
///   V = sum_k A_k(x) dx_k/dt,   power = sum_kl Phi_kl(x) dx_k/dt dx_l/dt.
///
/// B_ik is 1 if arm k is between the middle sphere and a sphere i with a larger number, -1 if it is
/// between the middle sphere and a sphere i with a smaller number, and 0 otherwise. The
/// displacement of a closed stroke is the integral of A along its loop, at whatever velocity it is
/// run.
struct ShapeMechanics {
  Eigen::RowVectorXd displacement_form;  ///< A [1]: velocity of the middle sphere per arm velocity
  Eigen::MatrixXd metric;                ///< Phi [M/T], symmetric and positive definite
  /// The velocities of all spheres are U = motion * dx/dt. `motion` [1] has a row for each sphere
  /// and a column for each arm.
  Eigen::MatrixXd motion;
  Eigen::MatrixXd resistance;  ///< R [M/T], symmetric and positive definite
  /// Drag per velocity of the swimmer with fixed arms, sum_ij R_ij [M/T].
  double towing_resistance = 0;
  // The derivatives by each arm, in the order of the arms; empty if `with_slopes` was false.
  std::vector<Eigen::RowVectorXd> displacement_form_slopes;  ///< dA/dx_k [1/L]
  std::vector<Eigen::MatrixXd> metric_slopes;                ///< dPhi/dx_k [M/(L T)]
};

/// Index of the middle sphere, from 0; if the number of spheres is even, of the first of the two in
/// the middle.
inline std::size_t middle_sphere(std::size_t spheres) {
  assert(spheres > 0);
  return (spheres - 1) / 2;
}

/// The mechanics of a swimmer as a function of its shape, in the units of the fit.
class Swimmer {
 public:
  explicit Swimmer(const ResistanceFit& fit) : resistance_(fit) {}

  Eigen::Index arms() const { return static_cast<Eigen::Index>(radii().size()) - 1; }
  /// The radii of the spheres along the line [L].
  const std::vector<double>& radii() const { return resistance_.radii(); }

  /// The smallest and the largest length of arm k, from 0, in the table [L]. Throws
  /// std::out_of_range if there is no arm k.
  std::array<double, 2> arm_interval(Eigen::Index k) const;

  /// True if the table contains the shape with these arms [L], up to a relative 1e-12 of the gaps
  /// for rounding.
  bool contains(const Eigen::VectorXd& arms) const;

  /// The mechanics at a shape [L], with derivatives if `with_slopes` is true. Throws
  /// Error(kBadInput) if the table does not contain the shape.
  ShapeMechanics at(const Eigen::VectorXd& arms, bool with_slopes = false) const;

 private:
  /// The gaps [L] between the surfaces of neighbours, which are the arms minus two radii.
  std::vector<double> gaps_of(const Eigen::VectorXd& arms) const;

  FittedResistance resistance_;
};

/// The curl dA_2/dx_1 - dA_1/dx_2 [1/L] at a shape of a swimmer with two arms. It is the
/// displacement of a small loop, counter-clockwise in the plane (x_1, x_2), divided by the area of
/// the loop. Throws Error(kBadInput) if the table does not contain the shape.
double displacement_curl(const Swimmer& swimmer, const Eigen::VectorXd& arms);

}  // namespace viscontact::swimmer
