// The loop over time that the contact models share; each says what its drag is and where its
// contact stands.
#pragma once

#include <functional>

#include "fitting/lubrication_force.hpp"
#include "reduced_model/motion.hpp"
#include "reduced_model/trajectory.hpp"

namespace viscontact {

struct ContactModel {
  double contact_gap = 0;  ///< q at which the sphere is in contact [L], >= 0
  double gamma_min = 0;    ///< solid contact [M L/T], <= 0; -infinity: none
  std::function<double(double gap)>
      resolved_resistance;  ///< drag over velocity that acts at a distance [M/T], >= 0 in effect
  std::function<double(double gamma)> film_thickness;  ///< the gap that gamma stands for [L]
};

/// Contact at q = 0 of which the film remembers k ln q: gamma = k ln(film/r), gamma_min = k ln((r1
/// + r2)/r). The resolved resistance is left to the caller. Throws Error(kBadInput) if the fit has
/// no positive k.
ContactModel contact_with_leading_term(const Motion& motion, const LubricationForce& force);

/// Steps of contact_step.hpp from the motion's start to its end, drag implicit in the velocity. A
/// row's lubrication force is the mean over the step before it, film and resolved drag together.
Trajectory run_contact_model(const Motion& motion, const ContactModel& model);

}  // namespace viscontact
