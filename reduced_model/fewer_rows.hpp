// Reduces the number of rows of a trajectory, so that its file is easy to handle (key `rows` of
// [motion]). The stage that simulates calls it. A change must keep all rows that
// compare_trajectories() looks for, such as the one with the smallest gap.
#pragma once

#include <vector>

#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact::reduced_model {

/// About `count` >= 2 of the rows, in their order. They are the first rows at or after each of
/// `count` equidistant times, and the rows that a comparison needs: the first, the last, the first
/// with the smallest gap, with the largest gap and with the lowest gamma, and the two rows around
/// each instant at which contact or solid contact begins or ends. If there are more than `count`
/// such instants, only the first and the last of them count. At most `count` rows are all returned.
std::vector<TrajectoryRow> fewer_rows(const std::vector<TrajectoryRow>& rows, int count);

}  // namespace viscontact::reduced_model
