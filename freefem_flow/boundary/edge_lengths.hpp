// How long the edges of the mesh are at a point of its boundary, and curves that are cut into such
// edges. bench/README.md has the errors of velocities with these lengths.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/setting/fluid.hpp"
#include "viscontact/particles/shapes/distance.hpp"

namespace viscontact::freefem_flow {

/// Free choices of the lengths of edges, from the table of errors in bench/README.md. Those with
/// AtEdges are for 24 edges on the smallest particle, and 24/n times as large for n edges.
struct EdgeTuning {
  /// The default of fluid.edges_per_particle.
  static constexpr double kUsualEdges = 24;
  /// Ratio of the longest edge in a narrow gap to the gap, and the largest such ratio for any
  /// number of edges. It allows two edges across the gap, because the fluid in a gap with one edge
  /// across it resists 7 % too much.
  static constexpr double kOfGapAt24Edges = 0.4, kLargestOfGap = 0.5;
  /// In gaps wider than kNarrow radii of the smallest particle, where the fluid resists less, edges
  /// may be longer: kFurtherAt24Edges times the excess of the gap over this width is added.
  static constexpr double kNarrow = 0.3, kFurtherAt24Edges = 0.35;
  /// Increase of the edge length per distance from the nearest particle; it depends on the number
  /// of edges as the ratio in a gap does, so that all edges shrink by one factor.
  static constexpr double kGrowthAt24Edges = 0.1;
  /// In a fluid with inertia the error is largest near the particles, so that edges further away
  /// may be longer: the increase per distance is multiplied by kFasterWithInertia, but not beyond
  /// kFastestWithInertia, which equals kGrowthAt24Edges, so that meshes with 24 or fewer edges on
  /// the smallest particle are the same as without inertia.
  static constexpr double kFasterWithInertia = 2, kFastestWithInertia = 0.1;
  /// Least number of edges across the domain, so that the flow far from all particles is resolved.
  static constexpr double kEdgesOfAWall = 6;
  /// Least edge over the length of its curve: FreeFEM merges nearer points.
  static constexpr double kShortest = 1e-7;
  /// Least number of edges on a circle, which is the least that a case may ask for.
  static constexpr std::size_t kLeastOnCircle = 6;
  /// Samples of 1/length in each edge, for the integral that places the ends of edges.
  static constexpr double kSamplesPerEdge = 8;
  /// Relative rounding error of a length along a curve, and of a number of edges.
  static constexpr double kRoundingOfLength = 1e-12, kRoundingOfCount = 1e-9;
};

/// x and y in the plane, r and z in a cylinder [L].
using Point = std::array<double, 2>;

/// The smallest extent [L] of a disc (its diameter), a box (its shorter side) or a cylinder.
double size_of(const particles::Domain& domain);

/// The lengths [L] of the edges on surfaces of particles, walls, the axis of a cylinder and
/// periodic sides. They are > 0 if surfaces have gaps, and <= 0 where surfaces touch or overlap.
class EdgeLengths {
 public:
  /// Throws std::bad_variant_access if there is no domain.
  EdgeLengths(const particles::Fluid& fluid, const particles::Domain& domain,
              const particles::FluidParticles& bodies, double coarsening = 1);

  /// That of an edge on the smallest particle, or less if another surface is near.
  double on_particle(std::size_t k, const Point& x) const;

  /// The same at the point outlines()[k].at(t). On a particle that is not round the length is also
  /// at most `coarsening` times 2 pi/edges_per_particle times the radius of curvature at the point.
  double on_outline(std::size_t k, double t) const;

  /// It increases with the distance from the nearest particle, to at most `coarsening` times a
  /// sixth of size_of() of the domain.
  double on_wall(const Point& x) const;

  /// On the axis or a periodic side: it increases with the distances from the two nearest surfaces,
  /// of which one may be a wall, to the limit of on_wall().
  double in_fluid(const Point& x) const;

  /// An edge on the smallest particle, for meshes with edges of equal length; without particles the
  /// limit of on_wall().
  double uniform() const { return longest_; }

  const std::vector<particles::PlacedShape>& outlines() const { return outlines_; }

 private:
  /// Negative outside the domain; infinite if all sides of a box are periodic.
  double distance_to_wall(const Point& x) const;
  /// To the two nearest particles or images; negative inside, infinite without any.
  std::array<double, 2> distances_to_particles(const Point& x) const;

  particles::Domain domain_;
  /// The longest edge [L] in a gap of this width [L].
  double across(double gap) const {
    return of_gap_ * gap + further_ * std::max(0.0, gap - narrow_);
  }
  // These are multiplied by `coarsening`, except narrow_.
  // Edge on the smallest particle [L]; increase of an edge per distance; the numbers of across().
  double longest_, growth_, of_gap_, further_, narrow_;
  double cap_;         // the longest edge on walls and in the fluid [L]
  double per_radius_;  // edge on a particle over the radius of curvature there
  std::vector<particles::PlacedShape> outlines_;
  std::vector<particles::PlacedShape> images_;  // with those of the particles
  // For each particle the outlines that shorten its edges.
  std::vector<std::vector<particles::PlacedShape>> neighbours_;
};

/// Throws Error(kNotConverged) if an edge of the length `edge` [L] is not longer than 1e-7 times
/// the length `length` [L] of its curve, or if `edge` is NaN, because FreeFEM merges the two ends
/// of such an edge.
void check_edge_length(double edge, double length);

/// Cuts a curve of the length `length` [L] into at least `least` edges. Returns the ends of the
/// edges as increasing distances [L] along the curve from 0 to `length`. `edge_length(s)` [L] is
/// the wanted length at the distance s. All edges are shorter than wanted by one common factor, so
/// that a whole number of them fits. Throws the error of check_edge_length().
template <class EdgeLength>
std::vector<double> cut_curve(double length, std::size_t least, const EdgeLength& edge_length) {
  // cost[i] approximates the integral of 1/edge_length from 0 to place[i], which is the number of
  // edges up to there before it is rounded.
  std::vector<double> place = {0}, cost = {0};
  const auto wanted_at = [&](double s) {
    const double wanted = std::min(edge_length(s), length);
    check_edge_length(wanted, length);
    return wanted;
  };
  double wanted = wanted_at(0);
  while (place.back() < length) {
    const double s = place.back();
    const double step = wanted / EdgeTuning::kSamplesPerEdge;
    const double next = s + step < length * (1 - EdgeTuning::kRoundingOfLength) ? s + step : length;
    const double wanted_next = wanted_at(next);
    cost.push_back(cost.back() + 2 * (next - s) / (wanted + wanted_next));
    place.push_back(next);
    wanted = wanted_next;
  }
  const auto edges = std::max(
      least, static_cast<std::size_t>(std::ceil(cost.back() - EdgeTuning::kRoundingOfCount)));
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

/// Cuts the line from `from` to `to` into edges. Returns the ends of the edges, with `from` and
/// `to` themselves. `edge_length(x)` [L] is the wanted length at the point x. Throws
/// Error(kNotConverged) as cut_curve() does, also if `from` and `to` are equal.
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
/// first. There are at least `least` edges. On an outline with sides, each side and each part
/// between two sides has at least `least` edges over the number of these parts, rounded down, and
/// its ends are points of the mesh. `edge_length(t)` [L] is the wanted length at outline.at(t).
/// Throws Error(kNotConverged) as cut_curve() does.
template <class EdgeLength>
std::vector<Point> cut_outline(const particles::PlacedShape& outline, std::size_t least,
                               const EdgeLength& edge_length) {
  const auto& shape = outline.shape;
  std::vector<double> joints;  // parameters at which parts begin or end
  for (int k = 0; k < shape.sides(); ++k) {
    joints.push_back(shape.side(k).from_parameter);
    joints.push_back(shape.side(k).to_parameter);
  }
  if (joints.empty()) joints.push_back(0);
  const auto parts = joints.size();
  joints.push_back(joints.front() + 2 * std::numbers::pi);
  // The outline is cut along s = r t, which is the length of the curve on a circle.
  const double r = shape.bounding_radius();
  std::vector<Point> points;
  for (std::size_t part = 0; part < parts; ++part) {
    const double from = joints[part], length = (joints[part + 1] - from) * r;
    const auto along_s = [&](double s) {
      const double t = from + s / r, speed = outline.at(t).speed, wanted = edge_length(t);
      return speed == r ? wanted : wanted * r / speed;
    };
    for (const double s : cut_curve(length, least / parts, along_s))
      if (parts == 1 || s < length) points.push_back(outline.at(from + s / r).point);
  }
  if (parts > 1) points.emplace_back();
  points.back() = points.front();
  return points;
}

}  // namespace viscontact::freefem_flow
