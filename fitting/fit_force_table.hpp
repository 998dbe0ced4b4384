// The fit of a force table (physics.md (3.2)): linear least squares for the coefficients of a
// basis. Lengths, masses and times are in the units of the table. The commands `fit` and `run` use
// it, and fit_pair.hpp for each entry of a pair. A change must keep that the fit does not depend on
// the units or on the order of the rows, but for rounding.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::fitting {

/// The choices of a fit.
struct FitSettings {
  /// The terms that are combined, at least one.
  lubrication::Basis basis = lubrication::default_basis();
  /// Whether residuals count relative to the force or absolutely.
  lubrication::Weights weights = lubrication::Weights::kRelative;
  /// Whether large residuals count less than in least squares (a robust loss).
  lubrication::Loss loss = lubrication::Loss::kSquared;
  /// True: the coefficient of 1/q is fixed. Its value is `leading_value`, or else that of theory
  /// (TableHead::leading_coefficient).
  bool fix_leading = false;
  /// Fixed coefficient of 1/q in the force at the table's first velocity u0 [M L^2/T^2], as in the
  /// fit file: -k u0 with the k of the resistance k/q. Nothing: that of theory. Without effect
  /// unless `fix_leading`.
  std::optional<double> leading_value{};
  /// For each row of the table the force > 0 [M L/T^2] to which its residual is relative; empty:
  /// the force of the row.
  std::vector<double> row_scales{};
  /// What the fitted resistance must be according to theory. A fit of another shape gets a warning.
  lubrication::FittedShape shape = lubrication::FittedShape::kDrag;
};

/// Fits a table. The force F in a row of another velocity u than the first row's u0 counts as
/// F (u0/u), because Stokes flow is linear. The caller sets table_sha256 and versions. Throws
/// Error(kBadInput) if there are fewer different gaps than fitted coefficients or than two, if rows
/// of equal gap have values of F/u that differ by more than their error estimates, or if
/// `fix_leading` is true but the basis lacks 1/q or there is no value for its coefficient; and the
/// errors of solve_robust_least_squares(). A row without error estimate (0) is allowed.
lubrication::Fit fit_force_table(const lubrication::MotionTable& table, const FitSettings& settings,
                                 const StopToken& stop = {});

/// As above with a basis by name and the loss kSquared. Throws Error(kBadInput) for an unknown
/// basis.
lubrication::Fit fit_force_table(const lubrication::MotionTable& table, std::string_view basis,
                                 lubrication::Weights weights);

}  // namespace viscontact::fitting
