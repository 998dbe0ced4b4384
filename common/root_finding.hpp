// Root finding in one unknown. Boost.Math 1.74 is not used, because results depend in their last
// digits on the points at which it evaluates functions, and its header takes 1.2 s to compile.
#pragma once

#include <cassert>

namespace viscontact {

/// The smallest double x at which holds(x) is true. holds() must be false at `from` and true at
/// `to` >= `from`. The result is `to` if the condition is true only there, or if `from` or `to` is
/// NaN. If the condition changes more than once, the result is one place where it becomes true.
template <class Condition>
double bisect_first_true(double from, double to, const Condition& holds) {
  assert(!(to < from));
  for (double middle = from + (to - from) / 2; from < middle && middle < to;
       middle = from + (to - from) / 2)
    (holds(middle) ? to : from) = middle;
  return to;
}

/// What happens if a step of Newton's method ends on an end of the bracket, the interval that
/// contains the root: with kClosed it is taken, with kOpen bisection replaces it.
enum class Bracket { kOpen, kClosed };

/// The root in [low, high] of an increasing function, by Newton's method, which starts at x in
/// [low, high]. A step that leaves the bracket, as it does with a slope of 0, is replaced by
/// bisection. `excess_and_slope(x)` returns the function and its derivative. The search ends where
/// the function is 0, or if settled(x, next) returns true, which means that the step from x to
/// `next` is only round-off, or after 200 steps.
template <class ExcessAndSlope, class Settled>
double bracketed_newton(double x, double low, double high, Bracket bracket,
                        const ExcessAndSlope& excess_and_slope, const Settled& settled) {
  assert(!(x < low) && !(x > high));
  // 60 steps of bisection alone shorten the bracket by a factor of 1e18.
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
