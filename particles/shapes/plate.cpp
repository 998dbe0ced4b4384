// Plates with round ends.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "viscontact/particles/shapes/shape_rule.hpp"

namespace viscontact::particles {
namespace {

double half_spine(const Vector2& s) { return s[0] - s[1]; }
double area_of_plate_ends(const Vector2& s) { return std::numbers::pi * s[1] * s[1]; }

Arc arc_of_plate_end(const Vector2& s, double sign) {
  return {{sign * half_spine(s), 0}, {s[1], s[1]}};
}

}  // namespace

constexpr ShapeRule kPlateRule = {
    .name = "plate",
    .key = {.name = "length",
            .needs_radius = true,
            .meaning = "[in the plane](#ellipses-and-plates): the particle is a plate of this "
                       "length along `angle`, with round ends of the `radius`",
            .otherwise = "none",
            .semi_axes =
                [](const Vector2& numbers, double radius) {
                  return Vector2{numbers[0] / 2, radius};
                },
            .least_ratio = 1.01},
    .measure = [](const Vector2& s) { return area_of_plate_ends(s) + 4 * half_spine(s) * s[1]; },
    // The sum of the moments of a rectangle with the half sides l and b, and of two half discs,
    // whose centroids are 4 b/(3 pi) beyond the ends of the rectangle.
    .inertia =
        [](const Vector2& s, double mass) {
          const double l = half_spine(s), b = s[1];
          const double discs = area_of_plate_ends(s), rectangle = 4 * l * b;
          const double of_rectangle = (l * l + b * b) / 3;
          const double of_discs = b * b / 2 + l * l + 2 * l * (4 * b * b * b / 3) / discs;
          return mass / (discs + rectangle) * (rectangle * of_rectangle + discs * of_discs);
        },
    .perimeter = [](const Vector2& s) { return 2 * std::numbers::pi * s[1] + 4 * half_spine(s); },
    .bounding_radius = [](const Vector2& s) { return s[0]; },
    .inner_radius = [](const Vector2& s) { return s[1]; },
    .least_curvature_radius = [](const Vector2& s) { return s[1]; },
    .at =
        [](const Vector2& s, double t) {
          constexpr double kTurn = 2 * std::numbers::pi;
          const double l = half_spine(s), b = s[1], arc = std::numbers::pi * b;
          const double length = kTurn * b + 4 * l;
          // Distance along the outline from where the end on the first axis begins.
          double from = (t / kTurn - std::floor(t / kTurn)) * length + arc / 2;
          if (from >= length) from -= length;
          // The other half of the outline is the same, turned by pi.
          const double sign = from >= length / 2 ? -1 : 1;
          if (sign < 0) from -= length / 2;
          const double phi = std::min(from, arc) / b - std::numbers::pi / 2;
          const Vector2 normal = from < arc ? Vector2{std::cos(phi), std::sin(phi)} : Vector2{0, 1};
          const Vector2 point = {l - std::max(0.0, from - arc) + b * normal[0], b * normal[1]};
          return OutlinePoint{sign * point, sign * normal, length / kTurn, b};
        },
    .arc_at = [](const Vector2& s,
                 const Vector2& normal) { return arc_of_plate_end(s, normal[0] < 0 ? -1 : 1); },
    .sides = 2,
    .side =
        [](const Vector2& s, int k) {
          const double sign = k == 0 ? 1 : -1;
          const Vector2 normal = {0, sign}, half = {sign * half_spine(s), 0};
          const Vector2 middle = s[1] * normal;
          constexpr double kPi = std::numbers::pi;
          const double per_length = kPi / (kPi * s[1] + 2 * half_spine(s));
          const double from = kPi / 2 * s[1] * per_length + k * kPi;
          return Side{normal,
                      middle + half,
                      middle - half,
                      arc_of_plate_end(s, sign),
                      arc_of_plate_end(s, -sign),
                      from,
                      from + 2 * half_spine(s) * per_length};
        },
    .far_points =
        [](const Vector2& s, const Vector2& from) {
          FarPoints far;
          const double farther = from[0] > 0 ? -1 : 1;
          for (const double sign : {farther, -farther}) {
            const Arc end = arc_of_plate_end(s, sign);
            const Vector2 to_end = end.centre - from;
            // On this side of the end's centre, the round end is not further than the sides are.
            if (sign * to_end[0] <= 0) continue;
            const auto n = static_cast<std::size_t>(far.count++);
            far.normals[n] = unit(to_end);
            far.points[n] = end.centre + s[1] * far.normals[n];
            far.distances[n] = norm(to_end) + s[1];
          }
          return far;
        },
    .distance_to =
        [](const Vector2& s, const Vector2& point) {
          const double beyond = std::max(0.0, std::abs(point[0]) - half_spine(s));
          return norm(Vector2{beyond, point[1]}) - s[1];
        }};

}  // namespace viscontact::particles
