#include "fitting/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/error.hpp"
#include "common/named.hpp"

namespace viscontact {
namespace {

/// Stokes flow is linear in the velocity: at equal gaps F/u must agree to within the rows' own error estimates, where they have any.
void check_linearity(const ForceTable& table) {
  std::map<double, const ForceTableRow*> first_at;
  for (const auto& row : table.rows) {
    const auto* first = first_at.try_emplace(row.gap, &row).first->second;
    const double allowed = row.relative_error_estimate + first->relative_error_estimate;
    const double ratio =
        (row.force / row.reference_velocity) / (first->force / first->reference_velocity);
    if (allowed > 0 && std::abs(ratio - 1) > allowed)
      throw Error(ExitCode::kBadInput,
                  fmt::format("at gap {} the force is not linear in the velocity: force over "
                              "velocity differs by {:.2g} relative between {} and {}, "
                              "the rows' error estimates allow {:.2g}",
                              row.gap, ratio - 1, first->reference_velocity, row.reference_velocity,
                              allowed));
  }
}

}  // namespace

std::string_view to_string(Weights weights) {
  return weights == Weights::kRelative ? "relative" : "absolute";
}

Weights parse_weights(std::string_view word) {
  if (word == "relative") return Weights::kRelative;
  if (word == "absolute") return Weights::kAbsolute;
  throw Error(ExitCode::kBadInput, fmt::format("weights '{}'; must be relative or absolute", word));
}

namespace {

/// The coefficient to hold. Throws Error(kBadInput) if neither settings nor table have one.
double held_leading(const ForceTable& table, const FitSettings& settings) {
  if (find_named(settings.basis.terms, kLeadingTerm) == nullptr)
    throw Error(ExitCode::kBadInput, "the basis has no term 1/q whose coefficient could be held");
  if (settings.leading_value) return *settings.leading_value;
  if (!table.leading_coefficient)
    throw Error(ExitCode::kBadInput,
                "the table does not say what theory's coefficient of 1/q is; give the value to hold, or write k of R = "
                "k/q into its header (# leading_coefficient: k)");
  return -*table.leading_coefficient * table.rows.front().reference_velocity;
}

void check_gaps(const ForceTable& table, const FitSettings& settings) {
  std::set<double> gaps;
  for (const auto& row : table.rows) gaps.insert(row.gap);
  const std::size_t needed =
      std::max<std::size_t>(2, settings.basis.terms.size() - (settings.hold_leading ? 1 : 0));
  if (gaps.size() < needed)
    throw Error(ExitCode::kBadInput,
                fmt::format("the table has {} different gap(s); basis {} needs at least {}",
                            gaps.size(), settings.basis.name, needed));
}

}  // namespace

Fit fit_force_table(const ForceTable& table, const FitSettings& settings) {
  check_linearity(table);
  check_gaps(table, settings);
  const auto& basis = settings.basis;
  const auto held = settings.hold_leading ? std::optional(held_leading(table, settings)) : std::nullopt;
  const auto rows = static_cast<Eigen::Index>(table.rows.size());
  const double u0 = table.rows.front().reference_velocity;

  Fit fit;
  fit.basis = basis.name;
  fit.reference_velocity = u0;
  fit.viscosity = table.viscosity;
  fit.radius = table.radius;
  fit.gap_interval = {std::ranges::min_element(table.rows, {}, &ForceTableRow::gap)->gap,
                      std::ranges::max_element(table.rows, {}, &ForceTableRow::gap)->gap};
  fit.weights = settings.weights;
  fit.loss = settings.loss;
  fit.geometry = table.geometry;
  fit.leading_coefficient = table.leading_coefficient;

  Eigen::VectorXd force(rows), weight(rows);
  Eigen::VectorXd left = Eigen::VectorXd::Zero(rows);  // what the held term leaves to the others
  Eigen::MatrixXd terms(rows, static_cast<Eigen::Index>(basis.terms.size()) - (held ? 1 : 0));
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto& row = table.rows[static_cast<std::size_t>(i)];
    const double log_gap = std::log(row.gap);
    force(i) = row.force * (u0 / row.reference_velocity);
    left(i) = force(i);
    Eigen::Index column = 0;
    for (const auto& term : basis.terms) {
      const double value = term.value.at(row.gap, log_gap);
      if (held && term.name == kLeadingTerm)
        left(i) -= *held * value;
      else
        terms(i, column++) = value;
    }
  }
  weight = settings.weights == Weights::kRelative ? Eigen::VectorXd(force.cwiseAbs().cwiseInverse())
                                                  : Eigen::VectorXd::Ones(rows);
  const Eigen::MatrixXd matrix = weight.asDiagonal() * terms;
  const Eigen::VectorXd right_hand_side = weight.cwiseProduct(left);
  const auto solution = solve_robust_least_squares(matrix, right_hand_side, settings.loss);
  const auto& least_squares = solution.least_squares;
  fit.condition_number = least_squares.condition_number;

  // Coefficients and covariance, with a zero row and column for what was held.
  fit.covariance.assign(basis.terms.size(), std::vector<double>(basis.terms.size(), 0.0));
  Eigen::Index free = 0;
  std::vector<Eigen::Index> column_of;
  for (const auto& term : basis.terms) {
    const bool is_held = held && term.name == kLeadingTerm;
    column_of.push_back(is_held ? -1 : free++);
    fit.terms.push_back({std::string(term.name),
                         is_held ? *held : least_squares.coefficients(column_of.back()),
                         is_held ? 0 : std::sqrt(least_squares.covariance(column_of.back(), column_of.back())),
                         is_held});
  }
  for (std::size_t i = 0; i < column_of.size(); ++i)
    for (std::size_t j = 0; j < column_of.size(); ++j)
      if (column_of[i] >= 0 && column_of[j] >= 0)
        fit.covariance[i][j] = least_squares.covariance(column_of[i], column_of[j]);

  FittedSystem system;
  const Eigen::VectorXd root = solution.row_weights.cwiseSqrt();
  const Eigen::VectorXd residual = matrix * least_squares.coefficients - right_hand_side;
  system.weighted_matrix = root.asDiagonal() * matrix;
  system.weighted_residual = root.cwiseProduct(residual);
  system.relative_residual = (terms * least_squares.coefficients - left).cwiseQuotient(force);
  system.scaled_residual = residual / solution.scale;
  fit.largest_relative_residual = system.relative_residual.cwiseAbs().maxCoeff();
  fit.rms_relative_residual = std::sqrt(system.relative_residual.array().square().mean());
  fit.diagnostics = diagnose(table, system, fit);
  return fit;
}

Fit fit_force_table(const ForceTable& table, std::string_view basis, Weights weights) {
  FitSettings settings;
  settings.basis = find_basis(basis);
  settings.weights = weights;
  return fit_force_table(table, settings);
}

}  // namespace viscontact
