// The fit of a force table: linear least squares for the coefficients of a basis.
#pragma once

#include <optional>
#include <string_view>

#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/force_table.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact {

/// How a table is fitted.
struct FitSettings {
  Basis basis = find_basis("lecture");
  Weights weights = Weights::kRelative;
  Loss loss = Loss::kSquared;
  /// True: the coefficient of 1/q is not fitted but held at `leading_value`, or at what theory says (ForceTable::leading_coefficient).
  bool hold_leading = false;
  std::optional<double>
      leading_value{};  ///< of the force at the table's first velocity, as in the fit file [M L^2/T^2]
};

/// Fits a table. Rows of other velocities than the first row's count as F (u0 / u): Stokes
/// flow is linear. table_sha256 and versions are left to the caller.
/// Throws Error(kBadInput) for fewer different gaps than free coefficients or than two, rows of equal gap whose F/u
/// differ by more than their error estimates, or a leading coefficient to hold that the basis or the table has not;
/// Error(kNotConverged) from the least squares.
Fit fit_force_table(const ForceTable& table, const FitSettings& settings);

/// The same with a basis by name, every row counted. Throws Error(kBadInput) for an unknown basis too.
Fit fit_force_table(const ForceTable& table, std::string_view basis, Weights weights);

}  // namespace viscontact
