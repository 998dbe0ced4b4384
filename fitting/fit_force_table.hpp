// The fit of a force table: the coefficients in F(q) = sum of coefficient * term(q), with the force
// F at the gap q, by linear least squares (docs/physics.md (3.2)). Lengths, masses and times are in
// the units of the table. A table and settings that determine no fit throw Error(kBadInput) or
// Error(kNotConverged). A poor fit throws nothing, but its diagnostics have warnings. Used by
// pipeline/ (commands `fit` and `run`), motions/fit/fit_pair.cpp (one fit for each resistance of a
// pair), case_file/, examples/ and the Python module. A change must keep that units and order of
// the rows change the fit by rounding only.
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
  /// The terms (functions of the gap) that the fit combines, at least one (asserted).
  lubrication::Basis basis = lubrication::default_basis();
  /// kRelative minimises the residuals (fit - force)/force, kAbsolute the residuals fit - force.
  lubrication::Weights weights = lubrication::Weights::kRelative;
  /// kSquared is plain least squares; with kHuber and kCauchy large residuals count less.
  lubrication::Loss loss = lubrication::Loss::kSquared;
  /// True: the coefficient of 1/q is not fitted. Its value is `leading_value`, or else -k u0 with
  /// the k that the table states (TableHead::leading_coefficient).
  bool fix_leading = false;
  /// The fixed coefficient of 1/q in the force at the velocity u0 of the table's first row
  /// [M L^2/T^2]; in theory -k u0 if the resistance is k/q near contact. Without `fix_leading` it
  /// has no effect.
  std::optional<double> leading_value{};
  /// Empty, or for each row of the table, in its order, a force > 0 [M L/T^2], by which its
  /// residual is divided in place of the force of the row.
  std::vector<double> row_scales{};
  /// What the fitted resistance must be according to theory: kDrag, positive and decreasing with
  /// the gap; kPositive, positive; kAny, anything. Diagnostics warn of another result.
  lubrication::FittedShape shape = lubrication::FittedShape::kDrag;
};

/// Fits a table with at least one row (not checked). A force F at the velocity u counts as F u0/u
/// at the velocity u0 of the first row, because Stokes flow is linear in the velocity. All members
/// of the fit are set except table_sha256 and versions. Throws Error(kBadInput) if the table has
/// fewer different gaps than coefficients to fit or than two, if `row_scales` is not as its comment
/// says, if F/u of two rows of equal gap differs by more than the sum of their error estimates
/// (unless both are 0: not known), if `fix_leading` is true but the basis has no other term, lacks
/// 1/q, or there is no value for its coefficient, or if double precision cannot hold the result;
/// Error(kNotConverged) if the terms are linearly dependent on these gaps or the robust loss does
/// not converge; Error(kInterrupted) if `stop` requests a stop during a robust fit.
lubrication::Fit fit_force_table(const lubrication::MotionTable& table, const FitSettings& settings,
                                 const StopToken& stop = {});

/// The same with the basis of this name, these weights, and otherwise default settings. Throws also
/// Error(kBadInput) for an unknown name.
lubrication::Fit fit_force_table(const lubrication::MotionTable& table, std::string_view basis,
                                 lubrication::Weights weights);

}  // namespace viscontact::fitting
