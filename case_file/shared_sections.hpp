// Sections that cases of one sphere and of a rolling one share (docs/case-file.md): [fluid],
// [sphere] and [tabulation]. Lengths, masses and times are in the units of the case. A wrong value
// is an Error(kBadInput) with file, line and key. case_file.cpp and rolling_case.cpp call it. A
// change must keep accepting users' cases.
#pragma once

#include <vector>

#include "viscontact/case_file/keys.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact::case_file {

/// Reads [tabulation] for a fluid of this viscosity [M/(L T)], > 0, and a sphere of this radius
/// [L], > 0 (neither is checked here). Its gaps rise, the smallest being at least 1e-8 radii.
/// Throws Error(kBadInput) with file, line and key for a wrong or missing value, for the same gap
/// or velocity twice, and if the sphere and its neighbour do not fit into the container at the
/// largest gap.
freefem_axi::Tabulation read_tabulation(const TomlSection& section, double viscosity,
                                        double radius);

/// What docs/case-file.md says about the keys of [tabulation], of its gaps and of its container:
/// three tables. This does not throw.
std::vector<KeyTable> tables_of_tabulation();

/// Declares the keys of [fluid] of a case of one sphere: its viscosity [M/(L T)], > 0, and its
/// `density` [M/L^3], >= 0, which stays as it is if the case does not give it.
void fluid_keys(Keys& keys, double& viscosity, double& density);

/// Declares the keys of [sphere] that give its radius [L], > 0, and its mass [M], > 0, or its
/// density [M/L^3], > 0, from which its mass follows. If the case gives the mass, `density` stays
/// as it is; if it gives neither, `mass` stays as it is. With `needs_mass` the case must give one
/// of the two. To give both is an error, and so is a mass that is no normal double.
void sphere_keys(Keys& keys, double& radius, double& density, double& mass, bool needs_mass);

/// The mass [M] of a sphere minus that of the fluid which it displaces: times the acceleration of
/// gravity, it is the weight less buoyancy (physics.md (4.15)). It is 0 if both densities are equal
/// and negative if the fluid is denser. `mass` [M], `fluid_density` [M/L^3] >= 0, `radius` [L] > 0;
/// nothing is checked or thrown, and the result may be infinite.
double mass_less_displaced_fluid(double mass, double fluid_density, double radius);

}  // namespace viscontact::case_file
