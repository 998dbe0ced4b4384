// Distances to and between circles, ellipses and plates, and the points at which circles meet.
#include "viscontact/particles/setting/outline.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace viscontact::particles {
namespace {

using Point = std::array<double, 2>;

/// Distance of the point (x, y), x >= 0 and y >= 0, from an ellipse with the semi-axes a >= b along
/// the axes; < 0 inside. The nearest point of the ellipse is (a^2 x/(s + a^2), b^2 y/(s + b^2))
/// with the largest root s of (a x/(s + a^2))^2 + (b y/(s + b^2))^2 = 1. The code divides s by b^2.
/// For s > -1 the left side of the equation decreases and is convex, so that Newton's method,
/// started below the root, approaches it from below and never passes it.
double distance_to_ellipse(double a, double b, double x, double y) {
  assert(a >= b && b > 0);
  const double square = (a / b) * (a / b);
  const double u = x / a, v = y / b;
  double near_x = 0, near_y = b;
  if (v > 0) {
    double s = std::max(v - 1, square * (u - 1));  // below the root, because one of the terms is 1
    // Newton's method ends by itself when s no longer grows.
    for (int n = 0; n < 100; ++n) {
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

/// The least value of a function of a point on the outline. The function is computed at evenly
/// spaced parameters, and ternary search then finds the minimum around the best of them.
template <class Function>
double least_on(const Outline& outline, const Function& function) {
  constexpr int kSamples = 128;  // the functions have at most two local minima
  constexpr double kStep = 2 * std::numbers::pi / kSamples;
  const auto value = [&](double t) { return function(outline.at(t)); };
  double least = std::numeric_limits<double>::infinity(), at = 0;
  for (int i = 0; i < kSamples; ++i)
    if (const double here = value(i * kStep); here < least) {
      least = here;
      at = i * kStep;
    }
  double low = at - kStep, high = at + kStep;
  constexpr int kDivisions = 60;  // (2/3)^60 is 3e-11; errors of a minimum are about its square
  for (int n = 0; n < kDivisions; ++n) {
    const double first = low + (high - low) / 3, second = high - (high - low) / 3;
    if (value(first) < value(second))
      high = second;
    else
      low = first;
  }
  return std::min(least, value((low + high) / 2));
}

/// The point nearest to x of the line between two points.
Point nearest_on_line(const std::array<Point, 2>& line, const Point& x) {
  const double dx = line[1][0] - line[0][0], dy = line[1][1] - line[0][1];
  const double square = dx * dx + dy * dy;
  const double along = (x[0] - line[0][0]) * dx + (x[1] - line[0][1]) * dy;
  const double t = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
  return {line[0][0] + t * dx, line[0][1] + t * dy};
}

double distance(const Point& x, const Point& y) {
  const double dx = y[0] - x[0], dy = y[1] - x[1];
  return std::sqrt(dx * dx + dy * dy);
}

/// On which side of a directed line a point is [L^2]: > 0 on the left, < 0 on the right.
double side_of(const std::array<Point, 2>& line, const Point& x) {
  return (line[1][0] - line[0][0]) * (x[1] - line[0][1]) -
         (line[1][1] - line[0][1]) * (x[0] - line[0][0]);
}

/// The four places of SpineContacts, in their order.
std::array<SpinePoints, 4> places_of_ends(const Outline& first, const Outline& second) {
  const auto one = first.spine(), other = second.spine();
  const bool cross = side_of(one, other[0]) * side_of(one, other[1]) < 0 &&
                     side_of(other, one[0]) * side_of(other, one[1]) < 0;
  return {SpinePoints{one[0], nearest_on_line(other, one[0]), cross},
          SpinePoints{one[1], nearest_on_line(other, one[1]), cross},
          SpinePoints{nearest_on_line(one, other[0]), other[0], cross},
          SpinePoints{nearest_on_line(one, other[1]), other[1], cross}};
}

/// Number of the place with the shortest distance among those for which `takes_part(number)` is
/// true. It is the first one if several have this distance, and places.size() if there is no place.
template <class Predicate>
std::size_t nearest_of(const std::array<SpinePoints, 4>& places, const Predicate& takes_part) {
  std::size_t nearest = places.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t end = 0; end < places.size(); ++end) {
    if (!takes_part(end)) continue;
    const double apart = distance(places[end].first, places[end].second);
    if (nearest < places.size() && !(apart < least)) continue;
    least = apart;
    nearest = end;
  }
  return nearest;
}

}  // namespace

std::array<Point, 2> Outline::spine() const {
  const double half = is_plate ? semi_axes[0] - semi_axes[1] : 0;
  const double x = half * std::cos(angle), y = half * std::sin(angle);
  return {Point{centre[0] + x, centre[1] + y}, Point{centre[0] - x, centre[1] - y}};
}

double Outline::length() const {
  assert(is_circle() || is_plate);
  return 2 * std::numbers::pi * end_radius() + (is_plate ? 4 * (semi_axes[0] - semi_axes[1]) : 0);
}

SpinePoints nearest_on_spines(const Outline& first, const Outline& second) {
  const auto places = places_of_ends(first, second);
  return places[nearest_of(places, [](std::size_t) { return true; })];
}

SpineContacts::SpineContacts(const Outline& first, const Outline& second) {
  constexpr double kApart = 0.1;  // share of the smaller end radius [1]
  const auto places = places_of_ends(first, second);
  const auto nearest = nearest_of(places, [](std::size_t) { return true; });
  places_ = {static_cast<int>(nearest)};
  contact_of_.fill(places_.front());
  const double apart = kApart * std::min(first.end_radius(), second.end_radius());
  const auto other = nearest_of(places, [&](std::size_t place) {
    return distance(places[place].first, places[nearest].first) > apart &&
           distance(places[place].second, places[nearest].second) > apart;
  });
  if (places[nearest].cross || other == places.size()) return;
  places_.push_back(static_cast<int>(other));
  const auto between = [&](std::size_t one, std::size_t two) {
    return distance(places[one].first, places[two].first) +
           distance(places[one].second, places[two].second);
  };
  for (std::size_t place = 0; place < places.size(); ++place)
    if (between(place, other) < between(place, nearest)) contact_of_[place] = places_[1];
}

SpinePoints SpineContacts::at(int place, const Outline& first, const Outline& second) const {
  assert(place >= 0 && place < 4);
  const auto places = places_of_ends(first, second);
  const int contact = contact_of(place);
  return places[nearest_of(places,
                           [&](std::size_t other) { return contact_of_[other] == contact; })];
}

Point Outline::at(double t) const {
  if (is_circle()) return {centre[0] + radius * std::cos(t), centre[1] + radius * std::sin(t)};
  if (is_plate) {
    constexpr double kPi = std::numbers::pi;
    const double half = semi_axes[0] - semi_axes[1], b = semi_axes[1], arc = kPi * b;
    // Distance along the outline from where the round end in the direction `angle` begins.
    double s = (t / (2 * kPi) - std::floor(t / (2 * kPi))) * length() + arc / 2;
    if (s >= length()) s -= length();
    // The other half of the outline is the same, turned by pi.
    const double turn = s >= length() / 2 ? kPi : 0;
    if (turn > 0) s -= length() / 2;
    const double phi = std::min(s, arc) / b - kPi / 2;
    const double x = half + b * std::cos(phi) - std::max(0.0, s - arc), y = b * std::sin(phi);
    const double c = std::cos(angle + turn), sine = std::sin(angle + turn);
    return {centre[0] + c * x - sine * y, centre[1] + sine * x + c * y};
  }
  const double x = semi_axes[0] * std::cos(t), y = semi_axes[1] * std::sin(t);
  const double c = std::cos(angle), s = std::sin(angle);
  return {centre[0] + c * x - s * y, centre[1] + s * x + c * y};
}

double Outline::speed_at(double t) const {
  if (is_circle()) return radius;
  if (is_plate) return length() / (2 * std::numbers::pi);
  return std::hypot(semi_axes[0] * std::sin(t), semi_axes[1] * std::cos(t));
}

double Outline::curvature_radius_at(double t) const {
  if (is_circle()) return radius;
  if (is_plate) return semi_axes[1];  // that of the ends; straight sides have none
  const double speed = speed_at(t);
  return speed * (speed / semi_axes[0]) * (speed / semi_axes[1]);
}

double distance_to(const Outline& outline, const Point& x) {
  const double dx = x[0] - outline.centre[0], dy = x[1] - outline.centre[1];
  // std::hypot takes ten times as long, and is better only for lengths beyond 1e150.
  if (outline.is_circle()) return std::sqrt(dx * dx + dy * dy) - outline.radius;
  if (outline.is_plate)
    return distance(nearest_on_line(outline.spine(), x), x) - outline.end_radius();
  const double c = std::cos(outline.angle), s = std::sin(outline.angle);
  const double along = std::abs(c * dx + s * dy), across = std::abs(c * dy - s * dx);
  const auto [a, b] = outline.semi_axes;
  return a > b ? distance_to_ellipse(a, b, along, across)
               : distance_to_ellipse(b, a, across, along);
}

double gap(const Outline& first, const Outline& second) {
  if (first.is_circle()) return distance_to(second, first.centre) - first.radius;
  if (second.is_circle()) return distance_to(first, second.centre) - second.radius;
  if (first.is_plate && second.is_plate) {
    const auto nearest = nearest_on_spines(first, second);
    const double apart = nearest.cross ? 0 : distance(nearest.first, nearest.second);
    return apart - first.end_radius() - second.end_radius();
  }
  if (first.is_plate) return gap(second, first);
  return least_on(first, [&](const Point& x) { return distance_to(second, x); });
}

double gap(const PlanePosition& obstacle, const Outline& outline) {
  if (outline.is_circle())
    return gap(obstacle, Vector{outline.centre[0], outline.centre[1], 0}, outline.radius);
  if (outline.is_plate) {
    const auto of_end = [&](const Point& x) {
      return gap(obstacle, Vector{x[0], x[1], 0}, outline.end_radius());
    };
    const auto ends = outline.spine();
    return std::min(of_end(ends[0]), of_end(ends[1]));
  }
  return least_on(outline, [&](const Point& x) { return gap(obstacle, Vector{x[0], x[1], 0}, 0); });
}

Outline outline_of(const Fluid& fluid, const Particles& particles, std::span<const double> angles,
                   std::size_t k, const Vector& shift) {
  assert(k < particles.count());
  const Vector x = particles.position(k) + shift;
  Outline outline{particles.dimension == 1 ? Point{0, x[0]} : Point{x[0], x[1]},
                  particles.radii[k]};
  if (fluid.is_ellipse(k) || fluid.is_plate(k)) {
    assert(k < angles.size());
    outline.semi_axes = fluid.semi_axes[k];
    outline.angle = angles[k];
    outline.is_plate = fluid.is_plate(k);
  }
  return outline;
}

std::optional<Chord> chord_of(const Particles& particles, std::size_t k, std::size_t other) {
  assert(particles.dimension == 2);
  assert(k < particles.count() && other < particles.count());
  // The points are computed from the disc with the smaller number, so that they are the same to the
  // last bit if k and `other` are exchanged.
  const std::size_t i = std::min(k, other), j = std::max(k, other);
  const Vector x = particles.position(i), apart = particles.position(j) - x;
  const double d = norm(apart), a = particles.radii[i], b = particles.radii[j];
  if (!(d < a + b) || !(d > std::abs(a - b))) return {};
  const double along = (d * d + (a - b) * (a + b)) / (2 * d);  // from x to the chord
  const double half_length = std::sqrt(std::max(0.0, (a - along) * (a + along)));
  const Vector unit = (1 / d) * apart;
  const std::array<double, 2> right = {x[0] + along * unit[0] + half_length * unit[1],
                                       x[1] + along * unit[1] - half_length * unit[0]};
  const std::array<double, 2> left = {x[0] + along * unit[0] - half_length * unit[1],
                                      x[1] + along * unit[1] + half_length * unit[0]};
  Chord chord{other};
  const double sign = k == i ? 1 : -1;
  const double radius = particles.radii[k], to_chord = k == i ? along : d - along;
  chord.from = k == i ? right : left;
  chord.to = k == i ? left : right;
  chord.middle = std::atan2(sign * unit[1], sign * unit[0]);
  chord.half = std::atan2(half_length, to_chord);
  chord.area = radius * radius * chord.half - to_chord * half_length;
  chord.wedge = std::atan2(half_length, along) + std::atan2(half_length, d - along);
  return chord;
}

std::vector<Chord> chords_of(const Fluid& fluid, const Particles& particles, std::size_t k) {
  std::vector<Chord> chords;
  const auto body = particles.bodies.body_of(static_cast<std::int32_t>(k));
  if (body < 0 || !fluid.is_disc(k) || fluid.constraint != RigidConstraint::kRigid) return chords;
  for (const auto member : particles.bodies.bodies[static_cast<std::size_t>(body)].members)
    if (const auto other = static_cast<std::size_t>(member); other != k && fluid.is_disc(other))
      if (const auto chord = chord_of(particles, k, other)) chords.push_back(*chord);
  const auto is_within = [](const Chord& chord, const Chord& of) {
    const double apart = std::remainder(chord.middle - of.middle, 2 * std::numbers::pi);
    return chord.half < of.half && std::abs(apart) + chord.half <= of.half;
  };
  const auto all = chords;
  std::erase_if(chords, [&](const Chord& chord) {
    return std::ranges::any_of(all, [&](const Chord& of) { return is_within(chord, of); });
  });
  std::ranges::sort(chords, {}, &Chord::middle);
  return chords;
}

std::vector<double> cut_areas_of(const Fluid& fluid, const Particles& particles) {
  std::vector<double> areas(particles.count());
  for (std::size_t k = 0; k < areas.size(); ++k)
    for (const auto& chord : chords_of(fluid, particles, k)) areas[k] += chord.area;
  if (std::ranges::all_of(areas, [](double area) { return area == 0; })) areas.clear();
  return areas;
}

}  // namespace viscontact::particles
