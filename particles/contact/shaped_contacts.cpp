// Shapes of a pair, or of a particle and an obstacle, at their places.
#include "viscontact/particles/contact/shaped_contacts.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace viscontact::particles {
namespace {

struct ShapedContactTuning {
  /// A surface of the curvature of its round wall has no finite effective radius: the largest
  /// radius of a particle in a round wall, over that of the wall.
  static constexpr double kMostOfWall = 0.999;
  /// Largest turn in a step [rad] of a particle that bears a load. Gaps then differ from the linear
  /// ones by up to a two hundredth of its size. In 36 piles of 24 shapes in steps of 5e-3 it halved
  /// the energy that steps with friction added (1.1 and 0.98 became 0.67 and 0.44 of 1e3) and
  /// divided 69 of 21600 steps; a limit of 0.03 divided a quarter of them.
  static constexpr double kLargestTurn = 0.1;
  /// The same by which turns move a contact along the surface, over the size of the particle. A
  /// thin ellipse that lies flat turns by less before its normal force has another arm: without
  /// this limit a single step added up to six times the energy of an ellipse of the ratio 50 that
  /// falls.
  static constexpr double kLargestShift = 0.1;
};

PlacedShape first_of(const Particles& p, const Pair& pair) {
  return p.placed_shape(index_of(pair.first));
}

PlacedShape second_of(const Particles& p, const Pair& pair) {
  return p.placed_shape(index_of(pair.second),
                        pair.first < 0 ? Vector{} : shift_of(p.cell, pair.image));
}

/// True if the pair may have several contacts, or if they may have other numbers than 0.
bool may_have_places(const Particles& p, const Pair& pair,
                     std::span<const PlanePosition> obstacles) {
  if (is_round(p, pair)) return false;
  const bool has_sides = p.shape(index_of(pair.second)).sides() > 0;
  if (pair.first < 0) return has_sides || obstacles[pair.plane()].is_curved();
  return has_sides && p.shape(index_of(pair.first)).sides() > 0;
}

Vector2 turned(const Vector2& x, double angle) {
  return from_axes({std::cos(angle), std::sin(angle)}, x);
}

/// The motion of an entry of the arrays, 0 of none (< 0).
ShapeMotion motion_of(std::int32_t entry, std::span<const double> displacements,
                      std::span<const double> turns) {
  if (entry < 0) return {};
  const auto k = index_of(entry);
  return {{displacements[2 * k], displacements[2 * k + 1]}, turns[k]};
}

/// The gap between the lines at right angles to `normal` that bound both shapes.
double gap_along_normal(const PlacedShape& first, const PlacedShape& second,
                        const Vector2& normal) {
  return dot(normal, second.centre - first.centre) -
         first.shape.support(along_axes(first.axis, normal)) -
         second.shape.support(along_axes(second.axis, -normal));
}

}  // namespace

ShapedContacts::ShapedContacts(const Particles& particles, const Pair& pair,
                               std::span<const PlanePosition> obstacles)
    : contacts_(pair.first < 0
                    ? std::variant<ShapeContacts, WallContacts>(
                          WallContacts(obstacles[pair.plane()], second_of(particles, pair)))
                    : ShapeContacts(first_of(particles, pair), second_of(particles, pair))) {}

std::span<const int> ShapedContacts::places() const {
  return std::visit([](const auto& contacts) { return contacts.places(); }, contacts_);
}

int ShapedContacts::contact_of(int place) const {
  return std::visit([&](const auto& contacts) { return contacts.contact_of(place); }, contacts_);
}

SurfaceContact ShapedContacts::at(const Particles& particles, const Pair& pair,
                                  std::span<const PlanePosition> obstacles) const {
  const auto second = second_of(particles, pair);
  if (const auto* walls = std::get_if<WallContacts>(&contacts_))
    return walls->at(pair.place, obstacles[pair.plane()], second);
  return std::get<ShapeContacts>(contacts_).at(pair.place, first_of(particles, pair), second);
}

PairRadii radii_of(const SurfaceContact& contact, const PlanePosition* obstacle) {
  PairRadii radii{contact.radii[0], contact.radii[1]};
  if (obstacle == nullptr) return radii;
  radii.first = std::numeric_limits<double>::infinity();
  if (obstacle->is_curved()) {
    radii.first = -obstacle->radius;
    radii.second = std::min(radii.second, ShapedContactTuning::kMostOfWall * obstacle->radius);
  }
  return radii;
}

ShapedContact::ShapedContact(const Particles& p, const Pair& pair,
                             std::span<const PlanePosition> obstacles)
    : contacts_(p, pair, obstacles),
      place_(contacts_.contact_of(pair.place)),
      shapes_{second_of(p, pair), second_of(p, pair)},
      is_at_obstacle_(pair.first < 0),
      at_start_(contacts_.at(p, pair, obstacles)) {
  angles_[1] = p.angles[index_of(pair.second)];
  if (is_at_obstacle_) {
    obstacle_ = obstacles[pair.plane()];
    return;
  }
  shapes_[0] = first_of(p, pair);
  angles_[0] = p.angles[index_of(pair.first)];
  for (std::size_t k = 0; k < 2; ++k) have_sides_[k] = shapes_[k].shape.sides() > 0;
  along_at_start_ = gap_along_normal(shapes_[0], shapes_[1], at_start_.normal);
}

double ShapedContact::gap_at(const PlanePosition& obstacle) const {
  assert(is_at_obstacle_);
  return contacts_.at(place_, obstacle, shapes_[1]).gap;
}

PlacedShape ShapedContact::moved(std::size_t side, const ShapeMotion& motion) const {
  const auto& from = shapes_[side];
  const Vector2 centre = from.centre + motion.displacement;
  if (from.shape.is_round()) return {from.shape, centre};
  return PlacedShape::at_angle(from.shape, centre, angles_[side] + motion.turn);
}

double ShapedContact::gap_after(const ShapeMotion& first, const ShapeMotion& second) const {
  if (is_at_obstacle_ || (have_sides_[0] && have_sides_[1])) return distance(first, second);
  const auto to_first = moved(0, first), to_second = moved(1, second);
  const auto along = [&](double turn) {
    const Vector2 normal = turn == 0 ? at_start_.normal : turned(at_start_.normal, turn);
    return gap_along_normal(to_first, to_second, normal);
  };
  double largest = along(0);
  if (have_sides_[0]) largest = std::max(largest, along(first.turn));
  if (have_sides_[1]) largest = std::max(largest, along(second.turn));
  return at_start_.gap + (largest - along_at_start_);
}

bool ShapedContact::pass(const ShapeMotion& first, const ShapeMotion& second) const {
  if (is_at_obstacle_) return false;
  const auto [of_first, of_second] = at_start_.levers();
  return at_start_.distance + dot(at_start_.normal, second.displacement - first.displacement) +
             of_first * first.turn + of_second * second.turn <
         0;
}

double ShapedContact::distance(const ShapeMotion& first, const ShapeMotion& second) const {
  if (!is_at_obstacle_) return contacts_.at(place_, moved(0, first), moved(1, second)).gap;
  return contacts_
      .at(place_, obstacle_, moved(1, {second.displacement - first.displacement, second.turn}))
      .gap;
}

double ShapedContact::turn(const ShapeMotion& first, const ShapeMotion& second) const {
  double largest = shapes_[1].shape.is_round() ? 0 : std::abs(second.turn);
  if (!is_at_obstacle_ && !shapes_[0].shape.is_round())
    largest = std::max(largest, std::abs(first.turn));
  return largest;
}

double ShapedContact::shift(const ShapeMotion& first, const ShapeMotion& second) const {
  const auto of_pair = radii();
  const double radius = 1 / (1 / of_pair.first + 1 / of_pair.second);
  const auto of_shape = [&](std::size_t side, const ShapeMotion& motion) {
    const auto& shape = shapes_[side].shape;
    return shape.is_round() ? 0 : radius * std::abs(motion.turn) / shape.bounding_radius();
  };
  return std::max(is_at_obstacle_ ? 0 : of_shape(0, first), of_shape(1, second));
}

Contact<2> contact_of(const Pair& pair, const ShapedContact& shaped) {
  const auto& start = shaped.at_start();
  Contact<2> contact{
      std::max(pair.first, -1), pair.second, start.normal, start.gap, pair.gamma, pair.impulse};
  contact.shaped = &shaped;
  if (pair.first >= 0)
    contact.image = pair.image;
  else
    contact.obstacle = -1 - pair.first;
  return contact;
}

double gap_after_turns(const Contact<2>& contact, std::span<const double> displacements,
                       std::span<const double> turns, bool is_distance) {
  assert(contact.shaped != nullptr);
  const auto& shaped = *contact.shaped;
  const auto first = motion_of(contact.first_entry(), displacements, turns),
             second = motion_of(contact.second, displacements, turns);
  return contact.gap +
         ((is_distance ? shaped.distance(first, second) : shaped.gap_after(first, second)) -
          shaped.at_start().gap);
}

bool pass(const Contact<2>& contact, std::span<const double> displacements,
          std::span<const double> turns) {
  assert(contact.shaped != nullptr);
  return contact.shaped->pass(motion_of(contact.first, displacements, turns),
                              motion_of(contact.second, displacements, turns));
}

double turn_of_shapes(const Contact<2>& contact, std::span<const double> displacements,
                      std::span<const double> turns) {
  assert(contact.shaped != nullptr);
  return contact.shaped->turn(motion_of(contact.first, displacements, turns),
                              motion_of(contact.second, displacements, turns));
}

bool turns_too_far(const Contact<2>& contact, std::span<const double> displacements,
                   std::span<const double> turns) {
  assert(contact.shaped != nullptr);
  const auto first = motion_of(contact.first, displacements, turns),
             second = motion_of(contact.second, displacements, turns);
  if (contact.shaped->turn(first, second) > ShapedContactTuning::kLargestTurn ||
      contact.shaped->shift(first, second) > ShapedContactTuning::kLargestShift)
    return true;
  if (contact.first < 0) return false;
  const auto& start = contact.shaped->at_start();
  const auto moved = [&](std::size_t side, const ShapeMotion& motion) {
    return motion.displacement + motion.turn * quarter_turn(start.arms[side]);
  };
  const double across = cross(start.normal, moved(1, second) - moved(0, first));
  return std::abs(across) > particles::kLargestTurn * (start.radii[0] + start.radii[1]);
}

void add_contacts_of(const Particles& particles, Pair pair,
                     std::span<const PlanePosition> obstacles, std::vector<Pair>& pairs) {
  if (!may_have_places(particles, pair, obstacles)) {
    pairs.push_back(pair);
    return;
  }
  const ShapedContacts contacts(particles, pair, obstacles);
  for (const int place : contacts.places()) {
    pair.place = place;
    pairs.push_back(pair);
  }
}

std::vector<Pair> at_present_places(std::vector<Pair> before, const Particles& particles,
                                    std::span<const PlanePosition> obstacles) {
  for (auto& pair : before)
    if (may_have_places(particles, pair, obstacles))
      pair.place = ShapedContacts(particles, pair, obstacles).contact_of(pair.place);
  std::ranges::stable_sort(before, {}, order_of);
  std::vector<Pair> pairs;
  for (const auto& pair : before)
    if (pairs.empty() || order_of(pairs.back()) != order_of(pair))
      pairs.push_back(pair);
    else if (pair.gamma < pairs.back().gamma)
      pairs.back() = pair;
  return pairs;
}

void list_present_contacts(std::vector<Pair>& pairs, const Particles& particles,
                           std::span<const PlanePosition> obstacles) {
  assert(std::ranges::is_sorted(pairs, {}, order_of));
  std::vector<Pair> listed;
  listed.reserve(pairs.size());
  const auto bodies = [](const Pair& pair) {
    return std::tuple(pair.first, pair.second, pair.image);
  };
  for (auto from = pairs.begin(); from != pairs.end();) {
    const auto to = std::find_if(from, pairs.end(),
                                 [&](const Pair& pair) { return bodies(pair) != bodies(*from); });
    if (!may_have_places(particles, *from, obstacles)) {
      listed.insert(listed.end(), from, to);
    } else {
      const auto before = at_present_places({from, to}, particles, obstacles);
      const auto begin = static_cast<std::ptrdiff_t>(listed.size());
      add_contacts_of(particles, {from->first, from->second, 0, 0, 0, from->image}, obstacles,
                      listed);
      std::sort(listed.begin() + begin, listed.end(),
                [](const Pair& a, const Pair& b) { return a.place < b.place; });
      for (auto made = listed.begin() + begin; made != listed.end(); ++made)
        for (const auto& old : before)
          if (old.place == made->place) *made = old;
    }
    from = to;
  }
  pairs = std::move(listed);
}

}  // namespace viscontact::particles
