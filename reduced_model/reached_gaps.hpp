// How close a motion comes to the plane and how far from it: the gaps that a table must hold.
#pragma once

#include <optional>

#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact {

/// The least and the largest gap [L] at which a model asks for the whole drag in a motion.
struct ReachedGaps {
  std::optional<double> smallest;  ///< none for a model that asks for no drag in a thin film
  double largest = 0;
};

/// Runs the model with `force`, which must be known at every gap > 0 (the exact drag, or a fit with
/// its limits below and above). For a contact model that stands at a threshold gap the smallest gap
/// is that of the film which it recovers from gamma by the drag.
/// Returns nothing if the model asks for no drag at all, or if the motion cannot be computed.
std::optional<ReachedGaps> reached_gaps(const ModelChoice& choice, const Motion& motion,
                                        const LubricationForce& force);

}  // namespace viscontact
