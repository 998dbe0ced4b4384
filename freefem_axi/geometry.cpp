#include "freefem_axi/geometry.hpp"

#include <algorithm>
#include <array>

#include "common/named.hpp"

namespace viscontact {
namespace {

using Parameters = std::span<const double>;

constexpr std::array kSphereParameters = {
    GeometryParameter{"radius", "-neighbourRadius", kPositive, {}},
    GeometryParameter{"velocity_ratio", "-velocityRatio", kFinite, 0.0},
};
constexpr std::array kCavityParameters = {
    GeometryParameter{"radius", "-cavityRadius", kPositive, {}},
};
constexpr std::array kRoughPlaneParameters = {
    GeometryParameter{"amplitude", "-amplitude", kPositive, {}},
    GeometryParameter{"wavelength", "-wavelength", kPositive, {}},
};

RoomNeeded room_above_floor(double radius, double gap, Parameters) {
  return {radius, gap + 2 * radius};
}

/// The middle of the gap is at mid-height.
RoomNeeded room_of_pair(double radius, double gap, Parameters parameters) {
  const double larger = std::max(radius, parameters[0]);
  return {larger, gap + 4 * larger};
}

bool has_velocity(Parameters parameters) { return parameters[1] != 0; }

/// The gap is that to the nearest wall: up to concentric.
RoomNeeded room_in_cavity(double radius, double, Parameters parameters) {
  return {0, 0, parameters[0] - radius};
}

constexpr std::array kGeometries = {
    Geometry{"plane", "plane.edp", {}, true, nullptr, room_above_floor},
    Geometry{"free_surface", "free_surface.edp", {}, true, nullptr, room_above_floor},
    Geometry{"sphere", "sphere.edp", kSphereParameters, true, has_velocity, room_of_pair},
    Geometry{"cavity", "cavity.edp", kCavityParameters, false, nullptr, room_in_cavity},
    Geometry{"rough_plane", "rough_plane.edp", kRoughPlaneParameters, true, nullptr,
             room_above_floor},
};

}  // namespace

const Geometry& find_geometry(std::string_view name) {
  return require_named(kGeometries, name, "geometry");
}

}  // namespace viscontact
