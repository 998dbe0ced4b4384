// The film, the bound of gamma and the drag of viscous_contact_threshold(), physics.md (4.7).
#include "viscontact/reduced_model/models/contact/viscous_contact_threshold.hpp"

#include <limits>

#include "viscontact/common/error.hpp"

namespace viscontact::reduced_model {

ContactModel viscous_contact_threshold(const Motion& motion,
                                       const lubrication::LubricationForce& force) {
  const double q_c = motion.parameter(kThresholdGap);
  if (!(motion.initial_gap > q_c))
    throw Error(ErrorKind::kBadInput,
                "viscous_contact.threshold_gap is {}; it must be less than motion.initial_gap, {}",
                q_c, motion.initial_gap);
  const double impulse_at_contact = force.impulse(q_c);
  const double solid_gap = motion.roughness[0] + motion.roughness[1];
  if (!(solid_gap < q_c))
    throw Error(ErrorKind::kBadInput,
                "viscous_contact.threshold_gap is {}; it must be greater than the roughness "
                "heights together, {}",
                q_c, solid_gap);

  ContactModel model;
  model.contact_gap = q_c;
  model.largest_gap = force.largest_gap();
  model.gamma_min = solid_gap == 0 ? -std::numeric_limits<double>::infinity()
                                   : std::min(0.0, force.impulse(solid_gap) - impulse_at_contact);
  if (solid_gap > 0) model.solid_resistance = force.resistance(solid_gap);
  model.drag = ResolvedDrag{[&force](double q) { return force.resistance(q); },
                            [&force](double q) { return force.impulse(q); }, force.largest_gap()};
  model.film_thickness = [&force, impulse_at_contact](double gamma) {
    return force.gap_of_impulse(impulse_at_contact + gamma);
  };
  model.film_law = "Gamma^-1(Gamma(threshold_gap) + gamma)";
  return model;
}

}  // namespace viscontact::reduced_model
