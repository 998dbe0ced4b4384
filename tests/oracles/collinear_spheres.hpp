// Exact resistance matrices of rigid spheres on a line in unbounded Stokes flow.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace viscontact {

/// R with F_i = sum_j R_ij U_j, F_i the force of sphere i on the fluid, at viscosity 1. Multipole
/// collocation (Gluckman, Pfeffer & Weinbaum 1971, J. Fluid Mech. 50, 705): the stream function is a
/// sum of r^(1-n) and r^(3-n) times Gegenbauer functions about each centre, and its coefficients are
/// fitted to the velocities of the surfaces by least squares. Ten digits hold if each gap is at least
/// a fifth of the larger radius beside it, eight at a tenth. Takes 10 ms for three spheres at gaps of
/// 1, and seconds at 0.02.
Eigen::MatrixXd exact_resistance(const std::vector<double>& radii, const std::vector<double>& gaps);

}  // namespace viscontact
