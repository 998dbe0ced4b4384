// Ellipses.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "viscontact/particles/shapes/normal_search.hpp"
#include "viscontact/particles/shapes/shape_rule.hpp"

namespace viscontact::particles {
namespace {

/// Distance of the point (x, y), x >= 0 and y >= 0, from an ellipse with the semi-axes a >= b along
/// the axes; < 0 inside. The nearest point of the ellipse is (a^2 x/(s + a^2), b^2 y/(s + b^2))
/// with the largest root s of (a x/(s + a^2))^2 + (b y/(s + b^2))^2 = 1. The code divides s by b^2.
/// For s > -1 the left side of the equation decreases and is convex, so that Newton's method,
/// started below the root, approaches it from below and never passes it.
double distance_to_ellipse(double a, double b, double x, double y) {
  const double square = (a / b) * (a / b);
  const double u = x / a, v = y / b;
  double near_x = 0, near_y = b;
  if (v > 0) {
    double s = std::max(v - 1, square * (u - 1));  // below the root, because one of the terms is 1
    // Newton's method ends by itself when s no longer grows.
    for (int n = 0; n < kNormalSearchTuning.most_iterations; ++n) {
      const double p = square * u / (s + square), q = v / (s + 1);
      const double value = p * p + q * q - 1;
      const double slope = 2 * (p * p / (s + square) + q * q / (s + 1));
      if (!(value > 0) || !(slope > 0)) break;
      const double next = s + value / slope;
      if (!(next > s)) break;
      s = next;
    }
    near_x = square * x / (s + square);
    near_y = y / (s + 1);
  } else if (const double part = a * x / (a * a - b * b); part < 1) {
    near_x = a * part;
    near_y = b * std::sqrt(1 - part * part);
  } else {
    near_x = a;
    near_y = 0;
  }
  const double distance = std::hypot(x - near_x, y - near_y);
  return u * u + v * v < 1 ? -distance : distance;
}

/// The normal of the ellipse `arc`, between the directions `from` and `to`, counter-clockwise, at
/// which the distance of its points from the origin has a maximum. The distance grows at `from` and
/// falls at `to`, or is stationary there, and has no other stationary points in between.
Vector2 farthest_between(const Arc& arc, const Vector2& from, const Vector2& to) {
  NormalSearch search(from, to);
  Vector2 normal = unit(from + to);
  for (int n = 0; n < kNormalSearchTuning.most_iterations && !search.is_done(); ++n) {
    const Vector2 far = arc.centre + arc.support_point(normal);
    normal = search.next(normal, dot(far, quarter_turn(normal)),
                         dot(far, normal) - arc.curvature_radius(normal));
  }
  return normal;
}

/// FarPoints of an ellipse whose centre is at (u, v) from the given point, with u, v >= 0 and the
/// semi-axes a >= b. A point of the ellipse at which the distance is stationary is on the line
/// through the given point and its own centre of curvature. There are four such points if the given
/// point is within the evolute, (a u)^(2/3) + (b v)^(2/3) < (a^2 - b^2)^(2/3), two of them nearest
/// ones; otherwise two, one of them nearest.
FarPoints far_points_in_quadrant(const Vector2& s, const Vector2& centre) {
  const auto [a, b] = s;
  const auto [u, v] = centre;
  const Arc arc{centre, s};
  FarPoints far;
  const auto add = [&](const Vector2& normal) {
    const auto n = static_cast<std::size_t>(far.count++);
    far.points[n] = arc.support_point(normal);
    far.normals[n] = normal;
    far.distances[n] = dot(centre, normal) + arc.support(normal);
  };
  const double focal = (a - b) * (a + b);
  const double p = std::cbrt(a * u), q = std::cbrt(b * v);
  const bool within_evolute = p * p + q * q < std::cbrt(focal) * std::cbrt(focal);
  if (v == 0)
    add({1, 0});
  else if (u == 0 && !within_evolute)
    add({0, 1});
  else
    add(farthest_between(arc, {1, 0}, {0, 1}));
  if (!within_evolute) return far;
  if (v == 0)
    add({-1, 0});
  else if (u == 0)
    add({-far.normals[0][0], far.normals[0][1]});
  else  // The stationary points have normals along (u/(m - a^2), v/(m - b^2)) with
      // (a u/(m - a^2))^2 + (b v/(m - b^2))^2 = 1. The first vector has the m of the least left
      // side.
    add(farthest_between(arc, unit(Vector2{-u * (q * q), v * (p * p)}), {-1, 0}));
  return far;
}

}  // namespace

constexpr ShapeRule kEllipseRule = {
    .name = "ellipse",
    .key = {.name = "semi_axes",
            .is_pair = true,
            .meaning = "[in the plane](#ellipses-and-plates), in place of `radius`: an ellipse, "
                       "whose first semi-axis points along `angle`",
            .otherwise = "from `radius`",
            .semi_axes = [](const Vector2& numbers, double) { return numbers; }},
    .measure = [](const Vector2& s) { return std::numbers::pi * s[0] * s[1]; },
    .inertia = [](const Vector2& s, double mass) { return mass / 4 * (s[0] * s[0] + s[1] * s[1]); },
    // By arithmetic and geometric means, whose number of equal digits doubles each time.
    .perimeter =
        [](const Vector2& s) {
          double mean = s[0], geometric = s[1], factor = 1, sum = (s[0] * s[0] + s[1] * s[1]) / 2;
          while (std::abs(mean - geometric) > 1e-8 * mean) {
            const double half = (mean - geometric) / 2;
            sum -= factor * half * half;
            geometric = std::sqrt(mean * geometric);
            mean -= half;
            factor *= 2;
          }
          return 4 * std::numbers::pi * sum / (mean + geometric);
        },
    .bounding_radius = [](const Vector2& s) { return std::max(s[0], s[1]); },
    .inner_radius = [](const Vector2& s) { return std::min(s[0], s[1]); },
    .least_curvature_radius =
        [](const Vector2& s) {
          const auto [least, most] = std::minmax(s[0], s[1]);
          return least / most * least;
        },
    .at =
        [](const Vector2& s, double t) {
          const double c = std::cos(t), sine = std::sin(t);
          const double speed = std::hypot(s[0] * sine, s[1] * c);
          return OutlinePoint{{s[0] * c, s[1] * sine},
                              {s[1] * c / speed, s[0] * sine / speed},
                              speed,
                              speed * (speed / s[0]) * (speed / s[1])};
        },
    .far_points =
        [](const Vector2& s, const Vector2& from) {
          const bool turned = s[0] < s[1];
          const Vector2 sign = {from[0] > 0 ? -1.0 : 1.0, from[1] > 0 ? -1.0 : 1.0};
          const auto mapped = [&](const Vector2& x) {
            return turned ? Vector2{sign[0] * x[1], sign[1] * x[0]}
                          : Vector2{sign[0] * x[0], sign[1] * x[1]};
          };
          const Vector2 centre = {std::abs(from[0]), std::abs(from[1])};
          auto far = turned ? far_points_in_quadrant({s[1], s[0]}, {centre[1], centre[0]})
                            : far_points_in_quadrant(s, centre);
          for (std::size_t n = 0; n < 2; ++n) {
            far.points[n] = mapped(far.points[n]);
            far.normals[n] = mapped(far.normals[n]);
          }
          return far;
        },
    .distance_to =
        [](const Vector2& s, const Vector2& point) {
          const double along = std::abs(point[0]), across = std::abs(point[1]);
          return s[0] > s[1] ? distance_to_ellipse(s[0], s[1], along, across)
                             : distance_to_ellipse(s[1], s[0], across, along);
        }};

}  // namespace viscontact::particles
