// Planes as bodies, and their pairs.
#include "viscontact/suspensions/cell/planes.hpp"

#include <algorithm>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/particles/setting/plane_beside_flow.hpp"

namespace viscontact::suspensions {

std::vector<PlaneBody> planes_beside(const particles::Setting& setting) {
  const auto obstacles = particles::obstacles_of(setting);
  const auto walls = obstacles.size() - setting.planes.size();
  std::vector<PlaneBody> planes;
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    if (const auto fault = particles::fault_of_plane(obstacles[k], *setting.lubrication, k < walls))
      throw Error(ErrorKind::kBadInput, "{} {}", fault->key, fault->message);
    const auto& start = obstacles[k].start;
    planes.push_back({start.normal, dot(start.normal, start.point)});
  }
  return planes;
}

void check_plane_motions(const particles::Setting& setting, const Matrix& gradient, double from,
                         double to) {
  for (const auto& plane : setting.planes)
    if (const auto fault = particles::fault_of_motion(plane, gradient, from, to))
      throw Error(ErrorKind::kBadInput, "{} {}", fault->key, fault->message);
}

void add_plane_pairs(std::span<const PlaneBody> planes, std::span<const double> positions,
                     std::span<const double> radii, double range, std::vector<NearPair>& pairs) {
  if (planes.empty()) return;
  const auto of_spheres = static_cast<std::ptrdiff_t>(pairs.size());
  for (std::size_t i = 0; i < radii.size(); ++i)
    for (std::size_t k = 0; k < planes.size(); ++k) {
      const double distance =
          dot(planes[k].normal, particles::point_of(positions.data(), i, 3)) - planes[k].level;
      if (distance < (1 + range) * radii[i])
        pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(radii.size() + k),
                         -distance * planes[k].normal});
    }
  std::ranges::inplace_merge(pairs, pairs.begin() + of_spheres, {}, [](const NearPair& pair) {
    return std::pair(pair.first, pair.second);
  });
}

}  // namespace viscontact::suspensions
