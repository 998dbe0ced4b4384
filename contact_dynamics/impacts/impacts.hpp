// The impacts of a time step, at their times within the step, docs/physics.md (5.15) and (5.16).
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <span>
#include <vector>

#include "viscontact/constraint_rows/contact_rows.hpp"
#include "viscontact/constraint_rows/solver_names.hpp"
#include "viscontact/contact_solver/problem/constraint_problem.hpp"
#include "viscontact/particles/contact/contact_laws.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/neighbours/pairs_of_particles.hpp"
#include "viscontact/particles/state/rebound.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"
#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

/// u* and w* are the velocities [L/T] and angular velocities [1/T] at the end of the step without
/// contacts. Impacts::run() adds the changes by impacts to `displacements`, `turns` and `bodies`.
struct ImpactStep {
  const ContactLaws& laws;  ///< with the coefficient of restitution
  std::span<const Plane> obstacles;
  double begin = 0,
         end = 0;                   ///< both [T]
  double h = 0;                     ///< length of the step [T], > 0
  double impulse_time = 0;          ///< time for which forces act on the velocities in it [T], > 0
  double touching = 0;              ///< gaps up to this one count as closed [L], > 0
  std::span<double> displacements;  ///< h u* of particles, then of planes under a load [L]
  /// h/m [T/M] with the mass m, or 0 if the motion is given, at a constant velocity in the step.
  std::span<const double> mobilities;
  /// h w* [rad], 1 (discs) or 3 numbers for each; empty if no particle turns.
  std::span<double> turns;
  /// h/I with the moment of inertia I [T/(M L^2)]; empty if no particle turns.
  std::span<const double> turn_mobilities;
  std::span<BodyStep> bodies;
};

/// Finds the impacts in the order of their times. An impact is a collision of solids that rebound,
/// with all contacts of connected particles that are hit at one time. Between impacts each
/// particle, or the centre of its rigid body, flies on a parabola: with the acceleration a [L/T^2]
/// by forces, its velocity at the time t of the step is u* + a (t - h/2), plus the changes by its
/// impacts. An impact at t_c that changes it by d thus moves it by (h - t_c) d until the end.
/// Bodies turn with a constant angular velocity between impacts.
///
/// A pair is hit when its gap closes. If it touches, it is hit if it approached before the step,
/// or, if it bore a load, if it approaches faster than five times the velocity that forces give its
/// particles in the step. Hits at one time that have a common particle or rigid body form one
/// impact. A particle that leaves an impact towards a neighbour that it touches hits it next
/// (Newton's cradle).
///
/// A contact is left to the projection, without rebound, if its bounce would last less than a
/// twentieth of the step, or after 1000 hits of the pair in the step (30 if it bore a load). An
/// impact that cannot be solved keeps its last impulses and makes converged() false. The order of
/// the particles changes results by rounding errors only.
template <int D>
class Impacts {
 public:
  /// `state` must outlive this object. A pair that State::pairs and State::walls lack is never hit.
  Impacts(State& state, const ImpactStep& step);

  /// Finds and solves all impacts, adds what they change to the motions of the ImpactStep, and
  /// changes gamma of the pairs: minus the impulse that the film of a pair has absorbed [M L/T], <=
  /// 0.
  void run();
  /// Gives all pairs gamma and the memory that they had before run(); motions stay as they are.
  void undo();

  /// The contacts of all impacts in which solids touched, in order of time.
  const std::vector<Rebound>& rebounds() const { return rebounds_; }
  /// The impulses [M L/T] and moments [M L^2/T] of these impacts on particles whose motion is
  /// given.
  const std::vector<GivenParticleLoad>& on_given() const { return on_given_; }
  const std::vector<ImpactImpulse>& impulses() const { return impulses_; }
  int iterations() const { return iterations_; }
  const StagesRun& stages() const { return stages_; }
  /// True if the residuals of velocities of all impacts are at most 1e-8 of the fastest approach in
  /// the impact.
  bool converged() const { return converged_; }
  const std::vector<std::int32_t>& touched() const { return touched_; }
  /// True if an impact changed particle `k`; false for an obstacle.
  bool is_touched(std::int32_t k) const {
    return !flight_of_.empty() && k >= 0 && flight_of_[index_of(k)] >= 0;
  }
  /// Pairs are numbered as in State::pairs, then as in State::walls.
  bool is_hit(std::size_t k) const {
    assert(k < pair_count());
    return !hits_of_.empty() && hits_of_[k] > 0;
  }
  /// Displacement of particle `k` with its impacts but without the projection [L]; 0 without an
  /// impact.
  Vector displacement(std::int32_t k) const;
  /// Corrects velocities and angular velocities that were computed as displacements and turns over
  /// h: an impact at t_c that changes the velocity by d adds only (h - t_c) d to the displacement,
  /// so that t_c d/h is missing.
  void add_lags(Particles& particles) const;

 private:
  // The changes of velocity [L/T] of a particle, or of the centre of its body; these times the
  // times of their impacts [L]; and the same of its angular velocity [1/T, rad].
  struct Flight {
    Vector change{}, lag{}, turn_change{}, turn_lag{};
    Vector displacement{};  // in the step, with all impacts [L]
    int version = 0;        // number of impacts
  };
  // A hit of a pair that is expected at `time` [T]. It is void if another impact has changed one of
  // the two particles since, whose Flight::version then differs from `versions`.
  struct Expected {
    double time;
    std::size_t pair;
    std::array<int, 2> versions;
    bool operator>(const Expected& other) const {
      return time != other.time ? time > other.time : pair > other.pair;
    }
  };
  // The place of a particle in its rigid body, which at the time t has turned by t rate - lag. All
  // members are 0 for a particle without a body.
  struct Arm {
    Vector offset{};  // of the particle from the centre at the beginning of the step [L]
    Vector rate{};    // angular velocity, with the impacts so far [1/T]
    Vector lag{};     // Flight::turn_lag [rad]
    // The change of `rate` in this step [1/T] by torques, and in space also by the free precession.
    Vector by_step{};
    // The change of the offset from the beginning of the step to the time t [L].
    Vector swing(double t) const {
      return is_off_centre() ? displacement_at({}, t * rate - lag, offset, D) : Vector{};
    }
    Vector at(double t) const { return offset + swing(t); }
    bool is_off_centre() const { return offset != Vector{}; }
  };
  // The motion of the second particle of a pair relative to the first particle, or, at an obstacle,
  // to the origin. c + a t + b t^2 is the part that does not come from turns of bodies.
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
    // time `impulse_time` when the step is at its middle, at h/2.
    Vector velocity_without_forces(double t, double impulse_time, double h) const {
      return velocity(t) - (2 * (impulse_time + t - h / 2)) * b -
             cross(second.by_step, second.at(t)) + cross(first.by_step, first.at(t));
    }
  };
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
  // The result is zero for an obstacle and for a particle without an impact.
  const Flight& flight_or_none(std::int32_t k) const;
  int version(std::int32_t k) const { return k < 0 ? 0 : flight_or_none(k).version; }
  // True for an obstacle, and for a particle whose motion is given.
  bool is_given(std::int32_t k) const { return k < 0 || !(step_.mobilities[index_of(k)] > 0); }
  // The velocity is that at the end of the step without contacts [L/T]; 0 for an obstacle.
  Vector free_velocity(std::int32_t k) const;
  // The acceleration is the mean by forces in the step [L/T^2]; 0 for an obstacle.
  Vector acceleration(std::int32_t k) const;
  // The angular velocity without contacts, at all times with what torques change in the step [1/T].
  Vector free_spin(std::int32_t k) const;
  Vector spin(std::int32_t k) const { return free_spin(k) + flight_or_none(k).turn_change; }
  // The next two are those of the centre of the rigid body.
  Vector centre_velocity(std::int32_t k) const;
  Vector centre_acceleration(std::int32_t k) const;
  Arm arm_of(std::int32_t k) const;
  // The body of `k` as it is at the time t with the impacts so far. Its lists of members stay
  // empty, because a copy takes time.
  RigidBody body_at(std::int32_t k, double t) const;
  // At an impact [1/T]. The angular velocity of a body in space changes between impacts; with the
  // constant spin() an impact with the coefficient of restitution 1 would not keep the energy.
  Vector spin_at(std::int32_t k, double t) const;
  // Whether the angular velocity of a particle changes in free flight, as that of bodies in space.
  bool precesses(std::int32_t k) const {
    return D == 3 && k >= 0 && state_.particles.bodies.body_of(k) >= 0;
  }
  Approach approach_of(std::size_t k);
  // The normal leads from the first to the second member of the pair.
  Vector normal_of(const Approach& approach, double t) const;
  double gap_of(const Approach& approach, double t) const;
  // The velocity of the obstacle at its point nearest to the second particle [L/T].
  Vector surface_of(const Approach& approach, double t) const;
  // The velocity of the second centre relative to the first, or to the surface [L/T].
  Vector velocity_of(const Approach& approach, double t) const;
  // The second derivative of the gap by forces, and at an obstacle also by its shape and turns.
  double acceleration_of_gap(const Approach& approach, double t) const;
  // The first time at which the gap closes. An obstacle's velocity must not jump in between.
  std::optional<double> time_of_meeting(const Approach& approach, double from, double until) const;
  // Adds the next hit of pair `k` from the time `from` on, if it is within the step.
  void expect(std::size_t k, double from);
  // The contact of pair `k` if it is hit at `time`: its gap is closed and closes fast enough.
  std::optional<Hit> hit_at(std::size_t k, double time);
  // Solves an impact, makes its records, and expects the next hits. Does nothing if the films
  // absorb it. Momentum is kept to rounding errors, and the energy does not grow.
  void apply_impacts(const std::vector<Hit>& hits, double time);
  // The unknowns are changes of velocities times h [L]. One particle of each unit is appended to
  // `unit_of`.
  ConstraintProblem<D> problem_of(const std::vector<Hit>& hits, double time,
                                  std::vector<std::int32_t>& unit_of);
  // `change` is that of velocity and angular velocity times h [L, rad].
  void move_unit(std::int32_t particle, const Motion<D>& change, double time);
  // Adds what all impacts changed to the displacements and turns of the particles.
  void finish();

  State& state_;
  ImpactStep step_;
  std::vector<BodyStep> free_bodies_;  // without impacts
  std::priority_queue<Expected, std::vector<Expected>, std::greater<>> expected_;
  // For each particle its place in flights_, or -1 if no impact changed it; empty without an
  // impact.
  std::vector<std::int32_t> flight_of_;
  std::vector<Flight> flights_;
  std::vector<std::int32_t> touched_;
  std::optional<PairsOfParticles> pairs_of_;
  std::vector<int> hits_of_;  // of each pair
  std::vector<Rebound> rebounds_;
  std::vector<ImpactImpulse> impulses_;
  std::vector<GivenParticleLoad> on_given_;
  int iterations_ = 0;
  StagesRun stages_;
  bool converged_ = true;
  struct Before {
    std::size_t number;
    Pair pair;
    PairMemory memory;
  };
  std::vector<Before> before_;  // pairs as they were before an impact
};

}  // namespace viscontact::particles
