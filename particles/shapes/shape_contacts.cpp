// Contacts of rounded shapes are those of the circles around the nearest points of their cores.
#include "viscontact/particles/shapes/shape_contacts.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace viscontact::particles {
namespace {

struct ContactsTuning {
  /// Contacts that are nearer to each other than this share of the smaller radius count as one [1].
  double apart = 0.1;
};
constexpr ContactsTuning kContactsTuning;

/// The points of two cores that belong to a corner of one of them.
struct CorePlace {
  Vector2 first{}, second{};  ///< [L]
};

struct CorePlaces {
  std::vector<CorePlace> places;
  bool overlap = false;  ///< whether the cores overlap
};

Vector2 vector2(const Vector& x) { return {x[0], x[1]}; }
Vector vector3(const Vector2& x) { return {x[0], x[1], 0}; }

/// The point nearest to x of the line between two points.
Vector2 nearest_on_line(const Vector2& from, const Vector2& to, const Vector2& x) {
  const double dx = to[0] - from[0], dy = to[1] - from[1];
  const double square = dx * dx + dy * dy;
  const double along = (x[0] - from[0]) * dx + (x[1] - from[1]) * dy;
  const double t = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
  return {from[0] + t * dx, from[1] + t * dy};
}

/// The point of the outline of a core that is nearest to x.
Vector2 nearest_on_core(const Core& core, const Vector2& x) {
  const auto& corners = core.corners;
  Vector2 nearest = nearest_on_line(corners.front(), corners[corners.size() > 1 ? 1 : 0], x);
  for (std::size_t k = 1; k < corners.size() && corners.size() > 2; ++k) {
    const Vector2 at = nearest_on_line(corners[k], corners[(k + 1) % corners.size()], x);
    if (norm(at - x) < norm(nearest - x)) nearest = at;
  }
  return nearest;
}

/// On which side of a directed line a point is [L^2]: > 0 on the left, < 0 on the right.
double side_of(const Core& line, const Vector2& x) {
  return cross(line.corners[1] - line.corners[0], x - line.corners[0]);
}

bool lines_cross(const Core& one, const Core& other) {
  return side_of(one, other.corners[0]) * side_of(one, other.corners[1]) < 0 &&
         side_of(other, one.corners[0]) * side_of(other, one.corners[1]) < 0;
}

CorePlaces places_of(const Core& first, const Core& second) {
  CorePlaces all;
  all.places.reserve(first.corners.size() + second.corners.size());
  for (const auto& corner : first.corners)
    all.places.push_back({corner, nearest_on_core(second, corner)});
  for (const auto& corner : second.corners)
    all.places.push_back({nearest_on_core(first, corner), corner});
  all.overlap =
      first.corners.size() == 2 && second.corners.size() == 2 && lines_cross(first, second);
  return all;
}

/// True if one of the cores has an inside.
bool have_area(const Core& first, const Core& second) {
  return first.corners.size() > 2 || second.corners.size() > 2;
}

/// Number of the place with the shortest distance among those for which `takes_part(number)` is
/// true. It is the first one if several have this distance, and places.size() if there is no place.
template <class Predicate>
std::size_t nearest_of(const std::vector<CorePlace>& places, const Predicate& takes_part) {
  std::size_t nearest = places.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t place = 0; place < places.size(); ++place) {
    if (!takes_part(place)) continue;
    const double apart = norm(places[place].second - places[place].first);
    if (nearest < places.size() && !(apart < least)) continue;
    least = apart;
    nearest = place;
  }
  return nearest;
}

double curvature_radius_at(const PlacedShape& shape, const Vector2& normal) {
  const Vector2 own = along_axes(shape.axis, normal);
  return shape.shape.arc_at(own).curvature_radius(own);
}

/// The contact at the nearest points of two shapes.
SurfaceContact contact_at(const NearestPoints& near, const PlacedShape& first,
                          const PlacedShape& second) {
  SurfaceContact contact{near.gap, near.normal};
  contact.radii = {curvature_radius_at(first, near.normal),
                   curvature_radius_at(second, -near.normal)};
  contact.arms = {near.first_arm - contact.radii[0] * near.normal,
                  near.second_arm + contact.radii[1] * near.normal};
  contact.distance = std::max(0.0, near.gap + contact.radii[0] + contact.radii[1]);
  return contact;
}

/// The contact with an obstacle at the nearest point of a shape, of which `near` is a result for
/// the shape and the wall.
SurfaceContact contact_at(const NearestPoints& near, const PlacedShape& shape) {
  SurfaceContact contact{near.gap, -near.normal};
  contact.radii[1] = curvature_radius_at(shape, near.normal);
  contact.arms[1] = near.first_arm - contact.radii[1] * near.normal;
  contact.is_at_obstacle = true;
  contact.on_obstacle = shape.centre + near.first_arm + near.gap * near.normal;
  return contact;
}

NearestToRoundWall nearest_to(const PlanePosition& obstacle, const PlacedShape& shape) {
  if (obstacle.is_curved())
    return nearest_to_round_wall(shape, vector2(obstacle.point), obstacle.radius);
  return {1, {nearest_to_wall(shape, vector2(obstacle.point), vector2(obstacle.normal))}};
}

/// The number of a contact at an obstacle that is not that of a corner (WallContacts).
int number_of(const NearestPoints& near, const PlanePosition& obstacle, const PlacedShape& shape) {
  if (!obstacle.is_curved()) return 0;
  const auto [a, b] = shape.shape.semi_axes();
  const Vector2 longer = a >= b ? shape.axis : quarter_turn(shape.axis);
  return dot(near.first_arm, longer) >= 0 ? 0 : 1;
}

}  // namespace

std::array<double, 2> SurfaceContact::friction_arms() const {
  if (is_at_obstacle) return {0, radii[1] - dot(arms[1], normal)};
  const double sum = radii[0] + radii[1];
  const double share = sum > 0 ? distance / sum : 0;
  return {dot(arms[0], normal) + share * radii[0], share * radii[1] - dot(arms[1], normal)};
}

Core core_of(const PlacedShape& placed) {
  const auto& [shape, centre, axis] = placed;
  const auto at = [&](const Arc& arc) { return centre + from_axes(axis, arc.centre); };
  Core core;
  if (shape.sides() == 0) {
    const Arc arc = shape.arc_at({1, 0});
    if (arc.is_circle()) core = {arc.semi_axes[0], {at(arc)}};
    return core;
  }
  core.radius = shape.side(0).before.semi_axes[0];
  for (int k = 0; k < shape.sides(); ++k) {
    const Arc arc = shape.side(k).before;
    if (!arc.is_circle() || arc.semi_axes[0] != core.radius) return {};
    core.corners.push_back(at(arc));
  }
  return core;
}

double gap(const PlacedShape& first, const PlacedShape& second) {
  if (core_of(first).corners.empty() || core_of(second).corners.empty())
    return nearest_points(first, second).gap;
  const ShapeContacts contacts(first, second);
  return contacts.at(contacts.places().front(), first, second).gap;
}

double gap(const PlanePosition& obstacle, const PlacedShape& shape) {
  double least = std::numeric_limits<double>::infinity();
  const WallContacts contacts(obstacle, shape);
  for (const int place : contacts.places())
    least = std::min(least, contacts.at(place, obstacle, shape).gap);
  return least;
}

ShapeContacts::ShapeContacts(const PlacedShape& first, const PlacedShape& second) {
  const Core one = core_of(first), other = core_of(second);
  if (one.corners.empty() || other.corners.empty()) {
    normal_ = nearest_points(first, second).normal;
    return;
  }
  if (one.corners.size() == 1 || other.corners.size() == 1) return;
  const auto [places, overlap] = places_of(one, other);
  const auto nearest = nearest_of(places, [](std::size_t) { return true; });
  places_[0] = static_cast<int>(nearest);
  contact_of_.assign(places.size(), places_[0]);
  const double apart = kContactsTuning.apart * std::min(one.radius, other.radius);
  const auto next = nearest_of(places, [&](std::size_t place) {
    return norm(places[place].first - places[nearest].first) > apart &&
           norm(places[place].second - places[nearest].second) > apart;
  });
  if (overlap || next == places.size()) return;
  if (have_area(one, other) && nearest_points(first, second).gap < -(one.radius + other.radius))
    return;
  places_[1] = static_cast<int>(next);
  count_ = 2;
  const auto between = [&](std::size_t place, std::size_t to) {
    return norm(places[to].first - places[place].first) +
           norm(places[to].second - places[place].second);
  };
  for (std::size_t place = 0; place < places.size(); ++place)
    if (between(place, next) < between(place, nearest)) contact_of_[place] = places_[1];
}

int ShapeContacts::contact_of(int place) const {
  assert(place >= 0);
  const auto number = static_cast<std::size_t>(place);
  return number < contact_of_.size() ? contact_of_[number] : places_[0];
}

SurfaceContact ShapeContacts::at(int place, const PlacedShape& first,
                                 const PlacedShape& second) const {
  const Core one = core_of(first), other = core_of(second);
  if (one.corners.empty() || other.corners.empty())
    return contact_at(nearest_points(first, second, normal_), first, second);
  const double radii = one.radius + other.radius;
  if (have_area(one, other))
    if (const auto near = nearest_points(first, second); near.gap < -radii)
      return contact_at(near, first, second);
  const auto [places, overlap] = places_of(one, other);
  const int contact = contact_of(place);
  const auto& at = places[nearest_of(
      places, [&](std::size_t number) { return contact_of(static_cast<int>(number)) == contact; })];
  SurfaceContact made;
  made.normal = at.second - at.first;
  made.distance = std::hypot(made.normal[0], made.normal[1]);
  if (made.distance > 0)
    for (auto& x : made.normal) x /= made.distance;
  else
    made.normal = {1, 0};
  made.gap = (overlap ? 0 : made.distance) - one.radius - other.radius;
  made.arms = {at.first - first.centre, at.second - second.centre};
  made.radii = {one.radius, other.radius};
  return made;
}

WallContacts::WallContacts(const PlanePosition& obstacle, const PlacedShape& shape) {
  const auto corners = core_of(shape).corners.size();
  for (std::size_t k = 0; k < corners; ++k) places_.push_back(static_cast<int>(k));
  if (corners > 0) return;
  const auto near = nearest_to(obstacle, shape);
  for (std::size_t n = 0; n < static_cast<std::size_t>(near.count); ++n)
    places_.push_back(number_of(near.places[n], obstacle, shape));
}

int WallContacts::contact_of(int place) const {
  return std::ranges::find(places_, place) != places_.end() ? place : places_.front();
}

SurfaceContact WallContacts::at(int place, const PlanePosition& obstacle,
                                const PlacedShape& shape) const {
  const Core core = core_of(shape);
  if (core.corners.empty()) {
    const auto near = nearest_to(obstacle, shape);
    const bool is_second =
        places_.size() > 1 && near.count > 1 && number_of(near.places[1], obstacle, shape) == place;
    return contact_at(near.places[is_second ? 1 : 0], shape);
  }
  const Vector2 corner = core.corners[static_cast<std::size_t>(contact_of(place))];
  const Vector end = vector3(corner);
  SurfaceContact contact{gap(obstacle, end, core.radius), vector2(normal_at(obstacle, end))};
  contact.arms[1] = corner - shape.centre;
  contact.radii[1] = core.radius;
  contact.is_at_obstacle = true;
  contact.on_obstacle = corner - (core.radius + contact.gap) * contact.normal;
  return contact;
}

}  // namespace viscontact::particles
