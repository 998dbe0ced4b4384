// The state of a simulation: everything, besides the case, on which the rest of the simulation
// depends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "viscontact/particles/state/pair_memory.hpp"
#include "viscontact/particles/state/particles.hpp"
#include "viscontact/particles/state/rebound.hpp"

namespace viscontact::particles {

/// Two particles, or a particle and an obstacle, that may touch soon. gamma is minus the impulse
/// that the fluid film between both surfaces has absorbed. It falls while the film is pressed, down
/// to gamma_min, at which the solids touch (film_law.hpp). In a fluid, gamma and the impulses of
/// discs are per unit length [M/T].
struct Pair {
  std::int32_t first = 0;   ///< number of a particle, or -1 - k for obstacle k of obstacles_of()
  std::int32_t second = 0;  ///< number of a particle, > first
  double gamma = 0;         ///< gamma_min <= gamma <= 0 [M L/T]
  /// Impulse in the last step [M L/T], > 0 where the contact pushes, and not less than the gamma
  /// before that step; the first guess of the next step.
  double impulse = 0;
  /// Estimate of the error of gamma [M L/T], >= 0: the sum of the residuals and rounding errors of
  /// all impulses that were subtracted from gamma. It is 0 if gamma is 0 or gamma_min, which are
  /// exact.
  double gamma_error = 0;
  /// Periodic image of `second` that meets `first`, -13 to 13; 0 is `second` itself (periods.hpp).
  /// If two images of `second` are near `first`, there are two pairs.
  std::int32_t image = 0;
  /// Row in State::memories; kNone if laws remember nothing besides gamma.
  std::int32_t memory = PairMemories::kNone;
  /// Number of the contact, if the two may have several (ShapeContacts, WallContacts); 0 for discs
  /// and spheres.
  std::int32_t place = 0;
  std::size_t plane() const { return static_cast<std::size_t>(-1 - first); }
  bool operator==(const Pair&) const = default;
};

/// How many particles a source has added to the simulation, and the numbers that decide which
/// particles it adds, and when.
struct SourceProgress {
  std::int64_t poured = 0;  ///< >= 0
  /// Time of its first particle [T]: Source::begin, or the time at which the first simulation with
  /// this source began, if this is later.
  double begin = 0;
  double begin_of_case = 0;   ///< Source::begin in that simulation [T], >= 0
  double rate = 0;            ///< Source::rate [1/T], > 0
  std::uint64_t seed = 0;     ///< Source::seed
  std::uint64_t species = 0;  ///< hash_of(Source::species)
  bool operator==(const SourceProgress&) const = default;
};

/// How a plane under a load (PlaneLoad) moves along its normal.
struct PlaneMotion {
  double displacement = 0;  ///< since time 0 [L]
  double velocity = 0;      ///< [L/T]
  bool operator==(const PlaneMotion&) const = default;
};

/// The load of all contacts and links on a particle whose motion is given.
struct GivenParticleLoad {
  std::int32_t particle = 0;
  Vector force{},  ///< mean in the last step [M L/T^2]
      torque{};    ///< about its centre [M L^2/T^2], of a disc in component 2
};

/// How far a suspension has been sheared (PairLubrication).
struct ShearProgress {
  double strain = 0;  ///< integral of the shear rate since the start [1]
  double rate = 0;  ///< factor on the gradient of the setting in the last step [1]; 0 at the start
  std::array<Vector, 3> gradient{};  ///< of the flow in the last step [1/T]; 0 at the start
  double offset = 0;  ///< displacement of images across y along x [L], within half a period
  /// The integral of signed_rate_of_strain() [1], of which the period vectors are those of an
  /// extension (suspensions/cell/strained_lattice.hpp).
  double net_strain = 0;
  /// The present period vectors [L] of a cell whose flow is no shear along x that changes along y;
  /// otherwise 0.
  std::array<Vector, 3> periods{};
  bool has_periods() const { return periods != std::array<Vector, 3>{}; }
  bool operator==(const ShearProgress&) const = default;
};

/// The state of a simulation, in any consistent units. To begin a new one, only `particles` has to
/// be set. The restart file (particle_runs/io/restart.cpp) stores the state bit for bit.
struct State {
  Particles particles;
  double time = 0;         ///< [T]
  std::int64_t steps = 0;  ///< >= 0
  /// The velocities are those at the time `time` - velocity_lag. The lag [T] is 0 except with
  /// Scheme::kLeapfrog.
  double velocity_lag = 0;
  /// Step n ends at time grid_time + (n - grid_step) h [T], where h is the time step of the case.
  /// Both members are 0 until a step ends at another time or a restart changes h; they are then the
  /// time at the end of that step, and the number of that step.
  double grid_time = 0;
  std::int64_t grid_step = 0;  ///< >= 0
  /// Neighbour list: pairs of particles that may touch soon, in order of first, second, image.
  std::vector<Pair> pairs;
  std::vector<Pair> walls;  ///< particles near obstacles, in order of obstacle, particle
  PairMemories memories;    ///< of `pairs` and `walls`, by Pair::memory
  // Two particles that are no pair of the list cannot touch as long as no particle has moved
  // further than its skin since the list was made.
  /// Positions at the time when `pairs` was made [L]; empty if there is no list yet.
  std::vector<double> positions_at_listing;
  std::vector<double> skins;  ///< skin of each particle [L], >= 0; empty if there is no list yet
  /// Mean forces and torques of the links in the last step [M L/T^2, M L^2/T^2], in the order of
  /// Links::force_count(), the first guess of the next step. Empty before the first step.
  std::vector<double> link_forces;
  /// Mean power of each arm in the last step [M L^2/T^3]. Empty before the first step.
  std::vector<double> arm_powers;
  double earlier_step = 0;  ///< length of the last step [T]; 0 if there was none
  /// Impulses of the impacts in the last step, without a fluid, for the tables walls.csv and
  /// stress.csv.
  std::vector<ImpactImpulse> impact_impulses;
  /// The motions of Setting::planes, 0 for planes without a load; empty if no plane has a load.
  std::vector<PlaneMotion> planes;
  /// Loads of the particles whose motion is given, without a fluid, in the order of their numbers.
  /// Empty before the first step.
  std::vector<GivenParticleLoad> given_loads;
  // The members from here to `earlier_positions` are empty or 0 without a fluid.
  /// Velocities and angular velocities in the last step [L/T, 1/T], motion_components() numbers
  /// (fluid_solver.hpp) for each particle: vx, vy, angular velocity; on an axis vz. Empty before
  /// the first step.
  std::vector<double> earlier_velocities;
  /// Forces and torques of the particles on the fluid at `earlier_velocities` [M L/T^2, M L^2/T^2],
  /// in the same order, without those of bodies, hinges and arms on particles without mass.
  std::vector<double> earlier_forces;
  /// In a fluid with inertia: length of the step before the last one [T]; 0 if there was none.
  double step_before = 0;
  /// In a fluid with inertia: the flow of earlier steps, as FluidSolver::saved_flow() returns it,
  /// only in a state that is to be written.
  std::vector<char> flow;
  /// With membranes: positions of all particles before the last step [L]; empty before the first
  /// step.
  std::vector<double> earlier_positions;
  /// The progress of each of Setting::sources. A simulation that begins adds an entry for each
  /// source that is not in the state yet. In `particles`, the particles of sources follow those of
  /// the case, in the order in which they were added.
  std::vector<SourceProgress> sources;
  ShearProgress shear;  ///< with PairLubrication
};

}  // namespace viscontact::particles
