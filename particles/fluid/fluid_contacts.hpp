// The pairs of a simulation in a fluid whose gaps may reach the threshold gap D_c in a step. Units
// are those of the case.
#pragma once

#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/fluid/contact_problem.hpp"
#include "viscontact/particles/plane.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// Makes state.pairs and state.walls again: all pairs with a gap below `reach` [L], and those that
/// are glued. Pairs keep their memory. `obstacles` are positions at the end of the step.
void list_pairs_in_reach(State& state, std::span<const PlanePosition> obstacles, double reach,
                         ThreadPool& pool);

/// The contact of a pair, with the gap D - `threshold` [L].
FluidContact fluid_contact_of(const Particles& particles, const Pair& pair,
                              std::span<const PlanePosition> obstacles, double threshold);

/// All pairs of the state: first those of particles, then those with obstacles.
std::vector<Pair*> all_pairs(State& state);

}  // namespace viscontact::particles
