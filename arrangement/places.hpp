// Where the centre of a particle may be: a disc or a box, on the free side of planes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "viscontact/arrangement/arrangement_tuning.hpp"
#include "viscontact/common/splitmix.hpp"
#include "viscontact/particles/domain/region.hpp"

namespace viscontact::particles {

/// The region for the centre of a particle: a disc or a box, on the free side of all planes.
class Places {
 public:
  /// `from_wall` is the least distance of the centre from a wall or plane [L].
  Places(const Domain& domain, std::span<const PlanePosition> planes, double from_wall) {
    set_domain(domain, from_wall);
    for (auto plane : planes) {
      plane.point = plane.point + from_wall * plane.normal;
      planes_.push_back(plane);
      // Planes across an axis of a box make the box from which random places are taken smaller.
      for (std::size_t d = 0; d < dimension_ && !round_; ++d) {
        if (periods_[d] > 0) continue;
        if (plane.normal[d] == 1) from_[d] = std::max(from_[d], plane.point[d]);
        if (plane.normal[d] == -1) to_[d] = std::min(to_[d], plane.point[d]);
      }
    }
  }

 private:
  void set_domain(const Domain& domain, double from_wall) {
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
    dimension_ = box.dimension();
    periods_ = periods_of(domain);
    for (std::size_t d = 0; d < dimension_; ++d) {
      from_[d] = box.from[d] + (box.periodic[d] ? 0 : from_wall);
      to_[d] = box.to[d] - (box.periodic[d] ? 0 : from_wall);
    }
  }

 public:
  std::size_t dimension() const { return dimension_; }
  bool are_empty() const {
    double size = 1;
    for (std::size_t d = 0; d < dimension_; ++d) {
      if (!(from_[d] <= to_[d])) return true;
      size *= to_[d] - from_[d];
    }
    if (planes_.empty() || size == 0) return false;
    Domain whole = DiscDomain{centre_, radius_};
    if (!round_) whole = BoxDomain{from_, to_, {}};
    return measure(whole, planes_) < ArrangementTuning::kLeastFraction * size;
  }
  /// Period along axis `d` [L]; 0 if there is none.
  double period(std::size_t d) const { return periods_[d]; }
  /// Lowest coordinate along axis `d` [L].
  double from(std::size_t d) const { return from_[d]; }
  /// Width along axis `d` [L].
  double length(std::size_t d) const { return to_[d] - from_[d]; }

  bool contain(const Vector& x) const {
    for (const auto& plane : planes_)
      if (!(dot(plane.normal, x - plane.point) >= 0)) return false;
    return is_in_domain(x);
  }
  /// True if the region has neither walls nor planes.
  bool are_unbounded() const {
    for (std::size_t d = 0; d < dimension_; ++d)
      if (periods_[d] == 0) return false;
    return planes_.empty();
  }
  bool has_planes() const { return !planes_.empty(); }

  bool is_in_domain(const Vector& x) const {
    if (!round_) {
      for (std::size_t d = 0; d < dimension_; ++d)
        if (!(from_[d] <= x[d] && x[d] <= to_[d])) return false;
      return true;
    }
    const double dx = x[0] - centre_[0], dy = x[1] - centre_[1];
    return dx * dx + dy * dy <= radius_ * radius_;
  }

  /// The periodic image of `x` in the box. `x` may be outside by less than one period.
  Vector wrapped(Vector x) const {
    for (std::size_t d = 0; d < dimension_; ++d) {
      if (periods_[d] == 0) continue;
      if (x[d] < from_[d]) x[d] += periods_[d];
      if (x[d] >= to_[d]) x[d] -= periods_[d];
      // Rounding may leave a coordinate at the upper side or just below the lower one.
      if (x[d] < from_[d] || x[d] >= to_[d]) x[d] = from_[d];
    }
    return x;
  }

  /// The point of the region that is nearest to `x` [L]; in a disc slightly inside its edge. With
  /// planes, a point near that one, which may be outside the region in a corner.
  Vector nearest(Vector x) const {
    x = nearest_in_domain(x);
    for (int round = 0; round < ArrangementTuning::kProjections && !contain(x); ++round) {
      for (const auto& plane : planes_) {
        const double height = dot(plane.normal, x - plane.point);
        if (height < 0) x = x - ArrangementTuning::kBeyond * height * plane.normal;
      }
      x = nearest_in_domain(x);
    }
    return x;
  }

  Vector nearest_in_domain(Vector x) const {
    if (!round_) {
      x = wrapped(x);
      for (std::size_t d = 0; d < dimension_; ++d)
        if (periods_[d] == 0) x[d] = std::clamp(x[d], from_[d], to_[d]);
      return x;
    }
    if (is_in_domain(x)) return x;
    const double dx = x[0] - centre_[0], dy = x[1] - centre_[1];
    const double factor = radius_ * ArrangementTuning::kInside / std::sqrt(dx * dx + dy * dy);
    return {centre_[0] + factor * dx, centre_[1] + factor * dy};
  }

  /// A random point, uniformly distributed, of the region, which is not empty.
  Vector random(SplitMix64& random) const {
    for (;;) {
      Vector x{};
      for (std::size_t d = 0; d < dimension_; ++d) x[d] = random.between(from_[d], to_[d]);
      if (contain(x)) return wrapped(x);
    }
  }

  /// The shortest vector from `a` to an image of `b`, for two points of the region.
  Vector difference(const Vector& a, const Vector& b) const {
    Vector apart = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    for (std::size_t d = 0; d < dimension_; ++d) {
      if (periods_[d] == 0) continue;
      if (apart[d] > periods_[d] / 2) apart[d] -= periods_[d];
      if (apart[d] < -periods_[d] / 2) apart[d] += periods_[d];
    }
    return apart;
  }

 private:
  // round_: the region is a disc. from_, to_: lowest and highest coordinates of the region [L];
  // periods_ [L]: 0 along an axis without a period.
  bool round_ = false;
  std::size_t dimension_ = 2;
  double radius_ = 0;
  Vector centre_{}, from_{}, to_{}, periods_{};
  std::vector<PlanePosition> planes_;  // moved by the least distance of the centre
};

}  // namespace viscontact::particles
