// A fit of the lubrication force: coefficients of a basis at one velocity, with what is needed to
// trust and to use it.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "fitting/force_table.hpp"

namespace viscontact {

/// What the least squares minimises: residuals over the force (`relative`) or residuals as they are
/// (`absolute`).
enum class Weights { kRelative, kAbsolute };

std::string_view to_string(Weights weights);

/// "relative" or "absolute". Throws Error(kBadInput) for another word.
Weights parse_weights(std::string_view word);

struct FitTerm {
  std::string name;        ///< of a Term
  double coefficient = 0;  ///< [force / dimension of the term]
  double standard_error =
      0;  ///< same dimension, >= 0; from the misfit, as if it were random noise (it is not)
};

/// F_lub(q, u0) = sum of coefficient * term(q) for q in gap_interval.
struct Fit {
  std::string basis;
  double reference_velocity = 0;            ///< u0 [L/T], not 0
  double viscosity = 0;                     ///< mu [M/(L T)], > 0
  double radius = 0;                        ///< r [L], > 0
  std::array<double, 2> gap_interval = {};  ///< [L], 0 < first < second
  Weights weights = Weights::kRelative;
  std::vector<FitTerm> terms;
  double largest_relative_residual = 0;
  double rms_relative_residual = 0;
  double condition_number = 1;                  ///< of the scaled, weighted columns
  std::vector<std::vector<double>> covariance;  ///< of the coefficients
  std::string table_sha256;                     ///< of the table file; may be empty
  std::map<std::string, std::string> versions;  ///< program name to version
};

/// Fits a basis (by name) to a table. Rows of other velocities than the first row's count as F (u0 / u): Stokes
/// flow is linear. table_sha256 and versions are left to the caller.
/// Throws Error(kBadInput) for an unknown basis, fewer different gaps than terms, or rows of equal gap whose F/u
/// differ by more than their error estimates; Error(kNotConverged) from the least squares.
Fit fit_force_table(const ForceTable& table, std::string_view basis, Weights weights);

/// Reads a fit file and checks it against docs/fit.schema.json. Throws Error(kBadInput) naming the
/// offending key.
Fit read_fit(const std::filesystem::path& path);

/// The text of the fit file (JSON).
std::string write_fit(const Fit& fit);

}  // namespace viscontact
