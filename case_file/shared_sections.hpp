// The sections [fluid], [sphere] and [tabulation] (docs/case-file.md), which are the same in cases
// of one sphere and in cases of a rolling sphere.
#pragma once

#include <vector>

#include "viscontact/case_file/keys.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact::case_file {

/// Reads [tabulation] for a fluid of this viscosity [M/(L T)], > 0, and a sphere of this radius
/// [L], > 0. The gaps [L] of the result rise, and the smallest is at least 1e-8 radii. A container
/// is at most 2e5 radii wide and high. Throws Error(kBadInput) with file, line and key for a wrong
/// or missing value, for the same gap or velocity twice, and if the sphere and its neighbour (a
/// plane or another body) do not fit into the container at the largest gap.
freefem_axi::Tabulation read_tabulation(const TomlSection& section, double viscosity,
                                        double radius);

/// [tabulation], tabulation.gaps and tabulation.container in docs/case-file.md.
std::vector<KeyTable> tables_of_tabulation();

/// The keys of [fluid]: viscosity [M/(L T)], > 0, and `density` [M/L^3], >= 0, which keeps its
/// value if the case does not give it.
void fluid_keys(Keys& keys, double& viscosity, double& density);

/// The keys of [sphere]: the radius [L], > 0, and the mass [M], > 0, or the density [M/L^3], > 0,
/// from which the mass follows. What the case does not give keeps its value. If `needs_mass` is
/// true, the case must give mass or density. Throws Error(kBadInput) if it gives both, or if the
/// mass from the density is 0, infinite or denormal.
void sphere_keys(Keys& keys, double& radius, double& density, double& mass, bool needs_mass);

/// The mass [M] of a sphere minus the mass of the fluid that the sphere displaces. This difference
/// times the acceleration of gravity is the weight less the buoyancy (docs/physics.md (4.15)). It
/// is negative if the fluid is denser than the sphere, and may be infinite.
double mass_less_displaced_fluid(double mass, double fluid_density, double radius);

}  // namespace viscontact::case_file
