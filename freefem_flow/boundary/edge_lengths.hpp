// Says how long the edges of the mesh are at a point of its boundary, and cuts curves into such
// edges. Lengths have the unit of the arguments. Functions throw only what they say; numbers of
// particles and ranges of arguments are not checked. mesh_boundary.cpp and periodic_cells.hpp use
// this file; membranes/membrane_boundary.cpp uses the functions that cut. A change of a length
// changes all meshes, and the errors of velocities in bench/README.md must be measured again.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/fluid.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"
#include "viscontact/particles/outline.hpp"

namespace viscontact::freefem_flow {

/// The coordinates of a point [L]: x and y in the plane, r and z in a cylinder.
using Point = std::array<double, 2>;

/// The smallest extent [L], > 0, of a disc (its diameter), a box (its shorter side) or a cylinder.
/// Throws std::bad_variant_access if there is no domain.
double size_of(const particles::Domain& domain);

/// The lengths [L] of the edges on surfaces of particles, walls, the axis of a cylinder and
/// periodic sides. They are > 0 if surfaces have gaps, and <= 0 where surfaces touch or overlap. In
/// a periodic domain the images of a particle, which are the particle shifted by a period, count as
/// particles.
class EdgeLengths {
 public:
  /// `fluid` gives the number of edges on the smallest particle, > 0; all lengths are multiplied by
  /// `coarsening` > 0. `bodies.particles` must not be null; there may be no particles. Throws
  /// std::bad_variant_access if there is no domain.
  EdgeLengths(const particles::Fluid& fluid, const particles::Domain& domain,
              const particles::FluidParticles& bodies, double coarsening = 1);

  /// The length at a point on the surface of particle k (from 0, must exist): that of an edge on
  /// the smallest particle, or less if another surface is near.
  double on_particle(std::size_t k, const Point& x) const;

  /// The same at the point outlines()[k].at(t), for an outline of any shape; t is the parameter of
  /// the outline [rad]. On an ellipse or plate the length is also at most `coarsening` times 2
  /// pi/edges_per_particle times the radius of curvature at the point.
  double on_outline(std::size_t k, double t) const;

  /// The length at a point on a wall: it increases with the distance from the nearest particle, to
  /// at most `coarsening` times a sixth of size_of() of the domain.
  double on_wall(const Point& x) const;

  /// The length at a point of the fluid, such as one on the axis or on a periodic side: it
  /// increases with the distances from the two nearest surfaces, of which one may be a wall. The
  /// limit of on_wall() holds, too.
  double in_fluid(const Point& x) const;

  /// The length > 0 of an edge on the smallest particle, for meshes with edges of equal length.
  /// Without particles it is the limit of on_wall().
  double uniform() const { return longest_; }

  /// The outlines of all particles, in the order of the particles.
  const std::vector<particles::Outline>& outlines() const { return outlines_; }

 private:
  double distance_to_wall(const Point& x) const;
  /// Distances [L] to the nearest and the second nearest particle or image; infinite without any.
  std::array<double, 2> distances_to_particles(const Point& x) const;

  particles::Domain domain_;
  /// The longest edge [L] in a gap of this width [L].
  double across(double gap) const {
    return of_gap_ * gap + further_ * std::max(0.0, gap - narrow_);
  }
  // Edge on the smallest particle [L]; increase of an edge per distance; the numbers of across().
  double longest_, growth_, of_gap_, further_, narrow_;
  double cap_;         // length [L] of the longest edge on walls and in the fluid
  double per_radius_;  // edge on a particle over the radius of curvature there
  std::vector<particles::Outline> outlines_;  // of the particles
  std::vector<particles::Outline> images_;    // of the particles and of their images
  // For each particle the outlines that shorten its edges.
  std::vector<std::vector<particles::Outline>> neighbours_;
};

/// Throws Error(kNotConverged) if an edge of the length `edge` [L] is not longer than 1e-7 times
/// the length `length` [L], > 0, of its curve, or if `edge` is NaN, because FreeFEM merges the two
/// ends of such an edge.
void check_edge_length(double edge, double length);

/// Cuts a curve of the length `length` [L], > 0, into at least `least` >= 0 edges. Returns the ends
/// of the edges as increasing distances [L] along the curve from 0 to `length`, one more than
/// edges. `edge_length(s)` [L], > 0, is the wanted length at the distance s. All edges are shorter
/// than wanted by one common factor, so that a whole number of them fits. Throws
/// Error(kNotConverged) if a wanted length is at most 1e-7 times `length` or NaN
/// (check_edge_length()).
template <class EdgeLength>
std::vector<double> cut_curve(double length, std::size_t least, const EdgeLength& edge_length) {
  // cost[i] approximates the integral of 1/edge_length from 0 to place[i], which is the number of
  // edges up to there before it is rounded.
  std::vector<double> place = {0}, cost = {0};
  constexpr double kSamplesPerEdge = 8;  // of that integral; a free choice
  const auto wanted_at = [&](double s) {
    const double wanted = std::min(edge_length(s), length);
    check_edge_length(wanted, length);
    return wanted;
  };
  double wanted = wanted_at(0);
  while (place.back() < length) {
    const double s = place.back();
    const double step = wanted / kSamplesPerEdge;
    const double next = s + step < length * (1 - 1e-12) ? s + step : length;
    const double wanted_next = wanted_at(next);
    cost.push_back(cost.back() + 2 * (next - s) / (wanted + wanted_next));
    place.push_back(next);
    wanted = wanted_next;
  }
  const auto edges = std::max(least, static_cast<std::size_t>(std::ceil(cost.back() - 1e-9)));
  std::vector<double> ends = {0};
  std::size_t i = 0;
  for (std::size_t e = 1; e < edges; ++e) {
    const double target = cost.back() * static_cast<double>(e) / static_cast<double>(edges);
    while (cost[i + 1] < target) ++i;
    ends.push_back(place[i] +
                   (target - cost[i]) / (cost[i + 1] - cost[i]) * (place[i + 1] - place[i]));
  }
  ends.push_back(length);
  return ends;
}

/// Cuts the line from `from` to `to`, which must differ (not checked), into edges. Returns the ends
/// of the edges, at least two points, with `from` and `to` themselves. `edge_length(x)` [L], > 0,
/// is the wanted length at the point x. Throws Error(kNotConverged) as cut_curve() does.
template <class EdgeLength>
std::vector<Point> cut_line(const Point& from, const Point& to, const EdgeLength& edge_length) {
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
  const auto at = [&](double s) {
    return Point{from[0] + s / length * (to[0] - from[0]),
                 from[1] + s / length * (to[1] - from[1])};
  };
  std::vector<Point> points;
  for (const double s : cut_curve(length, 1, [&](double t) { return edge_length(at(t)); }))
    points.push_back(at(s));
  points.front() = from;
  points.back() = to;
  return points;
}

/// Cuts an outline into edges. Returns their ends counter-clockwise; the last point is equal to the
/// first. There are at least `least` edges; on a plate at least least/4, rounded down, on each of
/// its two sides and two round ends. `edge_length(t)` [L], > 0, is the wanted length at the point
/// outline.at(t). Throws Error(kNotConverged) as cut_curve() does.
template <class EdgeLength>
std::vector<Point> cut_outline(const particles::Outline& outline, std::size_t least,
                               const EdgeLength& edge_length) {
  if (outline.is_plate) {
    // Each round end and each side is cut by itself, so that its ends are points of the mesh.
    const double length = outline.length(), per = 2 * std::numbers::pi / length;
    const double arc = std::numbers::pi * outline.end_radius(), side = length / 2 - arc;
    std::vector<Point> points;
    for (const auto& [from, of_part] : {std::pair{-arc / 2, arc},
                                        {arc / 2, side},
                                        {arc / 2 + side, arc},
                                        {3 * arc / 2 + side, side}}) {
      const auto at = [&](double s) { return per * (from + s); };
      for (const double s :
           cut_curve(of_part, least / 4, [&](double t) { return edge_length(at(t)); }))
        if (s < of_part) points.push_back(outline.at(at(s)));
    }
    points.push_back(points.front());
    return points;
  }
  // The outline is cut along s = radius t, which is the length of the curve on a circle.
  const double r = outline.radius;
  const auto along_s = [&](double s) {
    const double t = s / r;
    return outline.is_circle() ? edge_length(t) : edge_length(t) * r / outline.speed_at(t);
  };
  std::vector<Point> points;
  for (const double s : cut_curve(2 * std::numbers::pi * r, least, along_s))
    points.push_back(outline.at(s / r));
  points.back() = points.front();
  return points;
}

}  // namespace viscontact::freefem_flow
