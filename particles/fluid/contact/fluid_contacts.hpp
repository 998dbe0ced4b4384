// The pairs of a simulation in a fluid whose gaps may reach the threshold gap D_c in a step. Units
// are those of the case.
#pragma once

#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/domain/plane.hpp"
#include "viscontact/particles/fluid/contact/fluid_contact.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// Pairs of particles, and particles at obstacles, as State holds them.
struct PairLists {
  std::vector<Pair> pairs,  ///< two particles each
      walls;                ///< a particle and an obstacle each
};

/// All pairs with a gap below `reach` [L] and those that are glued, with their memory from `state`.
/// `obstacles` are positions at the end of the step. The side of a cylinder, whose normal has no
/// component along the axis, is left out.
PairLists pairs_in_reach(const State& state, std::span<const PlanePosition> obstacles, double reach,
                         ThreadPool& pool);

/// The contact of a pair, with the gap D - `threshold` [L]. A round wall is taken as its tangent
/// where the particle is after it moved with `free_velocities` [L/T, 1/T] for a time h [T].
FluidContact fluid_contact_of(const Particles& particles, const Pair& pair,
                              std::span<const PlanePosition> obstacles, double threshold,
                              std::span<const double> free_velocities, double h);

}  // namespace viscontact::particles
