// A sphere with its inertia, to more digits than a double has.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace viscontact {

/// m q'' = -R(q) q' + f(t), q(0) = q0, q'(0) = v0, as it stands: no use is made of its first
/// integral, which is left as a check.
struct InertialProblem {
  using Function = std::function<long double(long double)>;
  /// A smooth piece of f, from where the one before ends (the first: 0) to `until`.
  struct Piece {
    long double until;
    Function force;  ///< of the time; asked at both ends of the piece
  };

  long double mass, initial_gap, initial_velocity;
  Function resistance;  ///< R of the gap, > 0; smooth
  std::vector<Piece> pieces;
};

/// The motion in s = ln q and w = q'/q,
///
///     s' = w,    w' = f/(m q) - (R/m) w - w^2,
///
/// by collocation at the 7 points of Radau IIA (order 13, L-stable, stiffly accurate; Hairer &
/// Wanner, Solving Ordinary Differential Equations II, IV.8) in long double, started anew at each
/// end of a piece. The step is chosen by doubling: each is done as two halves too, which are kept.
class InertialMotion {
 public:
  /// `tolerance`: the most by which ln q, and w relative to its largest in the step, may differ
  /// between a step and its two halves. What that leaves in the halves is round-off: m u + Gamma -
  /// P, which should be 0, was below 1e-16 of the largest P on the way to a film of 1e-174 and
  /// back, and 1e-13 and 1e-17 gave the same first 15 digits. A w below 1e-6 over the end of the
  /// last piece may be dying out: its digits count from there.
  explicit InertialMotion(InertialProblem problem, long double tolerance = 1e-15L);

  /// To `time`, not before the present one and not after the last piece. A step ends there. Throws
  /// std::runtime_error if the step becomes nothing.
  void advance(long double time);

  long double time() const { return from_ + elapsed_; }
  long double log_gap() const { return state_[0]; }
  long double gap() const;
  long double velocity() const;
  long steps() const { return steps_; }

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
  // The time is kept as the piece's beginning, what has passed since, and what that sum has rounded
  // off: a film of 1e-170 has layers as short as that after a jump, and a sphere that lands falls
  // through all scales in a time that no number of order 1 tells from none.
  long double from_ = 0, elapsed_ = 0, unbooked_ = 0;
  long double length_ = 0;  // of the next step
  State state_;
  long steps_ = 0;
};

/// `motion` at the time before `until` at which its velocity is 0, to round-off. It must be neither
/// 0 nor of one sign at both, and `until` in the piece that the motion is in or begins.
InertialMotion advanced_to_turn(const InertialMotion& motion, long double until);

/// 6 pi mu r lambda(q/r) of a sphere near a plane: Brenner's series (brenner.hpp), for q/r below
/// 3e-4 the expansion of data/reference/near_contact_expansion.csv; interpolated in ln q to 1e-18.
/// q/r up to 1e3.
InertialProblem::Function exact_plane_resistance(long double viscosity, long double radius);

}  // namespace viscontact
