// Root finding in one unknown: bisection of a condition, and Newton's method in a bracket. Used by
// lubrication/, reduced_model/ and rolling/. A change must keep the points at which functions are
// evaluated, because results of these parts depend on them in their last digits. Arguments have the
// unit of the caller; nothing is thrown. Boost.Math 1.74 takes other points and is therefore not
// used; besides, its header takes 1.2 s to compile.
#pragma once

namespace viscontact {

/// Returns the smallest double at which holds(x) is true. The caller knows that it is false at
/// `from` and true at `to` >= `from`; neither is checked. The result is `to` if the condition is
/// true only there, or if one end is NaN. If the condition changes more than once in between,
/// returns one of the places where it becomes true. to - from must be finite (not checked).
template <class Condition>
double bisect_first_true(double from, double to, const Condition& holds) {
  for (double middle = from + (to - from) / 2; from < middle && middle < to;
       middle = from + (to - from) / 2)
    (holds(middle) ? to : from) = middle;
  return to;
}

/// Whether Newton's method may step onto an end of the bracket (kClosed), or bisection replaces
/// such a step (kOpen).
enum class Bracket { kOpen, kClosed };

/// The root in [low, high] of an increasing function, by Newton's method from x in [low, high]. A
/// step that leaves the bracket, as it does with a slope of 0, is replaced by bisection.
/// `excess_and_slope(x)` returns the function and its derivative. The search ends where the
/// function is 0, or if settled(x, next) says that the step from x to next is round-off, or after
/// 200 steps; then the last x is returned. That low <= x <= high, and that there is a root, is not
/// checked.
template <class ExcessAndSlope, class Settled>
double bracketed_newton(double x, double low, double high, Bracket bracket,
                        const ExcessAndSlope& excess_and_slope, const Settled& settled) {
  // A limit against endless loops that is not reached, because 60 steps of bisection alone shorten
  // the bracket by a factor of 1e18.
  constexpr int kMaxSteps = 200;
  for (int step = 0; step < kMaxSteps; ++step) {
    const auto [excess, slope] = excess_and_slope(x);
    if (excess == 0) break;
    (excess > 0 ? high : low) = x;
    double next = x - excess / slope;
    if (bracket == Bracket::kOpen ? !(next > low && next < high) : !(next >= low && next <= high))
      next = low + (high - low) / 2;
    const bool done = settled(x, next);
    x = next;
    if (done) break;
  }
  return x;
}

}  // namespace viscontact
