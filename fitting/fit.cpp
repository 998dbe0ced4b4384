#include "fitting/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/error.hpp"
#include "fitting/least_squares.hpp"
#include "fitting/terms.hpp"

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

Fit fit_force_table(const ForceTable& table, std::string_view basis_name, Weights weights) {
  const Basis& basis = find_basis(basis_name);
  check_linearity(table);
  std::set<double> gaps;
  for (const auto& row : table.rows) gaps.insert(row.gap);
  if (gaps.size() < basis.terms.size())
    throw Error(ExitCode::kBadInput,
                fmt::format("the table has {} different gap(s); basis {} needs at least {}",
                            gaps.size(), basis.name, basis.terms.size()));

  const auto rows = static_cast<Eigen::Index>(table.rows.size());
  const auto columns = static_cast<Eigen::Index>(basis.terms.size());
  const double u0 = table.rows.front().reference_velocity;
  Eigen::MatrixXd terms(rows, columns);
  Eigen::VectorXd force(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto& row = table.rows[static_cast<std::size_t>(i)];
    force(i) = row.force * (u0 / row.reference_velocity);
    for (Eigen::Index j = 0; j < columns; ++j)
      terms(i, j) = basis.terms[static_cast<std::size_t>(j)].value(row.gap);
  }
  const Eigen::VectorXd weight = weights == Weights::kRelative
                                     ? Eigen::VectorXd(force.cwiseAbs().cwiseInverse())
                                     : Eigen::VectorXd::Ones(rows);
  const auto solution =
      solve_least_squares(weight.asDiagonal() * terms, weight.cwiseProduct(force));
  const Eigen::ArrayXd relative_residual =
      (terms * solution.coefficients - force).cwiseQuotient(force).array();

  Fit fit;
  fit.basis = basis.name;
  fit.reference_velocity = u0;
  fit.viscosity = table.viscosity;
  fit.radius = table.radius;
  fit.gap_interval = {*gaps.begin(), *gaps.rbegin()};
  fit.weights = weights;
  fit.largest_relative_residual = relative_residual.abs().maxCoeff();
  fit.rms_relative_residual = std::sqrt(relative_residual.square().mean());
  fit.condition_number = solution.condition_number;
  for (Eigen::Index j = 0; j < columns; ++j) {
    fit.terms.push_back({std::string(basis.terms[static_cast<std::size_t>(j)].name),
                         solution.coefficients(j), std::sqrt(solution.covariance(j, j))});
    const Eigen::VectorXd covariances = solution.covariance.row(j);
    fit.covariance.emplace_back(covariances.begin(), covariances.end());
  }
  return fit;
}

}  // namespace viscontact
