// Points at which circles meet.
#include "viscontact/particles/setting/chords.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace viscontact::particles {

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
  if (body < 0 || !particles.is_round(k) || fluid.constraint != RigidConstraint::kRigid)
    return chords;
  for (const auto member : particles.bodies.bodies[static_cast<std::size_t>(body)].members)
    if (const auto other = static_cast<std::size_t>(member);
        other != k && particles.is_round(other))
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
