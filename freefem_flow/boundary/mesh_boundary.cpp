// Puts the boundary of a mesh together from walls, periodic sides, the axis of a cylinder and the
// surfaces of the particles.
#include "viscontact/freefem_flow/boundary/mesh_boundary.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include "viscontact/common/error.hpp"
#include "viscontact/freefem_flow/boundary/edge_lengths.hpp"
#include "viscontact/freefem_flow/boundary/periodic_cells.hpp"
#include "viscontact/particles/setting/chords.hpp"

namespace viscontact::freefem_flow {
namespace {

/// Free choices of the boundary; EdgeTuning has those of its edges.
struct BoundaryTuning {
  // If the inside of a particle is meshed, too, a polygon in it, kOfRadius times as large as the
  // outline and with edges of up to kLongest radii, makes this part of the mesh coarse: FreeFEM
  // derives the size of triangles from the nearest edges, and a few triangles represent a rigid
  // motion exactly. kOfRadius must be between 0.2 and 0.7, because curved_mesh.idp looks for both
  // parts of a particle at these two fractions of its radius.
  static constexpr double kOfRadius = 0.5, kLongest = 10;
  // Relative error of an area, above the rounding errors of positions that move with their body.
  static constexpr double kRounding = 1e-9;
};

/// Makes the boundary for one placement of the particles. of() may be called once only. The
/// arguments must outlive the object.
class BoundaryMaker {
 public:
  BoundaryMaker(const particles::Fluid& fluid, const particles::Domain& domain,
                const particles::FluidParticles& bodies, double coarsening)
      : bodies_(*bodies.particles),
        fluid_(fluid),
        fitted_(fluid.mesh == particles::FluidMesh::kFitted),
        has_holes_(fluid.constraint == particles::RigidConstraint::kRigid),
        lengths_(fluid, domain, bodies, coarsening) {}

  MeshBoundary of(const particles::DiscDomain& disc) {
    const particles::PlacedShape wall{particles::Shape::disc(disc.radius),
                                      {disc.centre[0], disc.centre[1]}};
    add_outline(wall, 1, false, [&](double t) { return on_wall(wall.at(t).point); });
    add_particles();
    return std::move(boundary_);
  }

  MeshBoundary of(const particles::BoxDomain& box) {
    const bool is_periodic = box.periodic[0] || box.periodic[1];
    if (fitted_ && is_periodic && !lengths_.outlines().empty())
      add_cells(box);
    else
      add_sides(box);
    add_particles();
    return std::move(boundary_);
  }

  /// The points are (distance from the axis, z), with the floor at z = 0.
  MeshBoundary of(const particles::CylinderDomain& cylinder) {
    const double radius = cylinder.radius, height = cylinder.height;
    const auto wall = [&](const Point& x) { return on_wall(x); };
    add_line({0, 0}, {radius, 0}, 2, wall);
    add_line({radius, 0}, {radius, height}, 1, wall);
    add_line({radius, height}, {0, height}, 3, wall);
    add_axis(height);
    return std::move(boundary_);
  }

  static MeshBoundary of(const std::monostate&) { return {}; }

 private:
  // On a fixed mesh, which does not follow the particles, all edges have one length.
  double on_wall(const Point& x) const {
    return fitted_ ? lengths_.on_wall(x) : lengths_.uniform();
  }
  double in_fluid(const Point& x) const {
    return fitted_ ? lengths_.in_fluid(x) : lengths_.uniform();
  }

  template <class EdgeLength>
  void add_line(const Point& from, const Point& to, int label, const EdgeLength& edge_length) {
    boundary_.add(cut_line(from, to, edge_length), label);
  }

  /// Adds a closed curve. The curve of a hole is clockwise, so that the fluid is on its left.
  template <class EdgeLength>
  void add_outline(const particles::PlacedShape& outline, int label, bool is_hole,
                   const EdgeLength& edge_length) {
    auto points = cut_outline(outline, EdgeTuning::kLeastOnCircle, edge_length);
    if (is_hole) std::ranges::reverse(points);
    boundary_.add(points, label);
  }

  /// Adds the surfaces of the particles and, if their inside is meshed, too, a polygon in each.
  void add_particles() {
    if (!fitted_) return;
    for (std::size_t k = 0; k < lengths_.outlines().size(); ++k) {
      const auto& outline = lengths_.outlines()[k];
      if (k < fluid_.cut_areas.size() && fluid_.cut_areas[k] > 0) {
        add_arcs(k);
        continue;
      }
      if (!has_holes_) {
        auto inner = outline;
        inner.shape = inner.shape.scaled(BoundaryTuning::kOfRadius);
        add_outline(inner, kInsideLabel, false, [&](double) {
          return BoundaryTuning::kLongest * outline.shape.bounding_radius();
        });
      }
      add_outline(outline, kFirstParticleLabel + static_cast<int>(k), has_holes_,
                  [&](double t) { return lengths_.on_outline(k, t); });
    }
  }

  /// Adds the arcs of disc k that are outside the overlapping discs of its body.
  void add_arcs(std::size_t k) {
    const auto chords = chords_of(fluid_, bodies_, k);
    constexpr double kTurn = 2 * std::numbers::pi;
    const auto& circle = lengths_.outlines()[k];
    const double radius = circle.shape.bounding_radius();
    for (std::size_t c = 0; c < chords.size(); ++c) {
      const auto &before = chords[c], &after = chords[(c + 1) % chords.size()];
      const double from = before.middle + before.half;
      const double to = after.middle - after.half + (c + 1 < chords.size() ? 0 : kTurn);
      const auto at = [&](double s) { return from + s / radius; };
      std::vector<Point> points;
      for (const double s : cut_curve((to - from) * radius, 1,
                                      [&](double t) { return lengths_.on_outline(k, at(t)); }))
        points.push_back(circle.at(at(s)).point);
      points.front() = before.to;
      points.back() = after.from;
      std::ranges::reverse(points);
      boundary_.add(points, kFirstParticleLabel + static_cast<int>(k));
    }
  }

  /// Opposite periodic sides get the same points, because all edges on them have the same length.
  void add_sides(const particles::BoxDomain& box) {
    const auto& a = box.from;
    const auto& b = box.to;
    const auto wall = [&](const Point& x) { return on_wall(x); };
    const auto uniform = [&](const Point&) { return lengths_.uniform(); };
    const auto side = [&](const Point& from, const Point& to, int label, bool is_periodic) {
      if (is_periodic)
        add_line(from, to, kPeriodicLabel, uniform);
      else
        add_line(from, to, label, wall);
    };
    side({a[0], a[1]}, {b[0], a[1]}, 3, box.periodic[1]);
    side({b[0], a[1]}, {b[0], b[1]}, 2, box.periodic[0]);
    side({b[0], b[1]}, {a[0], b[1]}, 4, box.periodic[1]);
    side({a[0], b[1]}, {a[0], a[1]}, 1, box.periodic[0]);
  }

  /// Adds the boundary of a region that takes the place of a periodic box (periodic_cells.hpp).
  /// Edges that are periodic images of each other get the same points.
  void add_cells(const particles::BoxDomain& box) {
    const auto edges = periodic_cells(box, lengths_.outlines());
    std::vector<std::vector<Point>> points(edges.size());
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto& edge = edges[e];
      const auto partner = static_cast<std::size_t>(std::max(edge.partner, 0));
      if (edge.partner < 0 || partner > e) {
        points[e] = cut_line(edge.from, edge.to, [&](const Point& x) {
          return edge.partner < 0 ? on_wall(x) : in_fluid(x);
        });
      } else {
        // The points are those of the partner in the opposite order, shifted by the period.
        const Point shift = {edge.from[0] - edges[partner].to[0],
                             edge.from[1] - edges[partner].to[1]};
        points[e] = points[partner];
        std::ranges::reverse(points[e]);
        for (auto& x : points[e]) x = {x[0] + shift[0], x[1] + shift[1]};
        points[e].front() = edge.from;
        points[e].back() = edge.to;
      }
      boundary_.add(points[e], edge.label);
    }
  }

  /// Adds the axis from the lid to the floor at 0, and the half circles of the spheres on it.
  void add_axis(double height) {
    const auto& outlines = lengths_.outlines();
    std::vector<std::size_t> order(fitted_ ? outlines.size() : 0);
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
      return outlines[a].centre[1] > outlines[b].centre[1];
    });
    const auto fluid = [&](const Point& x) { return in_fluid(x); };
    double z = height;
    for (const auto k : order) {
      const auto& circle = outlines[k];
      const double radius = circle.shape.bounding_radius();
      const double top = circle.centre[1] + radius, bottom = top - 2 * radius;
      add_line({0, z}, {0, top}, kAxisLabel, fluid);
      const auto at = [&](double s) {
        const double angle = s / radius;
        return Point{radius * std::sin(angle), circle.centre[1] + radius * std::cos(angle)};
      };
      std::vector<Point> points;
      for (const double s : cut_curve(std::numbers::pi * radius, EdgeTuning::kLeastOnCircle / 2,
                                      [&](double t) { return lengths_.on_particle(k, at(t)); }))
        points.push_back(at(s));
      points.front() = {0, top};
      points.back() = {0, bottom};
      boundary_.add(points, kFirstParticleLabel + static_cast<int>(k));
      if (!has_holes_)
        add_line({0, top}, {0, bottom}, kAxisLabel,
                 [&](const Point&) { return lengths_.uniform(); });
      z = bottom;
    }
    add_line({0, z}, {0, 0}, kAxisLabel, fluid);
  }

  const particles::Particles& bodies_;
  const particles::Fluid& fluid_;
  bool fitted_, has_holes_;  // the mesh follows the particles; they are holes in it
  EdgeLengths lengths_;
  MeshBoundary boundary_;
};

/// Throws Error(kNotConverged) if discs of one body overlap across a periodic side. chords_of()
/// takes only discs that overlap inside the box. If others overlap, the area [L^2] that the chords
/// cut off a disc differs from that in fluid.cut_areas.
void check_unions(const particles::Fluid& fluid, const particles::Particles& particles) {
  assert(fluid.cut_areas.size() <= particles.count());
  for (std::size_t k = 0; k < fluid.cut_areas.size(); ++k) {
    double area = 0;
    for (const auto& chord : chords_of(fluid, particles, k)) area += chord.area;
    if (std::abs(area - fluid.cut_areas[k]) >
        BoundaryTuning::kRounding * particles.radii[k] * particles.radii[k])
      throw Error(ErrorKind::kNotConverged,
                  "particle {} overlaps one of its body across a side of the period, where the "
                  "mesh does not join them; another origin of the period, or a plate in place of "
                  "the discs, avoids this",
                  particles.id(k));
  }
}

}  // namespace

MeshBoundary mesh_boundary(const particles::Fluid& fluid, const particles::Domain& domain,
                           const particles::FluidParticles& bodies, double coarsening) {
  assert(bodies.particles != nullptr && coarsening > 0);
  check_unions(fluid, *bodies.particles);
  BoundaryMaker maker(fluid, domain, bodies, coarsening);
  return std::visit([&](const auto& shape) { return maker.of(shape); }, domain);
}

}  // namespace viscontact::freefem_flow
