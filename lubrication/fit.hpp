// A fit of the lubrication force F_lub(q, u0) = sum of coefficient * term(q), with functions of the
// gap q (terms.hpp) at one velocity u0 of the sphere (docs/physics.md (3.2)): its coefficients, its
// interval of gaps, and its diagnostics, which say how far it can be trusted. Lengths, masses and
// times are in the units of the table of forces. Relative residuals, fit over table minus 1, have
// no dimension. fitting/ makes fits; lubrication_force.hpp, motions/, case_file/, results/,
// reduced_model/ and sweep/ use them. A wrong file or word throws Error(kBadInput). The members of
// a Fit that did not come from a file are not checked here. A change must agree with
// docs/fit.schema.json.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viscontact {

class JsonFields;
}

namespace viscontact::lubrication {

/// The cause of the residuals.
enum class Misfit {
  /// The basis: the residuals are larger than the error estimates of the rows explain, both in the
  /// sum of squares (chi-squared) and in at least one row. Another basis can fit better.
  kBasis,
  /// The data: the error estimates explain the residuals. Only a better table can reduce them.
  kData,
  /// Not known: a row of the table has no error estimate, or no degrees of freedom are left.
  kUnknown
};

/// The word for the cause in fit files: "basis", "data" or "unknown". Throws nothing.
std::string_view to_string(Misfit misfit);

/// The inverse of to_string(). Throws Error(kBadInput) for another word.
Misfit parse_misfit(std::string_view word);

/// A row with a residual so large that a robust loss reduces its weight (FitDiagnostics::outliers).
struct Outlier {
  double gap = 0;                 ///< [L], > 0
  double reference_velocity = 0;  ///< [L/T], not 0
  double relative_residual = 0;   ///< fit / table - 1, any sign
};

/// A row, compared with the prediction of the fit of all other rows.
struct LeftOutRow {
  double gap = 0;                ///< [L], > 0
  double relative_residual = 0;  ///< |prediction / table - 1|, >= 0
};

/// The row with the largest ratio of the residual to the error estimate of the same row.
struct WorstToEstimate {
  double gap = 0;                ///< [L], > 0
  double relative_residual = 0;  ///< fit / table - 1, any sign
  double ratio = 0;              ///< |relative_residual| / error estimate of this row, >= 0
};

/// Diagnostics of a fit. Relative residuals are fit/table - 1. Every row counts as an independent
/// measurement. If a table has rows of one gap at several velocities, whose F/u agree because
/// Stokes flow is linear, standard errors and leave-one-out residuals are therefore too small.
struct FitDiagnostics {
  /// Number of rows of the table, outliers included.
  std::size_t rows = 0;
  /// Number of rows that the table lacks because they could not be computed.
  std::size_t failed_rows = 0;
  /// Number of fitted coefficients; a fixed coefficient does not count.
  std::size_t free_coefficients = 0;
  /// Gap [L] > 0 of the row with the largest |relative residual|.
  double worst_gap = 0;
  /// The relative residual at worst_gap, with its sign.
  double worst_relative_residual = 0;
  /// Largest relative error estimate of the table's rows, >= 0; 0 if the table has none.
  double largest_error_estimate = 0;
  /// Largest |relative residual| of the rows that are not outliers, >= 0.
  double largest_inlier_residual = 0;
  /// Root mean square and largest size of the relative residuals that each row has in the fit of
  /// the other rows, r_i/(1 - h_i) with the residual r_i and the leverage h_i of row i (PRESS,
  /// Allen 1974). Nothing if the coefficients cannot be determined without one of the rows.
  std::optional<double> leave_one_out_rms{},  ///< the root mean square, >= 0
      leave_one_out_largest{};                ///< the largest size, >= 0
  /// Gap [L] of the row with the residual leave_one_out_largest; nothing if this residual is
  /// nothing.
  std::optional<double> leave_one_out_gap{};
  /// The inner row and the end row with the largest of these residuals. An end row is the only row
  /// at the smallest or largest gap, to which the fit of the other rows extrapolates; to all other,
  /// inner rows it interpolates. The inner row shows how large the error of the formula may be
  /// between rows. Nothing if leave_one_out_rms is nothing, or if the table has no such row.
  std::optional<LeftOutRow> left_out_inner{},  ///< the inner row
      left_out_end{};                          ///< the end row
  /// Number of rows, without outliers, whose |residual| is larger than their own error estimate; 0
  /// also in fit files of earlier versions, which lack it.
  std::size_t rows_beyond_estimate = 0;
  /// The row with the largest ratio among the rows that are not outliers. Nothing if none of them
  /// has an error estimate, or in fit files of earlier versions, which lack it.
  std::optional<WorstToEstimate> worst_to_estimate{};
  /// Sum of (relative residual/error estimate)^2 over the rows; nothing if a row has no estimate.
  std::optional<double> chi_squared{};
  std::size_t degrees_of_freedom = 0;  ///< rows - free coefficients
  /// kBasis if chi-squared of the rows that are not outliers is beyond the 99 % quantile of its
  /// distribution and rows_beyond_estimate > 0.
  Misfit misfit = Misfit::kUnknown;
  /// Akaike's information criterion with the correction for small samples (Hurvich & Tsai 1989),
  ///     n ln(sum of squares/n) + 2 K + 2 K (K + 1)/(n - K - 1),   K = free coefficients + 1,
  /// with the number n of rows and the residuals that the fit makes small (Fit::weights). A smaller
  /// value is better. Only fits of the same rows with the same weights can be compared. Nothing if
  /// n <= K + 1, if all residuals are 0, or for a robust loss, whose weights depend on the fit.
  std::optional<double> information_criterion{};
  /// Rows with |residual| > 5 times the scale of all residuals; only a robust loss has outliers.
  std::vector<Outlier> outliers;
  std::vector<std::string> warnings;  ///< sentences for the user
};

/// The residuals that the fit makes small: kRelative, fit/force - 1; kAbsolute, fit - force.
enum class Weights { kRelative, kAbsolute };

/// The word for the weights in fit files: "relative" or "absolute".
std::string_view to_string(Weights weights);

/// Translates "relative" or "absolute". Throws Error(kBadInput) for another word.
Weights parse_weights(std::string_view word);

/// What a row adds to the sum that the fit minimises. z is the residual of the row, divided by the
/// scale of all residuals:
///   kSquared  z^2/2
///   kHuber    z^2/2, and linear in |z| for |z| > 1.345 (Huber 1964)
///   kCauchy   (c^2/2) ln(1 + (z/c)^2), c = 2.385
/// With the constants 1.345 and 2.385, which robust_least_squares.cpp repeats, the efficiency on
/// Gaussian residuals is 95 % of that of least squares (Holland & Welsch 1977).
enum class Loss { kSquared, kHuber, kCauchy };

/// The word for the loss in fit files: "none", "huber" or "cauchy".
std::string_view to_string(Loss loss);

/// The inverse of to_string(). Throws Error(kBadInput) for another word.
Loss parse_loss(std::string_view word);

/// What a fitted resistance must be, according to theory, at all gaps of the interval: kDrag,
/// positive and falling with the gap; kPositive, positive; kAny, anything.
enum class FittedShape { kDrag, kPositive, kAny };

/// One term of a fit with its coefficient.
struct FitTerm {
  std::string name;        ///< name of a Term (terms.hpp); read_fit() refuses other names
  double coefficient = 0;  ///< in units of a force [M L/T^2] over that of the term
  /// Standard error of the coefficient, in the same unit, >= 0. Its formula treats the residuals as
  /// independent random noise, which the misfit of a basis is not.
  double standard_error = 0;
  /// True for a fixed coefficient: it was given and not fitted, and its standard error is 0.
  bool is_fixed = false;
};

/// F_lub(q, u0) = sum of coefficient * term(q) for q in gap_interval.
struct Fit {
  /// Name of a Basis, kOwnTerms for a user's list of terms, or kExactPlane.
  std::string basis;
  double reference_velocity = 0;            ///< u0 [L/T], not 0
  double viscosity = 0;                     ///< mu [M/(L T)], > 0
  double radius = 0;                        ///< r [L], > 0
  std::array<double, 2> gap_interval = {};  ///< [L], 0 < first < second
  /// The residuals that the least squares minimised.
  Weights weights = Weights::kRelative;
  /// The loss function of these residuals.
  Loss loss = Loss::kSquared;
  /// The terms with their coefficients, at least one.
  std::vector<FitTerm> terms;
  /// Largest |fit/force - 1| of all rows, outliers included, >= 0.
  double largest_relative_residual = 0;
  /// Root mean square of fit/force - 1 over the rows, >= 0.
  double rms_relative_residual = 0;
  /// Condition number of the matrix of the scaled, weighted columns, >= 1.
  double condition_number = 1;
  /// Covariance matrix of the coefficients, in the order of `terms`; entry (i, j) has the dimension
  /// of coefficient i times coefficient j. Empty if the file has none.
  std::vector<std::vector<double>> covariance;
  /// What the sphere approaches, in the words of the table; may be empty.
  std::string geometry;
  /// The walls around the fluid, in the words of the table; may be empty.
  std::string container;
  /// Coefficient k of 1/q in the resistance -F_lub/u0 by lubrication theory [M L/T], > 0, if the
  /// table states it.
  std::optional<double> leading_coefficient{};
  std::optional<FitDiagnostics> diagnostics{};  ///< nothing in a fit that was written by hand
  std::string table_sha256;                     ///< SHA-256 of the table file; may be empty
  std::map<std::string, std::string> versions;  ///< program name to version
};

/// The name that stands in place of a basis for the exact drag of a sphere near a plane in a
/// half-space (plane_drag.hpp). A fit with this name has no terms, and a force at every gap > 0.
inline constexpr std::string_view kExactPlane = "exact_plane";

/// A fit without terms and residuals that stands for the exact drag of a plane. Its gap_interval
/// has no meaning. `viscosity` [M/(L T)] > 0, `radius` [L] > 0 (not checked).
Fit exact_plane_fit(double viscosity, double radius);

/// True if `fit` stands for the exact drag of a plane.
bool is_exact_plane(const Fit& fit);

/// The fit for a fluid of another viscosity [M/(L T)] > 0 (not checked). The force is proportional
/// to the viscosity, so all coefficients are multiplied by the same factor.
Fit with_viscosity(Fit fit, double viscosity);

/// Reads or writes the keys of a fit file (common/text/json_fields.hpp). Reading throws the errors
/// of read_fit().
void fields_of(JsonFields& json, Fit& fit);

/// Reads a fit file and checks it against docs/fit.schema.json. Throws Error(kBadInput) with the
/// line, the key and what is allowed, or if the file cannot be read.
Fit read_fit(const std::filesystem::path& path);

/// As read_fit(), for the text of a fit file. `file` is its name in messages.
Fit parse_fit(const std::string& text, const std::string& file);

/// The text of the fit file (JSON), without provenance.
std::string write_fit(const Fit& fit);

/// `count` >= 2 gaps [L] in geometric progression on `interval`, 0 < first < second, at which fits
/// are checked and exported. The first and the last gap are exactly its ends. Neither `count` nor
/// `interval` is checked. The default of 201 points is also stated in the help of `export` and in
/// docs/file-formats.md.
std::vector<double> spread_gaps(const std::array<double, 2>& interval, int count = 201);

}  // namespace viscontact::lubrication
