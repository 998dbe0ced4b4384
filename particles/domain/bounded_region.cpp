#include "viscontact/particles/domain/bounded_region.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "viscontact/particles/domain/region.hpp"

namespace viscontact::particles {
namespace {

struct BoundedRegionTuning {
  // In a box that is kMany times as large as the distances of the planes, a bounded region has the
  // same size, but for kSame, as in a box twice as large. Planes that meet at angles below 1e-4
  // need a larger one.
  static constexpr double kMany = 1e4, kSame = 1e-9;
};

/// The box with this centre and half of the side [L].
BoxDomain box_about(const Vector& centre, double half, int dimension) {
  BoxDomain box;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) {
    box.from[d] = centre[d] - half;
    box.to[d] = centre[d] + half;
  }
  return box;
}

}  // namespace

double size_of_region(const Domain& domain, std::span<const PlanePosition> planes, int dimension) {
  assert(dimension >= 1 && dimension <= 3);
  if (!std::holds_alternative<std::monostate>(domain)) return measure(domain, planes);
  if (planes.empty() || dimension < 2) return 0;
  using Tuning = BoundedRegionTuning;
  Vector centre{};
  for (const auto& plane : planes)
    centre = centre + (1 / static_cast<double>(planes.size())) * plane.point;
  double reach = 0;
  for (const auto& plane : planes) reach = std::max(reach, norm(plane.point - centre));
  const double size = measure(box_about(centre, Tuning::kMany * reach, dimension), planes);
  const double again = measure(box_about(centre, 2 * Tuning::kMany * reach, dimension), planes);
  return std::abs(again - size) <= Tuning::kSame * size ? size : 0;
}

}  // namespace viscontact::particles
