// Computes the extent of the particles, extends it to planes nearby, and clips polygons by
// half-spaces (view_box.hpp).
#include "viscontact/report/particles/view_box.hpp"

#include <algorithm>
#include <cmath>

namespace viscontact::report {
namespace {

using particles::dot;
using particles::Frame;
using particles::PlanePosition;
using particles::Playback;
using particles::Vector;
using particles::operator+;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators
using particles::operator-;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators
using particles::operator*;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators

/// The extent of the particles of a frame along an axis, without the `cut` outermost particles at
/// either end.
Interval reach_of(const Playback& playback, const Frame& frame, std::size_t axis, std::size_t cut) {
  std::vector<double> lows, highs;
  for (std::size_t k = 0; k < playback.radii.size(); ++k) {
    const double x = position(playback, frame, k)[axis], r = playback.radii[k];
    if (!std::isfinite(x)) continue;
    lows.push_back(x - r);
    highs.push_back(x + r);
  }
  Interval reach;
  if (lows.size() <= 2 * cut) return reach;
  const auto at = static_cast<std::ptrdiff_t>(cut);
  std::ranges::nth_element(lows, lows.begin() + at);
  std::ranges::nth_element(highs, highs.end() - 1 - at);
  reach.add(lows[cut], highs[highs.size() - 1 - cut]);
  return reach;
}

double size_of(const ViewBox& box, int dimension) {
  double size = 0;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
    size = std::max(size, box.high[d] - box.low[d]);
  return size;
}

/// Extends the box to a plane that is near it, so that particles are seen to lie on the plane.
void extend_to_plane(ViewBox& box, const PlanePosition& plane, int dimension) {
  constexpr double kNear = 0.5;  // largest distance, in sizes of the box
  const double size = size_of(box, dimension);
  if (plane.is_curved())
    for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) {
      const double low = plane.point[d] - plane.radius, high = plane.point[d] + plane.radius;
      if (box.low[d] - low <= kNear * size) box.low[d] = std::min(box.low[d], low);
      if (high - box.high[d] <= kNear * size) box.high[d] = std::max(box.high[d], high);
    }
  double distance = 0;
  for (std::size_t d = 0; d < 3; ++d)
    distance +=
        plane.normal[d] * ((plane.normal[d] > 0 ? box.low[d] : box.high[d]) - plane.point[d]);
  if (distance <= 0 || distance > kNear * size) return;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) {
    const double shift = -plane.normal[d] * distance;
    (shift < 0 ? box.low[d] : box.high[d]) += shift;
  }
}

}  // namespace

ViewBox view_box_of(const Playback& playback, const std::vector<std::size_t>& frames,
                    const std::optional<ViewBox>& domain) {
  // If the extent of all particles is more than 1.5 times that of the central ones, some particles
  // have flown away.
  constexpr double kFlownAway = 1.5;
  const auto dimension = static_cast<std::size_t>(playback.dimension);
  // At both ends of all axes together, 2 % of the particles are left out.
  const auto cut = playback.radii.size() / (100 * dimension);
  ViewBox box;
  double size = 0;
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    Interval all, central;
    for (const auto f : frames) {
      const auto whole = reach_of(playback, playback.frames[f], axis, 0);
      const auto middle = reach_of(playback, playback.frames[f], axis, cut);
      all.add(whole.low, whole.high);
      central.add(middle.low, middle.high);
    }
    if (!(all.low <= all.high)) all = central = {-1, 1};
    const bool flown = all.high - all.low > kFlownAway * (central.high - central.low);
    box.low[axis] = flown ? central.low : all.low;
    box.high[axis] = flown ? central.high : all.high;
    size = std::max(size, box.high[axis] - box.low[axis]);
  }
  if (!(size > 0)) size = 1;
  for (const auto f : frames)
    for (const auto& plane : playback.frames[f].planes)
      extend_to_plane(box, plane, playback.dimension);
  // In a domain more than this many times as large as the box, the particles would be too small.
  constexpr double kTooLarge = 16;
  if (domain && size_of(*domain, playback.dimension) <= kTooLarge * size) box = *domain;
  // Margin, and smallest size in any direction, both in sizes of the box.
  constexpr double kMargin = 0.04, kFlattest = 0.15;
  size = std::max(size, size_of(box, playback.dimension));
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    const double more =
        std::max(kMargin * size, 0.5 * (kFlattest * size - (box.high[axis] - box.low[axis])));
    box.low[axis] -= more;
    box.high[axis] += more;
  }
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (const double period = playback.cell.lengths[axis]; period > 0) {
      box.low[axis] = playback.cell.from[axis];
      box.high[axis] = box.low[axis] + period;
    }
  return box;
}

Polygon clipped(const Polygon& polygon, const Vector& point, const Vector& normal) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double u = dot(normal, a - point), v = dot(normal, b - point);
    if (u >= 0) kept.push_back(a);
    if ((u >= 0) != (v >= 0)) kept.push_back(a + (u / (u - v)) * (b - a));
  }
  return kept;
}

Polygon clipped_to_view(Polygon polygon, const ViewBox& box,
                        const std::vector<PlanePosition>& planes, std::size_t own, int dimension) {
  // Planes may meet or coincide. Without the slack, round-off could remove polygons of such planes.
  const double slack = 1e-4 * size_of(box, dimension);
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) {
    Vector axis{0, 0, 0};
    axis[d] = 1;
    polygon = clipped(clipped(polygon, box.low, axis), box.high, -1.0 * axis);
  }
  for (std::size_t j = 0; j < planes.size(); ++j)
    if (j != own)
      polygon = clipped(polygon, planes[j].point - slack * planes[j].normal, planes[j].normal);
  return polygon;
}

}  // namespace viscontact::report
