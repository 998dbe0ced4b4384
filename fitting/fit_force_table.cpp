// Assembles and solves the equations of a fit (docs/physics.md (3.2)), and diagnoses the result.
#include "viscontact/fitting/fit_force_table.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "viscontact/common/error.hpp"
#include "viscontact/common/matrices/decompositions.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/fitting/robust_least_squares.hpp"

namespace viscontact::fitting {
namespace {

/// The solved least squares problem, with a row for each row of the table and a column for each
/// fitted coefficient. `weight` is Equations::weight; `row weight` is RobustSolution::row_weights.
struct FittedSystem {
  /// weight * sqrt(row weight) * term(gap).
  Eigen::MatrixXd weighted_matrix;
  /// weight * sqrt(row weight) * (fit - table).
  Eigen::VectorXd weighted_residual;
  /// (fit - table)/(force of the row), or (fit - table)/FitSettings::row_scales if these are given.
  Eigen::VectorXd relative_residual;
  /// The argument of the loss: weight * (fit - table)/RobustSolution::scale.
  Eigen::VectorXd scaled_residual;
  /// The coefficients with ln(q/r) in place of ln q. Their relative standard errors, unlike those
  /// of the fit, are the same in all units of length.
  std::vector<lubrication::FitTerm> fitted_terms{};
};

/// The diagnostics of a fit whose other members are complete.
lubrication::FitDiagnostics diagnose(const lubrication::MotionTable& table,
                                     const FittedSystem& system, const lubrication::Fit& fit,
                                     lubrication::FittedShape shape);

/// Free choices of the diagnostics of a fit; lubrication/fit.hpp repeats the first two.
struct DiagnosticsTuning {
  // The chi-squared quantile beyond which the basis, and not the data, counts as the cause.
  static constexpr double kQuantile = 0.99;
  // |residual| of an outlier over the scale of all residuals. Of Gaussian residuals only one in two
  // million is so large.
  static constexpr double kOutlier = 5;
  // 1 - leverage below which a row counts as the only one that determines a coefficient. Rounding
  // errors of a leverage are smaller.
  static constexpr double kRoundOff = 100 * std::numeric_limits<double>::epsilon();
  // Standard errors by which a coefficient may differ from theory. Random errors exceed two in only
  // one fit of twenty.
  static constexpr double kStandardErrors = 2;
  // Relative residual of a left-out row with a warning, which is for gaps that are too few or terms
  // that do not suit. A sound fit must not get it: the default basis (1/q, 1, q, q^2, q^3) on forty
  // gaps misses a left-out row by 0.05.
  static constexpr double kFar = 0.1;
  // Failed rows that the warning names; their number is in it, too.
  static constexpr std::size_t kNamed = 5;
};

/// The gap L [L] at which the sphere touches a second wall; infinity without one.
double largest_gap_of(const lubrication::MotionTable& table) {
  const auto wall = lubrication::second_wall(table.geometry, table.container, table.radius);
  return wall ? wall->largest_gap : lubrication::kNoWall;
}

/// The number of rows of the table at each of its gaps, which are one measurement.
std::map<double, std::size_t> rows_by_gap(const lubrication::MotionTable& table) {
  std::map<double, std::size_t> rows;
  for (const auto& row : table.rows) ++rows[row.gap];
  return rows;
}

double gap_of_row(const lubrication::MotionTable& table, Eigen::Index row) {
  return table.rows[static_cast<std::size_t>(row)].gap;
}

/// Of the chi-squared distribution. The type is double, because it compiles faster than long
/// double.
double chi_squared_quantile(double degrees_of_freedom) {
  assert(degrees_of_freedom > 0);
  using DoublePolicy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
  const boost::math::chi_squared_distribution<double, DoublePolicy> chi_squared(degrees_of_freedom);
  return boost::math::quantile(chi_squared, DiagnosticsTuning::kQuantile);
}

bool is_far(double scaled_residual) {
  return std::abs(scaled_residual) > DiagnosticsTuning::kOutlier;
}

/// True for an outlier of a fit with a robust loss. Plain least squares has no outliers.
bool is_outlier(const FittedSystem& system, lubrication::Loss loss, Eigen::Index row) {
  return loss != lubrication::Loss::kSquared && is_far(system.scaled_residual(row));
}

/// Sets the members of `d` that compare the residual of each row with the error estimate of the
/// same row. Outliers count only in chi_squared and in largest_error_estimate.
void compare_with_estimates(const lubrication::MotionTable& table, const FittedSystem& system,
                            lubrication::Loss loss, lubrication::FitDiagnostics& d) {
  bool every_row = true;
  const auto rows_at = rows_by_gap(table);
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
    const double share = 1 / static_cast<double>(rows_at.at(gap_of_row(table, i)));
    chi_squared += share * ratio * ratio;
    if (!inlier) continue;
    chi_squared_of_inliers += share * ratio * ratio;
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

/// The leverages of the rows: the diagonal of the projection onto the columns of `matrix`.
Eigen::VectorXd leverages(const Eigen::MatrixXd& matrix) {
  if (matrix.cols() == 0) return Eigen::VectorXd::Zero(matrix.rows());
  // The columns are scaled to length 1. The leverages do not depend on the scale of the columns,
  // but their rounding errors do.
  const Eigen::VectorXd over_length = matrix.colwise().norm().cwiseInverse();
  const Eigen::MatrixXd scaled = matrix * over_length.asDiagonal();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(scaled);
  return first_columns_of_q(qr).rowwise().squaredNorm();
}

/// For each row: true if it alone has the smallest or the largest gap of the table. A fit without
/// such a row extrapolates to its gap; a fit without any other row interpolates.
std::vector<bool> end_rows(const lubrication::MotionTable& table) {
  const auto [smallest, largest] =
      std::ranges::minmax(table.rows, {}, &lubrication::MotionRow::gap);
  std::vector<bool> is_end;
  for (const auto& row : table.rows)
    is_end.push_back((row.gap == smallest.gap || row.gap == largest.gap) &&
                     std::ranges::count(table.rows, row.gap, &lubrication::MotionRow::gap) == 1);
  return is_end;
}

void take_largest(std::optional<lubrication::LeftOutRow>& largest,
                  const lubrication::LeftOutRow& row) {
  if (!largest || row.relative_residual > largest->relative_residual) largest = row;
}

/// Sets the members of `d` that describe the residual of each row in the fit of the other rows.
/// This residual follows from the fit of all rows: residual/(1 - leverage).
void leave_one_out(const lubrication::MotionTable& table, const FittedSystem& system,
                   lubrication::FitDiagnostics& d) {
  if (d.degrees_of_freedom == 0) return;
  const Eigen::VectorXd leverage = leverages(system.weighted_matrix);
  const auto is_end = end_rows(table);
  double squares = 0;
  std::optional<lubrication::LeftOutRow> inner, end;
  for (Eigen::Index i = 0; i < leverage.size(); ++i) {
    // Leverage 1: the other rows do not determine the coefficients, so no member is set.
    if (1 - leverage(i) < DiagnosticsTuning::kRoundOff) return;
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

/// Akaike's information criterion with the correction for small samples; nothing if there are too
/// few rows for it or if all residuals are 0.
std::optional<double> information_criterion(const FittedSystem& system,
                                            const lubrication::FitDiagnostics& d) {
  const auto n = static_cast<double>(d.degrees_of_freedom + d.free_coefficients);  // of gaps
  const auto k = static_cast<double>(d.free_coefficients + 1);
  const double squares = system.weighted_residual.squaredNorm() * n / static_cast<double>(d.rows);
  if (n <= k + 1 || !(squares > 0)) return std::nullopt;
  return n * std::log(squares / n) + 2 * k + 2 * k * (k + 1) / (n - k - 1);
}

std::vector<lubrication::Outlier> outliers(const lubrication::MotionTable& table,
                                           const FittedSystem& system) {
  std::vector<lubrication::Outlier> found;
  for (Eigen::Index i = 0; i < system.scaled_residual.size(); ++i)
    if (is_far(system.scaled_residual(i)))
      found.push_back({gap_of_row(table, i),
                       table.rows[static_cast<std::size_t>(i)].reference_velocity,
                       system.relative_residual(i)});
  return found;
}

void warn_of_shape(const lubrication::Fit& fit, lubrication::FittedShape shape,
                   std::vector<std::string>& warnings) {
  bool positive = shape != lubrication::FittedShape::kAny,
       decreasing = shape == lubrication::FittedShape::kDrag;
  const auto wall = lubrication::second_wall_of(fit);
  const double largest_gap = wall ? wall->largest_gap : lubrication::kNoWall;
  // Beyond the middle between two walls the drag grows.
  decreasing = decreasing && !(fit.gap_interval[1] > largest_gap / 2);
  for (const double gap : lubrication::spread_gaps(fit.gap_interval)) {
    double resistance = 0, slope = 0;
    for (const auto& term : fit.terms) {
      const double coefficient = -term.coefficient / fit.reference_velocity;  // in R
      const auto found = lubrication::find_term(term.name).value();
      resistance += coefficient * found.value(gap, largest_gap);
      slope += coefficient * found.log_slope(gap, largest_gap);
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

std::string names_of_failed_rows(const lubrication::MotionTable& table) {
  std::vector<std::string> names;
  for (const auto& [name, reason] : table.failed_rows)
    if (names.size() < DiagnosticsTuning::kNamed) names.push_back(name);
  if (table.failed_rows.size() > DiagnosticsTuning::kNamed) names.emplace_back("...");
  return fmt::format("{}", fmt::join(names, "; "));
}

/// Adds warnings if no degree of freedom is left, if a coefficient is smaller than its standard
/// error, or if the coefficient of 1/q differs from that of theory by more than the errors allow.
/// The numbers in `d` must be set before.
void warn_of_coefficients(const lubrication::Fit& fit, const FittedSystem& system,
                          const lubrication::FitDiagnostics& d,
                          std::vector<std::string>& warnings) {
  if (d.degrees_of_freedom == 0)
    warnings.emplace_back(
        "there are as many coefficients as rows at different gaps, so that the residuals and the "
        "standard errors have no meaning");
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
    // A difference below the relative error of the forces themselves gets no warning either.
    const double error = std::max(DiagnosticsTuning::kStandardErrors * term.standard_error,
                                  d.largest_error_estimate * std::abs(theory));
    if (d.degrees_of_freedom > 0 && std::abs(departure) > error)
      warnings.push_back(fmt::format(
          "the coefficient of 1/q is {:.6g}, theory's is {:.6g}: {:+.2g} relative, {:.1f} standard "
          "errors apart",
          term.coefficient, theory, departure / theory, std::abs(departure) / term.standard_error));
  }
}

lubrication::FitDiagnostics diagnose(const lubrication::MotionTable& table,
                                     const FittedSystem& system, const lubrication::Fit& fit,
                                     lubrication::FittedShape shape) {
  lubrication::FitDiagnostics d;
  d.rows = table.rows.size();
  d.free_coefficients = static_cast<std::size_t>(system.weighted_matrix.cols());
  d.degrees_of_freedom = rows_by_gap(table).size() - d.free_coefficients;
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
  if (d.left_out_inner && d.left_out_inner->relative_residual > DiagnosticsTuning::kFar)
    d.warnings.push_back(
        fmt::format("fitted without the row at gap {:.4g}, the formula misses that row by {:.2g} "
                    "relative: between the rows around it the error can reach a fraction of that; "
                    "tabulate more gaps there, or fit fewer terms",
                    d.left_out_inner->gap, d.left_out_inner->relative_residual));
  return d;
}

/// Throws Error(kBadInput) if F/u of two rows of equal gap differs by more than the sum of their
/// relative error estimates. Two rows without error estimates (0) are not compared.
void check_linearity(const lubrication::MotionTable& table) {
  std::map<double, const lubrication::MotionRow*> first_at;
  for (const auto& row : table.rows) {
    const auto* first = first_at.try_emplace(row.gap, &row).first->second;
    const double allowed = row.relative_error_estimate + first->relative_error_estimate;
    const double ratio =
        (row.force / row.reference_velocity) / (first->force / first->reference_velocity);
    if (allowed > 0 && std::abs(ratio - 1) > allowed)
      throw Error(ErrorKind::kBadInput,
                  "at gap {} the force is not linear in the velocity: force over velocity differs "
                  "by {:.2g} relative between the velocities {} and {}; the rows' error estimates "
                  "allow {:.2g}",
                  row.gap, ratio - 1, first->reference_velocity, row.reference_velocity, allowed);
  }
}

/// The value of the fixed coefficient of 1/q [M L^2/T^2]. Throws Error(kBadInput) if the basis has
/// no such term, or if neither settings nor table give a value.
double fixed_leading(const lubrication::MotionTable& table, const FitSettings& settings) {
  if (find_named(settings.basis.terms, lubrication::kLeadingTerm) == nullptr)
    throw Error(ErrorKind::kBadInput, "the basis has no term 1/q whose coefficient could be fixed");
  if (settings.leading_value) return *settings.leading_value;
  if (!table.leading_coefficient)
    throw Error(ErrorKind::kBadInput,
                "the table does not say what theory's coefficient of 1/q is; give a value for it, "
                "or write the k of R = k/q into the table's header (# leading_coefficient: k)");
  return -*table.leading_coefficient * table.rows.front().reference_velocity;
}

/// Throws Error(kBadInput) if a term needs a second wall and the table has none above its gaps.
void check_second_wall(const lubrication::MotionTable& table, const lubrication::Basis& basis) {
  const double largest =
      std::ranges::max_element(table.rows, {}, &lubrication::MotionRow::gap)->gap;
  const double wall = largest_gap_of(table);
  for (const auto& term : basis.terms)
    if (lubrication::needs_second_wall(term.name) &&
        !(wall < lubrication::kNoWall && largest < wall))
      throw Error(ErrorKind::kBadInput,
                  "the term {} needs a wall opposite, at a gap L above {}; the table's geometry is "
                  "'{}' and its container '{}', which name none (closed cylinder, radius, height; "
                  "or cavity, radius)",
                  term.name, largest, table.geometry, table.container);
}

/// Throws Error(kBadInput) if the table has too few different gaps, or if the only coefficient is
/// fixed.
void check_gaps(const lubrication::MotionTable& table, const FitSettings& settings) {
  if (settings.fix_leading && settings.basis.terms.size() == 1)
    throw Error(ErrorKind::kBadInput,
                "the only coefficient is fixed, so that there is nothing to fit; give more terms");
  std::set<double> gaps;
  for (const auto& row : table.rows) gaps.insert(row.gap);
  const std::size_t needed =
      std::max<std::size_t>(2, settings.basis.terms.size() - (settings.fix_leading ? 1 : 0));
  if (gaps.size() < needed)
    throw Error(
        ErrorKind::kBadInput, "the table has {} different gap(s); the basis {} needs at least {}{}",
        gaps.size(), settings.basis.name, needed,
        table.failed_rows.empty()
            ? ""
            : fmt::format("; {} of its rows could not be computed", table.failed_rows.size()));
}

/// The least squares problem: minimise the sum over the rows of the table of (weight (terms x -
/// left))^2, with the coefficients x.
struct Equations {
  // F u0/u [M L/T^2]: the force at the velocity u0 of the first row.
  Eigen::VectorXd force;
  // `force` minus the fixed coefficient times 1/q, if that coefficient is fixed.
  Eigen::VectorXd left;
  // The values of the fitted terms at the gaps of the rows, a column for each term.
  Eigen::MatrixXd terms;
  // The force [M L/T^2] by which the residual of the row is divided to make it relative, not 0:
  // FitSettings::row_scales, or else `force`.
  Eigen::VectorXd scale;
  // 1/|scale| for relative weights, 1 for absolute ones.
  Eigen::VectorXd weight;
};

/// If `term` is f ln q or ln(L-q) and the basis contains the factor f or 1, the index of this
/// factor in the basis. Such a term is fitted with the logarithm of a length over r, and the
/// coefficient of the factor is corrected afterwards.
std::optional<std::size_t> partner_of(const lubrication::Term& term, const lubrication::Basis& b) {
  const auto factor = lubrication::factor_of_logarithm(term.name);
  if (!factor) return std::nullopt;
  const auto found = std::ranges::find(b.terms, *factor, &lubrication::Term::name);
  if (found == b.terms.end()) return std::nullopt;
  return static_cast<std::size_t>(found - b.terms.begin());
}

bool is_fixed(const lubrication::Term& term, const FitSettings& settings) {
  return settings.fix_leading && term.name == lubrication::kLeadingTerm;
}

/// The equations of the fit. `fixed` [M L^2/T^2] is the coefficient of 1/q, without effect unless
/// the settings fix it. A term that overflows gives an entry that is not finite.
Equations assemble(const lubrication::MotionTable& table, const FitSettings& settings,
                   double fixed) {
  const auto rows = static_cast<Eigen::Index>(table.rows.size());
  const auto columns =
      static_cast<Eigen::Index>(settings.basis.terms.size()) - (settings.fix_leading ? 1 : 0);
  const double u0 = table.rows.front().reference_velocity;
  const double largest_gap = largest_gap_of(table);
  Equations equations = {Eigen::VectorXd(rows), Eigen::VectorXd(rows),
                         Eigen::MatrixXd(rows, columns), Eigen::VectorXd(rows),
                         Eigen::VectorXd::Ones(rows)};
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto& row = table.rows[static_cast<std::size_t>(i)];
    equations.force(i) = equations.left(i) = row.force * (u0 / row.reference_velocity);
    Eigen::Index column = 0;
    for (const auto& term : settings.basis.terms) {
      // With ln(q/r) in place of ln q the condition number is the same in all units of length.
      const double unit = partner_of(term, settings.basis) ? table.radius : 1;
      const double to_wall = largest_gap - row.gap;
      const double value =
          term.value.at(row.gap, std::log(row.gap / unit), to_wall, std::log(to_wall / unit));
      if (is_fixed(term, settings))
        equations.left(i) -= fixed * value;
      else
        equations.terms(i, column++) = value;
    }
  }
  equations.scale = settings.row_scales.empty()
                        ? equations.force
                        : Eigen::VectorXd::Map(settings.row_scales.data(), rows);
  if (settings.weights == lubrication::Weights::kRelative)
    equations.weight = equations.scale.cwiseAbs().cwiseInverse();
  return equations;
}

/// Converts the coefficients and the covariance of the fitted terms f(q) ln(q/r) to those of the
/// terms f(q) ln q that the fit file contains.
void shift_logarithms(const FitSettings& settings, double radius, lubrication::Fit& fit) {
  const double shift = std::log(radius);
  if (shift == 0) return;
  const auto& terms = settings.basis.terms;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const auto partner = partner_of(terms[i], settings.basis);
    if (!partner) continue;
    fit.terms[*partner].coefficient -= shift * fit.terms[i].coefficient;
    for (std::size_t j = 0; j < terms.size(); ++j)
      fit.covariance[*partner][j] -= shift * fit.covariance[i][j];
    for (std::size_t j = 0; j < terms.size(); ++j)
      fit.covariance[j][*partner] -= shift * fit.covariance[j][i];
    fit.terms[*partner].standard_error =
        std::sqrt(std::max(0.0, fit.covariance[*partner][*partner]));
  }
}

/// Sets terms and covariance of `fit`. The covariance of a fixed coefficient is 0. `fixed` is that
/// of assemble().
void set_coefficients(const LeastSquaresSolution& solution, const FitSettings& settings,
                      double fixed, lubrication::Fit& fit) {
  std::vector<Eigen::Index> columns;  // column in the solution; -1 if fixed
  Eigen::Index free = 0;
  for (const auto& term : settings.basis.terms) {
    const std::string name(term.name);
    if (is_fixed(term, settings)) {
      columns.push_back(-1);
      fit.terms.push_back({name, fixed, 0, true});
    } else {
      fit.terms.push_back(
          {name, solution.coefficients(free), std::sqrt(solution.covariance(free, free)), false});
      columns.push_back(free++);
    }
  }
  fit.covariance.assign(columns.size(), std::vector<double>(columns.size(), 0.0));
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j)
      if (columns[i] >= 0 && columns[j] >= 0)
        fit.covariance[i][j] = solution.covariance(columns[i], columns[j]);
}

FittedSystem residuals_of(const Equations& equations, const RobustSolution& solution) {
  const Eigen::VectorXd residual =
      equations.terms * solution.least_squares.coefficients - equations.left;
  const Eigen::VectorXd weighted = equations.weight.cwiseProduct(residual);
  const Eigen::VectorXd root = solution.row_weights.cwiseSqrt();
  FittedSystem system;
  system.weighted_matrix = root.cwiseProduct(equations.weight).asDiagonal() * equations.terms;
  system.weighted_residual = root.cwiseProduct(weighted);
  system.relative_residual = residual.cwiseQuotient(equations.scale);
  system.scaled_residual = weighted / solution.scale;
  return system;
}

}  // namespace

lubrication::Fit fit_force_table(const lubrication::MotionTable& table, const FitSettings& settings,
                                 const StopToken& stop) {
  assert(!settings.basis.terms.empty());
  check_linearity(table);
  check_gaps(table, settings);
  check_second_wall(table, settings.basis);
  if (const auto& scales = settings.row_scales;
      !scales.empty() && (scales.size() != table.rows.size() ||
                          !std::ranges::all_of(scales, [](double scale) { return scale > 0; })))
    throw Error(
        ErrorKind::kBadInput,
        "row_scales must be empty or have one number > 0 for each of the {} rows of the table",
        table.rows.size());
  const double fixed = settings.fix_leading ? fixed_leading(table, settings) : 0;
  const auto equations = assemble(table, settings, fixed);
  auto solution = solve_robust_least_squares(equations.weight.asDiagonal() * equations.terms,
                                             equations.weight.cwiseProduct(equations.left),
                                             settings.loss, stop);

  // The least squares count rows as degrees of freedom. Rows of one gap are one measurement.
  const auto columns = static_cast<double>(equations.terms.cols());
  const double by_rows = static_cast<double>(table.rows.size()) - columns;
  const double by_gaps = static_cast<double>(rows_by_gap(table).size()) - columns;
  if (by_rows > 0 && by_gaps < by_rows)
    solution.least_squares.covariance *= by_gaps > 0 ? by_rows / by_gaps : 0;

  lubrication::Fit fit;
  fit.basis = settings.basis.name;
  fit.reference_velocity = table.rows.front().reference_velocity;
  fit.viscosity = table.viscosity;
  fit.radius = table.radius;
  fit.gap_interval = {std::ranges::min_element(table.rows, {}, &lubrication::MotionRow::gap)->gap,
                      std::ranges::max_element(table.rows, {}, &lubrication::MotionRow::gap)->gap};
  fit.weights = settings.weights;
  fit.loss = settings.loss;
  fit.geometry = table.geometry;
  fit.container = table.container;
  fit.leading_coefficient = table.leading_coefficient;
  set_coefficients(solution.least_squares, settings, fixed, fit);
  fit.condition_number = solution.least_squares.condition_number;
  auto system = residuals_of(equations, solution);
  system.fitted_terms = fit.terms;
  shift_logarithms(settings, table.radius, fit);
  fit.largest_relative_residual = system.relative_residual.cwiseAbs().maxCoeff();
  fit.rms_relative_residual = std::sqrt(system.relative_residual.array().square().mean());
  if (!std::isfinite(fit.rms_relative_residual) ||
      std::ranges::any_of(fit.terms, [](const lubrication::FitTerm& term) {
        return !std::isfinite(term.coefficient) || !std::isfinite(term.standard_error);
      }))
    throw Error(
        ErrorKind::kBadInput,
        "the forces are too large, or differ too much in size, to be fitted in double precision");
  fit.diagnostics = diagnose(table, system, fit, settings.shape);
  return fit;
}

lubrication::Fit fit_force_table(const lubrication::MotionTable& table, std::string_view basis,
                                 lubrication::Weights weights) {
  FitSettings settings;
  settings.basis = lubrication::find_basis(basis);
  settings.weights = weights;
  return fit_force_table(table, settings);
}

}  // namespace viscontact::fitting
