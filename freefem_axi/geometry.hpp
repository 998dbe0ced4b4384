// The registry of geometries: what the sphere approaches. q is the gap, r the radius of the sphere,
// mu the viscosity, R the resistance. Lengths are in any one unit. A new geometry needs a script
// and a row in geometry.cpp; docs/extending.md shows how. Case files and tabulation.hpp use the
// registry. A change must keep names, keys (of case files) and flags (of scripts).
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/common/allowed.hpp"
#include "viscontact/lubrication/table.hpp"

namespace viscontact::freefem_axi {

/// A parameter of a geometry: a key of `geometry` in the case file and a flag of the script.
struct GeometryParameter {
  std::string_view key;   ///< in the case file
  std::string_view flag;  ///< of the script
  Allowed allowed;        ///< the values that are accepted
  /// Value for a case without this key; nothing if the key is required.
  std::optional<double> fallback;
  /// True: a table names the parameter only if it differs from the fallback.
  bool is_named_if_given = false;
};

/// The space that a sphere at some gap and its neighbour need [L].
struct RequiredSpace {
  double container_radius = 0;  ///< the container's radius must be larger
  double container_height = 0;  ///< the container's height must be larger
  double largest_gap = std::numeric_limits<double>::infinity();  ///< largest gap that is allowed
};

/// The motion of a geometry that declares no others.
inline constexpr std::array kApproachAlone = {lubrication::MotionKind::kApproach};

/// A kind of neighbour.
struct Geometry {
  /// The name, which is `kind` in the case file.
  std::string_view name;
  /// The script in the folder scripts/. docs/extending.md says what it gets and prints.
  std::string_view script;
  /// The parameters, in the order of all spans of parameters below.
  std::span<const GeometryParameter> parameters;
  /// False if the geometry is closed and needs no container.
  bool takes_container;
  /// The neighbour's velocity (approach, slide) or angular velocity (roll, spin) over that of the
  /// sphere [1]. Null: the neighbour is always at rest.
  double (*neighbour_ratio)(lubrication::MotionKind motion, std::span<const double> parameters);
  /// Coefficient k of R ~ k/q near contact in theory, over that of a plane, 6 pi mu r^2 [1]. It
  /// depends on curvature and velocity of the neighbour. Null: not known.
  double (*leading_factor)(double radius, std::span<const double> parameters);
  /// The space for a sphere of radius r [L] at a gap [L].
  RequiredSpace (*required_space)(double radius, double gap, std::span<const double> parameters);
  /// True if the exact drag near a plane (lubrication/plane_drag.hpp) is the drag of this geometry.
  bool has_exact_drag = false;
  /// Computing time of a row over that of a row above a plane [1], for estimates.
  double relative_cost = 1;
  /// The motions for which the script imposes the right conditions on the neighbour, in the order
  /// of MotionKind. A script that changes a condition changes it for the approach alone
  /// (solveStokes in axisymmetric_stokes.idp); solveSideways in sideways_stokes.idp and solveSwirl
  /// in axisymmetric_stokes.idp have conditions of their own.
  std::span<const lubrication::MotionKind> motions = kApproachAlone;
  /// 1 over the neighbour's radius [1/L]: 0 of a plane, < 0 of a cavity. It gives theory's leading
  /// terms of sliding, rolling and spinning. Null: they are not known.
  double (*curvature)(std::span<const double> parameters) = nullptr;
  /// True: no tangential stress on the neighbour.
  bool is_shear_free = false;
};

/// All geometries.
std::span<const Geometry> all_geometries();

/// The geometries whose drag is the exact one near a plane.
std::vector<Geometry> geometries_with_exact_drag();

/// The geometry of a case that names none.
const Geometry& default_geometry();

/// True if the geometry declares this motion.
bool has_motion(const Geometry& geometry, lubrication::MotionKind motion);

/// The motions with these names, in the order of MotionKind; "all" stands for every motion that the
/// geometry has. Throws Error(kBadInput) for an unknown name, a name that stands twice, and a
/// motion that the geometry lacks.
std::vector<lubrication::MotionKind> parse_motions(const std::vector<std::string>& names,
                                                   std::string_view geometry);

/// The geometry with this name. Throws Error(kBadInput), which lists the names, if there is none.
const Geometry& find_geometry(std::string_view name);

}  // namespace viscontact::freefem_axi
