// What a picture of a frame shows besides discs, spheres and contacts: how far particles have
// turned, which of them are one rigid body, and the links.
#pragma once

#include <cstddef>
#include <string>

#include "viscontact/report/particles/frame_picture.hpp"

namespace viscontact::report {

/// A circle about a point; nothing if the panel does not show it.
std::string circle(const PanelSettings& panel, const particles::Vector& at, double radius);

/// Calls visit(k, place) for each drawn particle k and for those of its images that may be seen.
template <class Visit>
void for_each_image(const PanelSettings& d, const particles::Frame& frame, const Visit& visit) {
  for (std::size_t k = 0; k < d.playback.radii.size(); k += d.every)
    for (std::int32_t image = -particles::kLargestImage; image <= particles::kLargestImage;
         ++image) {
      const auto shift = shift_of(d.playback.cell, image);
      if (image == 0 || shift[0] != 0 || shift[1] != 0)
        visit(k, particles::operator+(position(d.playback, frame, k), shift));
    }
}

/// True if the particle belongs to a rigid body.
inline bool is_in_body(const particles::Playback& playback, std::size_t k) {
  return !playback.bodies.empty() && playback.bodies[k] >= 0;
}

/// The discs of rigid bodies, in a colour of their own, with lines that join the discs of each.
std::string body_discs(const PanelSettings& panel, const particles::Frame& frame);

/// A dot at the rim of each disc, which shows how far it has turned; nothing on very small discs.
std::string angle_marks(const PanelSettings& panel, const particles::Frame& frame);

/// Dots on sphere k where its three axes come out of it, as far as they are seen.
std::string orientation_marks(const PanelSettings& panel, const particles::Frame& frame,
                              std::size_t k);

/// Hinges as rings, springs as zigzag lines and arms as bars.
std::string link_marks(const PanelSettings& panel, const particles::Frame& frame);

}  // namespace viscontact::report
