// Newton's method, with bisection where it fails, for the unit normal at which a function of the
// normal's angle has a maximum.
#pragma once

#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "viscontact/particles/values/vector2.hpp"

namespace viscontact::particles {

struct NormalSearchTuning {
  /// Bisections alone need 60 for all digits. Newton's method takes 5 on the average, and 13 at
  /// most, for ellipses with ratios up to 20 that nearly touch.
  int most_iterations = 100;
  /// The last turn of the normal [rad]. Newton's method squares it, times a factor of the order
  /// of the ratio of the axes.
  double last_turn = 1e-9;
};
inline constexpr NormalSearchTuning kNormalSearchTuning;

/// The maximum is counter-clockwise of normals where the function grows with the angle, and
/// clockwise of those where it falls.
class NormalSearch {
 public:
  NormalSearch() = default;
  /// The maximum is known to be between these normals, of which `to` is less than half a turn
  /// counter-clockwise of `from`.
  NormalSearch(const Vector2& from, const Vector2& to) : from_(from), to_(to) {}

  /// The next normal, if at `normal` the derivative of the function by the angle is `slope`, and
  /// that of the slope -`bend`, where bend > 0 if the maximum is not known to be between normals.
  Vector2 next(const Vector2& normal, double slope, double bend) {
    (slope > 0 ? from_ : to_) = inside_ = normal;
    const bool is_enclosed = from_ && to_;
    assert(bend > 0 || is_enclosed);
    if (!(bend > 0)) return middle();
    const double turn = slope / bend;
    const Vector2 newton = unit(normal + turn * quarter_turn(normal));
    if (std::abs(turn) <= kNormalSearchTuning.last_turn) {
      is_done_ = true;
      return newton;
    }
    const bool is_slow = std::abs(turn) > turn_before_ / 2;
    turn_before_ = std::exchange(last_turn_, std::abs(turn));
    const bool is_between =
        is_enclosed && cross(*from_, newton) > 0 && cross(newton, *to_) > 0 && !is_slow;
    return is_between || !is_enclosed ? newton : middle();
  }
  /// The next normal, if `normal`, a result of next(), is beyond the maximum, where the slope may
  /// have any sign.
  Vector2 back_from(const Vector2& normal) {
    (cross(inside_, normal) > 0 ? to_ : from_) = normal;
    assert(from_ && to_);
    return middle();
  }
  /// Whether the last result is the maximum.
  bool is_done() const { return is_done_; }

 private:
  Vector2 middle() {
    is_done_ = !(cross(*from_, *to_) > std::numeric_limits<double>::epsilon() / 2);
    return unit(*from_ + *to_);
  }

  std::optional<Vector2> from_, to_;
  Vector2 inside_{};  // of the last normal that was not beyond the maximum
  double last_turn_ = std::numeric_limits<double>::infinity(), turn_before_ = last_turn_;
  bool is_done_ = false;
};

}  // namespace viscontact::particles
