// Least squares of the constraints of a step (contradiction.hpp), in the units of the case.
#include "viscontact/particles/constraints/contradiction.hpp"

#include <algorithm>
#include <cmath>

#include "viscontact/particles/constraints/unit_matrix.hpp"

namespace viscontact::particles {

template <int D>
std::vector<double> least_violations(const ConstraintProblem<D>& problem) {
  // Proximal steps of the least squares. The term M/h keeps the matrix regular and holds each step
  // back; the part that is missing falls by about kEpsilon in each step for motions that the rows
  // determine well.
  constexpr double kEpsilon = 1e-6;
  constexpr int kSteps = 30;
  const auto w = row_mobilities(problem);
  UnitMatrix<D> matrix(problem);
  auto y = motions<D>(problem, std::vector<double>(problem.rows.size(), 0.0));
  std::vector<double> violations(problem.blocks.size());
  for (int n = 0;; ++n) {
    matrix.set_to_masses();
    std::vector<Motion<D>> missing(y.size(), Motion<D>{});
    for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
      const auto& block = problem.blocks[b];
      violations[b] = 0;
      if (!block.is_contact && block.compliance > 0) continue;
      for (std::size_t r = block.row; r < block.row + (block.is_contact ? 1 : block.rows); ++r) {
        const double value = problem.rows[r].offset + problem.product(r, y);
        if (block.is_contact && value >= 0) continue;
        violations[b] = std::max(violations[b], std::abs(value));
        const double weight = 1 / (kEpsilon * w[r]);
        matrix.add_product(b, r, r, weight);
        problem.add_impulse(r, -weight * value, missing);
      }
    }
    if (n == kSteps || !matrix.factorise()) return violations;
    const auto change = matrix.solution_of(missing);
    for (std::size_t u = 0; u < y.size(); ++u)
      for (std::size_t k = 0; k < y[u].size(); ++k) y[u][k] += change[u][k];
  }
}

template std::vector<double> least_violations<2>(const ConstraintProblem<2>&);
template std::vector<double> least_violations<3>(const ConstraintProblem<3>&);

}  // namespace viscontact::particles
