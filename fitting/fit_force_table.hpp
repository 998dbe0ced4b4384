// The fit of a force table (physics.md (3.2)): linear least squares for the coefficients of a
// basis. Units are those of the table.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/lubrication/fit/fit.hpp"
#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::fitting {

/// The choices of a fit.
struct FitSettings {
  /// The terms that are combined, at least one.
  lubrication::Basis basis = lubrication::default_basis();
  /// How strongly the residual of each row counts.
  lubrication::Weights weights = lubrication::Weights::kRelative;
  /// How strongly large residuals count.
  lubrication::Loss loss = lubrication::Loss::kSquared;
  /// True: the coefficient of 1/q is fixed. Its value is `leading_value`, or else that of theory
  /// (TableHead::leading_coefficient).
  bool fix_leading = false;
  /// Fixed coefficient of 1/q in the force at the table's first velocity, as in the fit file
  /// [M L^2/T^2].
  std::optional<double> leading_value{};
  /// What the residual of each row is relative to, in place of its force, each > 0 [M L/T^2];
  /// empty: the forces.
  std::vector<double> row_scales{};
  /// What is known of the fitted resistance. A fit that is not like that gets a warning.
  lubrication::FittedShape shape = lubrication::FittedShape::kDrag;
};

/// Fits a table. The force F in a row of another velocity u than the first row's u0 counts as
/// F (u0/u), because Stokes flow is linear. The caller sets table_sha256 and versions. Throws
/// Error(kBadInput) if there are fewer different gaps than fitted coefficients or than two, if rows
/// of equal gap have values of F/u that differ by more than their error estimates, or if a
/// coefficient is to be fixed that the basis or the table does not have; and the
/// errors of solve_robust_least_squares().
lubrication::Fit fit_force_table(const lubrication::MotionTable& table, const FitSettings& settings,
                                 const StopToken& stop = {});

/// The same with a basis by name and the loss kSquared. Throws Error(kBadInput) for an unknown
/// basis, too.
lubrication::Fit fit_force_table(const lubrication::MotionTable& table, std::string_view basis,
                                 lubrication::Weights weights);

}  // namespace viscontact::fitting
