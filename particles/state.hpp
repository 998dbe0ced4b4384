// State of a simulation: everything, besides the case, that its future depends on. Lengths, masses
// and times are in any consistent units. The restart file (io/restart.cpp) stores these fields bit
// for bit; a change of Pair or State must keep old restart files readable.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "viscontact/particles/pair_memory.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// A pair of the neighbour list: two particles, or a particle and a plane, and their memory. In a
/// fluid, gamma and the impulses of discs are per unit length: M stands for M/L there. gamma is
/// minus the impulse that the film has absorbed, and gamma_min its value when the solids touch
/// (film_law.hpp).
struct Pair {
  std::int32_t first = 0;   ///< number of a particle, or -1 - k for plane k
  std::int32_t second = 0;  ///< number of a particle, > first
  double gamma = 0;         ///< gamma_min <= gamma <= 0 [M L/T]
  /// Impulse of the contact in the last step [M L/T], > 0 where it pushes, >= gamma before the
  /// step. The next projection takes it as its first guess.
  double impulse = 0;
  /// Estimate of the error of gamma [M L/T], >= 0: the sum of the residuals and rounding errors of
  /// all impulses that gamma is the sum of. It is 0 where gamma is at one of its bounds, because
  /// these values are known.
  double gamma_error = 0;
  /// The image of `second` that meets `first` (periods.hpp). If two images of `second` touch
  /// `first`, they are two pairs.
  std::int32_t image = 0;
  /// Row in State::memories of what the laws remember of the pair besides gamma.
  std::int32_t memory = PairMemories::kNone;
  /// Which contact of the two bodies it is, because plates may have two: at an obstacle the end 0
  /// or 1 of the plate's spine, between two plates a place of SpineContacts, 0 to 3, otherwise 0.
  std::int32_t place = 0;
  /// Place of the plane in the list of planes; only if `first` is negative.
  std::size_t plane() const { return static_cast<std::size_t>(-1 - first); }
  /// True if all members are equal.
  bool operator==(const Pair&) const = default;
};

/// What a source of a run has done, and what decides which particles it pours in and when.
struct SourceProgress {
  std::int64_t poured = 0;  ///< number of particles that it has poured in, >= 0
  /// Time from which it pours [T]: Source::begin, or the start of the first run that had the
  /// source, if this is later.
  double begin = 0;
  double begin_of_case = 0;   ///< Source::begin in that run [T], >= 0
  double rate = 0;            ///< Source::rate [1/T], > 0
  std::uint64_t seed = 0;     ///< Source::seed
  std::uint64_t species = 0;  ///< hash_of() Source::species
  /// True if all members are equal.
  bool operator==(const SourceProgress&) const = default;
};

/// A new simulation needs only `particles`; all other members then keep their defaults.
struct State {
  Particles particles;     ///< where they are and how they move
  double time = 0;         ///< [T]
  std::int64_t steps = 0;  ///< number of steps done
  /// The velocities are those at the time `time` - velocity_lag [T], >= 0; 0 unless the scheme is
  /// Scheme::kLeapfrog.
  double velocity_lag = 0;
  /// Step n ends at time grid_time + (n - grid_step) h [T], where h is the time step of the case.
  /// Both numbers are 0 until a step is cut short or a restart changes h; they are then the time
  /// and the number of that step.
  double grid_time = 0;
  std::int64_t grid_step = 0;  ///< number of the step that ended at grid_time
  /// Pairs of particles that may touch soon, in order of first, second, image.
  std::vector<Pair> pairs;
  std::vector<Pair> walls;  ///< particles at planes, in order of plane, particle
  PairMemories memories;    ///< of `pairs` and `walls`, by Pair::memory
  // Pairs outside the list cannot touch as long as no particle has moved further than its skin
  // since the list was made.
  /// Flat array of positions when `pairs` was made [L]; empty if there is no list yet.
  std::vector<double> positions_at_listing;
  std::vector<double> skins;  ///< skin of each particle [L]
  /// Forces and torques of the links in the last step, in the order of Links::force_count()
  /// [M L/T^2, M L^2/T^2]: the first guess of the next step. Empty before the first step.
  std::vector<double> link_forces;
  /// Work of each arm in the last step over its length [M L^2/T^3]; empty before the first step.
  std::vector<double> arm_powers;
  double earlier_step = 0;  ///< length of the last step [T]; 0 if there was none
  // What time stepping in a fluid needs of the step before; without a fluid these stay empty or 0.
  /// Velocities and angular velocities [L/T, 1/T], motion_components() numbers (fluid_solver.hpp)
  /// for each particle: vx, vy, angular velocity, or vz on an axis. Empty if there was no step.
  std::vector<double> earlier_velocities;
  /// Forces and torques of the particles on the fluid at these velocities [M L/T^2, M L^2/T^2], as
  /// many numbers in the same order. The forces that bodies, hinges and arms exert on particles
  /// without mass are left out.
  std::vector<double> earlier_forces;
  /// In a fluid with inertia: length of the step before that one [T]; 0 if there was none.
  double step_before = 0;
  /// In a fluid with inertia the flow of the steps before, FluidSolver::saved_flow(). It is set
  /// only in a state that is to be written, and empty otherwise.
  std::vector<char> flow;
  /// With membranes: the positions of all particles before the last step [L]. Empty if there was no
  /// step, and without membranes.
  std::vector<double> earlier_positions;
  /// The progress of each of Setting::sources. A simulation that begins adds an entry for each
  /// source that the state does not have. Particles that were poured in stand behind those of the
  /// case, in the order in which they came.
  std::vector<SourceProgress> sources;
};

}  // namespace viscontact::particles
