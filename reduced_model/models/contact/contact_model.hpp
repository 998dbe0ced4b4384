// The loop over time that all contact models with a time step share (physics.md (4.5) to (4.7)). A
// model supplies its resolved drag and the gap at which it makes contact. gamma is minus the
// impulse that the film has absorbed. Lengths, masses and times are in any consistent units. A
// change must keep the budget balanced to round-off, and raise kModelsRevision if results change.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/motion.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact::reduced_model {

/// A drag that acts at a distance, as functions of the gap q [L].
struct ResolvedDrag {
  /// Resistance [M/T].
  std::function<double(double gap)> resistance;
  /// A primitive of the resistance [M L/T].
  std::function<double(double gap)> impulse;
};

/// What distinguishes one contact model from another.
struct ContactModel {
  /// Gap at which the sphere is in contact [L], >= 0.
  double contact_gap = 0;
  /// Value of gamma at which the solids touch [M L/T], <= 0. -infinity: no solid contact. 0: no
  /// film, which is plain inelastic contact.
  double gamma_min = 0;
  /// Resistance of the film where the solids touch [M/T]: the rate of gamma over that of the film.
  /// 0 without a film.
  double solid_resistance = 0;
  /// The resolved drag; nothing if only f_ext acts at a distance.
  std::optional<ResolvedDrag> drag{};
  /// Thickness [L] of the film that is recovered from gamma [M L/T].
  std::function<double(double gamma)> film_thickness{};
  /// The function film_thickness as a formula, for the header of trajectory files.
  std::string film_law{};
  /// Coefficient e_d of restitution of the solids [1], 0 to 1; run_contact_model sets it.
  double restitution = 0;
  /// True: the velocity and gamma of a step are those in its middle (leapfrog), so that the gap is
  /// of second order. Allowed only without resolved drag.
  bool is_staggered = false;
};

/// Makes the steps of contact_step.hpp from the start of the motion to its end, and those of
/// rebound.hpp if there is a restitution and the sphere flies into contact. The forces in a row are
/// means over the step before it; the lubrication force is that of film and resolved drag together.
/// The beginning and the end of contact are found within the steps of impact and release, as if the
/// force were constant in each step; the error of these times is of the order of the scheme. With
/// `is_staggered` the force acts for half a step first and at the end, and a row has the velocity
/// and gamma that the force of another half step gives at the time of the row. The lowest gamma,
/// and thus the recovered film, includes the values at which the force changes its sign within a
/// step. The time at which the solids touch is found in the same way. Their velocity is what the
/// film leaves of an impact, or, if a load closes the film, the load over `solid_resistance`.
Trajectory run_contact_model(const Motion& motion, ContactModel model);

/// A function that makes a contact model for a motion and a force.
using MakeContactModel = ContactModel (*)(const Motion&, const lubrication::LubricationForce&);
/// Makes the contact model for `motion` and `force`, and runs it as above.
inline Trajectory run_contact_model(MakeContactModel make, const Motion& motion,
                                    const lubrication::LubricationForce& force) {
  return run_contact_model(motion, make(motion, force));
}

}  // namespace viscontact::reduced_model
