// The pairs of particles that may touch soon (State::pairs), for many steps, and the particles near
// obstacles (State::walls).
#pragma once

#include <span>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

/// Moves all positions by whole periods into the cell of a periodic domain, and changes Pair::image
/// with them. Does nothing without a period, or if the cell is sheared.
void wrap_into_cell(State& state);

/// True if no pair outside state.pairs can touch after the particles have moved by `displacements`
/// [L], because no particle is then further than its skin (state.skins) from its position when the
/// list was made. The mean displacement is subtracted first, because it brings no two particles
/// closer together. False if no list was made yet, unless there are no particles.
bool neighbour_list_is_valid(const State& state, std::span<const double> displacements,
                             ThreadPool& pool);

/// Makes state.pairs again: all pairs with a gap less than the sum of both skins, and all pairs
/// with gamma < 0, whose film still holds them together. The skin of each particle [L] becomes at
/// least three times its displacement, so that the list is valid for about three steps, and at
/// least a quarter of its radius; it never becomes smaller, except by the limit below. Pairs keep
/// what contact laws remember of them. Particles of one rigid body, and neighbours on a membrane,
/// are no pair.
///
/// In a periodic domain a skin is at most (shortest period/2 - radius)/2. Throws
/// Error(kNotConverged) if a displacement minus the mean displacement exceeds this length; the list
/// then stays as it was.
void rebuild_neighbour_list(State& state, std::span<const double> displacements, ThreadPool& pool);

/// Makes state.walls again: the pairs of an obstacle and a particle with a gap less than `margin`
/// [L], or with gamma < 0. `planes` are the obstacles at the end of the step. Pairs keep what
/// contact laws remember of them.
void rebuild_wall_list(State& state, std::span<const PlanePosition> planes, double margin,
                       ThreadPool& pool);

}  // namespace viscontact::particles
