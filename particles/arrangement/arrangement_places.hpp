// The places that the centres of an arrangement may take (arrangement.hpp). Lengths are in the unit
// of the case. Only + - * / and sqrt may be used, because these give the same bits on every
// machine.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <variant>

#include "viscontact/common/splitmix.hpp"
#include "viscontact/particles/domain/domain.hpp"

namespace viscontact::particles {

/// x and y of a centre, or of a vector between centres [L].
using Point = std::array<double, 2>;

/// The places that a centre may take: a disc, or a rectangle that may be periodic.
class Places {
 public:
  /// `from_wall` is the least distance of a centre from a wall [L].
  Places(const Domain& domain, double from_wall) {
    if (const auto* disc = std::get_if<DiscDomain>(&domain)) {
      radius_ = disc->radius - from_wall;
      centre_ = {disc->centre[0], disc->centre[1]};
      for (const std::size_t d : {0U, 1U}) {
        from_[d] = centre_[d] - radius_;
        to_[d] = centre_[d] + radius_;
      }
      round_ = true;
      return;
    }
    const auto& box = std::get<BoxDomain>(domain);
    periods_ = periods_of(domain);
    for (const std::size_t d : {0U, 1U}) {
      from_[d] = box.from[d] + (box.periodic[d] ? 0 : from_wall);
      to_[d] = box.to[d] - (box.periodic[d] ? 0 : from_wall);
    }
  }

  /// True if there is no place for a centre.
  bool are_empty() const { return !(from_[0] <= to_[0] && from_[1] <= to_[1]); }
  /// Period in direction `d` [L]; 0 if the domain is not periodic in it. `d` is 0 for x, 1 for y.
  double period(std::size_t d) const { return periods_[d]; }
  /// Smallest coordinate of a place in direction `d` [L].
  double from(std::size_t d) const { return from_[d]; }
  /// Largest less smallest coordinate of a place in direction `d` [L].
  double length(std::size_t d) const { return to_[d] - from_[d]; }

  /// True if a centre may be at `x`.
  bool contain(const Point& x) const {
    if (!round_) return from_[0] <= x[0] && x[0] <= to_[0] && from_[1] <= x[1] && x[1] <= to_[1];
    const double dx = x[0] - centre_[0], dy = x[1] - centre_[1];
    return dx * dx + dy * dy <= radius_ * radius_;
  }

  /// The same place in the box that is not repeated.
  Point wrapped(Point x) const {
    for (const std::size_t d : {0U, 1U}) {
      if (periods_[d] == 0) continue;
      if (x[d] < from_[d]) x[d] += periods_[d];
      if (x[d] >= to_[d]) x[d] -= periods_[d];
      // Rounding may leave a coordinate at the upper side or just below the lower one.
      if (x[d] < from_[d] || x[d] >= to_[d]) x[d] = from_[d];
    }
    return x;
  }

  /// The nearest place to `x` that is allowed, slightly inside.
  Point nearest(Point x) const {
    if (!round_) {
      x = wrapped(x);
      for (const std::size_t d : {0U, 1U})
        if (periods_[d] == 0) x[d] = std::clamp(x[d], from_[d], to_[d]);
      return x;
    }
    if (contain(x)) return x;
    const double dx = x[0] - centre_[0], dy = x[1] - centre_[1];
    // The centre moves inside by more than the rounding error, so that contain() holds.
    constexpr double kInside = 1 - 1e-12;
    const double factor = radius_ * kInside / std::sqrt(dx * dx + dy * dy);
    return {centre_[0] + factor * dx, centre_[1] + factor * dy};
  }

  /// A random place, uniformly distributed.
  Point random(SplitMix64& random) const {
    for (;;) {
      Point x{};
      for (const std::size_t d : {0U, 1U}) x[d] = random.between(from_[d], to_[d]);
      if (contain(x)) return wrapped(x);
    }
  }

  /// The shortest vector from `a` to `b`, across periodic sides too.
  Point difference(const Point& a, const Point& b) const {
    Point apart = {b[0] - a[0], b[1] - a[1]};
    for (const std::size_t d : {0U, 1U}) {
      if (periods_[d] == 0) continue;
      if (apart[d] > periods_[d] / 2) apart[d] -= periods_[d];
      if (apart[d] < -periods_[d] / 2) apart[d] += periods_[d];
    }
    return apart;
  }

 private:
  bool round_ = false;
  double radius_ = 0;
  Point centre_{}, from_{}, to_{};
  std::array<double, 2> periods_{};
};

}  // namespace viscontact::particles
