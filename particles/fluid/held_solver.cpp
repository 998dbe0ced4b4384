// Forces that keep linear conditions on the velocities of particles in a fluid (held_solver.hpp).
#include "viscontact/particles/fluid/held_solver.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "viscontact/common/error.hpp"

namespace viscontact::particles {

using Eigen::Index;

HeldSolver::HeldSolver(std::unique_ptr<FluidSolver> solver, double relative_error)
    : solver_(std::move(solver)), relative_error_(relative_error) {}

void HeldSolver::hold(std::vector<HeldRow> rows, double h) {
  rows_ = std::move(rows);
  h_ = h;
}

/// A v.
Eigen::VectorXd HeldSolver::sums(std::span<const double> velocities) const {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(static_cast<Index>(rows_.size()));
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (const auto& [component, coefficient] : rows_[r].entries)
      sums[static_cast<Index>(r)] += coefficient * velocities[component];
  return sums;
}

void HeldSolver::add_row_forces(std::span<double> forces, const Eigen::VectorXd& of_rows) const {
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (const auto& [component, coefficient] : rows_[r].entries)
      forces[component] += coefficient * of_rows[static_cast<Index>(r)];
}

void HeldSolver::add_responses(std::span<double> velocities, const Eigen::VectorXd& forces) const {
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (std::size_t i = 0; i < velocities.size(); ++i)
      velocities[i] += forces[static_cast<Index>(r)] * responses_[r][i];
}

void HeldSolver::place(const FluidParticles& bodies) {
  solver_->place(bodies);
  is_varied_ = false;
  responses_.clear();
  const std::size_t motions =
      bodies.particles->count() * motion_components(bodies.particles->dimension);
  const auto n = static_cast<Index>(rows_.size());
  matrix_.resize(n, n);
  for (Index r = 0; r < n; ++r) {
    std::vector<double> forces(motions);
    add_row_forces(forces, Eigen::VectorXd::Unit(n, r));
    responses_.push_back(solver_->velocities(forces, false));
    matrix_.col(r) = sums(responses_.back());
  }
  matrix_ = (matrix_ + matrix_.transpose().eval()) / 2;
}

double HeldSolver::theta(Index r) const {
  const double z = h_ * rows_[static_cast<std::size_t>(r)].stiffness * matrix_(r, r);
  return (1 + z) / (2 + z);
}

/// The forces of the rows that add `right` to their sums. Without springs, their forces are 0.
Eigen::VectorXd HeldSolver::solve(const Eigen::VectorXd& right, bool with_springs) const {
  std::vector<Index> taken;
  for (Index r = 0; r < right.size(); ++r)
    if (with_springs || !(rows_[static_cast<std::size_t>(r)].stiffness > 0)) taken.push_back(r);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(right.size());
  if (taken.empty()) return result;
  Eigen::MatrixXd matrix = matrix_(taken, taken);
  // Rows of lengths and of angles are made comparable.
  Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
  for (std::size_t i = 0; i < taken.size(); ++i)
    if (const double k = rows_[static_cast<std::size_t>(taken[i])].stiffness; k > 0)
      matrix.diagonal()[static_cast<Index>(i)] += 1 / (k * theta(taken[i]) * h_);
  matrix = scale.asDiagonal() * matrix * scale.asDiagonal();
  // Redundant rows, which are singular but for the errors of the answers, share the least forces.
  constexpr double kAboveErrors = 10;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factor;
  factor.setThreshold(kAboveErrors * relative_error_);
  factor.compute(matrix);
  const Eigen::VectorXd scaled = scale.cwiseProduct(right(taken));
  Eigen::VectorXd forces = factor.solve(scaled);
  forces += factor.solve(scaled - matrix * forces);
  result(taken) = scale.cwiseProduct(forces);
  return result;
}

/// Throws an error if the forces do not add `right` to the sums of the rows without stiffness.
void HeldSolver::check(const Eigen::VectorXd& right, const Eigen::VectorXd& forces) const {
  const Eigen::VectorXd added = matrix_ * forces;
  double largest = 0;
  for (Index r = 0; r < right.size(); ++r)
    largest = std::max(largest, std::abs(right[r]) + std::abs(added[r]));
  constexpr double kBroken = 1e-4;
  std::string names;
  for (Index r = 0; r < right.size(); ++r) {
    const auto& row = rows_[static_cast<std::size_t>(r)];
    if (row.stiffness > 0 || std::abs(added[r] - right[r]) <= kBroken * largest ||
        names.find(row.name) != std::string::npos)
      continue;
    names += (names.empty() ? "" : ", ") + row.name;
  }
  if (!names.empty())
    throw Error(ErrorKind::kNotConverged,
                fmt::format("the constraints of a step contradict each other: no motion satisfies "
                            "{}; change their lengths or places, or leave one out",
                            names));
}

std::vector<double> HeldSolver::velocities(std::span<const double> forces, bool driving) {
  auto velocities = solver_->velocities(forces, driving);
  if (rows_.empty()) return velocities;
  Eigen::VectorXd given = Eigen::VectorXd::Zero(static_cast<Index>(rows_.size()));
  if (driving)
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const auto& row = rows_[r];
      const auto i = static_cast<Index>(r);
      given[i] = row.stiffness > 0 ? -row.extension / (theta(i) * h_) : row.rate;
    }
  const Eigen::VectorXd right = given - sums(velocities);
  auto of_rows = solve(right, true);
  if (!driving) {
    add_responses(velocities, of_rows);
    return velocities;
  }
  check(right, of_rows);
  if (is_varied_) correct(given, forces, of_rows);
  row_forces_.assign(of_rows.begin(), of_rows.end());
  std::vector<double> all(forces.begin(), forces.end());
  add_row_forces(all, of_rows);
  // The flow, of which quantities are asked, is that with these forces.
  auto held = solver_->velocities(all, true);
  std::vector<double> rest(rows_.size());
  const auto sums_now = sums(held);
  for (std::size_t r = 0; r < rows_.size(); ++r)
    rest[r] = rows_[r].rate - sums_now[static_cast<Index>(r)];
  change(held, rest);
  return held;
}

std::vector<double> HeldSolver::velocities_without_springs(std::span<const double> forces) {
  auto velocities = solver_->velocities(forces, false);
  if (!rows_.empty()) add_responses(velocities, solve(-sums(velocities), false));
  return velocities;
}

void HeldSolver::change(std::span<double> velocities, std::span<const double> changes) const {
  if (rows_.empty()) return;
  const auto right =
      Eigen::Map<const Eigen::VectorXd>(changes.data(), static_cast<Index>(changes.size()));
  add_responses(velocities, solve(right, false));
}

std::vector<double> HeldSolver::spring_forces() const {
  std::vector<double> forces(responses_.empty() ? 0 : responses_.front().size());
  Eigen::VectorXd of_springs = Eigen::VectorXd::Zero(static_cast<Index>(rows_.size()));
  for (std::size_t r = 0; r < rows_.size() && r < row_forces_.size(); ++r)
    if (rows_[r].stiffness > 0) of_springs[static_cast<Index>(r)] = row_forces_[r];
  add_row_forces(forces, of_springs);
  return forces;
}

double HeldSolver::vary_penalty() {
  is_varied_ = true;
  return solver_->vary_penalty();
}

SecondMesh HeldSolver::vary_mesh() {
  is_varied_ = true;
  return solver_->vary_mesh();
}

/// Corrects forces of the rows that were computed with the mobility of the placement, for a mesh or
/// a penalty that differs from it. Each correction multiplies what is missing by about the relative
/// difference of both mobilities, which is an error of discretisation. `right` is what the rows, with
/// their compliance, must add up to under `forces`.
void HeldSolver::correct(const Eigen::VectorXd& right, std::span<const double> forces,
                         Eigen::VectorXd& of_rows) {
  constexpr int kCorrections = 2;
  for (int n = 0; n < kCorrections; ++n) {
    std::vector<double> all(forces.begin(), forces.end());
    add_row_forces(all, of_rows);
    Eigen::VectorXd missing = right - sums(solver_->velocities(all, true));
    for (Index r = 0; r < missing.size(); ++r)
      if (const double k = rows_[static_cast<std::size_t>(r)].stiffness; k > 0)
        missing[r] -= of_rows[r] / (k * theta(r) * h_);
    of_rows += solve(missing, true);
  }
}

}  // namespace viscontact::particles
