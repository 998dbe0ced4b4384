// One frame of a motion of particles as SVG, a panel of the still picture. view.js and picture.js
// in particle_runs/picture/page draw the same on a web page.
#pragma once

#include <cstddef>
#include <string>

#include "viscontact/particle_runs/picture/scene.hpp"

namespace viscontact::particles {

/// Projects points of the motion [L] to coordinates in a panel [page units]: x to the right and y
/// downwards from the panel's upper left corner.
struct Projection {
  /// Unit vectors [1] of the motion that point to the right, upwards and to the reader.
  Vector right{1, 0, 0}, up{0, 1, 0}, toward{0, 0, 1};
  double scale = 1;          ///< page units per unit of length at `middle` [1/L], > 0
  double left = 0, top = 0;  ///< place of the panel's corner along `right` and `up` [L]
  Vector middle{};           ///< what the reader looks at [L]
  double distance = 0;       ///< of the reader from there [L]; 0: infinite

  /// The magnification of things at the point p, divided by that at `middle`.
  double nearness(const Vector& p) const {
    return distance > 0 ? distance / (distance - dot(toward, p - middle)) : 1;
  }
  double x(const Vector& p) const { return scale * (nearness(p) * dot(right, p - middle) - left); }
  double y(const Vector& p) const { return scale * (top - nearness(p) * dot(up, p - middle)); }
};

/// The direction of view, with the scale 1 and the corner at 0. For `dimension` 2 the reader looks
/// from the front. For 3 the axis `up` points upwards, the view is turned by 30 degrees about it,
/// and the reader looks from 20 degrees above; view.js repeats both angles.
Projection view_of(int dimension, std::size_t up);

/// Settings that all panels of a picture share. The still picture is 1000 page units wide.
struct PanelSettings {
  const Scene& scene;  ///< must outlive the settings
  Projection view;
  double width = 0, height = 0;  ///< size of a panel [page units], > 0
  std::size_t every = 1;         ///< only particles 0, every, 2 every, ... are drawn; >= 1
};

/// Number of colours of contacts with gamma < 0 in the still picture. With few colours the file is
/// small.
inline constexpr int kContactColours = 20;

/// Number of colours for the friction of contacts with gamma = 0, in the still picture and on the
/// page. Friction is at most the coefficient of friction times the normal force; with 11 colours a
/// step is a tenth of this bound.
inline constexpr int kFrictionColours = 11;

/// The SVG elements of a panel that shows `frame`, a frame of panel.scene.playback. In motions in
/// the plane, `behind` is SVG text that is drawn behind the particles. Periodic images of particles
/// are drawn at the sides of the cell. If the cell is periodic in three directions, its edges are
/// drawn too, and particles are translucent if their contacts have forces, whose lines are drawn
/// over them. Elements may extend beyond the panel, and the caller must clip them. Throws
/// std::out_of_range for a contact with an obstacle that the frame does not have.
std::string frame_picture(const PanelSettings& panel, const Frame& frame,
                          const std::string& behind = "");

}  // namespace viscontact::particles
