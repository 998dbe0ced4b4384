// The flows of a motion of particles on one grid, with common scales for their colours. Lengths,
// masses and times are in the units of the case.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/particles/io/playback.hpp"
#include "viscontact/report/flow/flow_grid.hpp"
#include "viscontact/report/flow/pressure_colours.hpp"
#include "viscontact/report/flow/stream_lines.hpp"
#include "viscontact/report/particles/view_box.hpp"

namespace viscontact::report {

/// The flow around the particles of a frame, at the points of FlowFrames::grid.
struct FlowFrame {
  std::size_t frame = 0;  ///< its number in the playback
  /// [L/T], [M/(L T^2)]; NaN where there is no flow. Single precision is enough for a picture. The
  /// mean of the pressure over the points outside the particles is 0, because the pressure in a
  /// closed domain is known up to a constant.
  std::vector<float> speed, pressure;
  std::vector<StreamLine> lines;
};

struct FlowFrames {
  /// With an axis, the grid is in the half-plane x >= 0, and the flow has a mirror image.
  Grid grid;
  bool has_axis = false;
  std::vector<FlowFrame> frames;  ///< in order of time; empty: there is no flow to draw
  /// Upper end of the scale of speeds [L/T]: the speed that one in a thousand points outside the
  /// particles exceeds.
  double top_speed = 0;
  PressureColours pressure_colours;
};

/// A motion in the plane that looks like the given one: spheres on an axis become discs on the line
/// x = 0, and the side of their cylinder two lines. Other motions are returned as they are.
particles::Playback in_plane(const particles::Playback& playback);

/// The rectangle that the first flow of the motion fills [L], with its mirror image if there is an
/// axis; in the directions of periods it is the cell. Nothing if no frame has a flow. Throws the
/// errors of read_flow.
std::optional<Window> flow_extent(const particles::Playback& in_plane, bool has_axis);

/// The extent as the domain of view_box_of().
std::optional<ViewBox> box_of(const std::optional<Window>& extent);

/// The part of the flow that is drawn in a view. With an axis, its left and right ends are mirror
/// images of each other.
Window common_part(const Window& extent, const ViewBox& view);

/// Reads the flows of the given frames, as far as they have one. `window` is the part of the flow
/// that is drawn, and `points` the number of points of the grid of each frame. Throws the errors of
/// read_flow.
FlowFrames read_flows(const particles::Playback& in_plane, bool has_axis, const Window& window,
                      const std::vector<std::size_t>& frames, std::size_t points);

}  // namespace viscontact::report
