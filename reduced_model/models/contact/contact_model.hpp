// Declares the loop over time that all contact models with a time step share (physics.md (4.5) to
// (4.7)). Such a model does not resolve the thin film of fluid between sphere and wall, but
// replaces the film by contact with a memory gamma <= 0, minus the impulse that the film has
// absorbed. The model may resolve the drag at larger gaps. Lengths, masses and times are in any
// consistent units. The files of this folder and models.cpp use it. Error(kBadInput) is thrown if
// there are too many steps, Error(kInterrupted) at a stop. The members of a ContactModel are not
// checked. A change must keep the budget of impulses and works balanced to round-off, and raise
// kModelsRevision (trajectory.hpp) if results change.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/motion.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact::reduced_model {

/// The drag of the fluid at gaps q [L] above that of contact, where the model resolves it.
struct ResolvedDrag {
  /// Resistance: the drag over the velocity [M/T], > 0.
  std::function<double(double gap)> resistance;
  /// A primitive of the resistance [M L/T].
  std::function<double(double gap)> impulse;
  /// The drag is known below this gap [L] only, and infinite there or neglected beyond.
  double largest_gap = std::numeric_limits<double>::infinity();
};

/// What distinguishes one contact model from another.
struct ContactModel {
  /// Gap at which the sphere is in contact [L], >= 0.
  double contact_gap = 0;
  /// Gap at which the sphere touches the wall opposite [L], where the motion ends
  /// (motion_ends_at()); infinity without one.
  double largest_gap = std::numeric_limits<double>::infinity();
  /// Value of gamma at which the solids touch [M L/T], <= 0. With -infinity they never touch. With
  /// 0 there is no film, which is plain inelastic contact.
  double gamma_min = 0;
  /// Resistance of the film at the thickness at which the solids touch [M/T], > 0: the rate of
  /// gamma divided by the rate of the thickness. It is 0 if the solids never touch or if there is
  /// no film.
  double solid_resistance = 0;
  /// The resolved drag; nothing if only the external force acts outside contact.
  std::optional<ResolvedDrag> drag{};
  /// Film thickness [L], >= 0, at a value of gamma [M L/T], < 0; empty if there is no film.
  std::function<double(double gamma)> film_thickness{};
  /// The function film_thickness as a formula, for the head of trajectory files; may be empty.
  std::string film_law{};
  /// Coefficient e_d of restitution of the solids [1], 0 to 1; run_contact_model sets it.
  double restitution = 0;
  /// True: a step computes velocity and gamma in its middle (leapfrog), so that the error of the
  /// gap is of second order in the step. Allowed only without resolved drag (not checked).
  bool is_staggered = false;
};

/// Makes the steps of contact_step.hpp from the start of the motion to its end, and those of
/// rebound.hpp if there is a restitution and the sphere comes into contact from a flight.
///
/// The trajectory has a row for the start and one for each step. The forces in a row are means over
/// the step before it; its lubrication force is that of film and resolved drag together. The
/// beginning and the end of contact, and the time at which the solids touch, are found within a
/// step as if the force were constant in this step; their error has the order of the scheme. The
/// velocity at which the solids touch is what the film leaves of an impact or, if a load closes the
/// film, the load divided by `solid_resistance`. The lowest gamma, and thus the smallest film,
/// includes the values at the times at which the force changes its sign. If the model is staggered,
/// a row has the velocity and gamma that half a step of the force gives from the middle of the step
/// to the time of the row.
///
/// motion.initial_gap must be >= model.contact_gap (not checked). Throws Error(kBadInput) if the
/// motion has more than 1e8 steps or no value of viscous_contact.time_step, Error(kInterrupted) if
/// `motion.stop` requests a stop, and the errors of the functions of `model`.
Trajectory run_contact_model(const Motion& motion, ContactModel model);

/// A function that makes a contact model for a motion and a force.
using MakeContactModel = ContactModel (*)(const Motion&, const lubrication::LubricationForce&);
/// Makes the contact model for `motion` and `force` by the function `make`, and runs the model.
/// Throws the errors of `make` and of the other run_contact_model().
inline Trajectory run_contact_model(MakeContactModel make, const Motion& motion,
                                    const lubrication::LubricationForce& force) {
  return run_contact_model(motion, make(motion, force));
}

}  // namespace viscontact::reduced_model
