// Sums of the stresses of all pairs, and the viscosity from them, (9.10).
#pragma once

#include "viscontact/suspensions/rheology.hpp"
#include "viscontact/suspensions/stress.hpp"

namespace viscontact::suspensions {

/// Sums over all spheres or pairs [M L^2/T^2]; a force of pairs has the dyad of the vector from the
/// first to the second sphere and the force on the first.
struct StressSums {
  SymmetricTensor film, contact, friction, repulsion;
};

/// Sets the members of `rheology` that are stresses over the viscosity and shear rate. `volume` [L^3]
/// is infinite without a box.
void set_stresses(const StressSums& sums, const SymmetricTensor& strain_rate, double viscosity,
                  double volume, particles::Rheology& rheology);

}  // namespace viscontact::suspensions
