// Makes the models `viscous_contact`, `viscous_contact_leapfrog` and `inelastic_contact`, with
// contact at the gap q = 0 [L] and no drag before contact, and `viscous_contact_regular_drag` with
// the drag R(q) - k/q [M/T], where R is the fitted resistance and k [M L/T] the coefficient of 1/q
// in R. The initial gap q0 [L] is > 0, the heights of roughness [L] are >= 0 (not checked), and
// gamma [M L/T], minus the impulse that the film has absorbed, is <= 0. A fit without a positive k
// is an Error(kBadInput), except for `inelastic_contact`, which uses no fit. models.cpp and
// viscous_contact_exact.cpp use this file. A change must keep the texts of film_law, which heads of
// trajectories contain. A change of results must raise kModelsRevision (trajectory.hpp).
#include "viscontact/reduced_model/models/contact/viscous_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscontact::reduced_model {

/// The film has the thickness q0 exp(gamma/k) [L]. The solids touch at gamma_min [M L/T], where the
/// film is as thick as both heights of roughness together; gamma_min is 0 if these heights exceed
/// q0. Without roughness the solids never touch.
ContactModel viscous_contact(const Motion& motion, const lubrication::LubricationForce& force) {
  const double k = force.leading_coefficient();
  const double q0 = motion.initial_gap;
  const double solid_gap = motion.roughness[0] + motion.roughness[1];
  ContactModel model;
  model.largest_gap = force.largest_gap();
  model.gamma_min = solid_gap == 0 ? -std::numeric_limits<double>::infinity()
                                   : std::min(0.0, k * std::log(solid_gap / q0));
  if (solid_gap > 0) model.solid_resistance = k / solid_gap;
  model.film_thickness = [k, solid_gap, q0, gamma_min = model.gamma_min](double gamma) {
    return gamma <= gamma_min ? solid_gap : std::max(solid_gap, q0 * std::exp(gamma / k));
  };
  model.film_law = "initial_gap * exp(gamma/k)";
  if (solid_gap > 0) model.film_law += ", at least the roughness heights together";
  return model;
}

/// Makes the same model, but with steps that compute velocity and gamma in their middle.
ContactModel viscous_contact_leapfrog(const Motion& motion,
                                      const lubrication::LubricationForce& force) {
  auto model = viscous_contact(motion, force);
  model.is_staggered = true;
  return model;
}

/// Makes the same model, but with the drag R(q) - k/q at gaps q > 0. `force` must outlive the
/// result, which refers to it.
ContactModel viscous_contact_regular_drag(const Motion& motion,
                                          const lubrication::LubricationForce& force) {
  ContactModel model = viscous_contact(motion, force);
  model.drag =
      ResolvedDrag{[&force](double q) { return force.regular_resistance(q); },
                   [&force](double q) { return force.regular_impulse(q); }, force.largest_gap()};
  return model;
}

/// Makes a model of contact without a film, in which gamma is always 0.
ContactModel inelastic_contact(const Motion&, const lubrication::LubricationForce& force) {
  return {.largest_gap = force.largest_gap()};
}

}  // namespace viscontact::reduced_model
