// The exact matrix of a pair in the order of lubrication/pairs/pair_resistance.hpp.
#pragma once

#include <Eigen/Core>

namespace viscontact {

/// Viscosity 1. From the loads of pair_loads.hpp, whose axis has the other direction.
Eigen::MatrixXd exact_pair_matrix(double radius1, double radius2, double gap);

/// The rows and columns of sphere 1 if sphere 2 is a plane at rest.
Eigen::MatrixXd exact_plane_matrix(double radius, double gap);

}  // namespace viscontact
