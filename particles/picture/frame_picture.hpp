// One frame of a motion as SVG: particles, planes and contacts in a panel of the still picture.
// Lengths [L] are in the unit of the case. particles_picture.cpp calls it; the scripts in
// particles/picture/page draw the same, and a change must keep both alike.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

#include "viscontact/particles/picture/scene.hpp"

namespace viscontact::particles {

/// Projects points to page coordinates (y downwards) from the upper left corner of a panel.
struct Projection {
  /// Unit vectors; `toward` points to the reader.
  Vector right{1, 0, 0}, up{0, 1, 0}, toward{0, 0, 1};
  double scale = 1;          ///< page units per length
  double left = 0, top = 0;  ///< coordinates of the panel's corner along `right` and `up` [L]

  double x(const Vector& p) const { return scale * (dot(right, p) - left); }
  double y(const Vector& p) const { return scale * (top - dot(up, p)); }
};

/// The direction of view: from the front for motions in the plane (dimension 2); for motions in
/// space from a little above and from the side, with the third axis upwards. The scale is 1.
Projection view_of(int dimension);

/// Settings that all panels of a picture share.
struct PanelSettings {
  const Scene& scene;            ///< the motion and what is seen of it
  Projection view;               ///< from points of the motion to the panel
  double width = 0, height = 0;  ///< size of a panel in page units, > 0
  std::size_t every = 1;         ///< one particle in `every` is drawn, >= 1; 1: all
};

/// Number of colours of contacts with gamma < 0.
inline constexpr int kContactColours = 20;

/// Number of colours of the friction of contacts with gamma = 0.
inline constexpr int kFrictionColours = 11;

/// The elements of a panel that shows the frame. `behind` is drawn behind everything else. Across
/// the sides of a period, the images of particles and contacts are drawn, of which the panel shows
/// the part in its box.
std::string frame_picture(const PanelSettings& panel, const Frame& frame,
                          const std::string& behind = "");

}  // namespace viscontact::particles
