// A fit of the lubrication force F_lub(q, u0): the coefficients of a basis (terms.hpp) of functions
// of the gap q at one velocity u0 (physics.md (3.2)), its interval of gaps and its diagnostics.
// Lengths, masses and times are in the units of the table. fitting/ makes fits, and every model of
// motion reads them. A change must agree with docs/fit.schema.json.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/lubrication/fit/fit_diagnostics.hpp"

namespace viscontact {
class JsonFields;
}

namespace viscontact::lubrication {

/// Which residuals the least squares minimises: kRelative, fit/force - 1; kAbsolute, fit - force.
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
/// With these constants the efficiency on Gaussian residuals is 95 % of that of least squares
/// (Holland & Welsch 1977).
enum class Loss { kSquared, kHuber, kCauchy };

/// "none", "huber" or "cauchy".
std::string_view to_string(Loss loss);

/// The inverse of to_string(). Throws Error(kBadInput) for another word.
Loss parse_loss(std::string_view word);

/// What a fitted resistance must be, according to theory, at all gaps of the interval: kDrag,
/// positive and falling with the gap; kPositive, positive; kAny, anything.
enum class FittedShape { kDrag, kPositive, kAny };

/// One term of a fit with its coefficient.
struct FitTerm {
  std::string name;        ///< name of a Term
  double coefficient = 0;  ///< [M L/T^2 over the dimension of the term]
  /// Standard error of the coefficient, in the same dimension, >= 0. Its formula treats the
  /// residuals as independent random noise, although the misfit of a basis is not random.
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
  /// The loss function that was applied to them.
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
  /// What the sphere approaches, as the table says it; may be empty.
  std::string geometry;
  /// Coefficient k of 1/q in the resistance -F_lub/u0 by lubrication theory [M L/T], > 0, if the
  /// table states it.
  std::optional<double> leading_coefficient{};
  std::optional<FitDiagnostics> diagnostics{};  ///< nothing in a fit that was written by hand
  std::string table_sha256;                     ///< checksum of the table file; may be empty
  std::map<std::string, std::string> versions;  ///< program name to version
};

/// The name that stands in place of a basis for the exact drag of a sphere near a plane in a
/// half-space (plane_drag.hpp). A fit with this name has no terms, and its force is known for every
/// gap > 0.
inline constexpr std::string_view kExactPlane = "exact_plane";

/// A fit without terms and residuals that stands for the exact drag of a plane. Its interval is the
/// range of gaps for which doubles represent the drag. `viscosity` [M/(L T)] > 0, `radius` [L] > 0.
Fit exact_plane_fit(double viscosity, double radius);

/// True if `fit` stands for the exact drag of a plane.
bool is_exact_plane(const Fit& fit);

/// The fit for a fluid of another viscosity [M/(L T)] > 0. Stokes flow is linear in the viscosity,
/// so all coefficients are multiplied by the same factor.
Fit with_viscosity(Fit fit, double viscosity);

/// The fields of a fit file (common/text/json_fields.hpp).
void fields_of(JsonFields& json, Fit& fit);

/// Reads a fit file and checks it against docs/fit.schema.json. Throws Error(kBadInput) with the
/// line, the key and what is allowed.
Fit read_fit(const std::filesystem::path& path);

/// Does the same with the text of a fit file. `file` is its name in messages.
Fit parse_fit(const std::string& text, const std::string& file);

/// The text of the fit file (JSON), without provenance.
std::string write_fit(const Fit& fit);

}  // namespace viscontact::lubrication
