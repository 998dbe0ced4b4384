// The sections [fluid], [sphere] and [tabulation] (docs/case-file.md), which are the same in cases
// of one sphere and in cases of a rolling sphere. Lengths, masses and times are in the units of the
// case. A wrong value is an Error(kBadInput) with file, line and key. case_file.cpp and
// rolling_case.cpp call these functions. Further keys may be added if they have a default; a change
// must keep accepting users' cases.
#pragma once

#include <vector>

#include "viscontact/case_file/keys.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact::case_file {

/// Reads [tabulation] for a fluid of this viscosity [M/(L T)], > 0, and a sphere of this radius
/// [L], > 0 (neither is checked here). The gaps [L] of the result rise, and the smallest is at
/// least 1e-8 radii. A container is at most 2e5 radii wide and high. Throws Error(kBadInput) with
/// file, line and key for a wrong or missing value, for the same gap or velocity twice, and if the
/// sphere and its neighbour (a plane or another body) do not fit into the container at the largest
/// gap.
freefem_axi::Tabulation read_tabulation(const TomlSection& section, double viscosity,
                                        double radius);

/// What docs/case-file.md says about the keys of [tabulation], of tabulation.gaps and of
/// tabulation.container, in three tables. This function does not throw.
std::vector<KeyTable> tables_of_tabulation();

/// Declares the keys of [fluid] of a case of one sphere: its viscosity [M/(L T)], > 0, and its
/// `density` [M/L^3], >= 0. If the case does not give the density, `density` is not changed.
void fluid_keys(Keys& keys, double& viscosity, double& density);

/// Declares the keys of [sphere]: the radius [L], > 0, and the mass [M], > 0, or the density
/// [M/L^3], > 0, from which the mass follows. If the case gives the mass, `density` is not changed;
/// if it gives neither mass nor density, both are not changed. If `needs_mass` is true, the case
/// must give mass or density. Throws Error(kBadInput) if it gives both, or if the mass from the
/// density is 0, infinite or denormal.
void sphere_keys(Keys& keys, double& radius, double& density, double& mass, bool needs_mass);

/// The mass [M] of a sphere minus the mass of the fluid that the sphere displaces. This difference
/// times the acceleration of gravity is the weight less the buoyancy (docs/physics.md (4.15)). It
/// is 0 if both densities are equal and negative if the fluid is denser. `mass` [M] and `radius`
/// [L] are > 0, `fluid_density` [M/L^3] is >= 0; nothing is checked or thrown, and the result may
/// be infinite.
double mass_less_displaced_fluid(double mass, double fluid_density, double radius);

}  // namespace viscontact::case_file
