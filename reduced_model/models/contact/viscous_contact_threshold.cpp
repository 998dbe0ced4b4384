// Makes the model `viscous_contact_threshold` (viscous_contact_threshold.hpp), with contact at the
// gap q_c [L] and the whole drag at larger gaps. q_c must be greater than the heights of the
// roughness together [L], >= 0, and less than the initial gap. `impulse` of the force is the
// primitive Gamma [M L/T] of the resistance [M/T]; gamma [M L/T], <= 0, is minus the impulse that
// the film below q_c has absorbed. A q_c or a roughness outside this range or outside the fit, and
// in a run a gap outside the fit, are an Error(kBadInput). A film too thin for a double is an
// Error(kNotConverged). models.cpp uses this file. A change must keep the text of film_law, which
// heads of trajectories contain. A change of results must raise kModelsRevision (trajectory.hpp).
#include "viscontact/reduced_model/models/contact/viscous_contact_threshold.hpp"

#include <limits>

#include "viscontact/common/error.hpp"

namespace viscontact::reduced_model {

/// The film has the thickness [L] at which Gamma is Gamma(q_c) + gamma. The solids touch at
/// gamma_min [M L/T], where this thickness equals both heights of roughness together; without
/// roughness they never touch. `force` must outlive the result, which refers to it.
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
