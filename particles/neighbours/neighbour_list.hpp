// The neighbour list: pairs of particles that may touch soon, which are kept over many steps, and
// the particles near planes. Lengths are in the unit of the case. Both simulations use it. A change
// must keep the order of the pairs, on which the results of a simulation depend.
#pragma once

#include <span>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// Brings all positions into the cell of a periodic domain (Particles::cell). Pairs keep their
/// memory, their images and the list stay valid, and velocities do not change. Does nothing if the
/// domain has no period, or if images move relative to their particles (PeriodicCell::is_sheared).
void wrap_into_cell(State& state);

/// True as long as no pair outside state.pairs can touch after the particles have moved by
/// `displacements`, a flat array [L]. The mean displacement of all particles does not count,
/// because it brings no two particles closer together.
bool neighbour_list_is_valid(const State& state, std::span<const double> displacements,
                             ThreadPool& pool);

/// Makes state.pairs again for the present positions. The skin of each particle (state.skins)
/// becomes at least three times its displacement, so that the list is valid for about three steps,
/// and at least a quarter of its radius; it never becomes smaller. Pairs keep their memory, and
/// glued pairs stay in the list wherever their particles are. Particles of one rigid body are no
/// pair.
///
/// In a periodic domain a skin is at most (period/2 - radius)/2. Throws Error(kNotConverged) if a
/// displacement, without the mean displacement, exceeds this length.
void rebuild_neighbour_list(State& state, std::span<const double> displacements, ThreadPool& pool);

/// Makes state.walls again: the particles closer than `margin` [L] to an obstacle, and those that
/// are glued to it. `planes` are positions at the end of the step. Pairs keep their memory.
void rebuild_wall_list(State& state, std::span<const PlanePosition> planes, double margin,
                       ThreadPool& pool);

}  // namespace viscontact::particles
