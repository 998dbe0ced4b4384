// Judges a fit by its residuals, beside the error estimates of the table's rows.
#pragma once

#include <Eigen/Core>

#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/force_table.hpp"

namespace viscontact {

/// The least squares behind a fit: rows as in the table, one column a free coefficient.
struct FittedSystem {
  Eigen::MatrixXd weighted_matrix;  ///< weight * term(gap), and times the root of the loss's weight
  Eigen::VectorXd weighted_residual;  ///< likewise, fit - table
  Eigen::VectorXd relative_residual;
  Eigen::VectorXd scaled_residual;  ///< residual as the loss sees it: over the scale of all
};

/// Judges a fit whose other members are complete.
FitDiagnostics diagnose(const ForceTable& table, const FittedSystem& system, const Fit& fit);

}  // namespace viscontact
