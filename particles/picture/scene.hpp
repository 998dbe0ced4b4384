// What the still picture and the page show of a motion of particles: its frames in the plane, the
// part of space that is seen, the flow, and the scales of colours. Lengths, masses and times are in
// the units of the case. A change of SceneStyle must keep the names, by which the page reads it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "viscontact/particles/io/playback.hpp"
#include "viscontact/report/flow/flow_grid.hpp"
#include "viscontact/report/flow/stream_lines.hpp"
#include "viscontact/report/pictures/colours.hpp"

namespace viscontact::particles {

/// An interval along an axis [L]; empty if low > high.
struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double from, double to) {
    low = std::min(low, from);
    high = std::max(high, to);
  }
};

/// A box [L], whose sides are parallel to the axes, by two opposite corners.
struct ViewBox {
  Vector low{}, high{};
};

/// The flow around the particles of a frame, at the points of FlowFrames::grid.
struct FlowFrame {
  std::size_t frame = 0;  ///< its number in the playback
  /// Speed [L/T] and pressure [M/(L T^2)]; NaN where there is no flow. Single precision is enough
  /// for a picture. The mean of the pressure over the points outside the particles is 0, because
  /// the pressure in a closed domain is known up to a constant.
  std::vector<float> speed, pressure;
  std::vector<report::StreamLine> lines;  ///< streamlines
};

/// The flows that are drawn, all on one grid.
struct FlowFrames {
  /// With an axis, the grid is in the half-plane x >= 0, and the flow has a mirror image.
  report::Grid grid;
  bool has_axis = false;          ///< whether the flow is symmetric about the line x = 0
  std::vector<FlowFrame> frames;  ///< in order of time; empty: there is no flow to draw
  /// Upper end of the scale of speeds [L/T]: the speed that one in a thousand points outside the
  /// particles exceeds.
  double top_speed = 0;
  report::PressureColours pressure_colours;  ///< scale of the pressure
};

/// The largest size of the flow in a page, before it is written in base64 [bytes]: two bytes for
/// each point of all flows, one for the speed and one for the pressure. The streamlines add about a
/// tenth. In base64 this is half of the 24 MB that a page may have (page_data.hpp).
inline constexpr std::size_t kFlowBytesOfPage = 9'000'000;

/// The frames whose flow the page shows: all that have one, or evenly chosen ones if there are
/// many, and the number of points of the grid of each.
struct ShownFlows {
  std::vector<std::size_t> frames;  ///< numbers of the frames in the playback
  std::size_t points = 0;           ///< for each of them
};
ShownFlows shown_flows(const Playback& playback);

/// How wide a line is drawn: in proportion to a radius, within limits.
struct LineWidth {
  double share = 0;  ///< width divided by the radius, >= 0
  double least = 0;  ///< lower limit of the width, >= 0 [units of the still picture]
  double most = 0;   ///< upper limit of the width, >= least [units of the still picture]
};

/// Colours and proportions that the still picture and the page have in common. The page gets them
/// as JSON, by the same names.
struct SceneStyle {
  using Colour = const char*;  ///< "#rrggbb"
  /// Fill and edge of a disc: outside a fluid, in a fluid, and of a rigid body.
  std::array<Colour, 2> disc{"#a9c3da", "#4f728f"}, disc_in_fluid{"#f1ece0", "#3c3a34"},
      disc_of_body{"#e0cda6", "#8a713b"};
  /// Colours of a sphere from its brightest point to its rim, then of its edge; and the same of a
  /// sphere of a rigid body.
  std::array<Colour, 4> ball{"#e3eef7", "#a3bfd8", "#5b7f9f", "#34536e"},
      ball_of_body{"#f6ead0", "#dcc79c", "#a98d55", "#7a6231"};
  Colour mark = "#4a4a44", spring = "#2b6e3f";
  /// The dot that shows the angle of a disc: its distance from the centre and its radius, divided
  /// by the radius of the disc; the radius of the dots at the axes of a sphere, divided by that of
  /// the sphere.
  double mark_distance = 0.66, mark_radius = 0.13, axis_radius = 0.12;
  /// An axis of a sphere is marked if its component towards the reader is larger than this. A dot
  /// nearer to the rim would be seen from the side.
  double least_toward = 0.15;
  /// Widths of the lines that join the particles of a body, of arms, and half the width of springs,
  /// divided by the smaller radius of both ends.
  double body_line = 0.18, arm = 0.25, spring_width = 0.35;
  /// If no contact has a force: the line of a film or of a contact that slides, in proportion to
  /// the smaller radius of both ends.
  LineWidth film_line{0.3, 0.8, 5};
  LineWidth touching_line{0.06, 0.3, 1};  ///< likewise, of another contact
  /// If contacts have forces: the line of a contact with the force Scene::top_force, in proportion
  /// to the mean radius. Lines of smaller forces have the same share of this width as of the force,
  /// but at least the next two widths.
  LineWidth force_line{0.9, 0, 12};
  LineWidth film_with_force{0.1, 0.8, 2};  ///< least of a film, by the smaller radius of both ends
  LineWidth touching_with_force{0, 0.3, 0.3};  ///< least of another contact, likewise
  double page_unit = 1.5;    ///< a unit of the still picture in limits of the page [CSS pixels]
  int spring_turns = 12;     ///< corners of the zigzag line of a spring
  double spring_end = 0.12;  ///< length of each straight end divided by that of the spring
};
inline constexpr SceneStyle kStyle;

/// The description of a motion from which the still picture and the page are drawn.
struct Scene {
  /// The motion in the plane or in space. Spheres on an axis are discs on the line x = 0, and the
  /// side of their cylinder is two lines.
  Playback playback;
  bool has_axis = false;     ///< the motion is on an axis, at which the picture is symmetric
  bool is_in_fluid = false;  ///< there is a flow to draw
  /// Whether forces, impulses and masses are those per length across the plane, as of discs in a
  /// fluid.
  bool is_per_length() const {
    return playback.is_in_fluid && !has_axis && playback.dimension == 2;
  }
  /// The box that should be seen: all particles of the shown frames (or the central 98 % of each
  /// frame, if the others have flown far away), and the planes next to them. If there is a flow and
  /// the particles can be seen in its domain, all of it. In the directions of periods it is the
  /// cell. It has a positive size in each direction of the playback's dimension.
  ViewBox box;
  FlowFrames flows;         ///< the flow in the box
  double lowest_gamma = 0;  ///< the most negative gamma of all frames; 0: no gamma < 0
  std::string film_words;   ///< what the scale of gamma shows, with its unit or dimension
  bool touches = false;     ///< a contact of the shown frames has gamma = 0
  bool slides = false;      ///< a contact of the shown frames slides
  /// The normal force that the widest lines show [M L/T^2], of discs in a fluid per length [M/T^2]:
  /// 98 of 100 loaded contacts of the shown frames have less. 0: no contact has a force.
  double top_force = 0;
  double mean_radius = 0;   ///< [L]
  std::string force_words;  ///< what the widths of lines show; empty if top_force is 0
};

/// The scene of these frames with the flows of `flow_frames`, as far as they have one, on grids of
/// `points` points each. Throws the errors of read_flow.
Scene scene_of(const Playback& motion, const std::vector<std::size_t>& frames,
               const std::vector<std::size_t>& flow_frames, std::size_t points);

/// The normal force of a contact, of either sign, divided by Scene::top_force: from 0 to 1.
double force_share(const Scene& scene, const CurrentContact& contact);

/// |p_t|/(mu_s p_n) of a contact, the share of Coulomb's bound that its friction has reached, from
/// 0 to 1; 1 if it slides, 0 without friction or load.
double mobilised_friction(const Playback& playback, const CurrentContact& contact);

/// What the colours of that share mean.
inline constexpr const char* kFrictionWords =
    "contacts without a film: friction / (coefficient × normal force); 1: slides";

using Polygon = std::vector<Vector>;  ///< convex, its corners in order [L]

/// The part of a polygon with normal.(x - point) >= 0.
Polygon clipped(const Polygon& polygon, const Vector& point, const Vector& normal);

/// The part of a polygon that is in the box and on the free side of all planes except plane number
/// `own`, in which the polygon is.
Polygon clipped_to_view(Polygon polygon, const ViewBox& box,
                        const std::vector<PlanePosition>& planes, std::size_t own, int dimension);

}  // namespace viscontact::particles
