// The neighbour list of a simulation: the pairs of particles that may touch soon, which is used in
// many steps, and the particles near obstacles. Lengths are in the unit of the case file.
// simulation.cpp and fluid/ use it. Only rebuild_neighbour_list() throws. A change must keep the
// order of the pairs, because the bits of a simulation depend on it.
#pragma once

#include <span>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// Moves all positions by whole periods into the cell of a periodic domain (Particles::cell). The
/// numbers of images in State::pairs change accordingly, so that the list stays valid. Does nothing
/// if the domain has no period, or if images move relative to their particles
/// (PeriodicCell::is_sheared).
void wrap_into_cell(State& state);

/// True if no pair outside state.pairs can touch after the particles have moved by `displacements`
/// [L], a flat array with as many numbers for each particle as there are dimensions: no particle is
/// then further than its skin from its position when the list was made. The mean displacement of
/// all particles does not count, because it brings no two particles closer together.
bool neighbour_list_is_valid(const State& state, std::span<const double> displacements,
                             ThreadPool& pool);

/// Makes state.pairs again for the present positions: all pairs with a gap less than the sum of
/// both skins, and all pairs with gamma < 0, whose film still holds them together. The skin of each
/// particle (state.skins) [L] becomes at least three times its displacement, so that the list is
/// valid for about three steps, and at least a quarter of its radius; it never becomes smaller.
/// Pairs keep their memory. Particles of one rigid body, and neighbours on a membrane, are no pair.
///
/// In a periodic domain a skin is at most (shortest period/2 - radius)/2. Throws
/// Error(kNotConverged) if a displacement, without the mean displacement, exceeds this length.
void rebuild_neighbour_list(State& state, std::span<const double> displacements, ThreadPool& pool);

/// Makes state.walls again: the pairs of an obstacle and a particle with a gap less than `margin`
/// >= 0 [L], or with gamma < 0, whose film still holds the two together. `planes` are the positions
/// of the obstacles at the end of the step. Pairs keep their memory.
void rebuild_wall_list(State& state, std::span<const PlanePosition> planes, double margin,
                       ThreadPool& pool);

}  // namespace viscontact::particles
