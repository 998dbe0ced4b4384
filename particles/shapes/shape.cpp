// What all shapes have in common.
#include "viscontact/particles/shapes/shape.hpp"

#include <algorithm>
#include <cassert>

#include "viscontact/particles/shapes/shape_rule.hpp"

namespace viscontact::particles {
namespace {

const ShapeRule& rule_of(ShapeKind kind) { return *kShapeRules[static_cast<std::size_t>(kind)]; }

}  // namespace

Shape Shape::disc(double radius) { return {ShapeKind::kDisc, {radius, radius}}; }
Shape Shape::sphere(double radius) { return {ShapeKind::kSphere, {radius, radius}}; }
Shape Shape::plate(double half_length, double end_radius) {
  return {ShapeKind::kPlate, {half_length, end_radius}};
}
Shape Shape::ellipse(double first, double second) { return {ShapeKind::kEllipse, {first, second}}; }

Shape::Shape(ShapeKind kind, const Vector2& semi_axes) : kind_(kind), semi_axes_(semi_axes) {
  assert(std::ranges::min(semi_axes) > 0 || kind == ShapeKind::kDisc);
  assert(semi_axes[0] > semi_axes[1] || kind != ShapeKind::kPlate);
}

std::string_view Shape::name() const { return rule_of(kind_).name; }
double Shape::measure() const { return rule_of(kind_).measure(semi_axes_); }
double Shape::inertia(double mass) const { return rule_of(kind_).inertia(semi_axes_, mass); }
double Shape::perimeter() const { return rule_of(kind_).perimeter(semi_axes_); }
double Shape::bounding_radius() const { return rule_of(kind_).bounding_radius(semi_axes_); }
double Shape::inner_radius() const { return rule_of(kind_).inner_radius(semi_axes_); }
double Shape::least_curvature_radius() const {
  return rule_of(kind_).least_curvature_radius(semi_axes_);
}
OutlinePoint Shape::at(double t) const { return rule_of(kind_).at(semi_axes_, t); }
double Shape::support(const Vector2& normal) const {
  const Arc arc = arc_at(normal);
  return dot(arc.centre, normal) + arc.support(normal);
}
Vector2 Shape::support_point(const Vector2& normal) const {
  const Arc arc = arc_at(normal);
  return arc.centre + arc.support_point(normal);
}
Arc Shape::arc_at(const Vector2& normal) const {
  const auto& rule = rule_of(kind_);
  return rule.arc_at == nullptr ? Arc{{}, semi_axes_} : rule.arc_at(semi_axes_, normal);
}
int Shape::sides() const { return rule_of(kind_).sides; }
Side Shape::side(int k) const {
  assert(k >= 0 && k < sides());
  return rule_of(kind_).side(semi_axes_, k);
}
FarPoints Shape::far_points(const Vector2& from) const {
  return rule_of(kind_).far_points(semi_axes_, from);
}
double Shape::distance_to(const Vector2& point) const {
  return rule_of(kind_).distance_to(semi_axes_, point);
}

}  // namespace viscontact::particles
