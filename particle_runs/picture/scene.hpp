// What the still picture and the web page show of a motion of particles: frames in the plane, the
// part of space that is seen, the flow, and scales of colours.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "viscontact/particle_runs/io/playback.hpp"
#include "viscontact/report/flow/flow_grid.hpp"
#include "viscontact/report/flow/stream_lines.hpp"
#include "viscontact/report/pictures/colours.hpp"

namespace viscontact::particles {

/// An interval from `low` to `high` along an axis [L]; empty if low > high.
struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double from, double to) {
    low = std::min(low, from);
    high = std::max(high, to);
  }
};

struct ViewBox {
  /// The corners [L], 0 beyond the dimension.
  Vector low{}, high{};
};

/// The flow around the particles of a frame, at the points of FlowFrames::grid.
struct FlowFrame {
  std::size_t frame = 0;  ///< index of the frame in Playback::frames, from 0
  /// Speed [L/T] and pressure [M/(L T^2)] at each point of the grid, row by row from the bottom and
  /// each row from the left; NaN where there is no flow. The mean of the pressure over the points
  /// outside the particles is 0, because the equations of a closed domain determine the pressure up
  /// to a constant only.
  std::vector<float> speed, pressure;
  std::vector<report::StreamLine> lines;  ///< in the grid's window
};

struct FlowFrames {
  /// If has_axis, the points [L] cover the half-plane x >= 0, and the other half of the picture is
  /// the mirror image.
  report::Grid grid;
  bool has_axis = false;          ///< whether the flow is symmetric about the line x = 0
  std::vector<FlowFrame> frames;  ///< in order of time; empty: there is no flow to draw
  /// Upper end of the scale of speeds [L/T]: one in a thousand points of the fluid is faster.
  double top_speed = 0;
  report::PressureColours pressure_colours;
};

/// The largest size of all flows in a page [bytes]. Each point of a flow takes a byte for the speed
/// and a byte for the pressure. In base64 this size is half of the 24 MB that a page may have. The
/// streamlines take about a tenth more.
inline constexpr std::size_t kFlowBytesOfPage = 9'000'000;

struct ShownFlows {
  std::vector<std::size_t> frames;  ///< indices of the frames in Playback::frames, increasing
  std::size_t points = 0;           ///< 0 without a flow
};
/// Chooses all frames that have a flow, or 150 evenly chosen ones, and at most 60 000 points, so
/// few that all flows fit into kFlowBytesOfPage.
ShownFlows shown_flows(const Playback& playback);

/// The width of a line: it is proportional to a radius, but within limits [page units]. The still
/// picture is 1000 page units wide; on the web page, a page unit is SceneStyle::page_unit.
struct LineWidth {
  double share = 0;  ///< width divided by the radius
  double least = 0;
  double most = 0;
};

/// Colours and proportions of the still picture and the page, which gets them as JSON.
/// style_of_page() of particles_page.cpp and the scripts in particle_runs/picture/page have the
/// same names.
struct SceneStyle {
  using Colour = const char*;  ///< "#rrggbb"
  /// Fill and edge of a disc: outside a fluid, in a fluid, and of a rigid body.
  std::array<Colour, 2> disc{"#a9c3da", "#4f728f"}, disc_in_fluid{"#f1ece0", "#3c3a34"},
      disc_of_body{"#e0cda6", "#8a713b"};
  /// Three colours of a sphere from its brightest point to its rim, and that of its edge: in no
  /// rigid body, and in one.
  std::array<Colour, 4> ball{"#e3eef7", "#a3bfd8", "#5b7f9f", "#34536e"},
      ball_of_body{"#f6ead0", "#dcc79c", "#a98d55", "#7a6231"};
  double clear_ball = 0.3;  ///< opacity of spheres under lines of forces, in a periodic cell
  /// Colours of the marks of rotation on particles, and of springs.
  Colour mark = "#4a4a44", spring = "#2b6e3f";
  /// For the dot that shows the angle of a disc: its distance from the centre and its radius,
  /// divided by the radius of the disc. Then the radius of the dots at the axes of a sphere,
  /// divided by that of the sphere.
  double mark_distance = 0.66, mark_radius = 0.13, axis_radius = 0.12;
  /// An axis of a sphere is marked where its component towards the reader is larger than this.
  double least_toward = 0.15;
  /// Divided by the smaller radius of the two particles: the widths of the line that joins them in
  /// a rigid body, of an arm, and half of that of the zigzag line of a spring.
  double body_line = 0.18, arm = 0.25, spring_width = 0.35;
  /// The line of a contact that has a film (gamma < 0) or slides, if contacts have no forces, for
  /// the smaller radius of its two particles.
  LineWidth film_line{0.3, 0.8, 5};
  /// The line of any other contact, for the same radius, if contacts have no forces.
  LineWidth touching_line{0.06, 0.3, 1};
  /// The line for the force Scene::top_force, for the mean radius. Widths are proportional to the
  /// force, but at least the next two widths.
  LineWidth force_line{0.9, 0, 12};
  /// The least width for a contact with a force and a film, for the smaller radius.
  LineWidth film_with_force{0.1, 0.8, 2};
  /// The least width for a contact with a force and no film, for the smaller radius.
  LineWidth touching_with_force{0, 0.3, 0.3};
  double page_unit = 1.5;    ///< length of a page unit on the web page [CSS pixels], > 0
  int spring_turns = 12;     ///< corners of the zigzag line of a spring, >= 1
  double spring_end = 0.12;  ///< length of each straight end over that of the spring, < 0.5
};
inline constexpr SceneStyle kStyle;

/// The motion from which the still picture and the page are drawn, in the units of the case.
struct Scene {
  /// The motion in the plane or in space. Spheres on an axis are discs on the line x = 0, and the
  /// side of their cylinder is two lines.
  Playback playback;
  bool has_axis = false;     ///< on the line x = 0
  bool is_in_fluid = false;  ///< whether there is a flow to draw
  /// Whether forces, impulses and masses are per length normal to the plane (discs in a fluid).
  bool is_per_length() const {
    return playback.is_in_fluid && !has_axis && playback.dimension == 2;
  }
  /// The part of space that is shown, with a margin: all particles of the shown frames (if a few
  /// have flown far away, the central 98 % of each frame) and the planes next to them; the whole
  /// domain of a flow, if it is at most 16 times as large; along axes with a period the cell, in
  /// space with the largest radius beside it. Its size is > 0 in each direction of the playback's
  /// dimension.
  ViewBox box;
  FlowFrames flows;         ///< the flows in the box
  double lowest_gamma = 0;  ///< lowest gamma of all frames, <= 0 [M L/T], if is_per_length() [M/T]
  std::string film_words;   ///< words for the scale of gamma, with its unit or dimension
  bool touches = false;     ///< whether a contact of the shown frames has gamma = 0
  bool slides = false;      ///< whether a contact of the shown frames slides
  /// The normal force that the widest lines show [M L/T^2], if is_per_length() [M/T^2]; 98 % of the
  /// contacts with a force have at most this force. 0: no contact has a force.
  double top_force = 0;
  double mean_radius = 0;   ///< [L]; 0 without particles
  std::string force_words;  ///< words for the widths of lines; empty if top_force is 0
};

/// The scene that shows the frames of `motion` with the indices `frames`, and the flows of the
/// frames with the indices `flow_frames`, as far as they have one, on a grid of about `points`
/// points. If `known` has flows on the same grid, they are taken from there. Throws
/// Error(kBadInput), which names the file, if a flow cannot be read.
Scene scene_of(const Playback& motion, const std::vector<std::size_t>& frames,
               const std::vector<std::size_t>& flow_frames, std::size_t points,
               const FlowFrames& known = {});

/// The normal force of a contact over Scene::top_force, at most 1; 0 if top_force is 0.
double force_share(const Scene& scene, const CurrentContact& contact);

/// The tangential force of a contact divided by Coulomb's bound, at most 1. It is 1 if the contact
/// slides, and 0 without friction or load.
double mobilised_friction(const Playback& playback, const CurrentContact& contact);

inline constexpr const char* kFrictionWords =
    "contacts without a film: friction / (coefficient × normal force); 1: slides";

using Polygon = std::vector<Vector>;  ///< corners in order [L]; two corners: a line

/// The part of a convex polygon or line where the inner product of `normal` and x - point is >= 0.
Polygon clipped(const Polygon& polygon, const Vector& point, const Vector& normal);

/// The part of a convex polygon or line that is in the box and on the free side of all planes,
/// except of plane number `own`, in which it lies. Planes are moved back by 1e-4 of the longest
/// side of the box, so that rounding errors do not remove a polygon that lies in two equal planes.
Polygon clipped_to_view(Polygon polygon, const ViewBox& box,
                        const std::vector<PlanePosition>& planes, std::size_t own, int dimension);

}  // namespace viscontact::particles
