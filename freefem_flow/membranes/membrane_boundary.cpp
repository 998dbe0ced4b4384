// Puts the boundary of a mesh together from walls, periodic sides, rigid discs and membranes.
#include "viscontact/freefem_flow/membranes/membrane_boundary.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <variant>

#include "viscontact/common/error.hpp"
#include "viscontact/freefem_flow/boundary/edge_lengths.hpp"
#include "viscontact/membranes/membrane_curve.hpp"
#include "viscontact/particles/domain/periods.hpp"

namespace viscontact::freefem_flow {

using particles::BoxDomain;
using particles::DiscDomain;

namespace {

/// < 0 outside; infinite if all sides are periodic.
double distance_to_walls(const particles::Domain& domain, const Point& x) {
  if (const auto* disc = std::get_if<DiscDomain>(&domain))
    return disc->radius - std::hypot(x[0] - disc->centre[0], x[1] - disc->centre[1]);
  const auto& box = std::get<BoxDomain>(domain);
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < 2; ++d)
    if (!box.periodic[d]) distance = std::min({distance, x[d] - box.from[d], box.to[d] - x[d]});
  return distance;
}

/// Free choices of the edges around membranes; EdgeTuning has those of all boundaries.
struct MembraneEdgeTuning {
  // Increase of the edge length per distance from a curve with 24 edges.
  static constexpr double kGrowthAt24Edges = 0.25;
  // Largest edge over the distance from a curve, which makes two edges across a gap. An edge as
  // long as those of the curve over kOfOwnEdge is always allowed.
  static constexpr double kOfGap = 0.5, kOfOwnEdge = 8;
  // Least number of edges on a round wall, whose polygon is then nearly a circle.
  static constexpr std::size_t kLeastOnWall = 24;
  // Least width over the period of a strip without a membrane, in which a mesh can end;
  // membrane_boundary.hpp repeats it.
  static constexpr double kStrip = 1e-3;
};

class WantedEdges {
 public:
  WantedEdges(const particles::Domain& domain, const InnerCurves& curves)
      : curves_(curves), cap_(size_of(domain) / EdgeTuning::kEdgesOfAWall) {
    assert(curves.edges > 0 && curves.edges_of_disc > 0);
  }

  /// The wanted length [L] of an edge at the point x on a wall, or on the disc with the number
  /// `own`. Walls do not shorten this length.
  double at(const Point& x, std::size_t own = std::numeric_limits<std::size_t>::max()) const {
    double wanted = cap_;
    const auto shorten = [&](double edge, int edges, double distance) {
      wanted = std::min(
          {wanted,
           edge + MembraneEdgeTuning::kGrowthAt24Edges * EdgeTuning::kUsualEdges / edges * distance,
           std::max(edge / MembraneEdgeTuning::kOfOwnEdge, MembraneEdgeTuning::kOfGap * distance)});
    };
    for (const auto& nodes : curves_.membranes)
      for (Eigen::Index i = 0; i < nodes.rows(); i += 2)
        shorten((nodes.row((i + 2) % nodes.rows()) - nodes.row(i)).norm(), curves_.edges,
                std::hypot(nodes(i, 0) - x[0], nodes(i, 1) - x[1]));
    for (std::size_t k = 0; k < curves_.discs.size(); ++k) {
      const auto& disc = curves_.discs[k];
      const double edge = particles::kTwoPi * disc.shape.bounding_radius() / curves_.edges_of_disc;
      if (k == own)
        wanted = std::min(wanted, edge);
      else
        shorten(edge, curves_.edges_of_disc,
                std::hypot(disc.centre[0] - x[0], disc.centre[1] - x[1]) -
                    disc.shape.bounding_radius());
    }
    return wanted;
  }

  /// The same on the disc with the number `own`, but shorter near a wall.
  double on_disc(const particles::Domain& domain, std::size_t own, const Point& x) const {
    assert(own < curves_.discs.size());
    const double edge =
        particles::kTwoPi * curves_.discs[own].shape.bounding_radius() / curves_.edges_of_disc;
    return std::min(at(x, own),
                    std::max(edge / MembraneEdgeTuning::kOfOwnEdge,
                             MembraneEdgeTuning::kOfGap * distance_to_walls(domain, x)));
  }

 private:
  const InnerCurves& curves_;
  double cap_;  // the longest edge
};

}  // namespace

void check_places(const particles::Domain& domain, const InnerCurves& curves,
                  const SolverUnits& units) {
  const auto fail = [&](const char* what, const Point& place) {
    const auto x = units.in_case(place);
    throw Error(ErrorKind::kNotConverged,
                "{} at ({:.6g}, {:.6g}); use a shorter time_step, or more room between membranes, "
                "particles and walls",
                what, x[0], x[1]);
  };
  for (const auto& own : curves.membranes)
    for (const auto& node : own.rowwise()) {
      const Point x = {node(0), node(1)};
      if (!(distance_to_walls(domain, x) > 0)) fail("a membrane leaves the domain", x);
      for (const auto& disc : curves.discs)
        if (!(std::hypot(x[0] - disc.centre[0], x[1] - disc.centre[1]) >
              disc.shape.bounding_radius()))
          fail("a membrane meets a particle", x);
    }
  for (const auto& disc : curves.discs) {
    const Point x = {disc.centre[0], disc.centre[1]};
    if (!(distance_to_walls(domain, x) > disc.shape.bounding_radius()))
      fail("a particle leaves the domain", x);
  }
}

double shift_between_membranes(const particles::Domain& domain, const InnerCurves& curves) {
  const auto cell = particles::cell_of(domain);
  const double period = cell.lengths[0];
  if (!(period > 0) || (curves.membranes.empty() && curves.discs.empty())) return 0;
  // Where membranes and discs begin and end, each shifted by whole periods so that it begins inside
  // the box.
  std::vector<std::array<double, 2>> ranges;
  const auto add = [&](double from, double width) {
    const double start = from - period * particles::periods_beyond(cell, 0, from);
    ranges.push_back({start, start + width});
  };
  for (const auto& own : curves.membranes)
    add(own.col(0).minCoeff(), own.col(0).maxCoeff() - own.col(0).minCoeff());
  for (const auto& disc : curves.discs)
    add(disc.centre[0] - disc.shape.bounding_radius(), 2 * disc.shape.bounding_radius());
  std::ranges::sort(ranges);
  double end = ranges.front()[1], widest = 0, middle = 0;
  for (const auto& range : ranges) end = std::max(end, range[1]);
  end -= period;  // the largest end of the images that are shifted by minus one period
  for (const auto& [from, to] : ranges) {
    if (from - end > widest) {
      widest = from - end;
      middle = (from + end) / 2;
    }
    end = std::max(end, to);
  }
  if (!(widest > MembraneEdgeTuning::kStrip * period))
    throw Error(ErrorKind::kNotConverged,
                "no straight line across the periodic domain passes between the membranes and "
                "particles, at which the mesh could end; use a longer domain");
  return middle - cell.from[0];
}

MeshBoundary membrane_boundary(const particles::Domain& domain, const InnerCurves& curves) {
  const WantedEdges edges(domain, curves);
  const auto wanted_at = [&](const Point& x) { return edges.at(x); };
  MeshBoundary boundary;
  if (const auto* disc = std::get_if<DiscDomain>(&domain)) {
    const particles::PlacedShape wall{particles::Shape::disc(disc->radius),
                                      {disc->centre[0], disc->centre[1]}};
    boundary.add(cut_outline(wall, MembraneEdgeTuning::kLeastOnWall,
                             [&](double t) { return wanted_at(wall.at(t).point); }),
                 1);
  } else {
    const auto& box = std::get<BoxDomain>(domain);
    const Point a = {box.from[0], box.from[1]}, b = {box.to[0], box.to[1]};
    const auto left = cut_line({a[0], b[1]}, a, wanted_at);
    auto right = left;
    if (box.periodic[0]) {
      std::ranges::reverse(right);
      for (auto& x : right) x[0] = b[0];
    } else {
      right = cut_line({b[0], a[1]}, b, wanted_at);
    }
    boundary.add(cut_line(a, {b[0], a[1]}, wanted_at), 3);
    boundary.add(right, box.periodic[0] ? kPeriodicLabel : 2);
    boundary.add(cut_line(b, {a[0], b[1]}, wanted_at), 4);
    boundary.add(left, box.periodic[0] ? kPeriodicLabel : 1);
  }
  for (std::size_t k = 0; k < curves.discs.size(); ++k) {
    const auto& disc = curves.discs[k];
    auto points = cut_outline(disc, EdgeTuning::kLeastOnCircle,
                              [&](double t) { return edges.on_disc(domain, k, disc.at(t).point); });
    std::ranges::reverse(points);  // clockwise, so that the fluid is on the left
    boundary.add(points, kFirstParticleLabel + static_cast<int>(k));
  }
  const auto& nodes = curves.membranes;
  for (std::size_t m = 0; m < nodes.size(); ++m) {
    std::vector<Point> ends;
    for (Eigen::Index i = 0; i < nodes[m].rows(); i += 2)
      ends.push_back({nodes[m](i, 0), nodes[m](i, 1)});
    ends.push_back(ends.front());
    boundary.add(ends, kFirstMembraneLabel + static_cast<int>(m));
  }
  return boundary;
}

}  // namespace viscontact::freefem_flow
