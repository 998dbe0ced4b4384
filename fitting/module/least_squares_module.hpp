// The function of the module least_squares.
#pragma once

#include "viscontact/fitting/robust_least_squares.hpp"

namespace viscontact::fitting {

/// Sets `solution` to the result of solve_robust_least_squares(), and throws its errors.
extern "C" void viscontact_solve_robust_least_squares(const Eigen::MatrixXd& matrix,
                                                      const Eigen::VectorXd& right_hand_side,
                                                      lubrication::Loss loss, const StopToken& stop,
                                                      RobustSolution& solution);

}  // namespace viscontact::fitting
