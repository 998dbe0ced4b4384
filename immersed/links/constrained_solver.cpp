// Forces that keep linear conditions on velocities: A S A^T l = rate - A S f
// (constrained_solver.hpp).
#include "viscontact/immersed/links/constrained_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "viscontact/common/error.hpp"
#include "viscontact/common/matrices/decompositions.hpp"

namespace viscontact::particles {

using Eigen::Index;

namespace {

/// Free choices of the solver for linear conditions on velocities.
struct ConstrainedSolverTuning {
  // Numbers below this factor times the relative errors of the velocities count as zero.
  static constexpr double kAboveErrors = 10;
  // Geometric rows act where their z is at least this. Without them the motion is stable up to 1
  // without masses, and up to 2 with masses, where they damp an oscillation that is resolved.
  static constexpr double kResolved = 0.05, kResolvedWithMass = 0.1;
  // The least theta keeps 1/theta finite. It changes the force of a spring by less than the
  // relative error of the fluid solver's velocities does, which is at least 1e-9
  // (error_of_answers()).
  static constexpr double kLeastTheta = 1e-9;
  // The forces of links hardly depend on how fast the links turn, so that few rounds are needed.
  // Stiffnesses that are not settled make the step less accurate.
  static constexpr int kRounds = 50;
  static constexpr double kSettled = 1e-8;
  // A row is broken if its error exceeds this part of the largest sum. It is far above the relative
  // error of the velocities, which is usually 1e-9.
  static constexpr double kBroken = 1e-4;
  // Each correction multiplies the error of the sums by about the relative difference of both
  // mobilities, which is small.
  static constexpr int kCorrections = 2;
};

}  // namespace

ConstrainedSolver::ConstrainedSolver(std::unique_ptr<FluidSolver> solver, double relative_error,
                                     bool has_inertia)
    : solver_(std::move(solver)), relative_error_(relative_error), has_inertia_(has_inertia) {
  assert(solver_ != nullptr);
  assert(relative_error > 0);
}

void ConstrainedSolver::hold(std::vector<VelocityConstraint> rows, double h) {
  assert(h > 0);
  rows_ = std::move(rows);
  stiffnesses_.clear();
  row_forces_.clear();
  h_ = h;
}

Eigen::VectorXd ConstrainedSolver::sums(std::span<const double> velocities) const {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(static_cast<Index>(rows_.size()));
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (const auto& [component, coefficient] : rows_[r].entries)
      sums[static_cast<Index>(r)] += coefficient * velocities[component];
  return sums;
}

void ConstrainedSolver::add_row_forces(std::span<double> forces,
                                       const Eigen::VectorXd& of_rows) const {
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (const auto& [component, coefficient] : rows_[r].entries)
      forces[component] += coefficient * of_rows[static_cast<Index>(r)];
}

void ConstrainedSolver::add_responses(std::span<double> velocities,
                                      const Eigen::VectorXd& forces) const {
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (std::size_t i = 0; i < velocities.size(); ++i)
      velocities[i] += forces[static_cast<Index>(r)] * responses_[r][i];
}

void ConstrainedSolver::place(const FluidParticles& bodies) {
  solver_->place(bodies);
  is_varied_ = false;
  responses_.clear();
  row_forces_.clear();
  motions_ = bodies.particles->count() * motion_components(bodies.particles->dimension);
  respond();
}

void ConstrainedSolver::turn_with(std::span<const VelocityConstraint> rows) {
  assert(std::ranges::count_if(rows_, &VelocityConstraint::is_geometric) <= std::ssize(rows));
  std::size_t known = 0;
  for (auto& row : rows_)
    if (row.is_geometric) row.stiffness = rows[known++].stiffness;
  if (known == rows.size()) return;
  rows_.insert(rows_.end(), rows.begin() + static_cast<std::ptrdiff_t>(known), rows.end());
  respond();
}

void ConstrainedSolver::respond() {
  const auto n = static_cast<Index>(rows_.size());
  matrix_.resize(n, n);
  while (responses_.size() < rows_.size()) {
    std::vector<double> forces(motions_);
    add_row_forces(forces, Eigen::VectorXd::Unit(n, static_cast<Index>(responses_.size())));
    responses_.push_back(solver_->velocities(forces, false));
  }
  for (Index r = 0; r < n; ++r) matrix_.col(r) = sums(responses_[static_cast<std::size_t>(r)]);
  if (!has_inertia_) matrix_ = (matrix_ + matrix_.transpose().eval()) / 2;
  auto stiffnesses = std::move(stiffnesses_);
  for (std::size_t r = stiffnesses.size(); r < rows_.size(); ++r)
    stiffnesses.push_back(std::max(rows_[r].stiffness, 0.0));
  fixed_.clear();
  springs_.clear();
  if (n > 0) factorise();
  set_stiffnesses(std::move(stiffnesses));
}

double ConstrainedSolver::theta_for(double z, const VelocityConstraint& row) const {
  if (has_inertia_) {
    return std::isfinite(z * z)
               ? std::max(ConstrainedSolverTuning::kLeastTheta, 2 * z * z / (2 + z * z))
               : 2;
  }
  if (row.accelerates) z *= z;
  if (row.accelerates && row.is_geometric) z *= z;
  return std::isfinite(z) ? (1 + z) / (2 + z) : 1;
}

std::vector<double> ConstrainedSolver::rates_of_turning(
    const std::vector<double>& stiffnesses) const {
  std::vector<double> rates(rows_.size(), 0.0);
  const auto of = [&](std::size_t i) { return static_cast<std::size_t>(springs_[i]); };
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    if (!rows_[of(i)].is_geometric) continue;
    for (std::size_t j = 0; j < springs_.size(); ++j)
      if (rows_[of(j)].is_geometric)
        rates[of(i)] += h_ * std::sqrt(stiffnesses[of(i)] * stiffnesses[of(j)]) *
                        std::abs(spring_matrix_(static_cast<Index>(i), static_cast<Index>(j))) /
                        (scale_[springs_[i]] * scale_[springs_[j]]);
  }
  return rates;
}

void ConstrainedSolver::set_stiffnesses(std::vector<double> stiffnesses) {
  stiffnesses_ = std::move(stiffnesses);
  // Where the step resolves the motion, the row does not act.
  auto rates = rates_of_turning(stiffnesses_);
  std::vector<char> acts(rows_.size(), 0);
  for (std::size_t r = 0; r < rows_.size(); ++r)
    acts[r] = rates[r] >= (rows_[r].accelerates || has_inertia_
                               ? ConstrainedSolverTuning::kResolvedWithMass
                               : ConstrainedSolverTuning::kResolved);
  // Where a unit is turned, the forces that turn it count as forces of the step. The rows across
  // their links must then act, too.
  for (std::size_t r = 0; r < rows_.size(); ++r)
    if (acts[r] != 0 && rows_[r].entries.size() == 1)
      for (std::size_t s = 0; s < rows_.size(); ++s)
        if (rows_[s].of_forces.size() == 1)
          for (const auto& [row, coefficient] : rows_[r].of_forces)
            if (row == rows_[s].of_forces.front().first) acts[s] = 1;
  for (std::size_t r = 0; r < rows_.size(); ++r)
    if (rows_[r].is_geometric && acts[r] == 0) stiffnesses_[r] = 0;
  rates = rates_of_turning(stiffnesses_);
  thetas_.clear();
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const auto i = static_cast<Index>(r);
    const double z = rows_[r].is_geometric ? rates[r] : h_ * stiffnesses_[r] * matrix_(i, i);
    thetas_.push_back(theta_for(z, rows_[r]));
  }
}

std::vector<double> ConstrainedSolver::stiffnesses_for(const Eigen::VectorXd& of_rows) const {
  auto stiffnesses = stiffnesses_;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    if (!rows_[r].is_geometric) continue;
    stiffnesses[r] = rows_[r].stiffness;
    for (const auto& [row, coefficient] : rows_[r].of_forces)
      stiffnesses[r] += coefficient * of_rows[static_cast<Index>(row)];
    if (!(stiffnesses[r] > 0)) stiffnesses[r] = 0;
  }
  return stiffnesses;
}

Eigen::VectorXd ConstrainedSolver::given() const {
  Eigen::VectorXd given(static_cast<Index>(rows_.size()));
  for (std::size_t r = 0; r < rows_.size(); ++r)
    given[static_cast<Index>(r)] =
        (rows_[r].is_spring() ? -rows_[r].extension / (thetas_[r] * h_) : rows_[r].rate) -
        rows_[r].image_rate;
  return given;
}

bool ConstrainedSolver::settle_stiffnesses(std::span<const double> forces, double tolerance) {
  assert(tolerance >= 0);
  const auto before = stiffnesses_;
  const Eigen::VectorXd free = sums(solver_->velocities(forces, true));
  const auto largest_change = [&](const std::vector<double>& from, const std::vector<double>& to) {
    double change = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r)
      if (const double larger = std::max(from[r], to[r]); larger > 0)
        change = std::max(change, std::abs(to[r] - from[r]) / larger);
    return change;
  };
  for (int round = 0; round < ConstrainedSolverTuning::kRounds; ++round) {
    auto next = stiffnesses_for(solve(given() - free, true));
    const double change = largest_change(stiffnesses_, next);
    set_stiffnesses(std::move(next));
    if (change <= ConstrainedSolverTuning::kSettled) break;
  }
  if (largest_change(before, stiffnesses_) > tolerance) return true;
  set_stiffnesses(before);
  return false;
}

std::vector<double> ConstrainedSolver::row_forces_under(std::span<const double> forces) {
  if (rows_.empty()) return {};
  const Eigen::VectorXd of_rows = solve(given() - sums(solver_->velocities(forces, true)), true);
  return {of_rows.begin(), of_rows.end()};
}

Eigen::VectorXd ConstrainedSolver::missing(std::span<const double> velocities) const {
  Eigen::VectorXd missing = -sums(velocities);
  for (std::size_t r = 0; r < rows_.size(); ++r)
    missing[static_cast<Index>(r)] += rows_[r].rate - rows_[r].image_rate;
  return missing;
}

void ConstrainedSolver::factorise() {
  for (Index r = 0; r < matrix_.rows(); ++r)
    (rows_[static_cast<std::size_t>(r)].is_spring() ? springs_ : fixed_).push_back(r);
  // Rows are divided by the root of their mobility, so that those of lengths and of angles have the
  // same size. A row whose particles are all driven has the mobility 0.
  scale_ = matrix_.diagonal().unaryExpr([](double x) { return x > 0 ? 1 / std::sqrt(x) : 1; });
  const Eigen::MatrixXd scaled = scale_.asDiagonal() * matrix_ * scale_.asDiagonal();
  fixed_matrix_ = scaled(fixed_, fixed_);
  // Redundant rows make the matrix singular, up to the errors of the velocities. The decomposition
  // then gives the forces with the least sum of squares.
  const double noise = ConstrainedSolverTuning::kAboveErrors * relative_error_;
  factor_.setThreshold(noise);
  if (!fixed_.empty()) factor_.compute(fixed_matrix_);
  coupling_ = scaled(springs_, fixed_);
  if (springs_.empty()) return;
  spring_responses_ = solve_fixed(scaled(fixed_, springs_));
  spring_matrix_ = scaled(springs_, springs_) - coupling_ * spring_responses_;
  // If the other rows hold both ends of a spring, its mobility should be 0, but consists of errors.
  // Eigenvalues as small as these errors are set to 0: beside the small compliance of a stiff
  // spring they would count as a mobility.
  const Eigen::MatrixXd symmetric = (spring_matrix_ + spring_matrix_.transpose()) / 2;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(symmetric);
  const Eigen::VectorXd kept =
      modes.eigenvalues().unaryExpr([&](double x) { return x > noise ? 1.0 : 0.0; });
  const Eigen::MatrixXd projection =
      modes.eigenvectors() * kept.asDiagonal() * modes.eigenvectors().transpose();
  spring_matrix_ = projection * spring_matrix_ * projection;
}

Eigen::MatrixXd ConstrainedSolver::solve_fixed(const Eigen::MatrixXd& right) const {
  if (fixed_.empty()) return right;
  Eigen::MatrixXd forces = factor_.solve(right);
  // One step of iterative refinement.
  const Eigen::MatrixXd missing = right - fixed_matrix_ * forces;
  forces += factor_.solve(missing);
  return forces;
}

Eigen::VectorXd ConstrainedSolver::solve(const Eigen::VectorXd& right, bool with_springs) const {
  assert(static_cast<std::size_t>(right.size()) == rows_.size());
  const Eigen::VectorXd scaled = scale_.cwiseProduct(right);
  Eigen::VectorXd of_fixed = solve_fixed(scaled(fixed_));
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(right.size());
  // A geometric row whose forces do not pull has no stiffness, and its force is 0.
  std::vector<Index> acting;
  for (std::size_t i = 0; i < springs_.size(); ++i)
    if (stiffnesses_[static_cast<std::size_t>(springs_[i])] > 0)
      acting.push_back(static_cast<Index>(i));
  if (with_springs && !acting.empty()) {
    Eigen::VectorXd rest = (scaled(springs_) - coupling_ * of_fixed)(acting);
    Eigen::MatrixXd matrix = spring_matrix_(acting, acting);
    for (std::size_t i = 0; i < acting.size(); ++i) {
      const Index r = springs_[static_cast<std::size_t>(acting[i])];
      const auto k = static_cast<std::size_t>(r);
      matrix.diagonal()[static_cast<Index>(i)] +=
          scale_[r] * scale_[r] / (stiffnesses_[k] * thetas_[k] * h_);
    }
    // Soft and stiff springs get entries of one size.
    const Eigen::VectorXd own = matrix.diagonal().cwiseSqrt().cwiseInverse();
    matrix = own.asDiagonal() * matrix * own.asDiagonal();
    rest = own.cwiseProduct(rest);
    Eigen::VectorXd of_springs = Eigen::VectorXd::Zero(static_cast<Index>(springs_.size()));
    of_springs(acting) = own.cwiseProduct(matrix.completeOrthogonalDecomposition().solve(rest));
    of_fixed -= spring_responses_ * of_springs;
    forces(springs_) = of_springs;
  }
  forces(fixed_) = of_fixed;
  return scale_.cwiseProduct(forces);
}

void ConstrainedSolver::check(const Eigen::VectorXd& right, const Eigen::VectorXd& forces) const {
  const Eigen::VectorXd scaled = scale_.cwiseProduct(right);
  const Eigen::VectorXd added = scale_.cwiseProduct(matrix_ * forces);
  // The effects of the forces may cancel each other. Errors are therefore relative to the sum of
  // their absolute values.
  const Eigen::VectorXd parts = scale_.cwiseProduct(matrix_.cwiseAbs() * forces.cwiseAbs());
  double largest = 0;
  for (const Index r : fixed_) largest = std::max(largest, std::abs(scaled[r]) + parts[r]);
  std::string names;
  for (const Index r : fixed_) {
    const auto& name = rows_[static_cast<std::size_t>(r)].name;
    if (std::abs(added[r] - scaled[r]) <= ConstrainedSolverTuning::kBroken * largest ||
        names.find(name) != std::string::npos)
      continue;
    names += (names.empty() ? "" : ", ") + name;
  }
  if (!names.empty())
    throw Error(ErrorKind::kNotConverged,
                "the constraints of a step contradict each other: no motion satisfies {}; change "
                "their lengths or places, or leave one out",
                names);
}

std::vector<double> ConstrainedSolver::velocities(std::span<const double> forces, bool driving) {
  auto velocities = solver_->velocities(forces, driving);
  if (rows_.empty()) return velocities;
  Eigen::VectorXd prescribed = Eigen::VectorXd::Zero(static_cast<Index>(rows_.size()));
  if (driving) prescribed = given();
  const Eigen::VectorXd right = prescribed - sums(velocities);
  auto of_rows = solve(right, true);
  if (!driving) {
    add_responses(velocities, of_rows);
    return velocities;
  }
  check(right, of_rows);
  if (is_varied_) correct(prescribed, forces, of_rows);
  row_forces_.assign(of_rows.begin(), of_rows.end());
  std::vector<double> all(forces.begin(), forces.end());
  add_row_forces(all, of_rows);
  // The fluid solver is asked again with these forces, because quantities() and flow() are those of
  // its last solution.
  auto constrained = solver_->velocities(all, true);
  add_responses(constrained, solve(missing(constrained), false));
  return constrained;
}

std::vector<double> ConstrainedSolver::velocities_without_springs(std::span<const double> forces) {
  auto velocities = solver_->velocities(forces, false);
  if (!rows_.empty()) add_responses(velocities, solve(-sums(velocities), false));
  return velocities;
}

std::vector<double> ConstrainedSolver::change(std::span<double> velocities,
                                              std::span<const double> changes,
                                              bool with_springs) const {
  if (rows_.empty()) return {};
  assert(changes.size() == rows_.size());
  const auto right =
      Eigen::Map<const Eigen::VectorXd>(changes.data(), static_cast<Index>(changes.size()));
  const Eigen::VectorXd forces = solve(right, with_springs);
  add_responses(velocities, forces);
  return {forces.begin(), forces.end()};
}

std::vector<double> ConstrainedSolver::row_forces_for(std::span<const double> changes) const {
  if (rows_.empty()) return {};
  const Eigen::VectorXd forces = solve(sums(changes), false);
  return {forces.begin(), forces.end()};
}

std::vector<double> ConstrainedSolver::forces_of_step() const {
  std::vector<double> forces(responses_.empty() ? 0 : responses_.front().size());
  std::vector<char> acts;
  for (const auto& row : rows_) acts.push_back(row.is_spring() || row.accelerates ? 1 : 0);
  for (std::size_t r = 0; r < rows_.size(); ++r)
    if (rows_[r].is_geometric && stiffnesses_[r] > 0)
      for (const auto& [row, coefficient] : rows_[r].of_forces) acts[row] = 1;
  Eigen::VectorXd of_rows = Eigen::VectorXd::Zero(static_cast<Index>(rows_.size()));
  for (std::size_t r = 0; r < rows_.size() && r < row_forces_.size(); ++r)
    if (acts[r] != 0) of_rows[static_cast<Index>(r)] = row_forces_[r];
  add_row_forces(forces, of_rows);
  return forces;
}

void ConstrainedSolver::hold_velocities(std::span<double> velocities) const {
  if (!rows_.empty()) add_responses(velocities, solve(missing(velocities), false));
}

double ConstrainedSolver::vary_penalty() {
  is_varied_ = true;
  return solver_->vary_penalty();
}

SecondMesh ConstrainedSolver::vary_mesh() {
  is_varied_ = true;
  return solver_->vary_mesh();
}

void ConstrainedSolver::correct(const Eigen::VectorXd& right, std::span<const double> forces,
                                Eigen::VectorXd& of_rows) {
  for (int n = 0; n < ConstrainedSolverTuning::kCorrections; ++n) {
    std::vector<double> all(forces.begin(), forces.end());
    add_row_forces(all, of_rows);
    Eigen::VectorXd missing = right - sums(solver_->velocities(all, true));
    for (Index r = 0; r < missing.size(); ++r)
      if (const double k = stiffnesses_[static_cast<std::size_t>(r)]; k > 0)
        missing[r] -= of_rows[r] / (k * thetas_[static_cast<std::size_t>(r)] * h_);
    of_rows += solve(missing, true);
  }
}

}  // namespace viscontact::particles
