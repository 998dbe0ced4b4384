// Motions of particles that a page or a picture shows.
#pragma once

#include <cmath>

#include "tests/common/temporary_folder.hpp"
#include "tests/report/flow/flows.hpp"
#include "viscontact/common/vtk/flow_vtk.hpp"
#include "viscontact/particle_runs/picture/particles_picture.hpp"

namespace viscontact::particles {

/// Discs or spheres of radius 1 in a row on the first axis, which fall on a floor. Neighbours have
/// films from the second frame on; the floor has films in the last frame.
inline Playback falling_row(int dimension, int count, int frames) {
  Playback playback;
  playback.dimension = dimension;
  playback.radii.assign(static_cast<std::size_t>(count), 1);
  for (int f = 0; f < frames; ++f) {
    Frame frame;
    frame.time = 0.5 * f;
    const float height = static_cast<float>(frames - f);
    for (int k = 0; k < count; ++k) {
      frame.positions.push_back(2 * static_cast<float>(k));
      if (dimension == 3) frame.positions.push_back(0);
      frame.positions.push_back(height);
      if (f > 0 && k > 0) frame.contacts.push_back({k - 1, k, 0, -1.0 * k});
      if (f + 1 == frames) frame.contacts.push_back({-1, k, 0, k % 2 == 0 ? 0.0 : -0.5});
    }
    frame.planes.push_back(dimension == 2 ? PlanePosition{.point = {0, 0, 0}, .normal = {0, 1, 0}}
                                          : PlanePosition{.point = {0, 0, 0}, .normal = {0, 0, 1}});
    playback.frames.push_back(frame);
  }
  return playback;
}

/// Two spheres of radius 1 in a cell from 0 to 10 that is periodic in three directions and sheared,
/// so that the image across y is displaced by 3. Sphere 0 lies across the side y = 0.
inline Playback sheared_pair() {
  Playback playback;
  playback.dimension = 3;
  playback.up = 1;
  playback.radii = {1, 1};
  playback.cell.lengths = {10, 10, 10};
  Frame frame;
  frame.positions = {4, 0.5F, 8, 5, 5, 2};
  frame.offset = 3;
  playback.frames = {frame};
  return playback;
}

/// falling_row() of five particles with friction. The first two particles are one rigid body on a
/// hinge, a spring joins the second and the third, and an arm the third and the fourth. All turn,
/// and the last one slides on the floor in the last frame.
inline Playback linked_row(int dimension, int frames) {
  auto playback = falling_row(dimension, 5, frames);
  playback.friction_coefficient = 0.5;
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
    contact.friction = contact.first < 0 && contact.second == 4 ? ContactFriction::kSlides
                                                                : ContactFriction::kSticks;
  return playback;
}

/// A row of four discs or spheres of radius 1 with friction 0.5 and without films. The forces of
/// the three contacts are 4, 2 and 1. The first sticks with half of Coulomb's bound, the second
/// slides, and the third has no friction.
inline Playback loaded_row(int dimension) {
  auto playback = falling_row(dimension, 4, 1);
  playback.friction_coefficient = 0.5;
  auto& contacts = playback.frames[0].contacts;
  contacts = {{0, 1, 0, 0}, {1, 2, 0, 0}, {2, 3, 0, 0}};
  contacts[0].normal_force = 4;
  contacts[0].tangential_force = {0, 1, 0};
  contacts[0].friction = ContactFriction::kSticks;
  contacts[1].normal_force = 2;
  contacts[1].tangential_force = {0, 1, 0};
  contacts[1].friction = ContactFriction::kSlides;
  contacts[2].normal_force = 1;
  contacts[2].friction = ContactFriction::kSticks;
  return playback;
}

inline Playback one_particle() {
  Playback playback;
  playback.radii = {0.5F};
  playback.frames.resize(1);
  playback.frames[0].positions = {3, 4};
  return playback;
}

/// A disc of radius 0.5 that moves along the middle of the box [0, 4] x [0, 2] in `frames` frames,
/// in a flow of the given velocity and pressure. The flows are files in the folder.
inline Playback disc_in_flow(const TemporaryFolder& folder, int frames, const report::FlowAt& at) {
  Playback playback;
  playback.is_in_fluid = true;
  playback.radii = {0.5F};
  const auto file = folder.file("flow.vtu", write_flow(report::mesh_of({0, 4, 0, 2}, 16, at)));
  for (int f = 0; f < frames; ++f) {
    Frame frame;
    frame.time = f;
    frame.positions = {1 + 2 * static_cast<float>(f) / static_cast<float>(frames), 1};
    frame.angles = {static_cast<float>(f)};
    frame.flow = file;
    playback.frames.push_back(frame);
  }
  return playback;
}

}  // namespace viscontact::particles
