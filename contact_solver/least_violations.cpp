// The motion that violates the constraints of a problem least, by proximal steps.
#include <algorithm>
#include <cmath>
#include <vector>

#include "viscontact/contact_solver/constraint_solver.hpp"
#include "viscontact/contact_solver/methods/block_factor.hpp"

namespace viscontact::contact_solver {
namespace {

struct ViolationTuning {
  // Each step minimises the sum of v^2/(kEpsilon w) over the violated rows plus the square of the
  // change of the motions in the norm of the masses over the length of the step, which keeps the
  // matrix regular. A step multiplies errors by about kEpsilon if the rows determine the motions
  // well.
  static constexpr double kEpsilon = 1e-6;
  static constexpr int kSteps = 30;
};

}  // namespace

template <int D>
std::vector<double> least_violations(const ConstraintProblem<D>& problem) {
  const auto w = row_mobilities(problem);
  UnitMatrix<D> matrix(problem, true);
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
        const double weight = 1 / (ViolationTuning::kEpsilon * w[r]);
        matrix.add_product(b, r, r, weight);
        problem.add_impulse(r, -weight * value, missing);
      }
    }
    if (n == ViolationTuning::kSteps || !matrix.factorise()) break;
    const auto change = matrix.solution_of(missing);
    for (std::size_t u = 0; u < y.size(); ++u)
      for (std::size_t k = 0; k < y[u].size(); ++k) y[u][k] += change[u][k];
  }
  return violations;
}

template std::vector<double> least_violations<2>(const ConstraintProblem<2>&);
template std::vector<double> least_violations<3>(const ConstraintProblem<3>&);

}  // namespace viscontact::contact_solver
