// Sums of the stresses of all pairs, and the viscosity from them, (9.10).
#pragma once

#include "viscontact/suspensions/values/rheology.hpp"
#include "viscontact/suspensions/values/stress.hpp"

namespace viscontact::suspensions {

/// The stress of all spheres or pairs, times the volume.
struct StressPart {
  SymmetricTensor stress;  ///< [M L^2/T^2]
  double power = 0;        ///< of the flow against it [M L^2/T^3]

  /// Adds a force [M L/T^2] on the second of two spheres, and its opposite on the first, that are
  /// `apart` [L].
  void add_pair_force(const Vector& force, const Vector& apart,
                      const std::array<Vector, 3>& gradient) {
    stress.add_dyad(-1, apart, force);
    power -= dot(force, times(gradient, apart));
  }
  StressPart& operator+=(const StressPart& other) {
    stress.add(1, other.stress);
    power += other.power;
    return *this;
  }
};

struct StressSums {
  StressPart film, contact, friction, repulsion;
  StressSums& operator+=(const StressSums& other) {
    film += other.film;
    contact += other.contact;
    friction += other.friction;
    repulsion += other.repulsion;
    return *this;
  }
};

/// Sets the shear rate of `rheology` and the members that are stresses over the viscosity and this
/// rate. A rate below `least_rate` [1/T] is rest, and leaves all of them 0. `volume` [L^3] is
/// infinite without a box, where the stresses are NaN.
void set_stresses(const StressSums& sums, const SymmetricTensor& strain_rate, double least_rate,
                  double viscosity, double volume, particles::Rheology& rheology);

}  // namespace viscontact::suspensions
