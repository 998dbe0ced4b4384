// Assembles the equations of a fit, physics.md (3.2), from the rows of a table, solves them, and
// sets the members of the fit. Units are those of the table.
#include "viscontact/fitting/fit_force_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "viscontact/common/error.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/fitting/diagnose.hpp"
#include "viscontact/fitting/robust_least_squares.hpp"

namespace viscontact::fitting {
namespace {

/// Throws Error(kBadInput) if F/u differs between rows of equal gap by more than their error
/// estimates. F/u must be equal there, because Stokes flow is linear in the velocity. Rows without
/// an estimate are not checked.
void check_linearity(const lubrication::ForceTable& table) {
  std::map<double, const lubrication::ForceTableRow*> first_at;
  for (const auto& row : table.rows) {
    const auto* first = first_at.try_emplace(row.gap, &row).first->second;
    const double allowed = row.relative_error_estimate + first->relative_error_estimate;
    const double ratio =
        (row.force / row.reference_velocity) / (first->force / first->reference_velocity);
    if (allowed > 0 && std::abs(ratio - 1) > allowed)
      throw Error(ErrorKind::kBadInput,
                  fmt::format("at gap {} the force is not linear in the velocity: force over "
                              "velocity differs by {:.2g} relative between the velocities {} and "
                              "{}; the rows' error estimates allow {:.2g}",
                              row.gap, ratio - 1, first->reference_velocity, row.reference_velocity,
                              allowed));
  }
}

/// The value of the fixed coefficient of 1/q [M L^2/T^2]. Throws Error(kBadInput) if the basis has
/// no such term, or if neither settings nor table give a value.
double fixed_leading(const lubrication::ForceTable& table, const FitSettings& settings) {
  if (find_named(settings.basis.terms, lubrication::kLeadingTerm) == nullptr)
    throw Error(ErrorKind::kBadInput, "the basis has no term 1/q whose coefficient could be fixed");
  if (settings.leading_value) return *settings.leading_value;
  if (!table.leading_coefficient)
    throw Error(ErrorKind::kBadInput,
                "the table does not say what theory's coefficient of 1/q is; give a value for it, "
                "or write the k of R = k/q into the table's header (# leading_coefficient: k)");
  return -*table.leading_coefficient * table.rows.front().reference_velocity;
}

void check_gaps(const lubrication::ForceTable& table, const FitSettings& settings) {
  if (settings.fix_leading && settings.basis.terms.size() == 1)
    throw Error(ErrorKind::kBadInput,
                "the only coefficient is fixed, so that there is nothing to fit; give more terms");
  std::set<double> gaps;
  for (const auto& row : table.rows) gaps.insert(row.gap);
  const std::size_t needed =
      std::max<std::size_t>(2, settings.basis.terms.size() - (settings.fix_leading ? 1 : 0));
  if (gaps.size() < needed)
    throw Error(ErrorKind::kBadInput,
                fmt::format("the table has {} different gap(s); the basis {} needs at least {}{}",
                            gaps.size(), settings.basis.name, needed,
                            table.failed_rows.empty()
                                ? ""
                                : fmt::format("; {} of its rows could not be computed",
                                              table.failed_rows.size())));
}

/// The equations of the least-squares problem, with a row for each row of the table.
struct Equations {
  // The forces, scaled to the velocity of the first row.
  Eigen::VectorXd force;
  // The forces minus the fixed term.
  Eigen::VectorXd left;
  // A column for each fitted term.
  Eigen::MatrixXd terms;
  // What the relative residual of each row refers to.
  Eigen::VectorXd scale;
  // The weight of each row: 1/|scale| or 1.
  Eigen::VectorXd weight;
};

/// The place in the basis of the term that takes up ln r if `term`, f(q) ln q, is fitted as
/// f(q) ln(q/r) = f(q) ln q - ln r f(q): that of f(q). Nothing if the term has no logarithm or the
/// basis lacks f(q).
std::optional<std::size_t> partner_of(const lubrication::Term& term, const lubrication::Basis& b) {
  constexpr std::string_view kLogarithm = "ln q";
  if (!term.name.ends_with(kLogarithm)) return std::nullopt;
  auto factor = term.name.substr(0, term.name.size() - kLogarithm.size());
  factor = factor.empty() ? "1" : factor.substr(0, factor.size() - 1);
  const auto found = std::ranges::find(b.terms, factor, &lubrication::Term::name);
  if (found == b.terms.end()) return std::nullopt;
  return static_cast<std::size_t>(found - b.terms.begin());
}

bool is_fixed(const lubrication::Term& term, const FitSettings& settings) {
  return settings.fix_leading && term.name == lubrication::kLeadingTerm;
}

Equations assemble(const lubrication::ForceTable& table, const FitSettings& settings,
                   double fixed) {
  const auto rows = static_cast<Eigen::Index>(table.rows.size());
  const auto columns =
      static_cast<Eigen::Index>(settings.basis.terms.size()) - (settings.fix_leading ? 1 : 0);
  const double u0 = table.rows.front().reference_velocity;
  Equations equations = {Eigen::VectorXd(rows), Eigen::VectorXd(rows),
                         Eigen::MatrixXd(rows, columns), Eigen::VectorXd(rows),
                         Eigen::VectorXd::Ones(rows)};
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto& row = table.rows[static_cast<std::size_t>(i)];
    equations.force(i) = equations.left(i) = row.force * (u0 / row.reference_velocity);
    Eigen::Index column = 0;
    for (const auto& term : settings.basis.terms) {
      // With ln(q/r) the condition number does not depend on the unit of length.
      const double unit = partner_of(term, settings.basis) ? table.radius : 1;
      const double value = term.value.at(row.gap, std::log(row.gap / unit));
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

/// Goes over from coefficients of f(q) ln(q/r) to those of f(q) ln q, and their covariance.
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

/// Sets coefficients and covariance. A fixed coefficient has a row and a column of zeros.
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

lubrication::Fit fit_force_table(const lubrication::ForceTable& table, const FitSettings& settings,
                                 const StopToken& stop) {
  check_linearity(table);
  check_gaps(table, settings);
  const double fixed = settings.fix_leading ? fixed_leading(table, settings) : 0;
  const auto equations = assemble(table, settings, fixed);
  const auto solution = solve_robust_least_squares(equations.weight.asDiagonal() * equations.terms,
                                                   equations.weight.cwiseProduct(equations.left),
                                                   settings.loss, stop);

  lubrication::Fit fit;
  fit.basis = settings.basis.name;
  fit.reference_velocity = table.rows.front().reference_velocity;
  fit.viscosity = table.viscosity;
  fit.radius = table.radius;
  fit.gap_interval = {
      std::ranges::min_element(table.rows, {}, &lubrication::ForceTableRow::gap)->gap,
      std::ranges::max_element(table.rows, {}, &lubrication::ForceTableRow::gap)->gap};
  fit.weights = settings.weights;
  fit.loss = settings.loss;
  fit.geometry = table.geometry;
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

lubrication::Fit fit_force_table(const lubrication::ForceTable& table, std::string_view basis,
                                 lubrication::Weights weights) {
  FitSettings settings;
  settings.basis = lubrication::find_basis(basis);
  settings.weights = weights;
  return fit_force_table(table, settings);
}

}  // namespace viscontact::fitting
