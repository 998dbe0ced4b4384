// Declares the state of a simulation: everything, besides the case, on which the rest of the
// simulation depends. Lengths, masses and times are in any consistent units. The simulations change
// the state, the files in io/ and run/ write it for users, and the restart file (io/restart.cpp)
// stores it bit for bit. A change of Pair or State must keep old restart files readable. Nothing is
// checked or thrown here. The number of a particle is its place in State::particles, from 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "viscontact/particles/impacts/rebound.hpp"
#include "viscontact/particles/pair_memory.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// Two particles, or a particle and an obstacle, that may touch soon, and what the next steps need
/// to know of them. In a fluid, gamma and the impulses of discs are per unit length, so that their
/// unit is [M/T]. gamma is minus the impulse that the fluid film between both surfaces has
/// absorbed. It falls while the film is pressed, down to gamma_min, at which the solids touch
/// (film_law.hpp).
struct Pair {
  std::int32_t first = 0;   ///< number of a particle, or -1 - k for obstacle k of obstacles_of()
  std::int32_t second = 0;  ///< number of a particle, > first
  double gamma = 0;         ///< gamma_min <= gamma <= 0 [M L/T]
  /// Impulse of the contact in the last step [M L/T]. It is > 0 where the contact pushes, and not
  /// less than the gamma before that step. The solver of the next step takes it as its first guess.
  double impulse = 0;
  /// Estimate of the error of gamma [M L/T], >= 0: the sum of the residuals and rounding errors of
  /// all impulses that were subtracted from gamma. It is 0 if gamma is 0 or gamma_min, which are
  /// exact.
  double gamma_error = 0;
  /// Number of the periodic image of `second` that meets `first`, -13 to 13; 0 is `second` itself
  /// (periods.hpp). If two images of `second` are near `first`, there are two pairs.
  std::int32_t image = 0;
  /// Row in State::memories, which has what contact laws remember besides gamma; kNone if they
  /// remember nothing.
  std::int32_t memory = PairMemories::kNone;
  /// Number of the contact between both bodies, because plates with round ends may have two. At an
  /// obstacle it is the end, 0 or 1, of the plate; between two plates it is a place of
  /// SpineContacts (outline.hpp), 0 to 3; otherwise it is 0.
  std::int32_t place = 0;
  /// Place of the obstacle in obstacles_of(), from 0; only if `first` is negative.
  std::size_t plane() const { return static_cast<std::size_t>(-1 - first); }
  /// True if all members are equal.
  bool operator==(const Pair&) const = default;
};

/// How many particles a source has added to the simulation (arrangement/source.hpp), and the
/// numbers that decide which particles it adds, and when.
struct SourceProgress {
  std::int64_t poured = 0;  ///< number of particles that it has added, >= 0
  /// Time of its first particle [T]: Source::begin, or the time at which the first simulation with
  /// this source began, if this is later.
  double begin = 0;
  double begin_of_case = 0;   ///< Source::begin in that simulation [T], >= 0
  double rate = 0;            ///< Source::rate [1/T], > 0
  std::uint64_t seed = 0;     ///< Source::seed
  std::uint64_t species = 0;  ///< hash_of(Source::species)
  /// True if all members are equal.
  bool operator==(const SourceProgress&) const = default;
};

/// How a plane under a load (PlaneLoad) moves along its normal.
struct PlaneMotion {
  double displacement = 0;  ///< since time 0 [L]
  double velocity = 0;      ///< [L/T]
  /// True if both members are equal.
  bool operator==(const PlaneMotion&) const = default;
};

/// The force and the torque of all contacts and links on a particle whose motion is given.
struct GivenParticleLoad {
  std::int32_t particle = 0;  ///< its number
  Vector force{},             ///< mean in the last step [M L/T^2]
      torque{};               ///< about its centre [M L^2/T^2], of a disc in component 2
};

/// The state of a simulation. To begin a new one, only `particles` has to be set.
struct State {
  Particles particles;     ///< places, sizes, masses and motions of the particles
  double time = 0;         ///< present time [T]
  std::int64_t steps = 0;  ///< number of steps done, >= 0
  /// The velocities are those at the time `time` - velocity_lag. The lag is >= 0 [T]; it is 0
  /// except with Scheme::kLeapfrog.
  double velocity_lag = 0;
  /// Step n ends at time grid_time + (n - grid_step) h [T], where h is the time step of the case.
  /// Both members are 0 until a step ends at another time or a restart changes h; they are then the
  /// time at the end of that step, and the number of that step.
  double grid_time = 0;
  std::int64_t grid_step = 0;  ///< number of the step that ended at grid_time, >= 0
  /// Neighbour list: pairs of particles that may touch soon, in order of first, second, image.
  std::vector<Pair> pairs;
  std::vector<Pair> walls;  ///< particles near obstacles, in order of obstacle, particle
  PairMemories memories;    ///< memories of `pairs` and `walls`, by Pair::memory
  // Two particles that are no pair of the list cannot touch as long as no particle has moved
  // further than its skin since the list was made.
  /// Flat array of the positions at the time when `pairs` was made [L]; empty if there is no list
  /// yet.
  std::vector<double> positions_at_listing;
  std::vector<double> skins;  ///< skin of each particle [L], >= 0; empty if there is no list yet
  /// Mean forces and torques of the links in the last step [M L/T^2, M L^2/T^2], in the order of
  /// Links::force_count(). The solver of the next step takes them as its first guess. Empty before
  /// the first step.
  std::vector<double> link_forces;
  /// Mean power of each arm in the last step [M L^2/T^3]: its work divided by the length of the
  /// step. Empty before the first step.
  std::vector<double> arm_powers;
  double earlier_step = 0;  ///< length of the last step [T]; 0 if there was none
  /// Impulses of the blows in the last step, without a fluid. The rest of the motion does not
  /// depend on them. Restart files have them for the tables walls.csv and stress.csv.
  std::vector<BlowImpulse> blows;
  /// The motions of Setting::planes, 0 for planes without a load; empty if no plane has a load.
  std::vector<PlaneMotion> planes;
  /// Loads of the particles whose motion is given, without a fluid, in the order of their numbers.
  /// The rest of the motion does not depend on them. Empty before the first step.
  std::vector<GivenParticleLoad> given_loads;
  // The members from here to `earlier_positions` serve simulations in a fluid only; without a fluid
  // they are empty or 0.
  /// Velocities and angular velocities in the last step [L/T, 1/T], motion_components() numbers
  /// (fluid_solver.hpp) for each particle: vx, vy, angular velocity; on an axis vz. Empty before
  /// the first step.
  std::vector<double> earlier_velocities;
  /// Forces and torques of the particles on the fluid at `earlier_velocities` [M L/T^2, M L^2/T^2],
  /// in the same order, without those of bodies, hinges and arms on particles without mass.
  std::vector<double> earlier_forces;
  /// In a fluid with inertia: length of the step before the last one [T]; 0 if there was none.
  double step_before = 0;
  /// In a fluid with inertia: the flow of earlier steps, as FluidSolver::saved_flow() returns it.
  /// It is set only in a state that is to be written, and empty otherwise.
  std::vector<char> flow;
  /// With membranes: positions of all particles before the last step [L]. Empty before the first
  /// step.
  std::vector<double> earlier_positions;
  /// The progress of each of Setting::sources. A simulation that begins adds an entry for each
  /// source that is not in the state yet. In `particles`, the particles of sources follow those of
  /// the case, in the order in which they were added.
  std::vector<SourceProgress> sources;
};

}  // namespace viscontact::particles
