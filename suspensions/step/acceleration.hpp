// Anderson's acceleration of the loads of contacts, whose iteration is a fixed-point iteration.
#pragma once

#include <cstddef>
#include <deque>
#include <limits>
#include <vector>

#include "viscontact/suspensions/values/lanes.hpp"

namespace viscontact::suspensions {

/// Of the last iterates the combination with the least change, by least squares (Anderson 1965,
/// Walker & Ni 2011).
class Acceleration {
 public:
  void forget();
  /// Adds what the iteration makes of the loads `before`, and the motions that belong to it,
  /// relative to the flow of this rate. Forgets everything if the changes grow.
  void add(const std::vector<double>& before, const std::vector<double>& after,
           const std::vector<Motion>& motions, double rate);
  bool is_empty() const { return iterates_.size() < 2; }
  /// Combines the last iterates. There must be some.
  void combine(std::vector<double>& loads, std::vector<Motion>& motions, double& rate) const;

 private:
  struct Iterate {
    std::vector<double> loads, change;
    std::vector<Motion> motions;
    double rate = 0;
  };
  std::vector<double> weights() const;

  std::deque<Iterate> iterates_;
  double last_change_ = std::numeric_limits<double>::infinity();
};

}  // namespace viscontact::suspensions
