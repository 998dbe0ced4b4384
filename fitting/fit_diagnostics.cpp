#include "fitting/fit_diagnostics.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/named.hpp"
#include "fitting/fit.hpp"
#include "fitting/force_table.hpp"
#include "fitting/spread_gaps.hpp"

namespace viscontact {
namespace {

struct NamedMisfit {
  std::string_view name;
  Misfit misfit;
};

constexpr std::array kMisfits = {NamedMisfit{"basis", Misfit::kBasis},
                                 NamedMisfit{"data", Misfit::kData},
                                 NamedMisfit{"unknown", Misfit::kUnknown}};

double gap_of_row(const ForceTable& table, Eigen::Index row) {
  return table.rows[static_cast<std::size_t>(row)].gap;
}

/// The 99 % quantile of the chi-squared distribution, within 1 % from two degrees of freedom on (Wilson & Hilferty 1931).
double chi_squared_quantile(double freedom) {
  constexpr double kGaussianQuantile = 2.3263;
  const double part = 2 / (9 * freedom);
  return freedom * std::pow(1 - part + kGaussianQuantile * std::sqrt(part), 3);
}

void judge_misfit(const ForceTable& table, const FittedSystem& system, FitDiagnostics& d) {
  bool every_row = true;
  double chi_squared = 0;
  for (Eigen::Index i = 0; i < system.relative_residual.size(); ++i) {
    const double estimate = table.rows[static_cast<std::size_t>(i)].relative_error_estimate;
    d.largest_error_estimate = std::max(d.largest_error_estimate, estimate);
    every_row = every_row && estimate > 0;
    if (every_row) chi_squared += std::pow(system.relative_residual(i) / estimate, 2);
  }
  if (!every_row) return;
  d.chi_squared = chi_squared;
  if (d.degrees_of_freedom == 0) return;
  d.misfit = chi_squared > chi_squared_quantile(static_cast<double>(d.degrees_of_freedom))
                 ? Misfit::kBasis
                 : Misfit::kData;
}

void leave_one_out(const ForceTable& table, const FittedSystem& system, FitDiagnostics& d) {
  const auto& matrix = system.weighted_matrix;
  if (d.degrees_of_freedom == 0) return;
  Eigen::VectorXd leverage = Eigen::VectorXd::Zero(matrix.rows());
  if (matrix.cols() > 0) {
    // Columns of length 1, as in the least squares: the leverages do not depend on their scale, the rounding does.
    const Eigen::VectorXd over_length = matrix.colwise().norm().cwiseInverse();
    const Eigen::MatrixXd scaled = matrix * over_length.asDiagonal();
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(scaled);
    const Eigen::MatrixXd q =
        qr.householderQ() * Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols());
    leverage = q.rowwise().squaredNorm();
  }
  const double round_off = 100 * std::numeric_limits<double>::epsilon();
  double squares = 0, largest = -1;
  for (Eigen::Index i = 0; i < leverage.size(); ++i) {
    if (1 - leverage(i) < round_off) return;
    const double predicted = std::abs(system.relative_residual(i) / (1 - leverage(i)));
    squares += predicted * predicted;
    if (predicted <= largest) continue;
    largest = predicted;
    d.leave_one_out_gap = gap_of_row(table, i);
  }
  d.leave_one_out_largest = largest;
  d.leave_one_out_rms = std::sqrt(squares / static_cast<double>(leverage.size()));
}

std::optional<double> information_criterion(const FittedSystem& system, const FitDiagnostics& d) {
  const auto n = static_cast<double>(d.rows);
  const auto k = static_cast<double>(d.free_coefficients + 1);
  const double squares = system.weighted_residual.squaredNorm();
  if (n <= k + 1 || !(squares > 0)) return std::nullopt;
  return n * std::log(squares / n) + 2 * k + 2 * k * (k + 1) / (n - k - 1);
}

/// One Gaussian residual in two million lies as far out.
bool is_far(double scaled_residual) { return std::abs(scaled_residual) > 5; }

std::vector<Outlier> outliers(const ForceTable& table, const FittedSystem& system) {
  std::vector<Outlier> found;
  for (Eigen::Index i = 0; i < system.scaled_residual.size(); ++i)
    if (is_far(system.scaled_residual(i)))
      found.push_back({gap_of_row(table, i),
                       table.rows[static_cast<std::size_t>(i)].reference_velocity,
                       system.relative_residual(i)});
  return found;
}

/// Looks at the fitted resistance over its interval.
void warn_of_shape(const Fit& fit, std::vector<std::string>& warnings) {
  bool positive = true, decreasing = true;
  for (const double gap : spread_gaps(fit.gap_interval)) {
    double resistance = 0, slope = 0;
    for (const auto& term : fit.terms) {
      const double weight = -term.coefficient / fit.reference_velocity;
      const auto found = find_term(term.name).value();
      resistance += weight * found.value(gap);
      slope += weight * found.log_slope(gap);
    }
    if (positive && !(resistance > 0)) {
      warnings.push_back(fmt::format("the fitted resistance is not positive: {:.4g} at gap {:.4g}",
                                     resistance, gap));
      positive = false;
    }
    if (decreasing && !(slope < 0)) {
      warnings.push_back(fmt::format("the fitted resistance does not decrease at gap {:.4g}", gap));
      decreasing = false;
    }
  }
}

void warn_of_coefficients(const Fit& fit, const FitDiagnostics& d,
                          std::vector<std::string>& warnings) {
  if (d.degrees_of_freedom == 0)
    warnings.emplace_back(
        "as many coefficients as rows: the residuals and the standard errors say nothing");
  for (const auto& term : fit.terms) {
    if (!term.held && term.standard_error >= std::abs(term.coefficient) && term.standard_error > 0)
      warnings.push_back(
          fmt::format("the coefficient of {} is not determined: {:.4g}, standard error {:.2g}",
                      term.name, term.coefficient, term.standard_error));
    if (term.name != kLeadingTerm || term.standard_error == 0 ||
        fit.leading_coefficient.value_or(0) == 0)
      continue;
    const double theory = -*fit.leading_coefficient * fit.reference_velocity;
    const double departure = term.coefficient - theory;
    // Two standard errors: one fit in twenty of pure noise. Nor can it be known better than the table.
    const double error =
        std::max(2 * term.standard_error, d.largest_error_estimate * std::abs(theory));
    if (d.degrees_of_freedom > 0 && std::abs(departure) > error)
      warnings.push_back(fmt::format(
          "the coefficient of 1/q is {:.6g}, theory's is {:.6g}: {:+.2g} relative, {:.1f} standard "
          "errors apart",
          term.coefficient, theory, departure / theory, std::abs(departure) / term.standard_error));
  }
}

}  // namespace

std::string_view to_string(Misfit misfit) {
  return std::ranges::find(kMisfits, misfit, &NamedMisfit::misfit)->name;
}

Misfit parse_misfit(std::string_view word) {
  return require_named(kMisfits, word, "misfit").misfit;
}

FitDiagnostics diagnose(const ForceTable& table, const FittedSystem& system, const Fit& fit) {
  FitDiagnostics d;
  d.rows = table.rows.size();
  d.free_coefficients = static_cast<std::size_t>(system.weighted_matrix.cols());
  d.degrees_of_freedom = d.rows - d.free_coefficients;
  Eigen::Index worst = 0;
  system.relative_residual.cwiseAbs().maxCoeff(&worst);
  d.worst_gap = gap_of_row(table, worst);
  d.worst_relative_residual = system.relative_residual(worst);
  judge_misfit(table, system, d);
  leave_one_out(table, system, d);
  if (fit.loss == Loss::kSquared) d.information_criterion = information_criterion(system, d);
  if (fit.loss != Loss::kSquared) d.outliers = outliers(table, system);
  for (Eigen::Index i = 0; i < system.relative_residual.size(); ++i)
    if (fit.loss == Loss::kSquared || !is_far(system.scaled_residual(i)))
      d.largest_inlier_residual =
          std::max(d.largest_inlier_residual, std::abs(system.relative_residual(i)));
  warn_of_shape(fit, d.warnings);
  warn_of_coefficients(fit, d, d.warnings);
  // A tenth: more than the lecture's five terms miss on forty gaps (0.05), and not to be called lubrication theory any more.
  constexpr double kFar = 0.1;
  if (d.leave_one_out_largest && *d.leave_one_out_largest > kFar)
    d.warnings.push_back(
        fmt::format("fitted without one of its rows, the formula misses that row by up to {:.2g} "
                    "relative: between the rows it may be as far off; tabulate more gaps, or fit "
                    "fewer terms",
                    *d.leave_one_out_largest));
  return d;
}

}  // namespace viscontact
