// The fit of a force table: the coefficients in F(q) = sum of coefficient * term(q), by linear
// least squares (docs/physics.md (3.2)).
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::fitting {

/// The choices of a fit. The defaults are those of the command `fit`.
struct FitSettings {
  /// The terms (functions of the gap) that the fit combines, at least one.
  lubrication::Basis basis = lubrication::default_basis();
  /// kRelative minimises the residuals (fit - force)/force, kAbsolute the residuals fit - force.
  lubrication::Weights weights = lubrication::Weights::kRelative;
  /// kSquared gives plain least squares; with kHuber and kCauchy large residuals have less weight.
  lubrication::Loss loss = lubrication::Loss::kSquared;
  /// True: the coefficient of 1/q is not fitted. It has the value `leading_value` or, if this is
  /// not given, -k u0, where k [M L/T] is TableHead::leading_coefficient of the table and u0 the
  /// velocity of its first row.
  bool fix_leading = false;
  /// The fixed coefficient of 1/q in the force at the velocity u0 of the table's first row [M
  /// L^2/T^2]. In theory it is -k u0 if the resistance is k/q near contact.
  std::optional<double> leading_value{};
  /// Empty, or a force > 0 [M L/T^2] for each row of the table, in the order of the rows. The
  /// residual of a row is then divided by this force in place of the force of the row.
  std::vector<double> row_scales{};
  /// What theory says of the fitted resistance. kDrag: it is positive and decreases with the gap;
  /// kPositive: it is positive; kAny: nothing. Diagnostics warn of a fit that contradicts this.
  lubrication::FittedShape shape = lubrication::FittedShape::kDrag;
};

/// Fits a table, in its units; another system of units or another order of the rows changes the fit
/// by rounding errors only. A force F at the velocity u counts as F u0/u at the velocity u0 of the
/// first row, because Stokes flow is linear in the velocity. All members of the fit are set except
/// table_sha256 and versions; a poor fit has warnings in its diagnostics. Throws Error(kBadInput)
/// if a force is 0, the weights are relative and `row_scales` is empty; if the table has fewer
/// different gaps than coefficients to fit, or fewer than two; if `row_scales` has another number
/// of entries or an entry that is not > 0; if F/u of two rows with equal gaps differs relatively by
/// more than the sum of their error estimates, unless both estimates are 0 (not known); if
/// `fix_leading` is true but the basis lacks 1/q, has no other term, or there is no value for the
/// coefficient; or if double precision cannot hold the result. Throws Error(kNotConverged) if the
/// terms are linearly dependent on these gaps or the robust loss does not converge;
/// Error(kInterrupted) if `stop` requests a stop during a robust fit.
lubrication::Fit fit_force_table(const lubrication::MotionTable& table, const FitSettings& settings,
                                 const StopToken& stop = {});

/// Fits the table with the basis of this name, these weights, and otherwise the default settings.
/// Throws the errors of the function above, and Error(kBadInput) for an unknown name.
lubrication::Fit fit_force_table(const lubrication::MotionTable& table, std::string_view basis,
                                 lubrication::Weights weights);

}  // namespace viscontact::fitting
