// The flow G x sticks to a plane with the normal n if G t = 0 along it, n.G = 0, and its velocity
// is G x there.
#include "viscontact/particles/setting/plane_beside_flow.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace viscontact::particles {
namespace {

// Relative error of velocities that users round, and of unit normals.
constexpr double kRounding = 1e-9;

Vector flow_at(const Gradient& gradient, const Vector& x) {
  return {dot(gradient[0], x), dot(gradient[1], x), dot(gradient[2], x)};
}

double size_of(const Gradient& gradient) {
  double size = 0;
  for (const auto& row : gradient) size = std::max(size, norm(row));
  return size;
}

/// Whether the flow is a shear along the planes of this normal, or the fluid is at rest.
bool sticks(const Gradient& gradient, const Vector& n) {
  const Vector across = flow_at(gradient, n);
  const double least = kRounding * size_of(gradient);
  bool is_along = std::abs(dot(n, across)) <= least;
  for (std::size_t i = 0; i < 3; ++i) is_along &= norm(gradient[i] - across[i] * n) <= least;
  return is_along;
}

}  // namespace

std::optional<SettingFault> fault_of_plane(const Plane& plane, const PairLubrication& pairs,
                                           bool is_wall) {
  if (plane.start.is_curved())
    return SettingFault{"normal", "is that of a round wall; films are between spheres and planes"};
  if (plane.load)
    return SettingFault{
        "mass",
        "belongs to a plane that a load moves; beside [lubrication] planes move along "
        "themselves only"};
  if (norm(plane.angular_velocity) > 0)
    return SettingFault{"angular_velocity",
                        "turns this plane; beside [lubrication] planes move along themselves only"};
  const Vector& n = plane.start.normal;
  const bool is_along =
      sticks(pairs.gradient, n) && std::ranges::all_of(pairs.pieces, [&](const FlowPiece& piece) {
        return sticks(piece.gradient, n);
      });
  if (!is_along)
    return SettingFault{
        "normal",
        "belongs to a plane along which the flow changes, or through which it goes; "
        "lubrication.velocity must be a shear along the plane, or the fluid at rest"};
  if (is_wall) return {};
  for (const auto& piece : plane.velocity.pieces)
    if (std::abs(dot(n, piece.value)) > kRounding * norm(piece.value))
      return SettingFault{
          "velocity",
          "has a component along the normal; beside [lubrication] planes move along "
          "themselves only"};
  return {};
}

std::optional<SettingFault> fault_of_motion(const Plane& plane, const Gradient& gradient,
                                            double from, double to) {
  const Vector velocity = to > from ? plane.velocity.mean(from, to) : plane.velocity.value(from);
  const Vector flow = flow_at(gradient, plane.start.point);
  const double least = kRounding * (size_of(gradient) * norm(plane.start.point) + norm(velocity));
  if (norm(velocity - flow) <= least) return {};
  return SettingFault{
      "velocity",
      fmt::format(
          "is [{:.6g}, {:.6g}, {:.6g}] at the time {:.6g}, where the flow beside the plane has "
          "the velocity [{:.6g}, {:.6g}, {:.6g}] of lubrication.velocity; both must be equal, "
          "because the fluid sticks to the plane",
          velocity[0], velocity[1], velocity[2], from, flow[0], flow[1], flow[2])};
}

}  // namespace viscontact::particles
