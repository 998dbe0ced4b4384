// Exact resistance matrices of rigid spheres on a line in unbounded Stokes flow. Lengths are in one
// unit. Tests of the tables of a swimmer compare with them.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace viscontact {

/// The matrix R at viscosity 1, [L]: F_i = sum_j R_ij U_j is the force of sphere i on the fluid if
/// sphere j has the velocity U_j, for spheres with these radii [L] and gaps [L] between neighbours,
/// all > 0. Multipole collocation (Gluckman, Pfeffer & Weinbaum 1971, J. Fluid Mech. 50, 705): the
/// stream function is a sum of r^(1-n) and r^(3-n) times Gegenbauer functions about each centre,
/// and its coefficients are fitted to the velocities of the surfaces by least squares. Ten digits
/// are right if each gap is at least a fifth of the larger radius beside it, and eight at a tenth.
/// Three spheres of radius 1 at gaps of 1 take 10 ms, at gaps of 0.02 seconds.
Eigen::MatrixXd exact_resistance(const std::vector<double>& radii, const std::vector<double>& gaps);

}  // namespace viscontact
