// The equations of a sphere whose film resists (physics.md (4.8), (4.9)) as CVODE integrates them.
// Until the solids touch, the gap follows s = ln(q/r), whose equation is that of
// inertial_equation.hpp; in contact it is constant.
#pragma once

#include <array>
#include <span>

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/integration/cvode.hpp"
#include "viscontact/reduced_model/models/inertial_equation.hpp"
#include "viscontact/reduced_model/rolling/rolling_resistance.hpp"

namespace viscontact::reduced_model {

/// The components of the state: s, u - V, w, x and the angle.
enum RollingState : std::size_t { kLogGap, kMove, kTurn, kPosition, kAngle, kStates };
/// The state y of the sphere, in the order of RollingState.
using RollingStateVector = std::array<double, kStates>;

/// What the solids of sphere and plane do at present.
struct SolidState {
  bool touches = false;  ///< true: the gap is constant
  /// How the solids move along each other; kNone if they do not touch.
  SolidContact contact = SolidContact::kNone;
  double sliding_direction = 0;  ///< the sign of the slip while the sphere slides
};

/// The right-hand side for the present SolidState. `motion` and `fit` must outlive the object.
class RollingEquation {
 public:
  /// Solids touch at the gap `contact_gap` [L]; 0: they never touch. Throws Error(kBadInput) if
  /// the sphere starts above the interval of gaps of `fit`.
  RollingEquation(const RollingMotion& motion, const lubrication::PairFit& fit, double contact_gap);

  /// The state at time 0.
  RollingStateVector initial_state() const;
  /// The gap q in the state `y` [L], > 0.
  double gap_of(std::span<const double> y) const;
  /// dq/dt [L/T] at time t.
  double normal_velocity(double t, std::span<const double> y) const;
  double contact_force() const;                            ///< of the solids along z, >= 0
  double friction_force(std::span<const double> y) const;  ///< of the solids along x
  double slip(std::span<const double> y) const;            ///< of the lowest point [L/T]
  /// 1/m + r^2/I: how much a friction force accelerates the lowest point.
  double compliance() const;
  /// True if Coulomb's friction can keep the slip at 0. If not, sets the direction of sliding.
  bool can_roll(std::span<const double> y);

  /// For CVODE. `step_begin` is the time at which its present step begins.
  StiffSystem system(const double& step_begin) const;

  /// r of the sphere [L], > 0.
  double radius() const { return radius_; }

  /// What the solids do at present. Callers change it between two steps of CVODE.
  SolidState solids;

 private:
  RollingForce free_force(std::span<const double> y) const;
  double slip_rate(std::span<const double> y) const;
  void derivative(std::span<const double> y, std::span<double> f) const;
  void jacobian(std::span<const double> y, std::span<double> j) const;
  void tolerance(std::span<const double> y, std::span<double> allowed) const;

  const RollingMotion& motion_;
  RollingFluid fluid_;
  double radius_, contact_gap_;
  Motion normal_;
  lubrication::LubricationForce squeeze_;
  InertialEquation gap_equation_;
};

}  // namespace viscontact::reduced_model
