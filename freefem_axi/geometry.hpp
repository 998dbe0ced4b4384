// What the sphere approaches.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "viscontact/common/allowed.hpp"

namespace viscontact {

/// A number that says more about a neighbour: a key of the case file's `geometry` and a flag of the
/// script.
struct GeometryParameter {
  std::string_view key;
  std::string_view flag;
  Allowed allowed;
  std::optional<double> fallback;  ///< for a case that does not say; none: it must
};

/// What a sphere at some gap and its neighbour need around them [L].
struct RequiredSpace {
  double container_radius = 0;  ///< a closed cylinder must be wider than this
  double container_height = 0;  ///< and higher than this
  double largest_gap = std::numeric_limits<double>::infinity();  ///< inclusive
};

/// A kind of neighbour. One is added by writing its script and its row in geometry.cpp.
struct Geometry {
  std::string_view name;    ///< `kind` in the case file
  std::string_view script;  ///< in this folder; docs/extending.md says what it is given and answers
  std::span<const GeometryParameter> parameters;
  bool takes_container;  ///< false: it is its own
  /// True if the neighbour itself moves, so that it may pull the sphere along; null: it never does.
  bool (*moves)(std::span<const double> parameters);
  /// Theory's coefficient k of R ~ k/q near contact over that of a plane, 6 pi mu r^2: the relative curvature and velocity; null: not known.
  double (*leading_factor)(double radius, std::span<const double> parameters);
  /// For a sphere of radius r [L], a gap [L] and the parameters in the order above.
  RequiredSpace (*room)(double radius, double gap, std::span<const double> parameters);
};

/// The geometry of that name. Throws Error(kBadInput) that lists the names there are.
const Geometry& find_geometry(std::string_view name);

}  // namespace viscontact
