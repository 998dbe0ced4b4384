// Diagnostics of a fit (docs/theory.md): its residuals, compared with the error estimates of the
// table's rows. Units are those of the table. The thresholds of the warnings are in diagnose.cpp.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "viscontact/lubrication/fit/fit.hpp"
#include "viscontact/lubrication/force_table.hpp"

namespace viscontact::fitting {

/// The least squares problem of a fit: a row for each row of the table, a column for each fitted
/// coefficient.
struct FittedSystem {
  /// Weight * term(gap), times the square root of the weight that the loss gives the row.
  Eigen::MatrixXd weighted_matrix;
  /// (Fit - table), times the same weights.
  Eigen::VectorXd weighted_residual;
  /// Fit/table - 1, or the residual over another scale (FitSettings::row_scales).
  Eigen::VectorXd relative_residual;
  /// The argument of the loss: weight * (fit - table), without the loss's own weight, divided by
  /// the scale of all residuals.
  Eigen::VectorXd scaled_residual;
  /// The coefficients with ln(q/r) in place of ln q. Their relative standard errors, unlike those of
  /// the fit, are the same in all units of length.
  std::vector<lubrication::FitTerm> fitted_terms{};
};

/// The diagnostics of a fit whose other members are complete. There is a warning if the fitted
/// function has another shape.
lubrication::FitDiagnostics diagnose(const lubrication::ForceTable& table,
                                     const FittedSystem& system, const lubrication::Fit& fit,
                                     lubrication::FittedShape shape);

}  // namespace viscontact::fitting
