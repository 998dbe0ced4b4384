// The fit is the polynomial through S of all rows, where R = mu (R_lub + l exp S) with the
// viscosity mu, the largest radius l and the lubrication R_lub between neighbours.
#include "viscontact/swimmer/fit/fit_resistance.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <optional>

#include "viscontact/common/error.hpp"
#include "viscontact/common/matrices/decompositions.hpp"
#include "viscontact/common/splitmix.hpp"
#include "viscontact/swimmer/resistance/tensor_polynomial.hpp"

namespace viscontact::swimmer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Free choices of the fit and its errors.
struct ResistanceFitTuning {
  // Values of each gap, so that two nodes remain if one is left out.
  static constexpr std::size_t kFewestNodes = 3;
  // Least scale of the entry R_ij over sqrt(R_ii R_jj). It must be that in collinear_spheres.edp,
  // which makes the error estimates of a table.
  static constexpr double kLeastShare = 1e-3;
  // Draws of the errors of a table, each with its own random signs. 16 give the root mean square of
  // a result's change to about a fifth (1/sqrt(32)).
  static constexpr std::uint64_t kDraws = 16;
};

/// The nodes of the polynomials: for each gap, its values in the table [L], rising.
std::vector<std::vector<double>> nodes_of(const ResistanceTable& table) {
  auto nodes = gap_grid(table);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (nodes[k].size() < ResistanceFitTuning::kFewestNodes)
      throw Error(
          ErrorKind::kBadInput,
          "the table has {} values of the gap between spheres {} and {}; a fit needs at least {}",
          nodes[k].size(), k + 1, k + 2, ResistanceFitTuning::kFewestNodes);
  return nodes;
}

/// The rows of the table in the order of ResistanceFit::logarithms. Throws Error(kBadInput) if a
/// combination of gaps is missing or occurs twice.
std::vector<ResistanceRow> sorted_rows(const ResistanceTable& table,
                                       const std::vector<std::vector<double>>& nodes) {
  std::map<std::vector<double>, ResistanceRow> rows;
  for (const auto& row : table.rows) rows.insert({row.gaps, row});
  std::size_t count = 1;
  for (const auto& values : nodes) count *= values.size();
  if (rows.size() != count || table.rows.size() != count)
    throw Error(ErrorKind::kBadInput,
                "the table has {} rows; a fit needs each of the {} combinations of its gaps once",
                table.rows.size(), count);
  std::vector<ResistanceRow> sorted;
  for (auto& [gaps, row] : rows) sorted.push_back(std::move(row));
  return sorted;
}

/// S = log(R/(mu l) - R_lub/l) with `terms` terms in R_lub. Nothing if the argument of the
/// logarithm is not positive definite.
std::optional<MatrixXd> logarithm_of(const ResistanceRow& row, const ResistanceTable& table,
                                     int terms) {
  const double unit_length = std::ranges::max(table.radii);
  const MatrixXd rest = (matrix_of(row, table.radii.size()) / table.viscosity -
                         lubrication_matrix(table.radii, row.gaps, terms)) /
                        unit_length;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(rest);
  if (!(eigen.eigenvalues().minCoeff() > 0)) return {};
  return MatrixXd(eigen.eigenvectors() * eigen.eigenvalues().array().log().matrix().asDiagonal() *
                  eigen.eigenvectors().transpose());
}

/// R = mu (R_lub + l exp S) [M/T] for S = `logarithm` at these gaps [L].
MatrixXd matrix_from(const MatrixXd& logarithm, const std::vector<double>& gaps,
                     const ResistanceTable& table, int terms) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(logarithm);
  return table.viscosity *
         (lubrication_matrix(table.radii, gaps, terms) +
          std::ranges::max(table.radii) *
              (eigen.eigenvectors() * eigen.eigenvalues().array().exp().matrix().asDiagonal() *
               eigen.eigenvectors().transpose())
                  .eval());
}

/// The value [M/T] by which an error of the entry R_ij is divided to make it relative: |R_ij|, or
/// kLeastShare sqrt(R_ii R_jj) if that is larger.
double entry_scale(const MatrixXd& matrix, Index i, Index j) {
  return std::max(std::abs(matrix(i, j)),
                  ResistanceFitTuning::kLeastShare * std::sqrt(matrix(i, i) * matrix(j, j)));
}

/// The largest relative difference [1] of an entry of two matrices.
double relative_difference(const MatrixXd& fitted, const MatrixXd& exact) {
  double largest = 0;
  for (Index i = 0; i < exact.rows(); ++i)
    for (Index j = i; j < exact.cols(); ++j)
      largest = std::max(largest, std::abs(fitted(i, j) - exact(i, j)) / entry_scale(exact, i, j));
  return largest;
}

/// Adds to each entry of the row's matrix its error estimate with a random sign.
void change_by_estimates(ResistanceRow& row, SplitMix64& random) {
  const std::size_t spheres = row.gaps.size() + 1;
  const MatrixXd matrix = matrix_of(row, spheres);
  for (std::size_t i = 0; i < spheres; ++i)
    for (std::size_t j = i; j < spheres; ++j) {
      const auto entry = entry_position(i, j, spheres);
      const double error = row.relative_error_estimates[entry] *
                           entry_scale(matrix, static_cast<Index>(i), static_cast<Index>(j));
      row.entries[entry] += random.below(2) == 0 ? error : -error;
    }
}

/// The barycentric weights of the nodes of gap k. The variable of the polynomials is the inverse
/// distance of centres [1/L].
Eigen::VectorXd weights_of(const ResistanceFit& fit, std::size_t k) {
  Eigen::VectorXd inverse(static_cast<Index>(fit.gaps[k].size()));
  for (std::size_t i = 0; i < fit.gaps[k].size(); ++i)
    inverse[static_cast<Index>(i)] = 1 / (fit.gaps[k][i] + fit.radii[k] + fit.radii[k + 1]);
  return barycentric_weights(inverse);
}

/// Calls `use` with the indices of the matrices S on each line of the grid along gap k, on which
/// only gap k changes.
template <class Use>
void for_each_line(const ResistanceFit& fit, std::size_t k, const Use& use) {
  std::size_t inner = 1;
  for (std::size_t later = k + 1; later < fit.gaps.size(); ++later) inner *= fit.gaps[later].size();
  const std::size_t count = fit.gaps[k].size();
  for (std::size_t outer = 0; outer < fit.logarithms.size() / (inner * count); ++outer)
    for (std::size_t rest = 0; rest < inner; ++rest) {
      std::vector<std::size_t> line;
      for (std::size_t i = 0; i < count; ++i) line.push_back((outer * count + i) * inner + rest);
      use(line);
    }
}

/// The sum over i of weights_i S_i on a line of n nodes. It is 0 if S is a polynomial of degree n -
/// 2 or less in the inverse distance.
MatrixXd weighted_sum(const ResistanceFit& fit, const Eigen::VectorXd& weights,
                      const std::vector<std::size_t>& line) {
  MatrixXd sum = MatrixXd::Zero(fit.logarithms[0].rows(), fit.logarithms[0].cols());
  for (std::size_t i = 0; i < line.size(); ++i)
    sum += weights[static_cast<Index>(i)] * fit.logarithms[line[i]];
  return sum;
}

/// Sets the residual of the fit and its leave-one-out errors. The polynomial through all nodes of a
/// line except node i has at node i the value S_i - (sum_j w_j S_j)/w_i, with the barycentric
/// weights w.
void measure_errors(ResistanceFit& fit, const ResistanceTable& table,
                    const std::vector<ResistanceRow>& rows) {
  const std::size_t spheres = fit.radii.size();
  for (std::size_t m = 0; m < rows.size(); ++m)
    fit.largest_relative_residual =
        std::max(fit.largest_relative_residual,
                 relative_difference(
                     matrix_from(fit.logarithms[m], rows[m].gaps, table, fit.lubrication_terms),
                     matrix_of(rows[m], spheres)));
  double squares = 0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < fit.gaps.size(); ++k) {
    const auto weights = weights_of(fit, k);
    for_each_line(fit, k, [&](const std::vector<std::size_t>& line) {
      const MatrixXd sum = weighted_sum(fit, weights, line);
      for (std::size_t i = 0; i < line.size(); ++i) {
        const auto& row = rows[line[i]];
        const MatrixXd predicted = fit.logarithms[line[i]] - sum / weights[static_cast<Index>(i)];
        const double error =
            relative_difference(matrix_from(predicted, row.gaps, table, fit.lubrication_terms),
                                matrix_of(row, spheres));
        fit.largest_left_one_out_error = std::max(fit.largest_left_one_out_error, error);
        squares += error * error;
        ++count;
      }
    });
  }
  fit.rms_left_one_out_error = std::sqrt(squares / static_cast<double>(count));
}

/// The fit with `terms` terms of lubrication, without its errors. Nothing if a matrix of the table
/// minus its lubrication is not positive definite.
std::optional<ResistanceFit> fit_with(const ResistanceTable& table, int terms,
                                      const std::vector<ResistanceRow>& rows) {
  ResistanceFit fit;
  fit.viscosity = table.viscosity;
  fit.radii = table.radii;
  fit.container = table.container;
  fit.lubrication_terms = terms;
  fit.gaps = nodes_of(table);
  for (const auto& row : rows) {
    const auto logarithm = logarithm_of(row, table, terms);
    if (!logarithm) return {};
    fit.logarithms.push_back(*logarithm);
  }
  return fit;
}

}  // namespace

ResistanceFit fit_resistance(const ResistanceTable& table) {
  assert(table.radii.size() >= 2);
  const auto rows = sorted_rows(table, nodes_of(table));
  std::optional<ResistanceFit> best;
  for (int terms = 0; terms <= kLubricationTerms; ++terms) {
    auto fit = fit_with(table, terms, rows);
    if (!fit) continue;
    measure_errors(*fit, table, rows);
    if (!best || fit->largest_left_one_out_error < best->largest_left_one_out_error) best = fit;
  }
  if (!best)
    throw Error(ErrorKind::kBadInput, "the table has a matrix that is not positive definite");
  return *best;
}

PerturbedFits perturbed_fits(const ResistanceTable& table, const ResistanceFit& fit) {
  assert(fit.radii == table.radii && !fit.logarithms.empty());
  PerturbedFits perturbed;
  // With the barycentric weights w, S - w (w.S)/(w.w) is the least-squares polynomial of one degree
  // less, because on the nodes w is orthogonal to all polynomials of that degree.
  for (std::size_t k = 0; k < fit.gaps.size(); ++k) {
    const auto weights = weights_of(fit, k);
    auto lower = fit;
    for_each_line(fit, k, [&](const std::vector<std::size_t>& line) {
      const MatrixXd sum = weighted_sum(fit, weights, line) / weights.squaredNorm();
      for (std::size_t i = 0; i < line.size(); ++i)
        lower.logarithms[line[i]] -= weights[static_cast<Index>(i)] * sum;
    });
    perturbed.lower_degrees.push_back(std::move(lower));
  }
  const auto rows = sorted_rows(table, fit.gaps);
  for (std::uint64_t draw = 0; draw < ResistanceFitTuning::kDraws; ++draw) {
    SplitMix64 random(draw);
    auto changed = rows;
    for (auto& row : changed) change_by_estimates(row, random);
    // Errors as large as an eigenvalue make the matrix indefinite, so that there is no fit.
    if (auto fitted = fit_with(table, fit.lubrication_terms, changed))
      perturbed.table_errors.push_back(std::move(*fitted));
  }
  return perturbed;
}

}  // namespace viscontact::swimmer
