// Constraints between more than two units, against the dense equations that they stand for.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstddef>
#include <vector>

#include "tests/common/random.hpp"
#include "viscontact/constraint_rows/contact_rows.hpp"
#include "viscontact/contact_solver/constraint_solver.hpp"

namespace viscontact::contact_solver {
namespace {

constexpr int kUnits = 40;

/// Units of random masses and motions, of which each inner one is to stay in the middle of its two
/// neighbours (three parts), and whose mean height is given (as many parts as there are units).
ConstraintProblem<2> chain(Random& random, double compliance) {
  ConstraintProblem<2> problem;
  for (int u = 0; u < kUnits; ++u) {
    const std::vector<double> moved{random.uniform(-1, 1), random.uniform(-1, 1)}, turned{0.0};
    problem.units.push_back(particles::unit_of_particle<2>(
        random.uniform(0.5, 2), random.uniform(0.5, 2), moved.data(), turned.data()));
  }
  const auto add = [&](const std::vector<RowPart<2>>& parts, double offset) {
    ConstraintBlock block;
    block.row = problem.rows.size();
    block.is_contact = false;
    block.allowed = 1e-11;
    block.compliance = compliance;
    problem.blocks.push_back(block);
    problem.add_row(offset, parts, 0);
  };
  for (std::int32_t u = 1; u + 1 < kUnits; ++u)
    add({{u - 1, {0, 1, 0}}, {u, {0, -2, 0.3}}, {u + 1, {0, 1, 0}}}, random.uniform(-1, 1));
  std::vector<RowPart<2>> all;
  for (std::int32_t u = 0; u < kUnits; ++u) all.push_back({u, {0.1, 1.0 / kUnits, 0}});
  add(all, -0.5);
  return problem;
}

TEST(RowsOfManyParts, HoldWithTheLeastChangeOfTheMotions) {
  Random random(3);
  for (const double compliance : {0.0, 0.01}) {
    auto problem = chain(random, compliance);
    // J W J^T p + compliance p = -(offset + J y*)
    const auto rows = static_cast<Eigen::Index>(problem.rows.size());
    Eigen::MatrixXd j = Eigen::MatrixXd::Zero(rows, 3 * kUnits);
    Eigen::MatrixXd w = Eigen::MatrixXd::Zero(3 * kUnits, 3 * kUnits);
    Eigen::VectorXd free(3 * kUnits), offset(rows);
    for (Eigen::Index u = 0; u < kUnits; ++u)
      for (Eigen::Index k = 0; k < 3; ++k) {
        const auto& unit = problem.units[static_cast<std::size_t>(u)];
        free[3 * u + k] = unit.free[static_cast<std::size_t>(k)];
        w(3 * u + k, 3 * u + k) = k < 2 ? unit.mobility : unit.turn_mobility[0];
      }
    for (Eigen::Index r = 0; r < rows; ++r) {
      const auto row = static_cast<std::size_t>(r);
      offset[r] = problem.rows[row].offset;
      for (const auto& part : problem.parts_of(row))
        for (Eigen::Index k = 0; k < 3; ++k)
          j(r, 3 * part.unit + k) += part.coefficients[static_cast<std::size_t>(k)];
    }
    Eigen::MatrixXd matrix = j * w * j.transpose();
    matrix.diagonal().array() += compliance;
    const Eigen::VectorXd p = matrix.ldlt().solve(-(offset + j * free));
    const Eigen::VectorXd y = free + w * j.transpose() * p;

    const auto solution = solve_constraints(problem, 100000);
    EXPECT_LE(solution.result.residual, 1);
    // Sweeps alone take far longer in such a chain.
    EXPECT_LT(solution.result.iterations, 2000);
    for (Eigen::Index u = 0; u < kUnits; ++u)
      for (Eigen::Index k = 0; k < 3; ++k)
        EXPECT_NEAR(solution.motions[static_cast<std::size_t>(u)][static_cast<std::size_t>(k)],
                    y[3 * u + k], 1e-7)
            << u;
    for (Eigen::Index r = 0; r < rows; ++r)
      EXPECT_NEAR(problem.impulses[static_cast<std::size_t>(r)], p[r], 1e-5) << r;
  }
}

}  // namespace
}  // namespace viscontact::contact_solver
