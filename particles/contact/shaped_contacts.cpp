// Shapes of a pair, or of a particle and an obstacle, at their places.
#include "viscontact/particles/contact/shaped_contacts.hpp"

namespace viscontact::particles {
namespace {

PlacedShape first_of(const Particles& p, const Pair& pair) {
  return p.placed_shape(index_of(pair.first));
}

PlacedShape second_of(const Particles& p, const Pair& pair) {
  return p.placed_shape(index_of(pair.second),
                        pair.first < 0 ? Vector{} : shift_of(p.cell, pair.image));
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

}  // namespace viscontact::particles
