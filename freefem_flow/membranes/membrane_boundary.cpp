// Puts the boundary of a mesh together from walls, periodic sides and membranes
// (membrane_boundary.hpp). Opposite periodic sides must get the same points.
#include "viscontact/freefem_flow/membranes/membrane_boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "viscontact/common/error.hpp"
#include "viscontact/freefem_flow/boundary/edge_lengths.hpp"
#include "viscontact/particles/domain/periods.hpp"

namespace viscontact::freefem_flow {

using particles::BoxDomain;
using particles::DiscDomain;

void check_places(const particles::Domain& domain, const NodesOfMembranes& nodes, double unit) {
  const auto is_inside = [&](double x, double y) {
    if (const auto* disc = std::get_if<DiscDomain>(&domain))
      return std::hypot(x - disc->centre[0], y - disc->centre[1]) < disc->radius;
    const auto& box = std::get<BoxDomain>(domain);
    return (box.periodic[0] || (x > box.from[0] && x < box.to[0])) && y > box.from[1] &&
           y < box.to[1];
  };
  for (const auto& own : nodes)
    for (const auto& node : own.rowwise())
      if (!is_inside(node(0), node(1)))
        throw Error(ErrorKind::kNotConverged,
                    fmt::format("a membrane leaves the domain at ({:.6g}, {:.6g}); use a shorter "
                                "time_step, or more room between membranes and walls",
                                node(0) * unit, node(1) * unit));
}

double shift_between_membranes(const particles::Domain& domain, const NodesOfMembranes& nodes) {
  const auto cell = particles::cell_of(domain);
  const double period = cell.lengths[0];
  if (!(period > 0) || nodes.empty()) return 0;
  // Where membranes begin and end within the period, and the widest gap between them.
  std::vector<std::array<double, 2>> ranges;
  for (const auto& own : nodes) {
    const double from = own.col(0).minCoeff(), width = own.col(0).maxCoeff() - from;
    const double start = from - period * particles::periods_beyond(cell, 0, from);
    ranges.push_back({start, start + width});
  }
  std::ranges::sort(ranges);
  double end = ranges.front()[1], widest = 0, middle = 0;
  for (const auto& range : ranges) end = std::max(end, range[1]);
  end -= period;  // the furthest end of the images one period before
  for (const auto& [from, to] : ranges) {
    if (from - end > widest) {
      widest = from - end;
      middle = (from + end) / 2;
    }
    end = std::max(end, to);
  }
  if (!(widest > 1e-3 * period))
    throw Error(
        ErrorKind::kNotConverged,
        "no straight line across the periodic domain passes between the membranes, at which "
        "the mesh could end; use a longer domain");
  return middle - cell.from[0];
}

MeshBoundary membrane_boundary(const particles::Domain& domain, const NodesOfMembranes& nodes,
                               int edges) {
  // Edges grow by this share of the distance from the nearest membrane, with 24 edges on it.
  constexpr double kGrowthOfMembranes = 0.25, kEdgesOfAWall = 6, kOfGap = 0.5;
  const double growth = kGrowthOfMembranes * 24 / edges, cap = size_of(domain) / kEdgesOfAWall;
  const auto wanted_at = [&](const Point& x) {
    double wanted = cap;
    for (const auto& own : nodes)
      for (Eigen::Index i = 0; i < own.rows(); i += 2) {
        const double edge = (own.row((i + 2) % own.rows()) - own.row(i)).norm();
        const double distance = std::hypot(own(i, 0) - x[0], own(i, 1) - x[1]);
        wanted =
            std::min({wanted, edge + growth * distance, std::max(edge / 8, kOfGap * distance)});
      }
    return wanted;
  };
  MeshBoundary boundary;
  if (const auto* disc = std::get_if<DiscDomain>(&domain)) {
    constexpr std::size_t kLeastOnWall = 24;
    const particles::Outline wall{{disc->centre[0], disc->centre[1]}, disc->radius};
    boundary.add(cut_outline(wall, kLeastOnWall, [&](double t) { return wanted_at(wall.at(t)); }),
                 1);
  } else {
    const auto& box = std::get<BoxDomain>(domain);
    const auto &a = box.from, &b = box.to;
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
