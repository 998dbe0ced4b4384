// The table of shapes. A new kind is an entry of ShapeKind, a row here, and a source that has it.
#pragma once

#include "viscontact/particles/shapes/shape.hpp"

namespace viscontact::particles {

/// What Shape's functions of the same names do for one kind of shape with the semi-axes `s` [L].
struct ShapeRule {
  std::string_view name;
  double (*measure)(const Vector2& s);
  double (*inertia)(const Vector2& s, double mass);
  double (*perimeter)(const Vector2& s);
  double (*least_curvature_radius)(const Vector2& s);
  OutlinePoint (*at)(const Vector2& s, double t);
  Arc (*arc_at)(const Vector2& s, const Vector2& normal);
  int sides;
  Side (*side)(const Vector2& s, int k);  ///< nullptr without sides
  FarPoints (*far_points)(const Vector2& s, const Vector2& from);
};

extern const ShapeRule kDiscRule, kSphereRule, kPlateRule, kEllipseRule;

/// The rows, in the order of ShapeKind.
inline constexpr std::array<const ShapeRule*, kShapeKinds> kShapeRules = {
    &kDiscRule, &kSphereRule, &kPlateRule, &kEllipseRule};

}  // namespace viscontact::particles
