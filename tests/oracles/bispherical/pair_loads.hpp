// Exact loads of two spheres, or of a sphere above a plane, in unbounded Stokes flow of viscosity 1.
#pragma once

#include <Eigen/Core>

namespace viscontact {

/// Loads of the fluid on the spheres. The axis z goes from sphere 2 to sphere 1, x is across it. A
/// column belongs to a sphere that moves at 1 or turns at 1, everything else being at rest, or to a
/// strain E that this sphere alone feels: its surface then has the velocity -E.(x - centre). S is
/// Batchelor's stresslet (20/3 pi r^3 E of a sphere alone), without trace. The matrices have a
/// block of rows and of columns for each sphere; with the E.S of each strain, rows of strain times
/// -1, and S times 1, 2, 2 in the three groups they are symmetric (Lorentz 1896).
struct PairLoads {
  Eigen::MatrixXd axial;  ///< F_z, S_zz by U_z, E = zz - 1/3
  Eigen::MatrixXd
      trace;  ///< trace of the traction's moment on each sphere, by the columns of `axial`
  Eigen::MatrixXd transverse;  ///< F_x, T_y, S_xz by U_x, W_y, E = xz + zx
  Eigen::MatrixXd twofold;     ///< S_xx by E = xx - yy
  Eigen::MatrixXd spin;        ///< T_z by W_z
};

/// Bispherical harmonics of azimuthal modes 0, 1, 2 (Lee & Leal 1980, J. Fluid Mech. 98, 193). The
/// radii are within a factor of 100 of each other, and the gap is above 1e-6 of them. Errors are
/// below 1e-13 of the largest number of a matrix's kind. At gaps of 1, 0.001 and 1e-5 of equal
/// radii it takes 2 ms, 60 ms and 0.6 s.
PairLoads exact_pair_loads(double radius1, double radius2, double gap);

/// The sphere 1 above a plane at rest: blocks of one sphere.
PairLoads exact_loads_above_plane(double radius, double gap);

}  // namespace viscontact
