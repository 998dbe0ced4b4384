// The motion of a sphere with inertia, docs/physics.md (4.1), to more digits than a double has.
// Lengths, masses and times are in one unit each.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace viscontact {

/// The problem m q'' = -R(q) q' + f(t), q(0) = q0, q'(0) = v0, for the gap q of a sphere of mass m
/// with the resistance R and the force f. Its first integral is not used, so that it can check the
/// solution.
struct InertialProblem {
  using Function = std::function<long double(long double)>;
  /// A smooth piece of f, from the end of the piece before it (the first: from time 0) to `until`.
  struct Piece {
    long double until;
    Function force;  ///< of the time; asked at both ends of the piece
  };

  long double mass, initial_gap, initial_velocity;  ///< m > 0 [M], q0 > 0 [L], v0 [L/T]
  Function resistance;                              ///< R of the gap, > 0; smooth [M/T]
  std::vector<Piece> pieces;
};

/// The motion in s = ln q and w = q'/q,
///
///     s' = w,    w' = f/(m q) - (R/m) w - w^2,
///
/// by collocation at the 7 points of Radau IIA (order 13, L-stable, stiffly accurate; Hairer &
/// Wanner, Solving Ordinary Differential Equations II, IV.8) in long double, started anew at each
/// end of a piece. To choose its length, each step is also computed as two halves, which are kept.
class InertialMotion {
 public:
  /// `tolerance` is the largest difference of ln q, and of w relative to its largest value in the
  /// step, between a step and its two halves. The error that it leaves in the halves is rounding:
  /// m u + Gamma - P of the first integral, docs/physics.md (4.2), which should be 0, was below
  /// 1e-16 of the largest P on the way to a film of 1e-174 and back, and the tolerances 1e-13 and
  /// 1e-17 gave the same first 15 digits. Where |w| is below 1e-6 over the end time of the last
  /// piece, the difference of w is compared with that value, because the motion may be dying out.
  explicit InertialMotion(InertialProblem problem, long double tolerance = 1e-15L);

  /// Computes the motion until `time`, at which a step ends; not before the present time and not
  /// after the last piece. Throws std::runtime_error if the step becomes too short to advance the
  /// time.
  void advance(long double time);

  long double time() const { return from_ + elapsed_; }  ///< present time [T]
  long double log_gap() const { return state_[0]; }      ///< ln q
  long double gap() const;                               ///< q [L]
  long double velocity() const;                          ///< dq/dt [L/T]
  long steps() const { return steps_; }                  ///< number of steps so far

 private:
  static constexpr int kStages = 7;
  using State = std::array<long double, 2>;  // s, w

  State slope(const State& y, long double elapsed) const;
  /// State after a step; `largest_rate` grows to the largest |w| within it. Nothing if Newton's
  /// method does not converge.
  bool step(const State& y, long double elapsed, long double length, State& after,
            long double& largest_rate) const;
  void advance_in_piece(long double elapsed);

  InertialProblem problem_;
  long double tolerance_;
  std::size_t piece_ = 0;
  // The time is kept as three numbers: the beginning of the piece, the time since then, and the
  // rounding error of this sum. Near a film of 1e-170 the motion changes after a jump within times
  // as short as that, which would be lost in a sum with a number of order 1.
  long double from_ = 0, elapsed_ = 0, unbooked_ = 0;
  long double length_ = 0;  // of the next step
  State state_;
  long steps_ = 0;
};

/// `motion`, advanced to the time before `until` at which its velocity is 0, to rounding errors.
/// The velocities now and at `until` must have opposite signs, and `until` must be in the piece in
/// which the motion is or which it begins.
InertialMotion advanced_to_turn(const InertialMotion& motion, long double until);

/// The resistance R(q) = 6 pi mu r lambda(q/r) of a sphere of radius r near a plane in a fluid of
/// viscosity mu, for q/r up to 1e3. The drag factor lambda is Brenner's series (brenner.hpp), for
/// q/r below 3e-4 the expansion of data/reference/near_contact_expansion.csv. It is interpolated in
/// ln q with an error of 1e-18.
InertialProblem::Function exact_plane_resistance(long double viscosity, long double radius);

}  // namespace viscontact
