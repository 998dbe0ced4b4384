// The list of pairs that may touch soon, kept over steps.
#pragma once

#include <span>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// True while no pair outside state.pairs can touch, the particles displaced by `displacements` (flat [L]) from where they are. Motion that all share
/// (their mean) brings nobody closer, and does not count.
bool neighbour_list_is_valid(const State& state, std::span<const double> displacements,
                             ThreadPool& pool);

/// Makes state.pairs anew for the particles where they are, with reaches of at least three times their displacements, so that it lasts, and no
/// shorter than those in state.reaches, if there are any. Films keep what they remember; one that holds stays in the list wherever its particles are.
void rebuild_neighbour_list(State& state, std::span<const double> displacements, ThreadPool& pool);

}  // namespace viscontact::particles
