// The interval of gaps that a motion needs, which a table has to cover. Lengths are in the units of
// the case. A change must keep that a motion that cannot be computed is no error here. `run` warns
// by it before a tabulation, and messages say by it how far to tabulate. Used by pipeline/.
#pragma once

#include <optional>

#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact::reduced_model {

/// The smallest and the largest gap [L] at which a model evaluates the whole drag in a motion.
struct ReachedGaps {
  /// Nothing for a model that evaluates no drag in a thin film.
  std::optional<double> smallest;
  double largest = 0;  ///< [L], >= 0
};

/// Runs the model with `force`, which must be defined for every gap > 0: it must be the exact drag,
/// or a fit with its limits below and above. If a contact model makes contact at a threshold gap,
/// `smallest` is the thickness of the film recovered from gamma, because the drag at these gaps
/// determines that thickness. Returns nothing if the model evaluates no drag, or if the motion
/// cannot be computed.
std::optional<ReachedGaps> reached_gaps(const ModelChoice& choice, const Motion& motion,
                                        const lubrication::LubricationForce& force);

}  // namespace viscontact::reduced_model
