// The lengths of edges of the mesh, from distances to particles and walls.
#include "viscontact/freefem_flow/boundary/edge_lengths.hpp"

#include <cassert>
#include <limits>

#include "viscontact/common/error.hpp"

namespace viscontact::freefem_flow {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

}  // namespace

double size_of(const particles::Domain& domain) {
  if (const auto* disc = std::get_if<particles::DiscDomain>(&domain)) return 2 * disc->radius;
  if (const auto* cylinder = std::get_if<particles::CylinderDomain>(&domain))
    return std::min(2 * cylinder->radius, cylinder->height);
  const auto& box = std::get<particles::BoxDomain>(domain);
  return std::min(box.to[0] - box.from[0], box.to[1] - box.from[1]);
}

void check_edge_length(double edge, double length) {
  if (edge > EdgeTuning::kShortest * length) return;  // false for NaN
  throw Error(ErrorKind::kNotConverged,
              "the mesh of the fluid needs an edge of {:.3g} of the length of a curve, but "
              "resolves no less than {:.0e} of it: particles, or a particle and a wall, overlap or "
              "have too narrow a gap; use a larger fluid.threshold_gap or a shorter time_step",
              edge / length, EdgeTuning::kShortest);
}

EdgeLengths::EdgeLengths(const particles::Fluid& fluid, const particles::Domain& domain,
                         const particles::FluidParticles& bodies, double coarsening)
    : domain_(domain) {
  assert(bodies.particles != nullptr && fluid.edges_per_particle > 0 && coarsening > 0);
  const auto& p = *bodies.particles;
  const double ratio = EdgeTuning::kUsualEdges / fluid.edges_per_particle;
  double smallest = kFar;
  for (std::size_t k = 0; k < p.count(); ++k) {
    outlines_.push_back(p.placed_shape(k, bodies.angles));
    smallest = std::min(smallest, outlines_.back().shape.inner_radius());
  }
  cap_ = coarsening * size_of(domain) / EdgeTuning::kEdgesOfAWall;
  per_radius_ = coarsening * 2 * std::numbers::pi / fluid.edges_per_particle;
  longest_ =
      std::min(coarsening * 2 * std::numbers::pi * smallest / fluid.edges_per_particle, cap_);
  growth_ = coarsening * EdgeTuning::kGrowthAt24Edges * ratio;
  if (fluid.has_inertia())
    growth_ = std::max(growth_, std::min(EdgeTuning::kFasterWithInertia * growth_,
                                         EdgeTuning::kFastestWithInertia));
  of_gap_ = coarsening * std::min(EdgeTuning::kOfGapAt24Edges * ratio, EdgeTuning::kLargestOfGap);
  // Spheres on an axis have short edges in wide gaps, too, because the fluid in the gaps carries
  // all of their load, and because a mesh of a few spheres is small.
  further_ = p.dimension == 1 ? 0 : coarsening * EdgeTuning::kFurtherAt24Edges * ratio;
  narrow_ = EdgeTuning::kNarrow * smallest;
  const auto periods = particles::periods_of(domain);
  const auto shifts = [](double period) { return period > 0 ? 1 : 0; };
  for (int i = -shifts(periods[0]); i <= shifts(periods[0]); ++i)
    for (int j = -shifts(periods[1]); j <= shifts(periods[1]); ++j)
      for (auto image : outlines_) {
        image.centre[0] += i * periods[0];
        image.centre[1] += j * periods[1];
        images_.push_back(image);
      }
  // At this gap across() is at least longest_, so that surfaces further away do not shorten edges.
  const double reach = longest_ / of_gap_;
  for (std::size_t k = 0; k < p.count(); ++k) {
    const auto& outline = outlines_[k];
    auto& neighbours = neighbours_.emplace_back();
    for (std::size_t i = 0; i < images_.size(); ++i) {
      const auto& other = images_[i];
      const double gap = other.distance_to(outline.centre) - outline.shape.bounding_radius();
      // Discs of one rigid body may overlap; there is then no gap between them to resolve.
      const bool is_joined = gap < 0 && p.bodies.are_one(static_cast<std::int32_t>(k),
                                                         static_cast<std::int32_t>(i % p.count()));
      if (gap < reach && other.centre != outline.centre && !is_joined) neighbours.push_back(other);
    }
  }
}

double EdgeLengths::distance_to_wall(const Point& x) const {
  if (const auto* disc = std::get_if<particles::DiscDomain>(&domain_))
    return disc->radius - std::hypot(x[0] - disc->centre[0], x[1] - disc->centre[1]);
  if (const auto* cylinder = std::get_if<particles::CylinderDomain>(&domain_))
    return std::min({cylinder->radius - x[0], x[1], cylinder->height - x[1]});
  double distance = kFar;
  if (const auto* box = std::get_if<particles::BoxDomain>(&domain_))
    for (std::size_t d = 0; d < 2; ++d)
      if (!box->periodic[d])
        distance = std::min({distance, x[d] - box->from[d], box->to[d] - x[d]});
  return distance;
}

std::array<double, 2> EdgeLengths::distances_to_particles(const Point& x) const {
  double nearest = kFar, second = kFar;
  for (const auto& image : images_) {
    const double distance = image.distance_to(x);
    second = std::min(second, std::max(nearest, distance));
    nearest = std::min(nearest, distance);
  }
  return {nearest, second};
}

double EdgeLengths::on_particle(std::size_t k, const Point& x) const {
  assert(k < neighbours_.size());
  double distance = distance_to_wall(x);
  for (const auto& other : neighbours_[k]) distance = std::min(distance, other.distance_to(x));
  return std::min(longest_, across(distance));
}

double EdgeLengths::on_outline(std::size_t k, double t) const {
  assert(k < outlines_.size());
  const auto& outline = outlines_[k];
  const auto at = outline.at(t);
  const double length = on_particle(k, at.point);
  if (outline.shape.is_round()) return length;
  return std::min(length, per_radius_ * at.curvature_radius);
}

double EdgeLengths::on_wall(const Point& x) const {
  const double distance = distances_to_particles(x)[0];
  return std::min({longest_ + growth_ * distance, across(distance), cap_});
}

double EdgeLengths::in_fluid(const Point& x) const {
  // The gap is the sum of the distances from the two nearest surfaces, of which one may be a wall.
  const auto [nearest, second] = distances_to_particles(x);
  const double wall = distance_to_wall(x);
  const double gap = std::min({nearest + second, nearest + wall});
  return std::min({longest_ + growth_ * nearest, across(gap), cap_});
}

}  // namespace viscontact::freefem_flow
