// Where a condition begins to hold.
#pragma once

namespace viscontact {

/// The number at which a condition begins to hold that does not at `from` but does at `to`, to neighbouring numbers; `to` if it holds there alone. If it changes
/// more than once in between, one of the places.
template <class Condition>
double bisect_first_true(double from, double to, const Condition& holds) {
  for (double middle = from + (to - from) / 2; from < middle && middle < to;
       middle = from + (to - from) / 2)
    (holds(middle) ? to : from) = middle;
  return to;
}

}  // namespace viscontact
