// solve_robust_least_squares() of the program, which loads the module least_squares.
#include "viscontact/common/system/module.hpp"
#include "viscontact/fitting/module/least_squares_module.hpp"

namespace viscontact::fitting {

RobustSolution solve_robust_least_squares(const Eigen::MatrixXd& matrix,
                                          const Eigen::VectorXd& right_hand_side,
                                          lubrication::Loss loss, const StopToken& stop) {
  static const auto solve = function_of_module<decltype(viscontact_solve_robust_least_squares)>(
      "least_squares", "viscontact_solve_robust_least_squares");
  RobustSolution solution;
  solve(matrix, right_hand_side, loss, stop, solution);
  return solution;
}

}  // namespace viscontact::fitting
