// Computes a stroke again with changed fits (swim_errors.hpp). Lengths, masses and times are in the
// units of the fit.
#include "viscontact/swimmer/swim_errors.hpp"

#include <cmath>

namespace viscontact::swimmer {

SwimErrors swim_errors(const SwimSums& sums, const Stroke& stroke,
                       const std::vector<ResistanceFit>& lower_degrees,
                       const std::vector<ResistanceFit>& table_errors, double multiplier) {
  const auto changes = [&](const ResistanceFit& fit) -> SwimErrors {
    const auto changed = swim_sums(Swimmer(fit), stroke);
    const double displacement = changed.displacement - sums.displacement;
    // Because the loop is stationary, the least energy at the wanted displacement changes, to first
    // order, by the change of the loop's energy minus the multiplier times the change of its
    // displacement.
    return {displacement, changed.energy - sums.energy - multiplier * displacement};
  };
  SwimErrors errors;
  for (const auto& fit : lower_degrees) {
    const auto change = changes(fit);
    errors.displacement += std::abs(change.displacement);
    errors.energy += std::abs(change.energy);
  }
  SwimErrors squares;
  for (const auto& fit : table_errors) {
    const auto change = changes(fit);
    squares.displacement += change.displacement * change.displacement;
    squares.energy += change.energy * change.energy;
  }
  if (!table_errors.empty()) {
    const auto count = static_cast<double>(table_errors.size());
    errors.displacement += 2 * std::sqrt(squares.displacement / count);
    errors.energy += 2 * std::sqrt(squares.energy / count);
  }
  return errors;
}

}  // namespace viscontact::swimmer
