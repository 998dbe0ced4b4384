// The table of geometries. Case files and tables contain their names and keys.
#include "viscontact/freefem_axi/geometry.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "viscontact/common/named.hpp"

namespace viscontact::freefem_axi {
namespace {

using lubrication::MotionKind;
using Parameters = std::span<const double>;

// The functions below find parameters by their index. Radii, amplitude and wavelength are lengths
// [L]; ratios are those of the neighbour's velocity or angular velocity to that of the sphere [1].
constexpr std::array kSphereParameters = {
    GeometryParameter{
        .key = "radius", .flag = "-neighbourRadius", .allowed = kPositive, .fallback = {}},
    GeometryParameter{
        .key = "velocity_ratio", .flag = "-velocityRatio", .allowed = kFinite, .fallback = 0.0},
    GeometryParameter{.key = "rotation_ratio",
                      .flag = "-rotationRatio",
                      .allowed = kFinite,
                      .fallback = 0.0,
                      .is_named_if_given = true},
};
constexpr std::array kCavityParameters = {
    GeometryParameter{
        .key = "radius", .flag = "-cavityRadius", .allowed = kPositive, .fallback = {}},
};
constexpr std::array kRoughPlaneParameters = {
    GeometryParameter{
        .key = "amplitude", .flag = "-amplitude", .allowed = kPositive, .fallback = {}},
    GeometryParameter{
        .key = "wavelength", .flag = "-wavelength", .allowed = kPositive, .fallback = {}},
};

/// The radius and the height that a container must exceed.
RequiredSpace space_above_floor(double radius, double gap, Parameters) {
  return {radius, gap + 2 * radius};
}

/// The space above a rippled floor, whose ripples end at two sphere radii from the axis.
RequiredSpace space_above_ripples(double radius, double gap, Parameters) {
  return {2 * radius, gap + 2 * radius};
}

/// The middle of the gap is at half the height of the container.
RequiredSpace space_of_pair(double radius, double gap, Parameters parameters) {
  assert(!parameters.empty());
  const double larger = std::max(radius, parameters[0]);
  return {larger, gap + 4 * larger};
}

/// Motions about an axis have the ratio of angular velocities, the others that of velocities; the
/// neighbour feels no strain.
double ratio_of_pair(MotionKind motion, Parameters parameters) {
  assert(parameters.size() > 2);
  if (is_strain(motion)) return 0;
  return parameters[motion == MotionKind::kRoll || motion == MotionKind::kSpin ? 2 : 1];
}

/// A cavity needs no container. The gap, the distance to its nearest wall, is largest if sphere and
/// cavity are concentric.
RequiredSpace space_in_cavity(double radius, double, Parameters parameters) {
  assert(!parameters.empty());
  return {0, 0, parameters[0] - radius};
}

// These functions give k/(6 pi mu r^2), where R = k/q + ... is the resistance near contact. Theory
// (Cox & Brenner 1967; Jeffrey & Onishi 1984) gives k = 6 pi mu r_eff^2 with 1/r_eff = 1/r +
// 1/r_neighbour, where the radius of a cavity counts as negative. If the neighbour moves, k is
// multiplied by the rate of change of the gap over the velocity of the sphere. Beside a shear-free
// plane k is a quarter of that beside a plane without slip.
double leading_of_plane(double, Parameters) { return 1; }
double leading_of_free_surface(double, Parameters) { return 0.25; }
double leading_of_pair(double radius, Parameters parameters) {
  assert(parameters.size() > 1);
  const double share = parameters[0] / (radius + parameters[0]);
  return share * share * (1 - parameters[1]);
}
double leading_in_cavity(double radius, Parameters parameters) {
  assert(!parameters.empty());
  const double share = parameters[0] / (parameters[0] - radius);
  return share * share;
}

constexpr std::array kAllMotions = {MotionKind::kApproach, MotionKind::kSlide, MotionKind::kRoll,
                                    MotionKind::kSpin};
constexpr std::array kAllMotionsAndStrains = {MotionKind::kApproach,     MotionKind::kSlide,
                                              MotionKind::kRoll,         MotionKind::kSpin,
                                              MotionKind::kAxialStrain,  MotionKind::kShearStrain,
                                              MotionKind::kTwofoldStrain};
constexpr std::array kAlongAndAroundTheAxis = {MotionKind::kApproach, MotionKind::kSpin};

double flat(Parameters) { return 0; }
double curvature_of_sphere(Parameters parameters) {
  assert(!parameters.empty());
  return 1 / parameters[0];
}
double curvature_of_cavity(Parameters parameters) {
  assert(!parameters.empty());
  return -1 / parameters[0];
}

// The first row is default_geometry().
constexpr std::array kGeometries = {
    Geometry{.name = "plane",
             .script = "plane.edp",
             .parameters = {},
             .takes_container = true,
             .neighbour_ratio = nullptr,
             .leading_factor = leading_of_plane,
             .required_space = space_above_floor,
             .has_exact_drag = true,
             .motions = kAllMotionsAndStrains,
             .curvature = flat},
    Geometry{.name = "free_surface",
             .script = "free_surface.edp",
             .parameters = {},
             .takes_container = true,
             .neighbour_ratio = nullptr,
             .leading_factor = leading_of_free_surface,
             .required_space = space_above_floor,
             .motions = kAllMotions,
             .curvature = flat,
             .is_shear_free = true},
    Geometry{.name = "sphere",
             .script = "sphere.edp",
             .parameters = kSphereParameters,
             .takes_container = true,
             .neighbour_ratio = ratio_of_pair,
             .leading_factor = leading_of_pair,
             .required_space = space_of_pair,
             .relative_cost = 2.5,
             .motions = kAllMotionsAndStrains,
             .curvature = curvature_of_sphere},
    Geometry{.name = "cavity",
             .script = "cavity.edp",
             .parameters = kCavityParameters,
             .takes_container = false,
             .neighbour_ratio = nullptr,
             .leading_factor = leading_in_cavity,
             .required_space = space_in_cavity,
             .motions = kAllMotions,
             .curvature = curvature_of_cavity},
    // k is not known for this geometry, because R depends on the ripples even as the gap goes to 0.
    // Sliding and rolling are left out: a sphere that slides or rolls leaves the axis of the
    // circular ripples, and its resistance depends on its distance from this axis.
    Geometry{.name = "rough_plane",
             .script = "rough_plane.edp",
             .parameters = kRoughPlaneParameters,
             .takes_container = true,
             .neighbour_ratio = nullptr,
             .leading_factor = nullptr,
             .required_space = space_above_ripples,
             .motions = kAlongAndAroundTheAxis},
};

}  // namespace

std::span<const Geometry> all_geometries() { return kGeometries; }

std::vector<Geometry> geometries_with_exact_drag() {
  std::vector<Geometry> geometries;
  std::ranges::copy_if(kGeometries, std::back_inserter(geometries), &Geometry::has_exact_drag);
  return geometries;
}

const Geometry& default_geometry() { return kGeometries.front(); }

bool has_motion(const Geometry& geometry, lubrication::MotionKind motion) {
  return std::ranges::find(geometry.motions, motion) != geometry.motions.end();
}

std::vector<lubrication::MotionKind> parse_motions(const std::vector<std::string>& names,
                                                   std::string_view geometry_name) {
  const auto& geometry = find_geometry(geometry_name);
  std::vector<lubrication::MotionKind> motions(geometry.motions.begin(), geometry.motions.end());
  const std::string available = lubrication::motions_in_words(motions);
  if (names == std::vector<std::string>{"all"}) return motions;
  motions.clear();
  for (const auto& name : names) {
    const auto* known = find_named(lubrication::all_motions(), name);
    if (known == nullptr)
      throw Error(ErrorKind::kBadInput, "is '{}'; it must be one of {}, a list of these, or all",
                  name, available);
    if (!has_motion(geometry, known->kind))
      throw Error(ErrorKind::kBadInput, "is {}; beside a {} a sphere has the motions {}", name,
                  geometry_name, available);
    if (std::ranges::find(motions, known->kind) != motions.end())
      throw Error(ErrorKind::kBadInput, "names {} twice; name it once", name);
    motions.push_back(known->kind);
  }
  std::ranges::sort(motions);
  return motions;
}

const Geometry& find_geometry(std::string_view name) {
  return require_named(kGeometries, name, "geometry");
}

}  // namespace viscontact::freefem_axi
