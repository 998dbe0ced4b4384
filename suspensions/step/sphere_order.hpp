// An order of the spheres in which near spheres have near numbers, for the caches of the processor
// and for blocks of loops.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/suspensions/step/suspension_step.hpp"

namespace viscontact::suspensions {

/// The spheres of three coordinates each along a curve that fills space (Morton 1966).
std::vector<std::int32_t> spatial_order(std::span<const double> positions);

/// Solves a step with its spheres in another order. Bodies that are not in `order` stay after
/// these.
StepSolution solve_in_order(StepProblem problem, std::span<const std::int32_t> order);

}  // namespace viscontact::suspensions
