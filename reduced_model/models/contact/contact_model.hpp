// The loop over time of contact models, physics.md (4.5) to (4.7), which replace the thin film by
// contact with a memory gamma <= 0, minus the impulse that the film has absorbed.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/motion.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact::reduced_model {

/// The drag of the fluid at gaps [L] above that of contact, where the model resolves it.
struct ResolvedDrag {
  std::function<double(double gap)> resistance;  ///< drag over velocity [M/T], > 0
  std::function<double(double gap)> impulse;     ///< a primitive of the resistance [M L/T]
  /// The drag is known below this gap [L] only. It is infinite there, or neglected beyond.
  double largest_gap = std::numeric_limits<double>::infinity();
};

/// What distinguishes one contact model from another, in any consistent units.
struct ContactModel {
  /// Gap at which the sphere is in contact [L], >= 0.
  double contact_gap = 0;
  /// Gap at which the sphere touches the wall opposite [L] (motion_ends_at()); or infinity.
  double largest_gap = std::numeric_limits<double>::infinity();
  /// Value of gamma at which the solids touch [M L/T], <= 0. -infinity: they never touch. 0: there
  /// is no film, which is plain inelastic contact.
  double gamma_min = 0;
  /// Rate of gamma over rate of the film's thickness where the solids touch [M/T]; 0 if they never
  /// touch or if there is no film.
  double solid_resistance = 0;
  /// Nothing if only the external force acts outside contact.
  std::optional<ResolvedDrag> drag{};
  /// Film thickness [L], >= 0, at a value of gamma [M L/T], < 0; empty if there is no film.
  std::function<double(double gamma)> film_thickness{};
  /// The function film_thickness as a formula, for trajectory files; may be empty.
  std::string film_law{};
  /// Coefficient e_d of restitution; run_contact_model() sets it.
  double restitution = 0;
  /// True: a step computes velocity and gamma in its middle (leapfrog), so that the error of the
  /// gap is of second order. Allowed only without resolved drag.
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
/// motion.initial_gap must be >= model.contact_gap. Throws Error(kBadInput) if the motion has more
/// than 1e8 steps or no value of the time step, Error(kInterrupted) at a stop, and the errors of
/// the functions of `model`.
Trajectory run_contact_model(const Motion& motion, ContactModel model);

/// A function that makes a contact model for a motion and a force.
using MakeContactModel = ContactModel (*)(const Motion&, const lubrication::LubricationForce&);
/// Runs the model that `make` makes.
inline Trajectory run_contact_model(MakeContactModel make, const Motion& motion,
                                    const lubrication::LubricationForce& force) {
  return run_contact_model(motion, make(motion, force));
}

}  // namespace viscontact::reduced_model
