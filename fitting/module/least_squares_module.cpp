// The module least_squares: least squares with Ceres.
#include "viscontact/fitting/module/least_squares_module.hpp"

namespace viscontact::fitting {

extern "C" void viscontact_solve_robust_least_squares(const Eigen::MatrixXd& matrix,
                                                      const Eigen::VectorXd& right_hand_side,
                                                      lubrication::Loss loss, const StopToken& stop,
                                                      RobustSolution& solution) {
  solution = solve_robust_least_squares(matrix, right_hand_side, loss, stop);
}

}  // namespace viscontact::fitting
