// Models of a sphere near a plane in a viscous fluid that moves in two directions and turns
// (docs/physics.md (4.8) to (4.11)).
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/motions/pair_fit.hpp"

namespace viscontact::rolling {

/// The sphere, its start, the forces that do not depend on its motion, and the surfaces, in any
/// consistent units. x is along the plane, z away from it, y the axis of rotation, and q the gap.
/// The fluid is at rest where the plane is at rest; a plane with a constant velocity carries it
/// along.
struct RollingMotion {
  double mass = 0;               ///< m [M], > 0
  double moment_of_inertia = 0;  ///< I [M L^2], > 0
  double initial_gap = 0;        ///< q0 [L], > 0
  double normal_velocity = 0;    ///< dq/dt at the start [L/T]
  double velocity = 0;           ///< dx/dt at the start [L/T]
  double angular_velocity = 0;   ///< w at the start [1/T]; a sphere with w > 0 rolls along +x
  double force = 0;              ///< constant force along x [M L/T^2]
  double normal_force = 0;       ///< constant force along z [M L/T^2]; < 0 towards the plane
  double torque = 0;             ///< constant torque about y [M L^2/T^2]
  double plane_velocity = 0;     ///< V of the plane along x [L/T]
  double roughness = 0;          ///< gap at which solids touch [L], >= 0; 0: never
  double friction = 0;           ///< Coulomb's coefficient mu_s of the solids [1], >= 0
  double end_time = 0;           ///< [T], > 0
  double time_step = 0;  ///< step of the model viscous_contact, and spacing of all rows [T], > 0
  double relative_tolerance = 1e-9;  ///< relative tolerance of the integrator CVODE [1], in (0, 1)
  StopToken stop{};
};

/// Whether the solids touch, and if so whether they roll without slip or slide.
enum class SolidContact { kNone, kRolling, kSliding };

struct RollingRow {
  double time = 0;  ///< [T]
  /// q [L]. While the model viscous_contact is in contact, it is the thickness of the film.
  double gap = 0;
  double position = 0;          ///< x [L], 0 at the start
  double angle = 0;             ///< angle turned about y [radians], 0 at the start
  double normal_velocity = 0;   ///< dq/dt [L/T]
  double velocity = 0;          ///< dx/dt [L/T]
  double angular_velocity = 0;  ///< w [1/T]
  double contact_force = 0;     ///< force of the solids along z [M L/T^2], >= 0
  double friction_force = 0;    ///< force of the solids along x [M L/T^2]
  SolidContact contact = SolidContact::kNone;
};

/// The motion of a sphere, in order of time, with at least the row of time 0.
using RollingTrajectory = std::vector<RollingRow>;

/// The model of smooth surfaces: lubrication at every gap, integrated by CVODE, with rows at the
/// multiples of motion.time_step and at the end time. `fit` has the resistances of the sphere, in
/// the units of `motion`; below its gaps the formula of the fit is continued. Throws
/// Error(kBadInput) if `fit` lacks the resistance squeeze, slide, roll or slide_roll, if squeeze is
/// not positive at every gap of `fit`, if the sphere starts at, or rises to, a gap above those of
/// `fit`, or if there are more than 1e8 rows; Error(kNotConverged) if CVODE cannot make a step;
/// Error(kInterrupted) after a stop.
RollingTrajectory roll_smooth(const RollingMotion& motion, const motions::PairFit& fit);

/// The model of rough surfaces: that of roll_smooth(), with its errors, and with solid contact and
/// Coulomb's friction at the gap motion.roughness. The sphere does not rebound from the solids.
RollingTrajectory roll_rough(const RollingMotion& motion, const motions::PairFit& fit);

/// The model of viscous contact (docs/physics.md (4.5)) along z with time steps: the film acts only
/// by the impulse that it absorbs, which determines its thickness. The solids touch, with friction,
/// when the film is as thin as the roughness. The resistances along x and to rotation are those at
/// the film thickness, or at the gap if there is no contact, at the end of the step; above the
/// largest gap of the fit they are those at the largest gap. The motion ends with the row in which
/// the sphere reaches a wall opposite (lubrication/second_wall.hpp). The error of the trajectory is
/// of first order in the time step. Throws Error(kBadInput) if the fit lacks squeeze, slide, roll
/// or slide_roll, or if there are more than 1e8 steps; Error(kNotConverged) if a number leaves the
/// range of a double; Error(kInterrupted) after a stop.
RollingTrajectory roll_with_viscous_contact(const RollingMotion& motion,
                                            const motions::PairFit& fit);

/// How a motion ends.
struct RollingEnd {
  RollingRow last;
  double smallest_gap = 0;  ///< smallest gap of all rows [L]
  /// Velocity of the lowest point of the sphere relative to the plane, at the end [L/T].
  double slip = 0;
  /// Time of the first row in which the solids touch [T]; nothing if they never do.
  std::optional<double> contact_time;
  /// The largest speed of the centre relative to the plane, which the fluid follows [L/T].
  double largest_speed = 0;
};

/// The end of `trajectory` of a sphere of this radius [L]. `motion` gives the velocity of the
/// plane.
RollingEnd end_of(const RollingTrajectory& trajectory, const RollingMotion& motion, double radius);

/// A model by name.
struct RollingModel {
  std::string_view name;         ///< as users type it
  std::string_view description;  ///< for pages
  /// roll_smooth(), roll_rough() or roll_with_viscous_contact().
  RollingTrajectory (*run)(const RollingMotion& motion, const motions::PairFit& fit);
};

/// All models: smooth, rough, viscous_contact. Pages give the models their colours in this order.
const std::vector<RollingModel>& rolling_models();

}  // namespace viscontact::rolling
