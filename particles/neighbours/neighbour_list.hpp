// Makes and checks the neighbour list of a simulation. The list has the pairs of particles that may
// touch soon (State::pairs), so that it can be used in many steps, and the particles near obstacles
// (State::walls). Lengths are in the unit of the case file. simulation.cpp uses this file, and
// fluid/ uses wrap_into_cell(). Only rebuild_neighbour_list() throws; sizes of arrays are not
// checked. A change must keep the order of the pairs, because the bits of a simulation depend on
// it.
#pragma once

#include <span>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// Moves all positions by whole periods into the cell of a periodic domain (Particles::cell). It
/// also changes Pair::image in State::pairs, so that the list stays valid. The function does
/// nothing if the domain has no period, or if images move relative to their particles
/// (PeriodicCell::is_sheared).
void wrap_into_cell(State& state);

/// True if no pair outside state.pairs can touch after the particles have moved by `displacements`
/// [L], a flat array with as many numbers for each particle as there are dimensions. This is so if
/// no particle is then further than its skin (state.skins) from its position when the list was
/// made. The mean displacement of all particles since then is subtracted first, because it brings
/// no two particles closer together. False if no list was made yet, unless there are no particles.
bool neighbour_list_is_valid(const State& state, std::span<const double> displacements,
                             ThreadPool& pool);

/// Makes state.pairs again for the present positions: all pairs with a gap less than the sum of
/// both skins, and all pairs with gamma < 0, whose film still holds them together. The skin of each
/// particle (state.skins) [L] becomes at least three times its displacement, so that the list is
/// valid for about three steps, and at least a quarter of its radius; it never becomes smaller,
/// except by the limit below. The three and the quarter are free choices, which only change the
/// time. Pairs keep what contact laws remember of them. Particles of one rigid body, and neighbours
/// on a membrane, are no pair.
///
/// In a periodic domain a skin is at most (shortest period/2 - radius)/2. Throws
/// Error(kNotConverged) if a displacement minus the mean displacement exceeds this length; the list
/// then stays as it was.
void rebuild_neighbour_list(State& state, std::span<const double> displacements, ThreadPool& pool);

/// Makes state.walls again: the pairs of an obstacle and a particle with a gap less than `margin`
/// >= 0 [L], or with gamma < 0, whose film still holds the two together. `planes` are the positions
/// of the obstacles at the end of the step. Pairs keep what contact laws remember of them.
void rebuild_wall_list(State& state, std::span<const PlanePosition> planes, double margin,
                       ThreadPool& pool);

}  // namespace viscontact::particles
