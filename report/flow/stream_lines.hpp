// Level lines of fields, and the streamlines of a flow on a grid. Lengths and times are in the
// units of the case. flow_plots.hpp and particles/picture draw them. A change must keep that equal
// amounts flow between neighbouring lines. Nothing is thrown.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "viscontact/report/flow/flow_grid.hpp"

namespace viscontact::report {

using Polyline = std::vector<std::pair<double, double>>;  ///< points of a line [L]

/// A field that is linear on each of a set of straight triangles.
struct LinearField {
  std::vector<std::array<double, 2>> points;            ///< corners of the triangles [L]
  std::vector<double> values;                           ///< of the field at the points, any unit
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< places of their corners in `points`
};

/// The lines on which the field equals `level`, joined across triangles.
std::vector<Polyline> level_lines(const LinearField& field, double level);

/// A streamline in the direction of the flow.
struct StreamLine {
  Polyline points;  ///< [L]
  /// Place in `points` of an arrow that shows the direction, outside all particles; -1: no arrow.
  int arrow = -1;
};

/// Streamlines at equal steps of the stream function.
struct StreamLineSet {
  std::vector<StreamLine> lines;
  /// Step of the stream function between neighbours, > 0 [L^2/T], with an axis [L^3/T]; 0 if there
  /// are no lines.
  double step = 0;
};

/// Computes streamlines as level lines of the stream function psi of the velocity (u, v) along (x,
/// y): u = dpsi/dy, v = -dpsi/dx in the plane [L^2/T]; with an axis, where x is the distance from
/// it, x u = dpsi/dy, x v = -dpsi/dx [L^3/T]. psi is the least-squares solution of these equations
/// between neighbouring points of the grid (Batchelor 1967, "An Introduction to Fluid Dynamics",
/// 2.2).
class StreamLines {
 public:
  StreamLines(const Grid& grid, bool has_axis);
  ~StreamLines();
  StreamLines(StreamLines&&) noexcept;

  /// About `count` lines, at equal steps of psi: the same amount flows between any two neighbouring
  /// lines. There are no lines if nothing moves. `is_body` says for each point of the grid whether
  /// it is in a particle, which hides it. Frames should be given in their order, because the factor
  /// of the matrix is used again as long as the fluid covers about the same points.
  StreamLineSet of(const FlowOnGrid& flow, const std::vector<char>& is_body, int count);

 private:
  struct Equations;
  std::vector<double> stream_function(const FlowOnGrid& flow);

  Grid grid_;
  bool has_axis_;
  std::unique_ptr<Equations> equations_;
};

}  // namespace viscontact::report
