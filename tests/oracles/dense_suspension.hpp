// Spheres with near-contact lubrication by a dense matrix, from the loads of Reynolds' equation on
// each of two close spheres.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace viscontact::oracles {

struct DenseSuspension {
  std::vector<Eigen::Vector3d> positions;
  std::vector<double> radii;
  Eigen::Vector3d periods = Eigen::Vector3d::Zero();  ///< 0: no period
  double offset = 0;  ///< displacement along x of the image across y
  double viscosity = 1, range = 0.5, regularisation = 1e-3, drag = 1;
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();  ///< row i, column j: du_i/dx_j
  Eigen::VectorXd forces;  ///< force and torque of each sphere, 6 numbers

  struct Solution {
    Eigen::VectorXd motions;     ///< relative to the flow, 6 numbers of each sphere
    Eigen::Matrix3d stresslets;  ///< their sum
    int pairs = 0;
  };
  Solution solve() const;
};

}  // namespace viscontact::oracles
