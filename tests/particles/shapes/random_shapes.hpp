// Random shapes and places.
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "viscontact/particles/shapes/distance.hpp"
#include "viscontact/particles/shapes/shape_rule.hpp"

namespace viscontact::particles {

class RandomShapes {
 public:
  explicit RandomShapes(unsigned seed) : random_(seed) {}

  double uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  double log_uniform(double from, double to) { return from * std::pow(to / from, uniform(0, 1)); }
  double angle() { return uniform(-std::numbers::pi, std::numbers::pi); }
  bool coin() { return uniform(0, 1) < 0.5; }
  Vector2 direction() {
    const double phi = angle();
    return {std::cos(phi), std::sin(phi)};
  }

  Shape shape(ShapeKind kind, double most_ratio, double most_size) {
    const double size = log_uniform(1, most_size), ratio = log_uniform(1, most_ratio);
    switch (kind) {
      case ShapeKind::kDisc:
        return Shape::disc(size);
      case ShapeKind::kSphere:
        return Shape::sphere(size);
      case ShapeKind::kPlate:
        return Shape::plate(size, size / std::max(ratio, 1.001));
      case ShapeKind::kEllipse:
        break;
    }
    return coin() ? Shape::ellipse(size, size / ratio) : Shape::ellipse(size / ratio, size);
  }
  PlacedShape at_random_angle(const Shape& shape) {
    return PlacedShape::at_angle(shape, {uniform(-1, 1), uniform(-1, 1)}, angle());
  }
  /// Places the second shape so that its gap from a random point of the first one's outline is
  /// `gap` along the normal there.
  void place(const PlacedShape& first, PlacedShape& second, double gap) {
    const auto at = first.at(angle());
    const Vector2 own = along_axes(second.axis, -at.normal);
    second.centre =
        at.point + gap * at.normal - from_axes(second.axis, second.shape.support_point(own));
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace viscontact::particles
