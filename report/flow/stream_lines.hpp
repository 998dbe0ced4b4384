// Level lines of fields, and streamlines of a flow on a grid.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "viscontact/report/flow/flow_grid.hpp"

namespace viscontact::report {

using Polyline = std::vector<std::pair<double, double>>;  ///< points of a line [L]

/// A field that is linear on each of a set of straight triangles, and continuous.
struct LinearField {
  std::vector<std::array<double, 2>> points;            ///< corners of the triangles [L]
  std::vector<double> values;                           ///< at each point, in any unit
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of their corners in `points`
};

/// The lines on which the field equals `level`, joined across triangles, in no certain order. The
/// first and the last point of a closed line are equal.
std::vector<Polyline> level_lines(const LinearField& field, double level);

/// The points are in the order in which the fluid flows.
struct StreamLine {
  Polyline points;
  /// Index in `points` of the tip of an arrow that shows the direction, > 0; -1: no arrow.
  int arrow = -1;
};

/// Streamlines at equal steps of the stream function psi, between which equal amounts flow.
struct StreamLineSet {
  std::vector<StreamLine> lines;  ///< in the order of rising psi
  /// Step of psi between neighbouring lines [L^2/T], or [L^3/T] of a flow with an axis; 0 if psi is
  /// constant, so that there are no lines.
  double step = 0;
};

/// Streamlines as level lines of the stream function psi of the velocity (u, v) along (x, y). In
/// the plane, u = dpsi/dy and v = -dpsi/dx, with psi in [L^2/T]. If the flow is symmetric about an
/// axis and x is the distance from the axis, x u = dpsi/dy and x v = -dpsi/dx, with psi in [L^3/T]
/// (Batchelor 1967, "An Introduction to Fluid Dynamics", 2.2). psi solves these equations between
/// neighbouring points of the grid by least squares. The fluid may consist of several regions.
class StreamLines {
 public:
  /// If `has_axis` is true, the flows are symmetric about the axis x = 0, and grid.x(0) is not < 0.
  StreamLines(const Grid& grid, bool has_axis);
  ~StreamLines();
  StreamLines(StreamLines&&) noexcept;

  /// The lines at `count` > 0 values of psi in equal steps between its extremes outside the
  /// particles; a value may have several lines or none. Arrows are outside the particles. There are
  /// no lines if psi is constant. `is_body` is 1 for each point of the grid in a particle, which is
  /// drawn over the lines, otherwise 0. Velocities are NaN where there is no flow. Flows should be
  /// given in order of time, because the factor of the matrix is used again as long as the flow
  /// covers about the same points.
  StreamLineSet of(const FlowOnGrid& flow, const std::vector<char>& is_body, int count);

 private:
  struct Equations;
  // NaN at points that are neither in the fluid nor next to it.
  std::vector<double> stream_function(const FlowOnGrid& flow);

  Grid grid_;
  bool has_axis_;
  std::unique_ptr<Equations> equations_;
};

}  // namespace viscontact::report
