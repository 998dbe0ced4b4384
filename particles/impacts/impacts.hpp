// Finds and solves the blows of a time step, at their times within the step: docs/physics.md (5.15)
// and (5.16). A blow is a collision of solids that rebound, with all contacts of connected
// particles that are hit at one time. The projection (projection/) then computes the impulses of
// all remaining contacts of the step, without rebound. Lengths, masses and times are in any
// consistent units. Arrays have their entries in the order of the particles or bodies, which are
// numbered from 0; D (2 or 3) is the dimension. Nothing is checked or thrown; converged() tells
// whether all blows were solved. simulation.cpp and projection/ use this file. A change must keep
// that results depend on the order of the particles by rounding errors only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <span>
#include <vector>

#include "viscontact/particles/bodies/rigid_bodies.hpp"
#include "viscontact/particles/constraints/constraint_problem.hpp"
#include "viscontact/particles/contact/contact_laws.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/impacts/rebound.hpp"
#include "viscontact/particles/neighbours/pairs_of_particles.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// The step that the blows belong to. u* and w* are the velocities [L/T] and angular velocities
/// [1/T] that the particles would have at the end of the step without contacts. The arrays belong
/// to the simulation; Impacts::run() adds the changes by blows to `displacements`, `turns` and
/// `bodies`.
struct ImpactStep {
  const ContactLaws& laws;           ///< laws of all contacts, with the coefficient of restitution
  std::span<const Plane> obstacles;  ///< planes, which may move, and circles
  double begin = 0,                  ///< time at which the step begins [T]
      end = 0;                       ///< time at which the step ends [T], > begin
  double h = 0;                      ///< length of the step [T], > 0
  double kick = 0;                   ///< time for which forces act on the velocities in it [T], > 0
  double touching = 0;               ///< gaps up to this one count as closed [L], > 0
  std::span<double> displacements;   ///< h u* of all particles [L], D numbers for each
  /// h/m of all particles of the mass m [T/M], > 0, or 0 if the motion is given, at a constant
  /// velocity in the step.
  std::span<const double> mobilities;
  /// h w* of all particles [rad], 1 (discs) or 3 numbers for each; empty if no particle turns.
  std::span<double> turns;
  /// h/I of all particles of the moment of inertia I [T/(M L^2)], > 0; empty if no particle turns.
  std::span<const double> turn_mobilities;
  std::span<BodyStep> bodies;  ///< motions of all rigid bodies
};

/// Finds the blows of a step in the order of their times, which are counted from the beginning of
/// the step. Between blows each particle flies on a parabola: if forces give it the acceleration a
/// [L/T^2], its velocity at the time t is u* + a (t - h/2), plus the changes by its blows so far. A
/// blow at the time t_c that changes the velocity by d therefore moves the particle by (h - t_c) d
/// until the end of the step. The centre of a rigid body moves in the same way, and the body turns
/// with a constant angular velocity between blows.
///
/// A pair (two particles, or a particle and an obstacle) is hit when its gap closes. A pair that
/// touches and bore no load in the step before is hit if it approached before the step. A pair that
/// bore a load is hit only if it approaches faster than five times the velocity that forces give
/// its particles in the step. Hits at one time that have a common particle or rigid body form one
/// blow; other hits are solved one after the other. A particle that leaves a blow towards a
/// neighbour that it touches hits this neighbour next, so that a row of equal spheres passes a blow
/// on (Newton's cradle).
///
/// A contact is left to the projection, without rebound, if its bounce would last less than a
/// twentieth of the step, or after 1000 hits of the pair in the step (30 if it bore a load). These
/// numbers and the factor five above are free choices in impacts.cpp. With a smaller factor or
/// fraction, smaller bounces are computed; larger numbers of hits cost more time. A blow that
/// cannot be solved keeps its last impulses and makes converged() false.
template <int D>
class Impacts {
 public:
  /// `state` must outlive this object. State::pairs and State::walls must contain all pairs that
  /// may meet in the step; a pair that is missing there is never hit.
  Impacts(State& state, const ImpactStep& step);

  /// Finds and solves all blows, adds what they change to the motions of the ImpactStep, and
  /// changes gamma of the pairs: minus the impulse that the film of a pair has absorbed [M L/T],
  /// <= 0.
  void run();
  /// Gives all pairs gamma and the memory that they had before run(). The motions are not restored.
  void undo();

  /// The contacts of all blows in which solids touched, in order of time.
  const std::vector<Rebound>& rebounds() const { return rebounds_; }
  /// The impulses [M L/T] and moments [M L^2/T] of these blows on particles whose motion is given.
  const std::vector<GivenParticleLoad>& on_given() const { return on_given_; }
  /// The impulses of all contacts of these blows.
  const std::vector<BlowImpulse>& impulses() const { return impulses_; }
  /// Number of iterations of the solver in all blows, >= 0.
  int iterations() const { return iterations_; }
  /// Whether all blows were solved: the residuals of velocities are at most 1e-8 of the fastest
  /// approach in the blow (a free choice in strike.cpp).
  bool converged() const { return converged_; }
  /// The numbers of the particles that blows changed.
  const std::vector<std::int32_t>& touched() const { return touched_; }
  /// True if a blow changed particle `k`; false for an obstacle.
  bool is_touched(std::int32_t k) const {
    return !flight_of_.empty() && k >= 0 && flight_of_[index_of(k)] >= 0;
  }
  /// True if pair `k` was hit. Pairs are numbered as in State::pairs, then as in State::walls.
  bool is_hit(std::size_t k) const { return !hits_of_.empty() && hits_of_[k] > 0; }
  /// Displacement of particle `k` in the step with its blows but without the projection [L].
  Vector displacement(std::int32_t k) const;
  /// Corrects velocities and angular velocities that were computed as displacements and turns over
  /// h. A blow at the time t_c that changes the velocity by d adds only (h - t_c) d to the
  /// displacement. The quotient therefore lacks t_c d/h, which this function adds.
  void add_late_changes(Particles& particles) const;

 private:
  // What blows change in the motion of a particle, or of the centre of its rigid body. `change` is
  // the sum of the changes of its velocity [L/T]. `late` is the sum of these changes, each times
  // the time of its blow [L]. `turn_change` [1/T] and `late_turn` [rad] are the same two sums for
  // its angular velocity.
  struct Flight {
    Vector change{}, late{}, turn_change{}, late_turn{};
    Vector displacement{};  // in the step, with all blows [L]
    int version = 0;        // number of blows
  };
  // A hit of a pair that is expected at `time` [T]. It is void if another blow has changed one of
  // the two particles since: their numbers Flight::version then differ from `versions`.
  struct Expected {
    double time;
    std::size_t pair;
    std::array<int, 2> versions;
    bool operator>(const Expected& other) const {
      return time != other.time ? time > other.time : pair > other.pair;
    }
  };
  // The place of a particle in its rigid body, which turns around its centre: at the time t of the
  // step the body has turned by t rate - late. All members are 0 for a particle without a body.
  struct Arm {
    Vector offset{};  // of the particle from the centre at the beginning of the step [L]
    Vector rate{};    // angular velocity, with the blows so far [1/T]
    Vector late{};    // Flight::late_turn [rad]
    // The change of `rate` in this step [1/T] by torques, and in space also by the free precession
    // of the body.
    Vector by_step{};
    // The change of the offset from the beginning of the step to the time t [L].
    Vector swing(double t) const {
      return is_off_centre() ? displacement_at({}, t * rate - late, offset, D) : Vector{};
    }
    Vector at(double t) const { return offset + swing(t); }
    bool is_off_centre() const { return offset != Vector{}; }
  };
  // The motion of the second particle of a pair: at the time t of the step, place() is the vector
  // to its centre from that of the first particle, or, at an obstacle, from the origin. The
  // parabola c + a t + b t^2 is the part that does not come from the turning of rigid bodies.
  struct Approach {
    Vector c{}, a{}, b{};
    Arm first{}, second{};
    double sum = 0;  // sum of both radii; at an obstacle the radius of the second particle [L]
    const Plane* obstacle = nullptr;  // the partner, if it is an obstacle
    Vector before{};                  // relative velocity before the step [L/T]
    Vector pull{};                    // relative mean acceleration in the step [L/T^2]
    bool turns() const { return first.is_off_centre() || second.is_off_centre(); }
    Vector place(double t) const {
      return c + t * a + (t * t) * b + second.swing(t) - first.swing(t);
    }
    Vector velocity(double t) const {
      return a + (2 * t) * b + cross(second.rate, second.at(t)) - cross(first.rate, first.at(t));
    }
    Vector acceleration(double t) const {
      return 2.0 * b + cross(second.rate, cross(second.rate, second.at(t))) -
             cross(first.rate, cross(first.rate, first.at(t)));
    }
    // velocity() minus the changes by forces and torques in this step. Forces have acted for the
    // time `kick` when the step is at its middle, at h/2.
    Vector velocity_without_forces(double t, double kick, double h) const {
      return velocity(t) - (2 * (kick + t - h / 2)) * b - cross(second.by_step, second.at(t)) +
             cross(first.by_step, first.at(t));
    }
  };
  // A contact of a blow.
  struct Hit {
    std::size_t pair;
    Vector normal;    // unit vector
    double approach;  // velocity at which the gap closes, < 0 [L/T]
    // Velocity of the second centre relative to the first or the obstacle [L/T]. Both velocities
    // contain the turning of rigid bodies.
    Vector relative;
    double sum;  // Approach::sum [L]
  };

  Pair& pair(std::size_t k) {
    return k < state_.pairs.size() ? state_.pairs[k] : state_.walls[k - state_.pairs.size()];
  }
  std::size_t pair_count() const { return state_.pairs.size() + state_.walls.size(); }
  Flight& flight(std::int32_t k);
  const Flight& flight_or_none(std::int32_t k) const;
  int version(std::int32_t k) const { return k < 0 ? 0 : flight_or_none(k).version; }
  // True for an obstacle, and for a particle whose motion is given.
  bool is_given(std::int32_t k) const { return k < 0 || !(step_.mobilities[index_of(k)] > 0); }
  Vector free_velocity(std::int32_t k) const;
  Vector acceleration(std::int32_t k) const;
  Vector free_spin(std::int32_t k) const;
  Vector spin(std::int32_t k) const { return free_spin(k) + flight_or_none(k).turn_change; }
  Vector centre_velocity(std::int32_t k) const;
  Vector centre_acceleration(std::int32_t k) const;
  Arm arm_of(std::int32_t k) const;
  RigidBody body_at(std::int32_t k, double t) const;
  Vector spin_at(std::int32_t k, double t) const;
  // Whether the angular velocity of a particle changes in free flight, as that of bodies in space.
  bool precesses(std::int32_t k) const {
    return D == 3 && k >= 0 && state_.particles.bodies.body_of(k) >= 0;
  }
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
  ConstraintProblem<D> problem_of(const std::vector<Hit>& hits, double time,
                                  std::vector<std::int32_t>& unit_of);
  void move_unit(std::int32_t particle, const Motion<D>& change, double time);
  void finish();

  State& state_;
  ImpactStep step_;
  std::vector<BodyStep> free_bodies_;  // motions of the rigid bodies without blows
  std::priority_queue<Expected, std::vector<Expected>, std::greater<>> expected_;
  // For each particle its place in flights_, or -1 if no blow changed it; empty without a blow.
  std::vector<std::int32_t> flight_of_;
  std::vector<Flight> flights_;
  std::vector<std::int32_t> touched_;
  std::optional<PairsOfParticles> pairs_of_;
  std::vector<int> hits_of_;  // number of hits of each pair
  std::vector<Rebound> rebounds_;
  std::vector<BlowImpulse> impulses_;
  std::vector<GivenParticleLoad> on_given_;
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
