// Axisymmetric Stokes flows in a cylinder that have no singularity in it and are at rest on its
// floor z = 0. Lengths are in one unit; sphere_in_cylinder.cpp sums them.
#pragma once

#include <vector>

namespace viscontact {

/// A Stokes stream function psi and its derivatives in cylindrical coordinates (rho, z). The
/// velocity has the components psi_z/rho along rho and -psi_rho/rho along z.
struct StreamFunction {
  long double value, d_rho, d_z;
};

/// Flows whose sums approximate every flow that forces outside the cylinder drive. The error falls
/// exponentially with the square root of their number (the "lightning" method, Brubeck & Trefethen
/// 2022, SIAM J. Sci. Comput. 44, A1205). With the operator E^2 of the stream function, psi = z A
/// and psi = z A_z - A are such flows for each function A that is odd in z with E^2 A = 0. Here A
/// is a polynomial, or a source on a ring outside the cylinder. The rings come closer and closer to
/// the two corners, where the flow has Moffatt's weak singularities.
class FloorFields {
 public:
  FloorFields(long double radius, long double height);

  int count() const { return count_; }
  /// The stream functions of all flows at a point of the closed cylinder.
  std::vector<StreamFunction> at(long double rho, long double z) const;

 private:
  struct Ring {
    long double radius, z;
  };

  long double length_;  ///< the farthest point's distance from the origin
  std::vector<Ring> rings_;
  int count_;
};

}  // namespace viscontact
