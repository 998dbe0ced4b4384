// Sizes of convex regions as sums over their faces.
#include "viscontact/particles/domain/region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace viscontact::particles {
namespace {

// The corners of a convex polygon in order, or the two ends of a line.
using Face = std::vector<Vector>;

/// The part of a face on the free side of a plane.
Face clipped(const Face& face, const PlanePosition& plane) {
  Face kept;
  const auto height = [&](const Vector& x) { return dot(plane.normal, x - plane.point); };
  const std::size_t n = face.size(), sides = n == 2 ? 1 : n;
  for (std::size_t k = 0; k < n; ++k) {
    const double here = height(face[k]);
    if (here >= 0) kept.push_back(face[k]);
    if (k >= sides) break;
    const auto& next = face[(k + 1) % n];
    const double there = height(next);
    if ((here < 0) != (there < 0))
      kept.push_back(face[k] + (here / (here - there)) * (next - face[k]));
  }
  return kept;
}

/// Length of a line in two dimensions, or area of a polygon in three.
double size_of(const Face& face, std::size_t dimension) {
  if (dimension == 2) return face.size() == 2 ? norm(face[1] - face[0]) : 0;
  Vector sum{};
  for (std::size_t k = 1; k + 1 < face.size(); ++k)
    sum = sum + cross(face[k] - face[0], face[k + 1] - face[0]);
  return norm(sum) / 2;
}

/// A face in `plane` that reaches `reach` [L] beyond the point of the plane nearest to `near`.
Face wide_face(const PlanePosition& plane, const Vector& near, double reach,
               std::size_t dimension) {
  const auto& n = plane.normal;
  const Vector foot = near - dot(n, near - plane.point) * n;
  if (dimension == 2) {
    const Vector along{-n[1], n[0], 0};
    return {foot - reach * along, foot + reach * along};
  }
  Vector axis{};
  axis[std::abs(n[0]) < 0.5 ? 0 : 1] = 1;
  const Vector across = cross(n, axis);
  const Vector u = (reach / norm(across)) * across, v = cross(n, u);
  return {foot - u - v, foot + u - v, foot + u + v, foot - u + v};
}

bool coincide(const PlanePosition& a, const PlanePosition& b, double length) {
  constexpr double kRounding = 1e-12;
  return norm(a.normal - b.normal) <= kRounding &&
         std::abs(dot(a.normal, a.point - b.point)) <= kRounding * length;
}

/// The sum over all faces in `planes` of the size of the face times its distance from `centre`,
/// divided by the dimension. It is the size of the region if planes alone bound it. The faces must
/// be within `reach` of `centre`.
double sum_of_faces(std::span<const PlanePosition> planes, const Vector& centre, double reach,
                    std::size_t dimension) {
  double sum = 0;
  for (std::size_t f = 0; f < planes.size(); ++f) {
    auto face = wide_face(planes[f], centre, 2 * reach, dimension);
    for (std::size_t g = 0; g < planes.size() && !face.empty(); ++g) {
      if (g == f) continue;
      if (!coincide(planes[f], planes[g], reach))
        face = clipped(face, planes[g]);
      else if (g < f)
        face.clear();
    }
    sum += dot(planes[f].normal, centre - planes[f].point) * size_of(face, dimension);
  }
  return sum / static_cast<double>(dimension);
}

struct MeasureOf {
  std::span<const PlanePosition> planes;

  double operator()(std::monostate) const { return 0; }
  double operator()(const BoxDomain& box) const {
    std::vector<PlanePosition> all(planes.begin(), planes.end());
    const Vector from(box.from), to(box.to), centre = 0.5 * (from + to);
    for (std::size_t d = 0; d < box.dimension(); ++d) {
      Vector normal{};
      normal[d] = 1;
      all.push_back({from, normal});
      all.push_back({to, -1.0 * normal});
    }
    return sum_of_faces(all, centre, norm(to - from), box.dimension());
  }
  double operator()(const DiscDomain& disc) const {
    const double r = disc.radius;
    double sum = 0;
    for (std::size_t f = 0; f < planes.size(); ++f) {
      const auto& plane = planes[f];
      const double height = dot(plane.normal, disc.centre - plane.point);
      if (std::abs(height) >= r) continue;
      auto face = wide_face(plane, disc.centre, std::sqrt(r * r - height * height), 2);
      for (std::size_t g = 0; g < planes.size() && !face.empty(); ++g) {
        if (g == f) continue;
        if (!coincide(plane, planes[g], r))
          face = clipped(face, planes[g]);
        else if (g < f)
          face.clear();
      }
      sum += height * size_of(face, 2) / 2;
    }
    std::vector<double> ends = {0, 2 * std::numbers::pi};
    const auto height_at = [&](const PlanePosition& plane, double angle) {
      const Vector x = disc.centre + r * Vector{std::cos(angle), std::sin(angle), 0};
      return dot(plane.normal, x - plane.point);
    };
    for (const auto& plane : planes) {
      const double height = dot(plane.normal, disc.centre - plane.point);
      if (std::abs(height) >= r) continue;
      const double towards = std::atan2(plane.normal[1], plane.normal[0]);
      for (const double half : {std::acos(-height / r), -std::acos(-height / r)}) {
        const double angle = std::fmod(towards + half + 4 * std::numbers::pi, 2 * std::numbers::pi);
        ends.push_back(angle);
      }
    }
    std::ranges::sort(ends);
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      const double middle = (ends[k] + ends[k + 1]) / 2;
      if (std::ranges::all_of(planes, [&](const auto& p) { return height_at(p, middle) >= 0; }))
        sum += r * r * (ends[k + 1] - ends[k]) / 2;
    }
    return sum;
  }
  double operator()(const CylinderDomain& cylinder) const {
    double from = 0, to = cylinder.height;
    for (const auto& plane : planes)
      if (plane.normal[0] > 0)
        from = std::max(from, plane.point[0]);
      else if (plane.normal[0] < 0)
        to = std::min(to, plane.point[0]);
    return std::numbers::pi * cylinder.radius * cylinder.radius * std::max(to - from, 0.0);
  }
};

}  // namespace

double measure(const Domain& domain, std::span<const PlanePosition> planes) {
  std::vector<PlanePosition> cutting;
  std::ranges::copy_if(planes, std::back_inserter(cutting),
                       [](const PlanePosition& plane) { return !plane.is_curved(); });
  if (cutting.empty()) return measure(domain);
  return std::max(0.0, std::visit(MeasureOf{cutting}, domain));
}

}  // namespace viscontact::particles
