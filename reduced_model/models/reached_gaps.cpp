// Runs a model and takes the extreme gaps [L] from its trajectory. A motion that cannot be computed
// gives nothing. A change must keep that a stop is still thrown.
#include "viscontact/reduced_model/models/reached_gaps.hpp"

#include <algorithm>

#include "viscontact/common/error.hpp"

namespace viscontact::reduced_model {

std::optional<ReachedGaps> reached_gaps(const ModelChoice& choice, const Motion& motion,
                                        const lubrication::LubricationForce& force) {
  try {
    const Trajectory trajectory = simulate(choice, motion, force);
    const auto [low, high] = std::ranges::minmax_element(trajectory.rows, {}, &TrajectoryRow::gap);
    if (choice.model->contact == nullptr) return ReachedGaps{low->gap, high->gap};
    const ContactModel contact = contact_model_of(choice, motion, force);
    if (!contact.drag) return {};
    ReachedGaps reached{{}, high->gap};
    if (contact.contact_gap > 0)
      reached.smallest = trajectory.recovered_minimal_gap.value_or(low->gap);
    return reached;
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInterrupted) throw;
    return {};
  }
}

}  // namespace viscontact::reduced_model
