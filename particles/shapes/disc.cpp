// Discs and spheres.
#include <cmath>
#include <numbers>

#include "viscontact/particles/shapes/shape_rule.hpp"

namespace viscontact::particles {

constexpr ShapeRule kDiscRule = {
    .name = "disc",
    .key = {},
    .measure = [](const Vector2& s) { return std::numbers::pi * s[0] * s[0]; },
    .inertia = [](const Vector2& s, double mass) { return 0.5 * mass * s[0] * s[0]; },
    .perimeter = [](const Vector2& s) { return 2 * std::numbers::pi * s[0]; },
    .bounding_radius = [](const Vector2& s) { return s[0]; },
    .inner_radius = [](const Vector2& s) { return s[0]; },
    .least_curvature_radius = [](const Vector2& s) { return s[0]; },
    .at =
        [](const Vector2& s, double t) {
          const Vector2 normal = {std::cos(t), std::sin(t)};
          return OutlinePoint{s[0] * normal, normal, s[0], s[0]};
        },
    .far_points =
        [](const Vector2& s, const Vector2& from) {
          const double away = norm(from);
          const Vector2 normal = away > 0 ? (-1 / away) * from : Vector2{1, 0};
          return FarPoints{1, {s[0] * normal}, {normal}, {away + s[0]}};
        },
    .distance_to = [](const Vector2& s, const Vector2& point) { return norm(point) - s[0]; }};

constexpr ShapeRule kSphereRule = {
    .name = "sphere",
    .key = {},
    .measure = [](const Vector2& s) { return 4 * std::numbers::pi / 3 * s[0] * s[0] * s[0]; },
    .inertia = [](const Vector2& s, double mass) { return 0.4 * mass * s[0] * s[0]; },
    .perimeter = kDiscRule.perimeter,
    .bounding_radius = kDiscRule.bounding_radius,
    .inner_radius = kDiscRule.inner_radius,
    .least_curvature_radius = kDiscRule.least_curvature_radius,
    .at = kDiscRule.at,
    .far_points = kDiscRule.far_points,
    .distance_to = kDiscRule.distance_to};

}  // namespace viscontact::particles
