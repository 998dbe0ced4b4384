// The table of shapes. A new kind is a source with its rule, and here an entry of ShapeKind, a
// declaration and a row. docs/extending.md adds one as an example.
#pragma once

#include "viscontact/particles/shapes/shape.hpp"

namespace viscontact::particles {

enum class ShapeKind : std::uint8_t {
  kDisc,
  kSphere,
  kPlate,
  kEllipse,
  // A new kind stands here, at the end of the list.
};

/// The key of a table `[[particle]]` of a case that gives a particle in the plane its shape.
struct ShapeKey {
  std::string_view name;  ///< empty for the shapes that the key `radius` alone gives
  bool is_pair = false;   ///< its value is a list of two lengths, otherwise one length
  /// True if it stands beside `radius`, false if it stands in place of `radius`.
  bool needs_radius = false;
  // The cells of the key in the table of docs/cases.md.
  std::string_view meaning{}, otherwise{};
  /// Shape::semi_axes() from the numbers [L] of the key, of which a single length is the first, and
  /// `radius`.
  Vector2 (*semi_axes)(const Vector2& numbers, double radius) = nullptr;
  /// Bounds of the ratio of the first semi-axis to the second, or with `is_pair` of the larger to
  /// the smaller one: meshes were tested up to `most_ratio`; a shape below `least_ratio` is nearly
  /// another one.
  double least_ratio = 1, most_ratio = 100;
};

/// What Shape's functions of the same names do for one kind of shape with the semi-axes `s` [L].
struct ShapeRule {
  std::string_view name;
  ShapeKey key;
  double (*measure)(const Vector2& s);
  double (*inertia)(const Vector2& s, double mass);
  double (*perimeter)(const Vector2& s);
  double (*bounding_radius)(const Vector2& s);
  double (*inner_radius)(const Vector2& s);
  double (*least_curvature_radius)(const Vector2& s);
  OutlinePoint (*at)(const Vector2& s, double t);
  /// nullptr: the whole outline is one ellipse, with the semi-axes `s`.
  Arc (*arc_at)(const Vector2& s, const Vector2& normal) = nullptr;
  int sides = 0;
  Side (*side)(const Vector2& s, int k) = nullptr;  ///< nullptr without sides
  FarPoints (*far_points)(const Vector2& s, const Vector2& from);
  double (*distance_to)(const Vector2& s, const Vector2& point);
};

extern const ShapeRule kDiscRule, kSphereRule, kPlateRule, kEllipseRule;

/// The rows, in the order of ShapeKind.
inline constexpr std::array kShapeRules = {
    &kDiscRule, &kSphereRule, &kPlateRule, &kEllipseRule,
    // The row of a new kind stands here, at the end of the list.
};

}  // namespace viscontact::particles
