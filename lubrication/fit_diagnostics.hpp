// How far a fit can be trusted: what its residuals say beside the table's own error estimates.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viscontact {

/// Whether the residuals are larger than the table's error estimates explain.
enum class Misfit {
  kBasis,   ///< chi-squared and at least one row say that they are: another basis can do better
  kData,    ///< they are not: only a better table can
  kUnknown  ///< the table has no estimates, or nothing is left over to judge by
};

/// "basis", "data", "unknown".
std::string_view to_string(Misfit misfit);

/// Throws Error(kBadInput) for another word.
Misfit parse_misfit(std::string_view word);

/// A row that a robust loss sets aside.
struct Outlier {
  double gap = 0;                 ///< [L]
  double reference_velocity = 0;  ///< [L/T]
  double relative_residual = 0;   ///< fit / table - 1
};

/// A row as the fit of all other rows predicts it.
struct LeftOutRow {
  double gap = 0;                ///< [L]
  double relative_residual = 0;  ///< |prediction / table - 1|, >= 0
};

/// The row whose residual is the largest multiple of the error estimate of the same row.
struct WorstToEstimate {
  double gap = 0;                ///< [L]
  double relative_residual = 0;  ///< fit / table - 1
  double ratio = 0;              ///< |relative_residual| / error estimate of this row, >= 0
};

/// Relative residuals are fit / table - 1. Every row counts as a measurement of its own: rows of one gap at several velocities, which a linear solver makes
/// equal, make standard errors and left-one-out residuals too small.
struct FitDiagnostics {
  std::size_t rows = 0;
  std::size_t free_coefficients = 0;
  double worst_gap = 0;                ///< where the largest relative residual is [L]
  double worst_relative_residual = 0;  ///< with its sign
  double largest_error_estimate = 0;   ///< of the table's rows; 0: it has none
  double largest_inlier_residual = 0;  ///< the largest in size of the rows that are no outliers
  /// Of each row as predicted by the fit of the others, r_i / (1 - h_i) with the leverage h_i (Allen 1974, PRESS); nothing if a
  /// row is needed to determine the coefficients.
  std::optional<double> leave_one_out_rms{}, leave_one_out_largest{};
  std::optional<double> leave_one_out_gap{};  ///< where the largest is [L]
  /// The largest of these residuals of the inner rows, to which the fit of the others interpolates,
  /// and of the end rows (each alone at the smallest or largest gap), to which it extrapolates. Only
  /// the former tells how far off the formula may be between the rows. Nothing where
  /// leave_one_out_rms is nothing, or the table has no such row.
  std::optional<LeftOutRow> left_out_inner{}, left_out_end{};
  /// Rows, without outliers, whose residual is larger in size than the row's own error estimate.
  std::size_t rows_beyond_estimate = 0;
  /// Nothing if no row that is no outlier has an error estimate, or the file is of an earlier version.
  std::optional<WorstToEstimate> worst_to_estimate{};
  /// Sum of (relative residual / error estimate)^2; nothing unless every row has an estimate.
  std::optional<double> chi_squared{};
  std::size_t degrees_of_freedom = 0;  ///< rows - free coefficients
  /// kBasis: chi-squared of the rows that are no outliers is beyond the 99 % quantile of its
  /// distribution, and rows_beyond_estimate > 0.
  Misfit misfit = Misfit::kUnknown;
  /// Akaike's criterion for small samples, n ln(sum of squares / n) + 2 K + 2 K (K + 1)/(n - K - 1), K = free coefficients + 1 (Hurvich &
  /// Tsai 1989). Less is better; only between fits of the same rows with the same weights. Nothing for n <= K + 1, no residual, or a robust loss, which weighs the rows by the fit.
  std::optional<double> information_criterion{};
  std::vector<Outlier>
      outliers;  ///< beyond 5 times the scale of the others; with a robust loss only
  std::vector<std::string> warnings;  ///< each a sentence for the user
};

}  // namespace viscontact
