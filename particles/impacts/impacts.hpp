// The blows of a step between solids that rebound, at their times within the step: docs/physics.md
// (5.15) and (5.16). The projection of the step (projection/) follows with the motions that the
// blows leave. A blow is an impact with all its contacts. simulation.cpp and projection/ use it.
// Lengths, masses and times are in any consistent units. Results must depend on the order of the
// particles by rounding errors only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "viscontact/particles/bodies/rigid_bodies.hpp"
#include "viscontact/particles/constraints/constraint_problem.hpp"
#include "viscontact/particles/contact/contact_laws.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/impacts/rebound.hpp"
#include "viscontact/particles/neighbours/pairs_of_particles.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// The step that the blows belong to. u* and w* are the velocities and angular velocities at its
/// end without contacts. Arrays are those of the simulation and hold the motion without contacts;
/// run() adds what the blows change.
struct ImpactStep {
  const ContactLaws& laws;           ///< of all contacts
  std::span<const Plane> obstacles;  ///< they may move
  double begin = 0,                  ///< time at which the step begins [T]
      end = 0;                       ///< time at which the step ends [T], > begin
  double h = 0;                      ///< length of the step [T], > 0
  double kick = 0;                   ///< time for which forces act on the velocities in it [T], > 0
  double touching = 0;               ///< gaps up to this one count as closed [L], > 0
  std::span<double> displacements;   ///< h u* of all particles [L]
  std::span<const double> mobilities;       ///< h/m [T/M]
  std::span<double> turns;                  ///< h w* [rad]; empty if no particle turns
  std::span<const double> turn_mobilities;  ///< h/I [T/(M L^2)], as `turns`
  std::span<BodyStep> bodies;               ///< of all rigid bodies
};

/// Finds the blows of a step in the order of their times. Between blows each particle flies on the
/// parabola of the scheme: with the acceleration a of its forces, its velocity at the time t of the
/// step is u* + a (t - h/2), plus the changes by its blows so far. A blow at the time t_c that
/// changes the velocity by d moves the particle by (h - t_c) d in the rest of the step.
///
/// A pair is hit when its gap closes. A pair that touches and bore no load is hit if it approached
/// before the step. A pair that bore a load is hit only if it approaches faster than five times the
/// velocity that forces give its particles in the step. Blows of one time with a common body are
/// decided together, others one after the other. A particle that leaves a blow towards a neighbour
/// that it touches hits this neighbour next, so that a row of equal spheres passes a blow on
/// (Newton's cradle).
///
/// The projection takes over when a bounce would last less than a twentieth of the step, and after
/// 1000 hits of a pair in a step (30 if it bore a load). Nothing is thrown: what is not solved is
/// reported by converged().
template <int D>
class Impacts {
 public:
  /// `state` must outlive this object. Its lists hold all pairs that may meet in the step.
  Impacts(State& state, const ImpactStep& step);

  /// Finds all blows, adds them to the motions of `step` and changes gamma of the pairs.
  void run();
  /// Gives all pairs gamma and the memory that they had before run(). The motions stay as they are.
  void undo();

  /// The blows in which solids touched, in order of time.
  const std::vector<Rebound>& rebounds() const { return rebounds_; }
  /// Number of iterations that the blows took.
  int iterations() const { return iterations_; }
  /// Whether all blows were solved up to rounding errors.
  bool converged() const { return converged_; }
  /// The particles that blows changed.
  const std::vector<std::int32_t>& touched() const { return touched_; }
  /// True if a blow changed particle `k`; false for an obstacle.
  bool is_touched(std::int32_t k) const {
    return !flight_of_.empty() && k >= 0 && flight_of_[index_of(k)] >= 0;
  }
  /// Displacement of a particle with the blows alone [L], also after a projection changed it.
  Vector displacement(std::int32_t k) const;
  /// Adds to velocities and angular velocities what they have beyond displacements over h, because
  /// the blows came late in the step.
  void add_late_changes(Particles& particles) const;

 private:
  // What blows change in the motion of a particle: the sum of the changes of its velocity [L/T],
  // and in `late` the sum of the changes times the times of the blows [L]; turns: [1/T], [rad].
  struct Flight {
    Vector change{}, late{}, turn_change{}, late_turn{};
    Vector displacement{};  // in the step, with all blows [L]
    int version = 0;        // number of blows
  };
  // A blow that is expected at `time`, unless one of the particles is changed before.
  struct Expected {
    double time;
    std::size_t pair;
    std::array<int, 2> versions;
    bool operator>(const Expected& other) const {
      return time != other.time ? time > other.time : pair > other.pair;
    }
  };
  // The flight of the second particle of a pair: c + a t + b t^2 at the time t of the step is the
  // vector from the centre of the first particle, or, at an obstacle, the centre itself.
  struct Approach {
    Vector c{}, a{}, b{};
    double sum = 0;  // of the radii; of the second particle alone at an obstacle [L]
    const Plane* obstacle = nullptr;  // the first body, if it is an obstacle
    Vector before{};                  // relative velocity before the step [L/T]
    Vector at_rest{};  // `before` and the changes by the blows so far, without the load of the step
    Vector place(double t) const { return c + t * a + (t * t) * b; }
  };
  // A contact of a blow.
  struct Hit {
    std::size_t pair;
    Vector normal;
    double approach;  // velocity at which the gap closes, < 0 [L/T]
    Vector relative;  // velocity of the second centre relative to the first or the obstacle [L/T]
  };

  Pair& pair(std::size_t k) {
    return k < state_.pairs.size() ? state_.pairs[k] : state_.walls[k - state_.pairs.size()];
  }
  std::size_t pair_count() const { return state_.pairs.size() + state_.walls.size(); }
  Flight& flight(std::int32_t k);
  const Flight& flight_or_none(std::int32_t k) const;
  int version(std::int32_t k) const { return k < 0 ? 0 : flight_or_none(k).version; }
  Vector free_velocity(std::int32_t k) const;
  Vector acceleration(std::int32_t k) const;
  Vector spin(std::int32_t k) const;
  Approach approach_of(std::size_t k);
  Vector normal_of(const Approach& approach, double t) const;
  double gap_of(const Approach& approach, double t) const;
  Vector surface_of(const Approach& approach, double t) const;
  Vector velocity_of(const Approach& approach, double t) const;
  double acceleration_of_gap(const Approach& approach, double t) const;
  std::optional<double> time_of_meeting(const Approach& approach, double from, double until) const;
  void expect(std::size_t k, double from);
  std::optional<Hit> hit_at(std::size_t k, double time);
  void strike(const std::vector<Hit>& hits, double time);
  Vector offset_at(std::int32_t k, double t) const;
  Vector turning_velocity(std::int32_t k, double t) const;
  ConstraintProblem<D> problem_of(const std::vector<Hit>& hits, double time,
                                  std::vector<std::int32_t>& unit_of);
  void move_unit(std::int32_t particle, const Motion<D>& change, double time);
  void finish();

  State& state_;
  ImpactStep step_;
  std::vector<BodyStep> free_bodies_;  // step_.bodies without blows
  std::priority_queue<Expected, std::vector<Expected>, std::greater<>> expected_;
  std::vector<std::int32_t> flight_of_;  // of each particle, -1: none; empty without a blow
  std::vector<Flight> flights_;
  std::vector<std::int32_t> touched_;
  std::optional<PairsOfParticles> pairs_of_;
  std::vector<int> hits_of_;  // number of hits of each pair
  std::vector<Rebound> rebounds_;
  int iterations_ = 0;
  bool converged_ = true;
  struct Before {
    std::size_t number;
    Pair pair;
    PairMemory memory;
  };
  std::vector<Before> before_;  // pairs as they were before a blow
};

}  // namespace viscontact::particles
