// The film, the bound of gamma (4.6) and the resolved drag (4.7) of each model, docs/physics.md.
#include "viscontact/reduced_model/models/contact/viscous_contact.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace viscontact::reduced_model {

ContactModel viscous_contact(const Motion& motion, const lubrication::LubricationForce& force) {
  assert(motion.initial_gap > 0 && motion.roughness[0] >= 0 && motion.roughness[1] >= 0);
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

ContactModel viscous_contact_leapfrog(const Motion& motion,
                                      const lubrication::LubricationForce& force) {
  auto model = viscous_contact(motion, force);
  model.is_staggered = true;
  return model;
}

ContactModel viscous_contact_regular_drag(const Motion& motion,
                                          const lubrication::LubricationForce& force) {
  ContactModel model = viscous_contact(motion, force);
  model.drag =
      ResolvedDrag{[&force](double q) { return force.regular_resistance(q); },
                   [&force](double q) { return force.regular_impulse(q); }, force.largest_gap()};
  return model;
}

ContactModel inelastic_contact(const Motion&, const lubrication::LubricationForce& force) {
  return {.largest_gap = force.largest_gap()};
}

}  // namespace viscontact::reduced_model
