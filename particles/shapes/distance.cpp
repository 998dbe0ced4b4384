// The maximum of the gap between bounding lines, by Newton's method on the direction of the normal.
#include "viscontact/particles/shapes/distance.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "viscontact/particles/shapes/normal_search.hpp"

namespace viscontact::particles {
namespace {

struct DistanceTuning {
  /// By how much of the sizes and the distance shapes must be apart to be told from others despite
  /// rounding errors of some 1e-16 of them.
  double margin = 1e-13;
  /// Sides whose directions differ by less are parallel [rad], because sines and cosines of their
  /// angles are rounded.
  double parallel = 1e-15;
  /// Directions from each shape in a search for deep overlaps. Of 216 000 random pairs with ratios
  /// up to 20, whose centres are anywhere within each other, 5 had another maximum that was larger
  /// by up to 2e-4 of the sizes; with 24 directions 17, and 2e-3.
  std::size_t directions = 36;
  /// Largest turn of the normal in one step from there [rad].
  double largest_turn = 0.3;
};
constexpr DistanceTuning kDistanceTuning;

/// An arc in the plane, with its centre relative to that of its shape.
struct PlacedArc {
  Vector2 axis{}, centre{}, semi_axes{};

  Vector2 support_point(const Vector2& normal, double& curvature_radius) const {
    const auto [a, b] = semi_axes;
    if (a == b) {
      curvature_radius = a;
      return a * normal;
    }
    const Vector2 along = along_axes(axis, normal);
    const double x = a * along[0], y = b * along[1], height = norm(Vector2{x, y});
    const double inverse = 1 / height, part = a * inverse * b;
    curvature_radius = part * inverse * part;
    return from_axes(axis, {a * inverse * x, b * inverse * y});
  }
};

PlacedArc placed(const Arc& arc, const Vector2& axis) {
  return {axis, from_axes(axis, arc.centre), arc.semi_axes};
}

PlacedArc arc_at(const PlacedShape& shape, const Vector2& normal) {
  return placed(shape.shape.arc_at(along_axes(shape.axis, normal)), shape.axis);
}

[[maybe_unused]] bool is_unit(const Vector2& direction) {
  return std::abs(norm(direction) - 1) < 1e-12;
}

/// An arc of the first shape and one of the second.
using Arcs = std::array<PlacedArc, 2>;

/// The lines perpendicular to a normal that bound two ellipses, each on the side of the other.
struct BoundingLines {
  Vector2 normal{};
  std::array<Vector2, 2> arms{};  ///< the points of the ellipses on them [L]
  Vector2 between{};              ///< from the first point to the second [L]
  double gap = 0;                 ///< of the lines [L]
  double slope = 0;               ///< derivative of `gap` by the angle of the normal [L]
  double bend = 0;                ///< minus the derivative of `slope`: gap + curvature radii [L]
};

/// What the maximum of the gap is like at the normal of a side.
struct SideMaximum {
  enum class Where { kHere, kCounterClockwise, kClockwise } where = Where::kHere;
  NearestPoints points{};  ///< if it is here; otherwise only normal and gap are given
  Arcs arcs{};             ///< those next to the side, towards the maximum
};

/// The part of an outline that is on a line perpendicular to a normal.
struct LinePart {
  double from = 0, to = 0;  ///< along the line, to the left of the normal [L]
  double height = 0;        ///< distance of the line from the centre [L]
  PlacedArc before{}, after{};
};

LinePart part_of(const Side& side, const Vector2& axis) {
  const Vector2 along = quarter_turn(side.normal);
  return {dot(side.from, along), dot(side.to, along), dot(side.from, side.normal),
          placed(side.before, axis), placed(side.after, axis)};
}

LinePart line_part(const PlacedShape& shape, const Vector2& normal) {
  for (int k = 0; k < shape.shape.sides(); ++k) {
    const Side side = shape.shape.side(k);
    const Vector2 own = from_axes(shape.axis, side.normal);
    if (dot(own, normal) > 0 && std::abs(cross(own, normal)) <= kDistanceTuning.parallel)
      return part_of(side, shape.axis);
  }
  const PlacedArc arc = arc_at(shape, normal);
  double radius = 0;
  const Vector2 point = arc.centre + arc.support_point(normal, radius);
  const double along = dot(point, quarter_turn(normal));
  return {along, along, dot(point, normal), arc, arc};
}

NearestPoints points_of(const BoundingLines& at) {
  return {at.gap, at.normal, at.arms[0], at.arms[1]};
}

NearestPoints exchanged(const NearestPoints& points) {
  return {points.gap, -points.normal, points.second_arm, points.first_arm};
}

class ShapePair {
 public:
  ShapePair(const PlacedShape& first, const PlacedShape& second)
      : shapes_{&first, &second},
        between_(second.centre - first.centre),
        least_radius_(first.shape.least_curvature_radius() + second.shape.least_curvature_radius()),
        margin_(kDistanceTuning.margin *
                (norm(between_) + first.shape.bounding_radius() + second.shape.bounding_radius())) {
  }

  NearestPoints nearest(const std::optional<Vector2>& guess) const {
    std::optional<SideMaximum> from, to;  // between them is the maximum
    if (shapes_[0]->shape.sides() + shapes_[1]->shape.sides() > 0)
      if (const auto points = maximum_at_side(from, to)) return *points;
    const auto is_between = [&](const Vector2& normal) {
      return (!from || cross(from->points.normal, normal) > 0) &&
             (!to || cross(normal, to->points.normal) > 0);
    };
    if (guess && is_between(*guess)) {
      const Arcs arcs = from ? from->arcs : to ? to->arcs : arcs_at(*guess);
      if (are_apart(lines(arcs, *guess).gap)) return maximum(arcs, *guess);
    }
    if (from) return maximum(from->arcs, from->points.normal);
    if (to) return maximum(to->arcs, to->points.normal);
    if (const auto normal = separating_normal()) return maximum(arcs_at(*normal), *normal);
    return deep_maximum();
  }

 private:
  /// True if the shapes are still apart by the margin, in the direction of lines with this gap,
  /// when each has lost a layer of its least curvature radius. Their convex cores have one shortest
  /// distance.
  bool are_apart(double gap) const { return gap > margin_ - least_radius_; }

  Arcs arcs_at(const Vector2& normal) const {
    return {arc_at(*shapes_[0], normal), arc_at(*shapes_[1], -normal)};
  }

  BoundingLines lines(const Arcs& arcs, const Vector2& normal) const {
    double first_radius = 0, second_radius = 0;
    const Vector2 first = arcs[0].support_point(normal, first_radius);
    const Vector2 second = arcs[1].support_point(normal, second_radius);
    BoundingLines at{normal, {arcs[0].centre + first, arcs[1].centre - second}};
    // The order of the sums makes the bits the same if the shapes are exchanged.
    at.between = between_ + (arcs[1].centre - arcs[0].centre) - (first + second);
    at.gap = dot(at.between, normal);
    at.slope = dot(at.between, quarter_turn(normal));
    at.bend = at.gap + (first_radius + second_radius);
    return at;
  }

  SideMaximum maximum_near_side(std::size_t own, const Side& side, const Vector2& normal) const;
  std::optional<NearestPoints> maximum_at_side(std::optional<SideMaximum>& from,
                                               std::optional<SideMaximum>& to) const;
  std::optional<Vector2> separating_normal() const;
  NearestPoints maximum(const Arcs& arcs, Vector2 normal) const;
  BoundingLines ascended(BoundingLines at) const;
  NearestPoints deep_maximum() const;

  std::array<const PlacedShape*, 2> shapes_;
  Vector2 between_;
  double least_radius_, margin_;
};

SideMaximum ShapePair::maximum_near_side(std::size_t own, const Side& side,
                                         const Vector2& normal) const {
  const PlacedShape& other = *shapes_[1 - own];
  const Vector2 along = quarter_turn(normal), between = own == 0 ? between_ : -between_;
  const LinePart mine = part_of(side, shapes_[own]->axis), its = line_part(other, -normal);
  // Along the line, the part of the other shape runs the other way.
  const double shift = dot(between, along), its_from = shift - its.to, its_to = shift - its.from;
  SideMaximum found;
  found.points.gap = dot(between, normal) - (mine.height + its.height);
  found.points.normal = normal;
  if (its_from > mine.to) {
    found.where = SideMaximum::Where::kCounterClockwise;
    found.arcs = {mine.after, its.after};
  } else if (its_to < mine.from) {
    found.where = SideMaximum::Where::kClockwise;
    found.arcs = {mine.before, its.before};
  } else {
    const double middle = (std::max(mine.from, its_from) + std::min(mine.to, its_to)) / 2;
    found.points.first_arm = mine.height * normal + middle * along;
    found.points.second_arm = (middle - shift) * along - its.height * normal;
  }
  if (own == 0) return found;
  std::swap(found.arcs[0], found.arcs[1]);
  found.points = exchanged(found.points);
  return found;
}

std::optional<NearestPoints> ShapePair::maximum_at_side(std::optional<SideMaximum>& from,
                                                        std::optional<SideMaximum>& to) const {
  for (std::size_t own = 0; own < 2; ++own)
    for (int k = 0; k < shapes_[own]->shape.sides(); ++k) {
      const Side side = shapes_[own]->shape.side(k);
      const Vector2 normal = from_axes(shapes_[own]->axis, side.normal);
      if (!(dot(normal, between_) * (own == 0 ? 1 : -1) > 0)) continue;  // not apart
      const auto found = maximum_near_side(own, side, normal);
      // With half of the margin, so that no rounding error makes a normal apart, but not the normal
      // of a side next to it, which would leave the arc uncertain.
      if (!are_apart(found.points.gap + margin_ / 2)) continue;
      if (found.where == SideMaximum::Where::kHere) return found.points;
      const Vector2& here = found.points.normal;
      if (found.where == SideMaximum::Where::kCounterClockwise) {
        if (!from || cross(from->points.normal, here) > 0) from = found;
      } else if (!to || cross(here, to->points.normal) > 0) {
        to = found;
      }
    }
  return {};
}

/// A normal for which are_apart() is true; std::nullopt if there is none. Points of the outline of
/// the difference of the shapes, without the layers, are found on both sides of the line from its
/// centre to the place of the other shape, and the normal of the chord between these points shows
/// a new one, until a normal separates, or the place is on the inner side of the chord (minkowski
/// portal refinement, Snethen, in Game Programming Gems 7).
std::optional<Vector2> ShapePair::separating_normal() const {
  if (between_ == Vector2{}) return {};
  const auto separates = [&](const Vector2& normal, Vector2& point) {
    const auto at = lines(arcs_at(normal), normal);
    point = between_ - at.between - least_radius_ * normal;
    return are_apart(at.gap);
  };
  Vector2 normal = unit(between_), left{}, right{};
  if (separates(normal, right)) return normal;
  double side = cross(between_, right);
  int n = 0;
  for (;; ++n) {  // another point, on the other side of the line
    if (side == 0 || n == kNormalSearchTuning.most_iterations) return {};
    normal = (side < 0 ? 1 : -1) * unit(quarter_turn(right));
    if (separates(normal, left)) return normal;
    const double other = cross(between_, left);
    if ((other > 0) != (side > 0)) break;
    right = left;
    side = other;
  }
  if (side > 0) std::swap(left, right);
  for (; n < kNormalSearchTuning.most_iterations; ++n) {
    const Vector2 chord = left - right;
    if (chord == Vector2{}) return {};
    normal = -quarter_turn(unit(chord));
    if (dot(between_, normal) <= dot(right, normal)) return {};
    Vector2 point{};
    if (separates(normal, point)) return normal;
    (cross(between_, point) > 0 ? left : right) = point;
  }
  return {};
}

/// Newton's method from a normal with a gap larger than minus both least curvature radii. Where it
/// is larger, the gap is a concave function of the angle, so that other normals are beyond the
/// maximum.
NearestPoints ShapePair::maximum(const Arcs& arcs, Vector2 normal) const {
  if (arcs[0].semi_axes[0] == arcs[0].semi_axes[1] &&
      arcs[1].semi_axes[0] == arcs[1].semi_axes[1]) {
    const Vector2 between = between_ + (arcs[1].centre - arcs[0].centre);
    const double distance = norm(between);
    auto at = lines(arcs, (1 / distance) * between);
    at.gap = distance - (arcs[0].semi_axes[0] + arcs[1].semi_axes[0]);
    return points_of(at);
  }
  NormalSearch search;
  for (int n = 0; n < kNormalSearchTuning.most_iterations && !search.is_done(); ++n) {
    const auto at = lines(arcs, normal);
    normal =
        at.gap > -least_radius_ ? search.next(normal, at.slope, at.bend) : search.back_from(normal);
  }
  return points_of(lines(arcs, normal));
}

/// Newton's method to a local maximum, in steps that are so short that the gap grows.
BoundingLines ShapePair::ascended(BoundingLines at) const {
  const double most = kDistanceTuning.largest_turn;
  double share = 1;
  for (int n = 0; n < kNormalSearchTuning.most_iterations; ++n) {
    const double newton = at.bend > 0 ? at.slope / at.bend : at.slope > 0 ? most : -most;
    const double turn = share * std::clamp(newton, -most, most);
    const Vector2 normal = unit(at.normal + turn * quarter_turn(at.normal));
    const auto next = lines(arcs_at(normal), normal);
    // The gain of such a small step is lost in rounding errors of the gap.
    const bool is_better = next.gap >= at.gap || (share == 1 && std::abs(turn) < 1e-7);
    if (is_better) at = next;
    if (std::abs(turn) <= kNormalSearchTuning.last_turn) break;
    share = is_better ? 1 : share / 2;
  }
  return at;
}

/// The largest of the maxima at sides, and of those near normals at which the gap is larger than at
/// the next ones, among many that are dense where an outline is curved.
NearestPoints ShapePair::deep_maximum() const {
  NearestPoints best{-std::numeric_limits<double>::infinity()};
  std::array<BoundingLines, 2 * kDistanceTuning.directions> grid;
  std::array<double, grid.size()> angles{};
  std::array<std::size_t, grid.size()> order{};
  std::size_t count = 0;
  for (std::size_t own = 0; own < 2; ++own) {
    const auto& [shape, centre, axis] = *shapes_[own];
    for (int k = 0; k < shape.sides(); ++k) {
      const Side side = shape.side(k);
      const auto found = maximum_near_side(own, side, from_axes(axis, side.normal));
      if (found.where == SideMaximum::Where::kHere && found.points.gap > best.gap)
        best = found.points;
    }
    for (std::size_t k = 0; k < kDistanceTuning.directions; ++k, ++count) {
      const auto outline = shape.at(2 * std::numbers::pi * static_cast<double>(k) /
                                    static_cast<double>(kDistanceTuning.directions));
      const Vector2 normal = (own == 0 ? 1 : -1) * from_axes(axis, outline.normal);
      grid[count] = lines(arcs_at(normal), normal);
      angles[count] = std::atan2(normal[1], normal[0]);
      order[count] = count;
    }
  }
  std::ranges::sort(order, {}, [&](std::size_t k) { return angles[k]; });
  for (std::size_t k = 0; k < count; ++k) {
    const auto& at = grid[order[k]];
    const bool is_largest = at.gap >= grid[order[(k + count - 1) % count]].gap &&
                            at.gap >= grid[order[(k + 1) % count]].gap;
    // Opposite to a normal away from the other shape, the gap is larger.
    if (!is_largest || dot(at.normal, between_) < 0) continue;
    if (const auto found = ascended(at); found.gap > best.gap) best = points_of(found);
  }
  return best;
}

}  // namespace

PlacedShape PlacedShape::at_angle(const Shape& shape, const Vector2& centre, double angle) {
  return {shape, centre, {std::cos(angle), std::sin(angle)}};
}

OutlinePoint PlacedShape::at(double t) const {
  OutlinePoint at = shape.at(t);
  const auto [x, y] = at.point;
  at.point = {centre[0] + axis[0] * x - axis[1] * y, centre[1] + axis[1] * x + axis[0] * y};
  at.normal = from_axes(axis, at.normal);
  return at;
}

NearestPoints nearest_points(const PlacedShape& first, const PlacedShape& second,
                             const std::optional<Vector2>& guess) {
  assert(is_unit(first.axis) && is_unit(second.axis) && (!guess || is_unit(*guess)));
  return ShapePair(first, second).nearest(guess);
}

NearestPoints nearest_to_wall(const PlacedShape& shape, const Vector2& point,
                              const Vector2& normal) {
  assert(is_unit(shape.axis) && is_unit(normal));
  const LinePart part = line_part(shape, -normal);
  const Vector2 arm = ((part.from + part.to) / 2) * quarter_turn(-normal) - part.height * normal;
  return {dot(normal, shape.centre - point) - part.height, -normal, arm, {}};
}

NearestToRoundWall nearest_to_round_wall(const PlacedShape& shape, const Vector2& centre,
                                         double radius) {
  assert(is_unit(shape.axis) && radius > 0);
  const auto far = shape.shape.far_points(along_axes(shape.axis, centre - shape.centre));
  NearestToRoundWall nearest{far.count};
  for (std::size_t n = 0; n < static_cast<std::size_t>(far.count); ++n)
    nearest.places[n] = {radius - far.distances[n],
                         from_axes(shape.axis, far.normals[n]),
                         from_axes(shape.axis, far.points[n]),
                         {}};
  return nearest;
}

}  // namespace viscontact::particles
