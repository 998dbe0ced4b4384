// The stress of a suspension and what it consists of, (9.9) and (9.10).
#pragma once

#include <cstddef>

namespace viscontact::particles {

/// At one instant or as the mean over a step. With a gradient that is no simple shear, `viscosity`
/// and its parts are sigma:E/(2 viscosity of the fluid E:E). Without a box there is no volume, so
/// that they and n1, n2, `pressure` are NaN; at rest all of them are 0.
struct Rheology {
  double time = 0;    ///< [T]
  double strain = 0;  ///< since the start of the case [1]
  /// signed_rate_of_strain() of the flow [1/T]: given, or the result of a given stress.
  double shear_rate = 0;
  double viscosity = 0;  ///< sigma_xy/(viscosity of the fluid times shear rate) [1]
  /// (sigma_xx - sigma_yy) and (sigma_yy - sigma_zz) over the viscosity of the fluid and the
  /// magnitude of the shear rate [1].
  double n1 = 0, n2 = 0;
  double pressure = 0;  ///< minus the mean of the normal stresses of the particles, over the same
  /// Parts of `viscosity`. The rest is 1 for the fluid and the part of the repulsion.
  double viscosity_film = 0, viscosity_contact = 0, viscosity_friction = 0;
  std::size_t pairs = 0, contacts = 0;
  double smallest_gap = 0;  ///< [L], infinite without pairs
  double dissipation = 0;   ///< of spheres and contacts, without the fluid's own [M L^2/T^3]
  double net_strain = 0;    ///< the integral of `shear_rate` [1]
  int solutions = 0;        ///< linear problems that the step solved
};

}  // namespace viscontact::particles
