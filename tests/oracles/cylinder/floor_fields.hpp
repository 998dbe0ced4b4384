// Axisymmetric Stokes flows without singularity in a cylinder, at rest on its floor.
#pragma once

#include <vector>

namespace viscontact {

/// A Stokes stream function and its derivatives; u_rho = psi_z/rho, u_z = -psi_rho/rho.
struct StreamFunction {
  long double value, d_rho, d_z;
};

/// Flows which together approximate any that a smooth force outside the cylinder drives: the error
/// falls exponentially with the square root of their number (the "lightning" method, Brubeck &
/// Trefethen 2022, SIAM J. Sci. Comput. 44, A1205). With E^2 the operator of the stream function,
/// psi = z A and psi = z A_z - A are such flows for each A odd in z with E^2 A = 0. Here A comes
/// from polynomials, and from sources on rings outside, closer and closer to the two corners, where
/// the flow has Moffatt's weak singularities.
class FloorFields {
 public:
  FloorFields(long double radius, long double height);

  int count() const { return count_; }
  /// All of them at a point of the closed cylinder.
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
