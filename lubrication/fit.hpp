// A fit of the lubrication force: coefficients of a basis at one velocity, with what is needed to
// trust and to use it.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/lubrication/fit_diagnostics.hpp"

namespace viscontact {

/// What the least squares minimises: residuals over the force (`relative`) or residuals as they are
/// (`absolute`).
enum class Weights { kRelative, kAbsolute };

std::string_view to_string(Weights weights);

/// "relative" or "absolute". Throws Error(kBadInput) for another word.
Weights parse_weights(std::string_view word);

/// How a residual z (over the residuals' own scale) counts: z^2/2; Huber 1964: as |z| beyond 1.345; Cauchy:
/// (c^2/2) ln(1 + (z/c)^2) with c = 2.385. Both constants keep 95 % of least squares' efficiency on Gaussian residuals (Holland & Welsch 1977).
enum class Loss { kSquared, kHuber, kCauchy };

/// "none", "huber", "cauchy".
std::string_view to_string(Loss loss);

/// Throws Error(kBadInput) for another word.
Loss parse_loss(std::string_view word);

struct FitTerm {
  std::string name;        ///< of a Term
  double coefficient = 0;  ///< [force / dimension of the term]
  double standard_error =
      0;  ///< same dimension, >= 0; from the misfit, as if it were random noise (it is not)
  bool held = false;  ///< given, not fitted: its standard error is 0
};

/// F_lub(q, u0) = sum of coefficient * term(q) for q in gap_interval.
struct Fit {
  std::string basis;                        ///< name of a Basis; kOwnTerms: a user's own list
  double reference_velocity = 0;            ///< u0 [L/T], not 0
  double viscosity = 0;                     ///< mu [M/(L T)], > 0
  double radius = 0;                        ///< r [L], > 0
  std::array<double, 2> gap_interval = {};  ///< [L], 0 < first < second
  Weights weights = Weights::kRelative;
  Loss loss = Loss::kSquared;
  std::vector<FitTerm> terms;
  double largest_relative_residual = 0;  ///< of all rows, outliers too
  double rms_relative_residual = 0;
  double condition_number = 1;                  ///< of the scaled, weighted columns
  std::vector<std::vector<double>> covariance;  ///< of the coefficients
  std::string geometry;                         ///< the table's, in words; may be empty
  std::optional<double>
      leading_coefficient{};  ///< k of R = k/q [M L/T] in theory, if the table says it
  std::optional<FitDiagnostics> diagnostics{};  ///< none in a fit that was written by hand
  std::string table_sha256;                     ///< of the table file; may be empty
  std::map<std::string, std::string> versions;  ///< program name to version
};

/// The name of the basis that is none: the exact drag of a sphere near a plane in a half-space (plane_drag.hpp), for every gap > 0.
inline constexpr std::string_view kExactPlane = "exact_plane";

/// What stands for the exact drag where a fit is wanted: no terms, no misfit. Its interval says where the doubles end.
Fit exact_plane_fit(double viscosity, double radius);

/// The fit of the same flow in a fluid of another viscosity > 0: Stokes flow is linear in it.
Fit with_viscosity(Fit fit, double viscosity);

/// Reads a fit file and checks it against docs/fit.schema.json. Throws Error(kBadInput) with the
/// line, the offending key and what is allowed.
Fit read_fit(const std::filesystem::path& path);

/// The same of a fit file's text; `file` is its name for messages.
Fit parse_fit(const std::string& text, const std::string& file);

/// The text of the fit file (JSON).
std::string write_fit(const Fit& fit);

}  // namespace viscontact
