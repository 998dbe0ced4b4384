// How far a fit can be trusted: what its residuals show when they are compared with the error
// estimates of the table. Lengths and times are in the units of the table. Relative residuals, fit
// over table minus 1, have no dimension. fitting/fit_force_table.cpp computes the diagnostics; the
// keys of a fit file are those of docs/fit.schema.json.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viscontact::lubrication {

/// The cause of the residuals.
enum class Misfit {
  /// The basis: the residuals are larger than the error estimates explain, by chi-squared and in at
  /// least one row, so that another basis can fit better.
  kBasis,
  /// The data: the error estimates explain the residuals, so only a better table can reduce them.
  kData,
  /// Not known: a row of the table has no error estimate, or no degrees of freedom are left.
  kUnknown
};

/// "basis", "data" or "unknown".
std::string_view to_string(Misfit misfit);

/// The inverse of to_string(). Throws Error(kBadInput) for another word.
Misfit parse_misfit(std::string_view word);

/// A row that a robust loss sets aside.
struct Outlier {
  double gap = 0;                 ///< [L]
  double reference_velocity = 0;  ///< [L/T]
  double relative_residual = 0;   ///< fit / table - 1
};

/// A row, compared with the prediction of a fit to all other rows.
struct LeftOutRow {
  double gap = 0;                ///< [L]
  double relative_residual = 0;  ///< |prediction / table - 1|, >= 0
};

/// The row with the largest ratio of the residual to the error estimate of the same row.
struct WorstToEstimate {
  double gap = 0;                ///< [L]
  double relative_residual = 0;  ///< fit / table - 1
  double ratio = 0;              ///< |relative_residual| / error estimate of this row, >= 0
};

/// Diagnostics of a fit. Relative residuals are fit/table - 1. Every row counts as a separate
/// measurement. Rows of one gap at several velocities are therefore counted several times, although
/// a linear solver makes them equal; standard errors and leave-one-out residuals are then too
/// small.
struct FitDiagnostics {
  /// Number of rows of the table, outliers included.
  std::size_t rows = 0;
  /// Number of rows that the table lacks because they could not be computed.
  std::size_t failed_rows = 0;
  /// Number of coefficients that were fitted, not fixed.
  std::size_t free_coefficients = 0;
  /// Gap [L] of the row with the largest relative residual.
  double worst_gap = 0;
  /// The relative residual at worst_gap, with its sign.
  double worst_relative_residual = 0;
  /// Largest relative error estimate of the table's rows; 0 if the table has none.
  double largest_error_estimate = 0;
  /// Largest |relative residual| of the rows that are not outliers.
  double largest_inlier_residual = 0;
  /// Root mean square and largest size of the relative residuals that each row has in the fit of
  /// the other rows, r_i/(1 - h_i) with the residual r_i and the leverage h_i of row i (PRESS,
  /// Allen 1974). Nothing if the coefficients cannot be determined without one of the rows.
  std::optional<double> leave_one_out_rms{},  ///< the root mean square, >= 0
      leave_one_out_largest{};                ///< the largest size, >= 0
  /// Gap [L] of the row with the residual leave_one_out_largest.
  std::optional<double> leave_one_out_gap{};
  /// The inner row and the end row with the largest of these residuals. The fit of the other rows
  /// interpolates to an inner row and extrapolates to an end row, which is alone at the smallest or
  /// largest gap. Only the inner row shows how large the error of the formula may be between the
  /// rows. Nothing if leave_one_out_rms is nothing, or if the table has no such row.
  std::optional<LeftOutRow> left_out_inner{},  ///< the inner row
      left_out_end{};                          ///< the end row
  /// Number of rows, without outliers, whose |residual| is larger than their own error estimate.
  std::size_t rows_beyond_estimate = 0;
  /// The row with the largest ratio among those that are not outliers. Nothing if none of them has
  /// an error estimate, or if an earlier version of Viscontact wrote the file.
  std::optional<WorstToEstimate> worst_to_estimate{};
  /// Sum of (relative residual/error estimate)^2 over the rows; nothing if a row has no estimate.
  std::optional<double> chi_squared{};
  std::size_t degrees_of_freedom = 0;  ///< rows - free coefficients
  /// kBasis if chi-squared of the rows that are not outliers is beyond the 99 % quantile of its
  /// distribution and rows_beyond_estimate > 0.
  Misfit misfit = Misfit::kUnknown;
  /// Akaike's information criterion with the correction for small samples (Hurvich & Tsai 1989),
  ///     n ln(sum of squares/n) + 2 K + 2 K (K + 1)/(n - K - 1),   K = free coefficients + 1,
  /// with the number n of rows. A smaller value is better. Only fits of the same rows with the same
  /// weights can be compared.
  /// Nothing if n <= K + 1, if all residuals are 0, or for a robust loss, because then the weights
  /// of the rows depend on the fit.
  std::optional<double> information_criterion{};
  /// Rows with residuals beyond 5 times the scale of the others; only a robust loss has outliers.
  std::vector<Outlier> outliers;
  std::vector<std::string> warnings;  ///< sentences for the user
};

}  // namespace viscontact::lubrication
