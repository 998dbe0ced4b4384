// Fits of the lubrication force on a sphere, F_lub(q, u0) = sum of coefficient * term(q)
// (docs/physics.md (3.2)), and their files.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/lubrication/second_wall.hpp"

namespace viscontact {

class JsonFields;
}

namespace viscontact::lubrication {

/// The cause of the residuals.
enum class Misfit {
  /// The basis is the cause: the residuals are larger than the error estimates of the rows explain,
  /// both in the sum of squares (chi-squared) and in at least one row.
  kBasis,
  /// The data are the cause: the error estimates explain the residuals.
  kData,
  /// A row of the table has no error estimate, or no degrees of freedom are left.
  kUnknown
};

/// The word in fit files: "basis", "data" or "unknown".
std::string_view to_string(Misfit misfit);

/// Inverse of to_string(Misfit). Throws Error(kBadInput) for another word.
Misfit parse_misfit(std::string_view word);

/// A row of the table of forces that a fit with a robust loss (kHuber or kCauchy) does not follow:
/// its residual is more than 5 times the scale of all residuals (Loss).
struct Outlier {
  double gap = 0;                 ///< [L], > 0
  double reference_velocity = 0;  ///< [L/T], not 0
  double relative_residual = 0;   ///< fit / table - 1
};

/// A row of the table of forces, compared with the prediction of the fit of all other rows.
struct LeftOutRow {
  double gap = 0;                ///< [L], > 0
  double relative_residual = 0;  ///< |prediction / table - 1|, >= 0
};

/// The row of the table of forces with the largest ratio of its residual to its own error estimate.
struct WorstToEstimate {
  double gap = 0;                ///< [L], > 0
  double relative_residual = 0;  ///< fit / table - 1, any sign
  double ratio = 0;              ///< |relative_residual| / error estimate of this row, >= 0
};

/// Diagnostics of a fit. Relative residuals are fit/table - 1 [1]. All rows of one gap count as one
/// measurement in degrees of freedom, standard errors, chi-squared and the information criterion,
/// because their F/u agree: Stokes flow is linear in the velocity.
struct FitDiagnostics {
  /// The number of rows, outliers included.
  std::size_t rows = 0;
  /// Rows that the table lacks because they could not be computed.
  std::size_t failed_rows = 0;
  /// Fixed coefficients do not count.
  std::size_t free_coefficients = 0;
  /// Gap [L] of the row with the largest |relative residual|.
  double worst_gap = 0;
  /// The residual of this row, with its sign.
  double worst_relative_residual = 0;
  /// The largest error estimate of all rows, relative; 0 if the table has none.
  double largest_error_estimate = 0;
  /// Largest |relative residual| of the rows that are not outliers.
  double largest_inlier_residual = 0;
  /// The leave-one-out residual of a row is its relative residual in the fit of the other rows,
  /// r_i/(1 - h_i) with the residual r_i and the leverage h_i of row i (PRESS, Allen 1974). Nothing
  /// if the coefficients cannot be determined without one of the rows. These residuals are too
  /// small where a table has rows of one gap at several velocities.
  std::optional<double> leave_one_out_rms{},  ///< root mean square
      leave_one_out_largest{};                ///< largest magnitude
  /// Gap [L] of the row with the residual leave_one_out_largest.
  std::optional<double> leave_one_out_gap{};
  /// The inner row and the end row with the largest leave-one-out residuals. An end row is the only
  /// row at the smallest or at the largest gap, so that the fit of the other rows extrapolates to
  /// it. All other rows are inner rows, to which the fit of the others interpolates. The inner row
  /// shows how large the error of the formula may be between rows. Nothing if leave_one_out_rms is
  /// nothing, or if the table has no such row.
  std::optional<LeftOutRow> left_out_inner{}, left_out_end{};
  /// Rows, without outliers, whose |relative residual| is larger than their own error estimate.
  std::size_t rows_beyond_estimate = 0;
  /// Outliers do not count. Nothing without error estimates.
  std::optional<WorstToEstimate> worst_to_estimate{};
  /// The sum over the gaps of (relative residual/error estimate)^2 [1], of which the mean over the
  /// rows at a gap counts. Nothing if a row has no error estimate.
  std::optional<double> chi_squared{};
  std::size_t degrees_of_freedom = 0;  ///< number of different gaps - free_coefficients
  /// It is kBasis if chi-squared of the rows that are not outliers is beyond the 99 % quantile of
  /// its distribution and rows_beyond_estimate > 0.
  Misfit misfit = Misfit::kUnknown;
  /// Akaike's information criterion with the correction for small samples (Hurvich & Tsai 1989),
  ///     n ln(sum of squares/n) + 2 K + 2 K (K + 1)/(n - K - 1),   K = free coefficients + 1,
  /// with the number n of different gaps and the residuals that the fit makes small (Fit::weights).
  /// A smaller value is better. Only fits of the same rows with the same weights can be compared.
  /// Nothing if n <= K + 1, if all residuals are 0, or for a robust loss.
  std::optional<double> information_criterion{};
  /// Rows whose |residual| is more than 5 times the scale of all residuals; none with kSquared.
  std::vector<Outlier> outliers;
  std::vector<std::string> warnings;  ///< sentences for the user
};

/// The residuals that the fit makes small. With kRelative they are fit/force - 1 [1], with
/// kAbsolute fit - force [M L/T^2].
enum class Weights { kRelative, kAbsolute };

/// The word in fit files: "relative" or "absolute".
std::string_view to_string(Weights weights);

/// Inverse of to_string(Weights). Throws Error(kBadInput) for another word.
Weights parse_weights(std::string_view word);

/// What a row adds to the sum that the fit minimises. z is the residual of the row, divided by the
/// scale of all residuals (RobustSolution::scale), which estimates their standard deviation from
/// their median, so that outliers hardly change it:
///   kSquared  z^2/2
///   kHuber    z^2/2, and linear in |z| for |z| > 1.345 (Huber 1964)
///   kCauchy   (c^2/2) ln(1 + (z/c)^2), c = 2.385
/// With the constants 1.345 and 2.385, which robust_least_squares.cpp repeats, the efficiency on
/// Gaussian residuals is 95 % of that of least squares (Holland & Welsch 1977).
enum class Loss { kSquared, kHuber, kCauchy };

/// The word in fit files: "none" for kSquared, "huber" or "cauchy".
std::string_view to_string(Loss loss);

/// Inverse of to_string(Loss). Throws Error(kBadInput) for another word.
Loss parse_loss(std::string_view word);

/// The shape that a fitted resistance must have, according to theory, at all gaps of the interval.
/// With kDrag it is positive and falls with the gap, with kPositive it is positive, and with kAny
/// it has any values. The fit of another shape gets a warning.
enum class FittedShape { kDrag, kPositive, kAny };

struct FitTerm {
  std::string name;        ///< name of a Term (terms.hpp)
  double coefficient = 0;  ///< in the unit of force [M L/T^2] over that of the term
  /// The unit is that of the coefficient. Its formula treats the residuals as independent random
  /// noise, which residuals of kBasis are not.
  double standard_error = 0;
  /// The coefficient was given and not fitted; its standard error is 0.
  bool is_fixed = false;
};

/// A fit for the gaps q in gap_interval, in the units of the table of forces to which it was
/// fitted. read_fit() checks the ranges of the members, but not that leading_coefficient is > 0.
struct Fit {
  /// Name of a Basis, kOwnTerms for a user's list of terms, or kExactPlane.
  std::string basis;
  double reference_velocity = 0;            ///< u0 [L/T], not 0
  double viscosity = 0;                     ///< mu [M/(L T)], > 0
  double radius = 0;                        ///< r [L], > 0
  std::array<double, 2> gap_interval = {};  ///< [L], 0 < first < second
  Weights weights = Weights::kRelative;
  Loss loss = Loss::kSquared;
  /// There is at least one, each only once; there are none if the basis is kExactPlane.
  std::vector<FitTerm> terms;
  /// Largest |fit/force - 1| of all rows, outliers included.
  double largest_relative_residual = 0;
  /// Root mean square of fit/force - 1 over the rows.
  double rms_relative_residual = 0;
  /// The matrix is that of the scaled, weighted columns; >= 1.
  double condition_number = 1;
  /// The covariance of the coefficients, in the order of `terms`; entry (i, j) has the dimension of
  /// coefficient i times coefficient j. Empty if there are no terms.
  std::vector<std::vector<double>> covariance;
  /// What the sphere approaches, in the words of the table; may be empty.
  std::string geometry;
  /// The walls around the fluid, in the words of the table; may be empty.
  std::string container;
  /// Coefficient k of 1/q in the resistance -F_lub/u0 by lubrication theory [M L/T], > 0. Nothing
  /// if the table did not state it.
  std::optional<double> leading_coefficient{};
  std::optional<FitDiagnostics> diagnostics{};  ///< nothing in a fit that was written by hand
  std::string table_sha256;                     ///< of the table file; may be empty
  std::map<std::string, std::string> versions;  ///< program name to version
};

/// The name in place of a basis for the exact drag of a sphere near a plane in a half-space
/// (plane_drag.hpp). A fit with this name has no terms.
inline constexpr std::string_view kExactPlane = "exact_plane";

/// The fit for kExactPlane. `viscosity` [M/(L T)] and `radius` [L] must be > 0. The gap_interval
/// and the reference velocity have no meaning.
Fit exact_plane_fit(double viscosity, double radius);

/// The wall opposite the neighbour that the fit's words for geometry and container name; nothing if
/// there is none, or if a fitted gap is not below its largest gap.
std::optional<SecondWall> second_wall_of(const Fit& fit);

/// The gap [L] at which Gamma, the primitive of the resistance, is 0: the radius, or half of the
/// largest gap if there is a second wall at a gap that is not greater than the radius.
double zero_of_impulse(const Fit& fit);

bool is_exact_plane(const Fit& fit);

/// The fit for a fluid of another viscosity [M/(L T)]. The force is proportional to the viscosity,
/// so that all coefficients and their errors are multiplied by the ratio of the viscosities.
Fit with_viscosity(Fit fit, double viscosity);

/// Reads or writes the keys of a fit file, which docs/fit.schema.json lists. Reading throws
/// Error(kBadInput) for a key that is missing, unknown or has a wrong value.
void fields_of(JsonFields& json, Fit& fit);

/// Reads a fit file. Throws the error of fields_of(), with the line and what is allowed, and
/// Error(kBadInput) if the file cannot be read.
Fit read_fit(const std::filesystem::path& path);

/// Reads the text of a fit file and throws as read_fit(). Messages call it `file`.
Fit parse_fit(const std::string& text, const std::string& file);

/// The text of the fit file (JSON), without the key `provenance`.
std::string write_fit(const Fit& fit);

/// `count` >= 2 gaps [L] in geometric progression on `interval`, 0 < first < second, at which fits
/// are checked and exported. The first and the last gap are exactly the ends of `interval`. The
/// help of the command `export` and docs/file-formats.md also state the default of 201.
std::vector<double> spread_gaps(const std::array<double, 2>& interval, int count = 201);

}  // namespace viscontact::lubrication
