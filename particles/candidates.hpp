// The list of pairs that may touch soon, kept over steps.
#pragma once

#include <span>

#include "particles/state.hpp"
#include "particles/team.hpp"

namespace viscontact::particles {

/// True while no pair outside state.pairs can touch, the particles displaced by `displacements` (flat [L]) from where they are.
bool list_holds(const State& state, std::span<const double> displacements, Team& team);

/// Makes state.pairs anew for the particles where they are, with reaches of at least twice the displacements of a step, so that it lasts. Films keep
/// what they remember; one that holds stays in the list wherever its particles are.
void make_list(State& state, std::span<const double> displacements, Team& team);

}  // namespace viscontact::particles
