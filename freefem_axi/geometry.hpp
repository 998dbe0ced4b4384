// The kinds of bodies beside a sphere, its neighbours, for which FreeFEM computes the force on the
// sphere. A new one needs a FreeFEM script and a row in geometry.cpp (docs/extending.md).
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

/// A number that describes a neighbour: a length [L], or a ratio without dimension.
struct GeometryParameter {
  std::string_view key;   ///< its key in the table `geometry` of a case file, such as "radius"
  std::string_view flag;  ///< the script's argument, as "-neighbourRadius"
  Allowed allowed;        ///< the values that are accepted
  /// The value for a case without this key; nothing means that the key is required.
  std::optional<double> fallback;
  /// True: the head of a table names the parameter only if it differs from the fallback.
  bool is_named_if_given = false;
};

/// The space that a sphere at one gap and its neighbour need [L].
struct RequiredSpace {
  double container_radius = 0;  ///< >= 0; the container's radius must be larger
  double container_height = 0;  ///< >= 0; the container's height must be larger
  /// Largest gap that is allowed; <= 0 if the sphere has no room.
  double largest_gap = std::numeric_limits<double>::infinity();
};

/// The motions of a geometry that lists none in geometry.cpp.
inline constexpr std::array kApproachAlone = {lubrication::MotionKind::kApproach};

/// A kind of neighbour, and what the computation of its tables needs. The functions take the values
/// of `parameters`, all of them and in this order. q is the gap, r the radius of the sphere, mu the
/// viscosity, R the resistance (minus the force over the velocity).
struct Geometry {
  /// The name, which is the key `kind` of `geometry` in the case file.
  std::string_view name;
  /// File of the FreeFEM script in freefem_axi/scripts/, which docs/extending.md describes.
  std::string_view script;
  std::span<const GeometryParameter> parameters;  ///< numbers that describe the neighbour
  /// True if the fluid is unbounded or in a container; false if the neighbour encloses the fluid.
  bool takes_container;
  /// The ratio [1] of the neighbour's velocity (approach, slide) or angular velocity (roll, spin)
  /// to that of the sphere. Null: the neighbour is always at rest.
  double (*neighbour_ratio)(lubrication::MotionKind motion, std::span<const double> parameters);
  /// The ratio [1] of k in R = k/q + ... near contact, by lubrication theory, to the k of a plane,
  /// 6 pi mu r^2. It depends on curvature and velocity of the neighbour, and is <= 0 if the
  /// neighbour moves away at least as fast as the sphere follows. Null: not known.
  double (*leading_factor)(double radius, std::span<const double> parameters);
  /// At this gap.
  RequiredSpace (*required_space)(double radius, double gap, std::span<const double> parameters);
  /// Whether lubrication/plane_drag.hpp has the drag of this geometry in unbounded fluid.
  bool has_exact_drag = false;
  /// Computing time of a row over that of a row above a plane; only for estimates of time.
  double relative_cost = 1;
  /// The motions of the sphere that can be tabulated, in the order of MotionKind. The FreeFEM
  /// function that solves a motion must impose the neighbour's boundary condition: solveStokes
  /// (approach), solveSwirl (spin) or solveSideways (slide, roll) in scripts/. With strains all of
  /// them must, and solveTwofold; a neighbour that is no sphere is at rest.
  std::span<const lubrication::MotionKind> motions = kApproachAlone;
  /// 1 over the neighbour's radius [1/L]: 0 for a plane, < 0 for a cavity. Null: not known, and so
  /// are the leading coefficients of slide, roll and spin (lubrication/near_contact.hpp).
  double (*curvature)(std::span<const double> parameters) = nullptr;
  /// True: the tangential stress on the neighbour is 0. False: the fluid does not slip on it.
  bool is_shear_free = false;
};

/// All geometries, at least one.
std::span<const Geometry> all_geometries();

/// The geometries whose member has_exact_drag is true.
std::vector<Geometry> geometries_with_exact_drag();

/// The geometry of a case that names none: the plane.
const Geometry& default_geometry();

/// Whether it is one of geometry.motions.
bool has_motion(const Geometry& geometry, lubrication::MotionKind motion);

/// The motions with these names, in the order of MotionKind; the one name "all" stands for all
/// motions of the geometry with the name `geometry`. Throws Error(kBadInput) for an unknown name,
/// for a name that stands twice, for a motion that the geometry lacks, and for an unknown geometry.
std::vector<lubrication::MotionKind> parse_motions(const std::vector<std::string>& names,
                                                   std::string_view geometry);

/// The geometry with this name. Throws Error(kBadInput), which lists the names, if there is none.
const Geometry& find_geometry(std::string_view name);

}  // namespace viscontact::freefem_axi
