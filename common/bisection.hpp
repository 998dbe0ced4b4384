// Finds by bisection where a condition becomes true.
#pragma once

namespace viscontact {

/// Returns the smallest double at which a condition is true, where the condition is false at `from`
/// and true at `to`; `to` if it is true only there. If the condition changes more than once in
/// between, returns one of the places where it becomes true.
template <class Condition>
double bisect_first_true(double from, double to, const Condition& holds) {
  for (double middle = from + (to - from) / 2; from < middle && middle < to;
       middle = from + (to - from) / 2)
    (holds(middle) ? to : from) = middle;
  return to;
}

}  // namespace viscontact
