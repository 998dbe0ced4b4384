// The loop over time that the contact models share; each says what its drag is and where its
// contact stands.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/motion.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {

/// Drag that acts at a distance, as functions of the gap q [L].
struct ResolvedDrag {
  std::function<double(double gap)> resistance;  ///< [M/T]
  std::function<double(double gap)> impulse;     ///< its primitive [M L/T]
};

struct ContactModel {
  double contact_gap = 0;  ///< q at which the sphere is in contact [L], >= 0
  double gamma_min =
      0;  ///< solid contact [M L/T], <= 0; -infinity: none; 0: no film, plain inelastic contact
  std::optional<ResolvedDrag> drag;                    ///< none: only f_ext acts at a distance
  std::function<double(double gamma)> film_thickness;  ///< the gap that gamma stands for [L]
  std::string film_law{};  ///< that function as a formula, for the heads of files
};

/// Contact at q = 0 of which the film remembers k ln q. The sphere starts with gamma = 0 at the gap
/// q0, so by the first integral k ln q = k ln q0 + gamma the film is q0 exp(gamma/k) thick, but never
/// thinner than r1 + r2; at gamma_min = k ln((r1 + r2)/r), where the solids touch, it is r1 + r2.
/// The resolved drag is left to the caller. Throws Error(kBadInput) if the fit has no positive k.
ContactModel contact_with_leading_term(const Motion& motion, const LubricationForce& force);

/// Steps of contact_step.hpp from the motion's start to its end. A row's lubrication and solid forces are means over the step before it, film
/// and resolved drag together. The contact interval is found within the steps of impact and release, the force taken as constant in each: off by the scheme's own error of a step. The
/// lowest gamma, and so the film recovered from it, counts what lies within steps in which the force changes its sign.
Trajectory run_contact_model(const Motion& motion, const ContactModel& model);

}  // namespace viscontact
