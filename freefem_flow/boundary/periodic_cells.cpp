// Cuts each cell out of the plane by the lines halfway to its neighbours, joins corners that are
// the same in the period, and keeps the edges whose other side is an image. Lengths are in the unit
// of the case; nothing is thrown. Edges must keep their partners, or the mesh is not periodic.
#include "viscontact/freefem_flow/boundary/periodic_cells.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "viscontact/freefem_flow/mesh_boundary.hpp"

namespace viscontact::freefem_flow {
namespace {

/// What lies on the other side of an edge: a particle shifted by whole periods, or a wall.
struct Neighbour {
  int particle = -1;  ///< -1: a wall
  int label = 0;      ///< of the wall
  std::array<int, 2> image{};
};

/// A corner of a cell, and what lies behind the edge from it to the next corner.
struct Corner {
  Point at;
  Neighbour behind;
};

using Polygon = std::vector<Corner>;

/// Keeps the part of the convex polygon with normal.x <= offset.
void clip(Polygon& polygon, const Point& normal, double offset, const Neighbour& behind) {
  const auto excess = [&](const Corner& c) {
    return normal[0] * c.at[0] + normal[1] * c.at[1] - offset;
  };
  Polygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto& here = polygon[k];
    const auto& next = polygon[(k + 1) % polygon.size()];
    const double a = excess(here), b = excess(next);
    if (a <= 0) kept.push_back(here);
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
      const double s = a / (a - b);
      const Point at = {here.at[0] + s * (next.at[0] - here.at[0]),
                        here.at[1] + s * (next.at[1] - here.at[1])};
      kept.push_back({at, a < 0 ? behind : here.behind});
    } else if (a == 0 && b > 0 && !kept.empty()) {
      kept.back().behind = behind;
    }
  }
  polygon = std::move(kept);
}

/// Square of the distance of the furthest corner from a point.
double square_of_reach(const Polygon& polygon, const Point& from) {
  double reach = 0;
  for (const auto& corner : polygon) {
    const double dx = corner.at[0] - from[0], dy = corner.at[1] - from[1];
    reach = std::max(reach, dx * dx + dy * dy);
  }
  return reach;
}

/// The Laguerre cell of particle k. Walls bound it along directions that are not periodic.
Polygon cell_of(std::size_t k, const particles::BoxDomain& box,
                std::span<const particles::Outline> circles) {
  const auto& own = circles[k];
  std::array<double, 2> period{}, low{}, high{};
  for (std::size_t d = 0; d < 2; ++d) {
    period[d] = box.to[d] - box.from[d];
    low[d] = box.periodic[d] ? own.centre[d] - period[d] : box.from[d];
    high[d] = box.periodic[d] ? own.centre[d] + period[d] : box.to[d];
  }
  // The order of the labels 1 to 4 is left, right, bottom, top. The sides of a periodic direction
  // are further away than the images of the particle itself, which cut them off.
  Polygon cell = {{{low[0], low[1]}, {-1, 3, {}}},
                  {{high[0], low[1]}, {-1, 2, {}}},
                  {{high[0], high[1]}, {-1, 4, {}}},
                  {{low[0], high[1]}, {-1, 1, {}}}};
  // Near particles cut the cell first. It is then so small that the lines of most others need no
  // cut.
  const double near = 16 * period[0] * period[1] / static_cast<double>(circles.size());
  double reach = square_of_reach(cell, own.centre);
  for (const bool is_near : {true, false})
    for (std::size_t j = 0; j < circles.size(); ++j)
      for (int sx = box.periodic[0] ? -1 : 0; sx <= (box.periodic[0] ? 1 : 0); ++sx)
        for (int sy = box.periodic[1] ? -1 : 0; sy <= (box.periodic[1] ? 1 : 0); ++sy) {
          if (j == k && sx == 0 && sy == 0) continue;
          const Point d = {circles[j].centre[0] + sx * period[0] - own.centre[0],
                           circles[j].centre[1] + sy * period[1] - own.centre[1]};
          const double square = d[0] * d[0] + d[1] * d[1];
          if ((square < near) != is_near) continue;
          // The line of equal power: d.(x - c) = (|d|^2 + r^2 - r_j^2)/2.
          const double half =
              (square + own.radius * own.radius - circles[j].radius * circles[j].radius) / 2;
          if (half > 0 && half * half > reach * square) continue;
          clip(cell, d, half + d[0] * own.centre[0] + d[1] * own.centre[1],
               {static_cast<int>(j), 0, {sx, sy}});
          reach = square_of_reach(cell, own.centre);
        }
  return cell;
}

/// Joins corners of the period that are close together: gives one place to all of them.
class Corners {
 public:
  Corners(const particles::BoxDomain& box, std::span<const particles::Outline> circles)
      : box_(box), circles_(circles) {}

  Point joined(const Point& x) {
    const Point wrapped =
        moved_near(x, {(box_.from[0] + box_.to[0]) / 2, (box_.from[1] + box_.to[1]) / 2});
    for (const auto& corner : corners_) {
      const Point near = moved_near(wrapped, corner.at);
      if (std::hypot(near[0] - corner.at[0], near[1] - corner.at[1]) <= corner.reach)
        return moved_near(corner.at, x);
    }
    constexpr double kShortOfDistance = 0.1;
    corners_.push_back({wrapped, kShortOfDistance * distance(wrapped)});
    return moved_near(wrapped, x);
  }

 private:
  struct Joined {
    Point at;
    double reach;
  };
  /// x shifted by whole periods to be as near to `centre` as possible.
  Point moved_near(Point x, const Point& centre) const {
    for (std::size_t d = 0; d < 2; ++d)
      if (box_.periodic[d]) {
        const double period = box_.to[d] - box_.from[d];
        x[d] -= period * std::round((x[d] - centre[d]) / period);
      }
    return x;
  }
  double distance(const Point& x) const {
    double least = std::max(box_.to[0] - box_.from[0], box_.to[1] - box_.from[1]);
    for (const auto& circle : circles_) {
      const Point near = moved_near(x, circle.centre);
      least = std::min(least, distance_to(circle, near));
    }
    return least;
  }
  const particles::BoxDomain& box_;
  std::span<const particles::Outline> circles_;
  std::vector<Joined> corners_;
};

}  // namespace

std::vector<CellEdge> periodic_cells(const particles::BoxDomain& box,
                                     std::span<const particles::Outline> circles) {
  std::vector<CellEdge> edges;
  Corners corners(box, circles);
  std::vector<Polygon> cells;
  for (std::size_t k = 0; k < circles.size(); ++k) cells.push_back(cell_of(k, box, circles));
  // Corners on walls come first, so that others are moved to the wall and not off it.
  for (const auto& cell : cells)
    for (std::size_t c = 0; c < cell.size(); ++c)
      if (cell[c].behind.particle < 0) {
        corners.joined(cell[c].at);
        corners.joined(cell[(c + 1) % cell.size()].at);
      }
  // Edges between particle k and neighbour j with image (sx, sy), to find the partner of each.
  std::map<std::tuple<int, int, int, int>, int> by_neighbours;
  for (std::size_t k = 0; k < circles.size(); ++k) {
    const auto& cell = cells[k];
    for (std::size_t c = 0; c < cell.size(); ++c) {
      const auto& behind = cell[c].behind;
      if (behind.particle >= 0 && behind.image == std::array<int, 2>{}) continue;
      CellEdge edge{corners.joined(cell[c].at), corners.joined(cell[(c + 1) % cell.size()].at),
                    behind.particle < 0 ? behind.label : kPeriodicLabel, -1};
      if (edge.from == edge.to) continue;
      if (behind.particle >= 0) {
        const int number = static_cast<int>(k);
        by_neighbours[{number, behind.particle, behind.image[0], behind.image[1]}] =
            static_cast<int>(edges.size());
        const auto partner =
            by_neighbours.find({behind.particle, number, -behind.image[0], -behind.image[1]});
        if (partner != by_neighbours.end()) {
          edge.partner = partner->second;
          edges[static_cast<std::size_t>(partner->second)].partner = static_cast<int>(edges.size());
        }
      }
      edges.push_back(edge);
    }
  }
  return edges;
}

}  // namespace viscontact::freefem_flow
