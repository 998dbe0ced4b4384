// A matrix W as the mobility of imagined units, and the rounds for its skew part.
#include "viscontact/contact_solver/dense_constraints.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

#include "viscontact/common/matrices/decompositions.hpp"
#include "viscontact/contact_solver/constraint_solver.hpp"

namespace viscontact::contact_solver {
namespace {

using Eigen::Index;

struct DenseTuning {
  // Each round multiplies the error by about the ratio of the skew part of W to the symmetric part.
  static constexpr int kMostRounds = 40;
  // Imagined degrees of freedom of a unit: those of a disc.
  static constexpr Index kOfUnit = 3;
};

/// The eigenvectors of a symmetric matrix W with a positive diagonal that is known up to a relative
/// error, after its rows and columns were scaled to the diagonal 1. Eigenvectors whose eigenvalue
/// is 0 within the error are unmoved: no impulse changes the sum of the rows, each divided by
/// (W_rr)^(1/2), with the entries of such a vector as weights.
struct MovedDirections {
  Eigen::MatrixXd root;     ///< a matrix L with W = L L^T within the error
  Eigen::MatrixXd unmoved;  ///< as columns
  Eigen::VectorXd scales;   ///< (W_rr)^(1/2)

  /// `w` is W [T/M], and `error` [1] its relative error.
  MovedDirections(const Eigen::MatrixXd& w, double error) : scales(w.diagonal().cwiseSqrt()) {
    assert(w.rows() == w.cols() && error > 0);
    const Eigen::MatrixXd scaled = w.cwiseQuotient(scales * scales.transpose());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(scaled);
    const double least = error * modes.eigenvalues().maxCoeff();
    const auto count = (modes.eigenvalues().array() <= least).count();  // they come first
    unmoved = modes.eigenvectors().leftCols(count);
    Eigen::VectorXd roots = modes.eigenvalues().cwiseMax(0).cwiseSqrt();
    roots.head(count).setZero();
    root = scales.asDiagonal() * modes.eigenvectors() * roots.asDiagonal();
  }

  /// Removes from the offsets [L] the sums that no impulse can change, if the error `rounding` [L]
  /// of each offset explains them. Otherwise the impulses would grow without end.
  Eigen::VectorXd consistent(const Eigen::VectorXd& offsets, double rounding) const {
    Eigen::VectorXd scaled = offsets.cwiseQuotient(scales);
    for (Index m = 0; m < unmoved.cols(); ++m) {
      const auto mode = unmoved.col(m);
      const double sum = mode.dot(scaled);
      if (std::abs(sum) <= rounding * mode.cwiseAbs().cwiseQuotient(scales).sum())
        scaled -= sum * mode;
    }
    return scaled.cwiseProduct(scales);
  }
};

/// Adds the rows to a problem whose matrix is W = root root^T. Each column of `root` is an imagined
/// degree of freedom, which a unit impulse moves by a unit length; three of them make a RigidUnit.
void add_rows(const Eigen::MatrixXd& root, std::span<const double> offsets,
              std::span<const double> guesses, ConstraintProblem<2>& problem) {
  assert(offsets.size() == guesses.size() && root.rows() == std::ssize(offsets));
  constexpr Index kOfUnit = DenseTuning::kOfUnit;
  const Index units = (root.cols() + kOfUnit - 1) / kOfUnit;
  RigidUnit<2> unit;
  unit.mobility = unit.inverse_mobility = 1;
  unit.turn_mobility = unit.inverse_turn_mobility = {1};
  problem.units.assign(static_cast<std::size_t>(units), unit);
  std::vector<RowPart<2>> parts(static_cast<std::size_t>(units));
  for (Index r = 0; r < root.rows(); ++r) {
    for (Index u = 0; u < units; ++u) {
      auto& part = parts[static_cast<std::size_t>(u)];
      part = {static_cast<std::int32_t>(u), {}};
      for (Index k = 0; k < kOfUnit && kOfUnit * u + k < root.cols(); ++k)
        part.coefficients[static_cast<std::size_t>(k)] = root(r, kOfUnit * u + k);
    }
    problem.add_row(offsets[static_cast<std::size_t>(r)], parts,
                    guesses[static_cast<std::size_t>(r)]);
  }
}

}  // namespace

SolverResult solve_dense_constraints(DenseConstraints& problem, int max_iterations,
                                     bool gives_loads) {
  const auto n = std::ssize(problem.offsets);
  assert(std::ssize(problem.w) == n * n && std::ssize(problem.impulses) == n && problem.error > 0);
  using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::MatrixXd w = Eigen::Map<const ByRows>(problem.w.data(), n, n);
  const Eigen::MatrixXd symmetric = (w + w.transpose()) / 2, skew = w - symmetric;
  const MovedDirections directions(symmetric, problem.error);
  double allowed = std::numeric_limits<double>::infinity();
  for (const auto& block : problem.blocks) allowed = std::min(allowed, block.allowed);
  const Eigen::Map<const Eigen::VectorXd> without(problem.offsets.data(), n);
  SolverResult result;
  for (int round = 0;
       round < DenseTuning::kMostRounds && (gives_loads || result.iterations < max_iterations);
       ++round) {
    const Eigen::VectorXd before = Eigen::Map<const Eigen::VectorXd>(problem.impulses.data(), n);
    const auto offsets = directions.consistent(without + skew * before, problem.rounding);
    ConstraintProblem<2> of_units;
    of_units.blocks = problem.blocks;
    add_rows(directions.root, {offsets.data(), problem.offsets.size()}, problem.impulses, of_units);
    const auto solved = gives_loads
                            ? solve_with_given_loads(of_units, false).result
                            : solve_constraints(of_units, max_iterations - result.iterations,
                                                ConstraintStart::kLeastImpulses)
                                  .result;
    result.iterations += solved.iterations;
    result.stages += solved.stages;
    result.residual = solved.residual;
    problem.impulses = of_units.impulses;
    const Eigen::VectorXd change =
        skew * (Eigen::Map<const Eigen::VectorXd>(problem.impulses.data(), n) - before);
    if (gives_loads || change.cwiseAbs().maxCoeff() <= allowed) break;
  }
  return result;
}

}  // namespace viscontact::contact_solver
