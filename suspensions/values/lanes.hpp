// Motions and loads of spheres in registers of four numbers.
#pragma once

#include "viscontact/common/lanes.hpp"
#include "viscontact/particles/values/vector.hpp"

namespace viscontact::suspensions {

using viscontact::cross;
using viscontact::dot;

using particles::dot;
using particles::norm;
using particles::Vector;
using particles::operator+;
using particles::operator-;
using particles::operator*;

inline Lanes lanes_of(const Vector& a) { return Lanes{a[0], a[1], a[2], 0}; }
inline Vector vector_of(const Lanes& a) { return {a[0], a[1], a[2]}; }

/// Three components without the fourth number, which rows of pairs have no memory for.
class Packed {
 public:
  Packed() = default;
  explicit Packed(const Lanes& a) : components_{a[0], a[1], a[2]} {}
  operator Lanes() const { return lanes_of(components_); }  // NOLINT: the same vector

 private:
  Vector components_{};
};
inline Lanes lanes_of(const Packed& a) { return a; }

/// The velocity [L/T] and angular velocity [1/T] of a sphere, or the force [M L/T^2] and torque
/// [M L^2/T^2] on it.
struct alignas(kLaneAlignment) Motion {
  Lanes along{};
  Lanes turn{};
};

}  // namespace viscontact::suspensions
