// Motions of particles that a page or a picture shows.
#pragma once

#include <cmath>

#include "viscontact/report/particles/particles_page.hpp"

namespace viscontact::report {

/// Discs or spheres of radius 1 in a row on the first axis, which fall on a floor. Neighbours have
/// films from the second frame on; the floor has films in the last frame.
inline particles::Playback falling_row(int dimension, int count, int frames) {
  particles::Playback playback;
  playback.dimension = dimension;
  playback.radii.assign(static_cast<std::size_t>(count), 1);
  for (int f = 0; f < frames; ++f) {
    particles::Frame frame;
    frame.time = 0.5 * f;
    const float height = static_cast<float>(frames - f);
    for (int k = 0; k < count; ++k) {
      frame.positions.push_back(2 * static_cast<float>(k));
      if (dimension == 3) frame.positions.push_back(0);
      frame.positions.push_back(height);
      if (f > 0 && k > 0) frame.contacts.push_back({k - 1, k, 0, -1.0 * k});
      if (f + 1 == frames) frame.contacts.push_back({-1, k, 0, k % 2 == 0 ? 0.0 : -0.5});
    }
    frame.planes.push_back(dimension == 2
                               ? particles::PlanePosition{.point = {0, 0, 0}, .normal = {0, 1, 0}}
                               : particles::PlanePosition{.point = {0, 0, 0}, .normal = {0, 0, 1}});
    playback.frames.push_back(frame);
  }
  return playback;
}

/// falling_row() of five particles with friction. The first two particles are one rigid body on a
/// hinge, a spring joins the second and the third, and an arm the third and the fourth. All turn,
/// and the last one slides on the floor in the last frame.
inline particles::Playback linked_row(int dimension, int frames) {
  auto playback = falling_row(dimension, 5, frames);
  playback.has_friction = true;
  playback.bodies = {0, 0, -1, -1, -1};
  playback.links.hinges = {{0, dimension == 2 ? 1.0 : 0.0, dimension == 2 ? 0.0 : 1.0}};
  playback.links.springs = {{1, 2}};
  playback.links.arms = {{2, 3}};
  for (int f = 0; f < frames; ++f) {
    auto& frame = playback.frames[static_cast<std::size_t>(f)];
    for (int k = 0; k < 5; ++k)
      if (dimension == 2)
        frame.angles.push_back(0.3F * static_cast<float>(f));
      else
        frame.orientations.insert(
            frame.orientations.end(),
            {std::cos(0.2F * static_cast<float>(f)), 0, 0, std::sin(0.2F * static_cast<float>(f))});
  }
  for (auto& contact : playback.frames.back().contacts)
    contact.friction = contact.first < 0 && contact.second == 4
                           ? particles::ContactFriction::kSlides
                           : particles::ContactFriction::kSticks;
  return playback;
}

inline particles::Playback one_particle() {
  particles::Playback playback;
  playback.radii = {0.5F};
  playback.frames.resize(1);
  playback.frames[0].positions = {3, 4};
  return playback;
}

}  // namespace viscontact::report
