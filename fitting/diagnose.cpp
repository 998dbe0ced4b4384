// Chi-squared, leave-one-out residuals (PRESS, Allen 1974), Akaike's criterion (Hurvich & Tsai
// 1989), outliers, and warnings in words.
#include "viscontact/fitting/diagnose.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>

#include "viscontact/lubrication/spread_gaps.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::fitting {
namespace {

double gap_of_row(const lubrication::ForceTable& table, Eigen::Index row) {
  return table.rows[static_cast<std::size_t>(row)].gap;
}

/// The 99 % quantile of the chi-squared distribution. It is computed in double precision, because
/// Boost's default, long double, takes longer to compile.
double chi_squared_quantile(double degrees_of_freedom) {
  using DoublePolicy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
  const boost::math::chi_squared_distribution<double, DoublePolicy> chi_squared(degrees_of_freedom);
  return boost::math::quantile(chi_squared, 0.99);
}

/// True for a residual of more than 5 times the scale. Of Gaussian residuals, one in two million is
/// as large.
bool is_far(double scaled_residual) { return std::abs(scaled_residual) > 5; }

/// True for a row that a robust loss sets aside.
bool is_outlier(const FittedSystem& system, lubrication::Loss loss, Eigen::Index row) {
  return loss != lubrication::Loss::kSquared && is_far(system.scaled_residual(row));
}

/// Compares the residual of each row with the error estimate of the same row, because the estimate
/// of another row may be much larger. Outliers count only in chi_squared and in
/// largest_error_estimate.
void compare_with_estimates(const lubrication::ForceTable& table, const FittedSystem& system,
                            lubrication::Loss loss, lubrication::FitDiagnostics& d) {
  bool every_row = true;
  double chi_squared = 0, chi_squared_of_inliers = 0;
  std::size_t outliers = 0;
  for (Eigen::Index i = 0; i < system.relative_residual.size(); ++i) {
    const double residual = system.relative_residual(i);
    const bool inlier = !is_outlier(system, loss, i);
    if (inlier) d.largest_inlier_residual = std::max(d.largest_inlier_residual, std::abs(residual));
    if (!inlier) ++outliers;
    const double estimate = table.rows[static_cast<std::size_t>(i)].relative_error_estimate;
    d.largest_error_estimate = std::max(d.largest_error_estimate, estimate);
    every_row = every_row && estimate > 0;
    if (!(estimate > 0)) continue;
    const double ratio = std::abs(residual) / estimate;
    chi_squared += ratio * ratio;
    if (!inlier) continue;
    chi_squared_of_inliers += ratio * ratio;
    if (ratio > 1) ++d.rows_beyond_estimate;
    if (d.worst_to_estimate && ratio <= d.worst_to_estimate->ratio) continue;
    d.worst_to_estimate = {gap_of_row(table, i), residual, ratio};
  }
  if (!every_row) return;
  d.chi_squared = chi_squared;
  if (d.degrees_of_freedom <= outliers) return;
  const bool beyond_quantile =
      chi_squared_of_inliers >
      chi_squared_quantile(static_cast<double>(d.degrees_of_freedom - outliers));
  d.misfit = beyond_quantile && d.rows_beyond_estimate > 0 ? lubrication::Misfit::kBasis
                                                           : lubrication::Misfit::kData;
}

/// Leverages of the rows: the diagonal of the projection onto the columns of `matrix`.
Eigen::VectorXd leverages(const Eigen::MatrixXd& matrix) {
  if (matrix.cols() == 0) return Eigen::VectorXd::Zero(matrix.rows());
  // The columns are scaled to length 1. The leverages do not depend on the scale of the columns,
  // but their rounding errors do.
  const Eigen::VectorXd over_length = matrix.colwise().norm().cwiseInverse();
  const Eigen::MatrixXd scaled = matrix * over_length.asDiagonal();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(scaled);
  const Eigen::MatrixXd q =
      qr.householderQ() * Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols());
  return q.rowwise().squaredNorm();
}

/// True for each row that is alone at the smallest or largest gap of the table. The fit of the
/// other rows extrapolates to such a row and interpolates to every other one.
std::vector<bool> end_rows(const lubrication::ForceTable& table) {
  const auto [smallest, largest] =
      std::ranges::minmax(table.rows, {}, &lubrication::ForceTableRow::gap);
  std::vector<bool> is_end;
  for (const auto& row : table.rows)
    is_end.push_back((row.gap == smallest.gap || row.gap == largest.gap) &&
                     std::ranges::count(table.rows, row.gap, &lubrication::ForceTableRow::gap) ==
                         1);
  return is_end;
}

/// Replaces `largest` by `row` if the residual of `row` is larger.
void take_largest(std::optional<lubrication::LeftOutRow>& largest,
                  const lubrication::LeftOutRow& row) {
  if (!largest || row.relative_residual > largest->relative_residual) largest = row;
}

void leave_one_out(const lubrication::ForceTable& table, const FittedSystem& system,
                   lubrication::FitDiagnostics& d) {
  if (d.degrees_of_freedom == 0) return;
  const Eigen::VectorXd leverage = leverages(system.weighted_matrix);
  const auto is_end = end_rows(table);
  const double round_off = 100 * std::numeric_limits<double>::epsilon();
  double squares = 0;
  std::optional<lubrication::LeftOutRow> inner, end;
  for (Eigen::Index i = 0; i < leverage.size(); ++i) {
    // Without this row the coefficients are not determined, so that the other rows have no fit.
    if (1 - leverage(i) < round_off) return;
    const double predicted = std::abs(system.relative_residual(i) / (1 - leverage(i)));
    squares += predicted * predicted;
    take_largest(is_end[static_cast<std::size_t>(i)] ? end : inner,
                 {gap_of_row(table, i), predicted});
  }
  d.left_out_inner = inner;
  d.left_out_end = end;
  auto largest = inner;
  if (end) take_largest(largest, *end);
  d.leave_one_out_gap = largest->gap;
  d.leave_one_out_largest = largest->relative_residual;
  d.leave_one_out_rms = std::sqrt(squares / static_cast<double>(leverage.size()));
}

std::optional<double> information_criterion(const FittedSystem& system,
                                            const lubrication::FitDiagnostics& d) {
  const auto n = static_cast<double>(d.rows);
  const auto k = static_cast<double>(d.free_coefficients + 1);
  const double squares = system.weighted_residual.squaredNorm();
  if (n <= k + 1 || !(squares > 0)) return std::nullopt;
  return n * std::log(squares / n) + 2 * k + 2 * k * (k + 1) / (n - k - 1);
}

std::vector<lubrication::Outlier> outliers(const lubrication::ForceTable& table,
                                           const FittedSystem& system) {
  std::vector<lubrication::Outlier> found;
  for (Eigen::Index i = 0; i < system.scaled_residual.size(); ++i)
    if (is_far(system.scaled_residual(i)))
      found.push_back({gap_of_row(table, i),
                       table.rows[static_cast<std::size_t>(i)].reference_velocity,
                       system.relative_residual(i)});
  return found;
}

/// Warns if the fitted resistance is not positive or does not decrease with the gap, as far as its
/// shape demands it.
void warn_of_shape(const lubrication::Fit& fit, lubrication::FittedShape shape,
                   std::vector<std::string>& warnings) {
  bool positive = shape != lubrication::FittedShape::kAny,
       decreasing = shape == lubrication::FittedShape::kDrag;
  for (const double gap : lubrication::spread_gaps(fit.gap_interval)) {
    double resistance = 0, slope = 0;
    for (const auto& term : fit.terms) {
      const double weight = -term.coefficient / fit.reference_velocity;
      const auto found = lubrication::find_term(term.name).value();
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

/// The names of the table's failed rows, of many only the first ones.
std::string names_of_failed_rows(const lubrication::ForceTable& table) {
  constexpr std::size_t kNamed = 5;
  std::vector<std::string> names;
  for (const auto& [name, reason] : table.failed_rows)
    if (names.size() < kNamed) names.push_back(name);
  if (table.failed_rows.size() > kNamed) names.emplace_back("...");
  return fmt::format("{}", fmt::join(names, "; "));
}

void warn_of_coefficients(const lubrication::Fit& fit, const FittedSystem& system,
                          const lubrication::FitDiagnostics& d,
                          std::vector<std::string>& warnings) {
  if (d.degrees_of_freedom == 0)
    warnings.emplace_back(
        "there are as many coefficients as rows, so that the residuals and the standard errors "
        "have no meaning");
  for (const auto& term : system.fitted_terms)
    if (!term.is_fixed && term.standard_error >= std::abs(term.coefficient) &&
        term.standard_error > 0)
      warnings.push_back(
          fmt::format("the coefficient of {} is not determined: {:.4g}, standard error {:.2g}",
                      term.name, term.coefficient, term.standard_error));
  for (const auto& term : fit.terms) {
    if (term.name != lubrication::kLeadingTerm || term.standard_error == 0 ||
        fit.leading_coefficient.value_or(0) == 0)
      continue;
    const double theory = -*fit.leading_coefficient * fit.reference_velocity;
    const double departure = term.coefficient - theory;
    // Two standard errors, because random errors exceed them in only one fit of twenty. The error
    // estimates of the table count, too, because they limit how well the fit can know the
    // coefficient.
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

lubrication::FitDiagnostics diagnose(const lubrication::ForceTable& table,
                                     const FittedSystem& system, const lubrication::Fit& fit,
                                     lubrication::FittedShape shape) {
  lubrication::FitDiagnostics d;
  d.rows = table.rows.size();
  d.free_coefficients = static_cast<std::size_t>(system.weighted_matrix.cols());
  d.degrees_of_freedom = d.rows - d.free_coefficients;
  Eigen::Index worst = 0;
  system.relative_residual.cwiseAbs().maxCoeff(&worst);
  d.worst_gap = gap_of_row(table, worst);
  d.worst_relative_residual = system.relative_residual(worst);
  compare_with_estimates(table, system, fit.loss, d);
  leave_one_out(table, system, d);
  if (fit.loss == lubrication::Loss::kSquared)
    d.information_criterion = information_criterion(system, d);
  if (fit.loss != lubrication::Loss::kSquared) d.outliers = outliers(table, system);
  d.failed_rows = table.failed_rows.size();
  if (d.failed_rows > 0)
    d.warnings.push_back(
        fmt::format("the table lacks {} of {} rows, which could not be computed ({}); the fit is "
                    "that of the other rows",
                    d.failed_rows, d.failed_rows + d.rows, names_of_failed_rows(table)));
  warn_of_shape(fit, shape, d.warnings);
  warn_of_coefficients(fit, system, d, d.warnings);
  // A formula that misses a row by more than a tenth does not describe lubrication theory. The
  // lecture's five terms on forty gaps miss a row by 0.05, for which there is no warning.
  constexpr double kFar = 0.1;
  if (d.left_out_inner && d.left_out_inner->relative_residual > kFar)
    d.warnings.push_back(
        fmt::format("fitted without the row at gap {:.4g}, the formula misses that row by {:.2g} "
                    "relative: between the rows around it the error can reach a fraction of that; "
                    "tabulate more gaps there, or fit fewer terms",
                    d.left_out_inner->gap, d.left_out_inner->relative_residual));
  return d;
}

}  // namespace viscontact::fitting
