// A trajectory with fewer rows, for files that people can handle.
#pragma once

#include <vector>

#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {

/// About `count` (at least 2) of the rows, in their order: those next after `count` times at equal
/// distances, and those that a comparison must not lose: the first and the last, the first of the
/// smallest gap, of the largest gap and of the lowest gamma, and the rows on both sides of each
/// instant at which contact or solid contact begins or ends. If there are more than `count` such
/// instants, only the first and the last of them count. Rows that are no more than `count` stay.
std::vector<TrajectoryRow> fewer_rows(const std::vector<TrajectoryRow>& rows, int count);

}  // namespace viscontact
