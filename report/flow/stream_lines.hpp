// Level lines of fields, and streamlines of a flow on a grid. Lengths and times are in the units of
// the case. flow_plots.cpp and particles/picture draw them. A change must keep that equal amounts
// flow between neighbouring streamlines. Nothing is checked or thrown.
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
  std::vector<double> values;                           ///< of the field at each point, in any unit
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of their corners in `points`
};

/// The lines on which the field equals `level`, joined across triangles. The first and the last
/// point of a closed line are equal. `level` has the unit of the field; no lines if it is nowhere.
std::vector<Polyline> level_lines(const LinearField& field, double level);

/// A streamline; its points are in the order in which the fluid flows.
struct StreamLine {
  Polyline points;  ///< [L]
  /// Index in `points` of the tip of an arrow that shows the direction, > 0; -1: no arrow.
  int arrow = -1;
};

/// Streamlines at equal steps of the stream function.
struct StreamLineSet {
  std::vector<StreamLine> lines;
  /// Step of psi between neighbouring lines [L^2/T], with an axis [L^3/T]; 0 without lines.
  double step = 0;
};

/// Computes streamlines as level lines of the stream function psi of the velocity (u, v) along (x,
/// y): u = dpsi/dy, v = -dpsi/dx in the plane [L^2/T]; with an axis, where x is the distance from
/// it, x u = dpsi/dy, x v = -dpsi/dx [L^3/T] (Batchelor 1967, "An Introduction to Fluid Dynamics",
/// 2.2). psi solves these equations between neighbouring points of the grid by least squares.
class StreamLines {
 public:
  /// For flows on `grid`. With `has_axis` they are symmetric about x = 0; then grid.x(0) >= 0.
  StreamLines(const Grid& grid, bool has_axis);
  ~StreamLines();
  StreamLines(StreamLines&&) noexcept;

  /// About `count` > 0 lines at equal steps of psi, with arrows outside the particles. There are
  /// none if nothing moves. `is_body` is 1 for each point of the grid in a particle, which hides
  /// it, otherwise 0; `is_body` and the lists of `flow` have grid.size() numbers, in the order of
  /// the grid. Flows should be given in order of time, because the factor of the matrix is used
  /// again as long as the fluid covers about the same points.
  StreamLineSet of(const FlowOnGrid& flow, const std::vector<char>& is_body, int count);

 private:
  struct Equations;
  std::vector<double> stream_function(const FlowOnGrid& flow);

  Grid grid_;
  bool has_axis_;
  std::unique_ptr<Equations> equations_;
};

}  // namespace viscontact::report
