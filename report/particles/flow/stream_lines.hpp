// Streamlines of the flow around particles. Lengths and times are in the units of the case.
#pragma once

#include <memory>
#include <vector>

#include "viscontact/report/particles/flow/flow_grid.hpp"

namespace viscontact::report {

/// A streamline in the direction of the flow.
struct StreamLine {
  Polyline points;  ///< [L]
  /// Place in `points` of an arrow that shows the direction, outside all particles; -1: no arrow.
  int arrow = -1;
};

/// Computes streamlines as level lines of the stream function psi: u = dpsi/dy, v = -dpsi/dx in the
/// plane [L^2/T]; with an axis, where x is the distance from it, x u = dpsi/dy, x v = -dpsi/dx
/// [L^3/T]. psi is the least-squares solution of these equations along the sides of the grid
/// (Batchelor 1967, "An Introduction to Fluid Dynamics", 2.2).
class StreamLines {
 public:
  StreamLines(const Grid& grid, bool has_axis);
  ~StreamLines();
  StreamLines(StreamLines&&) noexcept;

  /// About `count` lines, at equal steps of psi: between any two neighbours flows the same amount.
  /// `is_body` says for each point of the grid whether it is in a particle, which hides it. None if
  /// nothing moves. Frames should be given in their order, because the factor of the matrix is
  /// used again as long as the fluid covers about the same points.
  std::vector<StreamLine> of(const FlowOnGrid& flow, const std::vector<char>& is_body, int count);

 private:
  struct Equations;
  std::vector<double> stream_function(const FlowOnGrid& flow);

  Grid grid_;
  bool has_axis_;
  std::unique_ptr<Equations> equations_;
};

}  // namespace viscontact::report
