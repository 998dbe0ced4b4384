// Draws one frame of a motion of particles as SVG: the content of one panel of the still picture.
// Lengths [L] are in the case's unit. Page units are those of the SVG, of which the still picture
// is 1000 wide. Nothing is checked or thrown. particles_picture.cpp draws its panels by
// frame_picture(), and particles_page.cpp uses kFrictionColours. The scripts view.js and picture.js
// in particles/picture/page draw the same on a web page, so a change must be made there, too.
#pragma once

#include <cstddef>
#include <string>

#include "viscontact/particles/picture/scene.hpp"

namespace viscontact::particles {

/// Projects points of the motion [L] to coordinates in a panel [page units]: x to the right and y
/// downwards from the panel's upper left corner.
struct Projection {
  /// Unit vectors [1] of the motion that point to the right, upwards and to the reader.
  Vector right{1, 0, 0}, up{0, 1, 0}, toward{0, 0, 1};
  double scale = 1;          ///< page units per length [1/L], > 0
  double left = 0, top = 0;  ///< coordinates of the panel's corner along `right` and `up` [L]

  /// The coordinates of the point p [L] in the panel [page units].
  double x(const Vector& p) const { return scale * (dot(right, p) - left); }
  double y(const Vector& p) const { return scale * (top - dot(up, p)); }
};

/// The direction of view, with the scale 1: from the front for `dimension` 2 (motions in the
/// plane). For 3 (motions in space) the third axis points upwards, and the view is turned by 30
/// degrees about it and from 20 degrees above; view.js repeats these free choices.
Projection view_of(int dimension);

/// Settings that all panels of a picture share.
struct PanelSettings {
  const Scene& scene;            ///< the motion; it must outlive the settings
  Projection view;               ///< from the motion to each panel
  double width = 0, height = 0;  ///< size of a panel [page units], > 0
  std::size_t every = 1;         ///< draws particles 0, every, 2 every, ...; >= 1
};

/// Number of colours of contacts with gamma < 0 in the still picture. gamma is minus the impulse
/// that a film has absorbed. Any number >= 2 works; with few colours the file is small.
inline constexpr int kContactColours = 20;

/// Number of colours, in steps of a tenth of Coulomb's bound, for the friction of contacts with
/// gamma = 0, in the still picture and on the page.
inline constexpr int kFrictionColours = 11;

/// The SVG elements of a panel that shows `frame`, a frame of panel.scene.playback. In motions in
/// the plane, `behind` is SVG that is drawn behind them, and images of particles are drawn at the
/// sides of a period. In motions in space, `behind` is not used and particles have no images.
/// Elements may extend beyond the panel, which must cut them off.
std::string frame_picture(const PanelSettings& panel, const Frame& frame,
                          const std::string& behind = "");

}  // namespace viscontact::particles
