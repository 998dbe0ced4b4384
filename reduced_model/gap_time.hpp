// When a trajectory first reaches a gap.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace viscontact::reduced_model {

struct TrajectoryRow;

/// The first time at which a trajectory reaches a gap.
struct GapTime {
  double gap = 0;              ///< the gap [L], > 0
  std::optional<double> time;  ///< the first time [T] at this gap; nothing if it is never reached
  bool operator==(const GapTime&) const = default;  ///< exact
};

/// The first time at which each of the gaps [L], > 0, is reached. `film` is the thickness of the
/// film of a row in contact (gamma < 0) [L], >= 0. A contact model resolves no film thicker than
/// `thickest_film` [L]: thinner ones count only in contact. Without contact, `film` is empty and
/// `thickest_film` is 0.
///
/// Between two rows in flight, ln q is the cubic polynomial with the values and slopes u/q of both
/// rows. In contact, ln q is linear, as it is under a constant force.
std::vector<GapTime> gap_times(const std::vector<TrajectoryRow>& rows, std::span<const double> gaps,
                               const std::function<double(const TrajectoryRow&)>& film = {},
                               double thickest_film = 0);

}  // namespace viscontact::reduced_model
