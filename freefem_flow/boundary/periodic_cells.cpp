// Power diagrams of a periodic box. Corners that are very near to each other are joined, and edges
// between particles of the box are left out.
#include "viscontact/freefem_flow/boundary/periodic_cells.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <tuple>

#include "viscontact/freefem_flow/boundary/mesh_boundary.hpp"

namespace viscontact::freefem_flow {
namespace {

struct Neighbour {
  int particle = -1;           ///< -1: a wall
  int label = 0;               ///< of the wall; 0: a particle
  std::array<int, 2> image{};  ///< numbers of periods by which the particle is shifted
};

/// A corner of a cell, and what lies behind the edge from it to the next corner.
struct Corner {
  Point at;
  Neighbour behind;
};

using Polygon = std::vector<Corner>;

/// Replaces the convex polygon, given counter-clockwise, by its part with normal.x <= offset, which
/// may be empty. `behind` is what lies beyond this line. `normal` need not have the length 1.
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

/// Square of the distance of the furthest corner from the point `from`; 0 without corners.
double square_of_reach(const Polygon& polygon, const Point& from) {
  double reach = 0;
  for (const auto& corner : polygon) {
    const double dx = corner.at[0] - from[0], dy = corner.at[1] - from[1];
    reach = std::max(reach, dx * dx + dy * dy);
  }
  return reach;
}

/// The cell of particle k, counter-clockwise. Walls bound it along directions that are not
/// periodic.
Polygon cell_of(std::size_t k, const particles::BoxDomain& box,
                std::span<const particles::PlacedShape> circles) {
  assert(k < circles.size());
  const auto& own = circles[k];
  const double own_radius = own.shape.bounding_radius();
  std::array<double, 2> period{}, low{}, high{};
  for (std::size_t d = 0; d < 2; ++d) {
    period[d] = box.to[d] - box.from[d];
    low[d] = box.periodic[d] ? own.centre[d] - period[d] : box.from[d];
    high[d] = box.periodic[d] ? own.centre[d] + period[d] : box.to[d];
  }
  // Along a periodic direction the polygon begins a period away from the centre. The lines to the
  // two images of the particle itself, half a period away, cut these sides off.
  Polygon cell = {{{low[0], low[1]}, {-1, 3, {}}},
                  {{high[0], low[1]}, {-1, 2, {}}},
                  {{high[0], high[1]}, {-1, 4, {}}},
                  {{low[0], high[1]}, {-1, 1, {}}}};
  // Lines to near particles, some 50 within the distance sqrt(near), cut the cell first. It is then
  // so small that the lines to most others do not reach it. The number changes only the time.
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
          // The line on which both power distances are equal, with the centre c of particle k and
          // the vector d from it to the centre of particle j: d.(x - c) = (|d|^2 + r^2 - r_j^2)/2.
          const double radius = circles[j].shape.bounding_radius();
          const double half = (square + own_radius * own_radius - radius * radius) / 2;
          if (half > 0 && half * half > reach * square) continue;
          clip(cell, d, half + d[0] * own.centre[0] + d[1] * own.centre[1],
               {static_cast<int>(j), 0, {sx, sy}});
          reach = square_of_reach(cell, own.centre);
        }
  return cell;
}

/// Gives one place to corners that are close together, or that are so after a shift by whole
/// periods.
class Corners {
 public:
  Corners(const particles::BoxDomain& box, std::span<const particles::PlacedShape> circles)
      : box_(box), circles_(circles) {}

  /// The place of the corner x. If an earlier corner, shifted by whole periods to be next to x, is
  /// nearer to x than a tenth of its own distance from the particles, the place is that of the
  /// earlier corner. Much smaller fractions give edges that are too short for the mesh there.
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
    double reach;  ///< [L]: corners up to this distance get the place `at`
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
  /// Distance of x from the nearest particle or image, at most the larger side of the box.
  double distance(const Point& x) const {
    double least = std::max(box_.to[0] - box_.from[0], box_.to[1] - box_.from[1]);
    for (const auto& circle : circles_) {
      const Point near = moved_near(x, circle.centre);
      least = std::min(least, circle.distance_to(near));
    }
    return least;
  }
  const particles::BoxDomain& box_;
  std::span<const particles::PlacedShape> circles_;
  std::vector<Joined> corners_;
};

}  // namespace

std::vector<CellEdge> periodic_cells(const particles::BoxDomain& box,
                                     std::span<const particles::PlacedShape> circles) {
  assert(!circles.empty() && (box.periodic[0] || box.periodic[1]));
  std::vector<CellEdge> edges;
  Corners corners(box, circles);
  std::vector<Polygon> cells;
  for (std::size_t k = 0; k < circles.size(); ++k) cells.push_back(cell_of(k, box, circles));
  // The first of several near corners decides their place. Corners on walls are joined first, so
  // that corners near a wall move onto it.
  for (const auto& cell : cells)
    for (std::size_t c = 0; c < cell.size(); ++c)
      if (cell[c].behind.particle < 0) {
        corners.joined(cell[c].at);
        corners.joined(cell[(c + 1) % cell.size()].at);
      }
  // The number of the edge between particle k and particle j shifted by (sx, sy) periods, with the
  // key (k, j, sx, sy). Its partner has the key (j, k, -sx, -sy).
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
