// Tabulations that several tests ask for.
#pragma once

#include <vector>

#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact::freefem_axi {

/// A sphere of radius 1 in a fluid of viscosity 1, moving at -1 in a closed cylinder, lengths in
/// sphere radii.
inline Tabulation unit_tabulation(std::vector<double> gaps, double container_radius,
                                  double relative_accuracy) {
  Tabulation tabulation;
  tabulation.viscosity = 1;
  tabulation.radius = 1;
  tabulation.gaps = std::move(gaps);
  tabulation.reference_velocities = {-1};
  tabulation.container = Container{container_radius, 2 * container_radius};
  tabulation.relative_accuracy = relative_accuracy;
  return tabulation;
}

}  // namespace viscontact::freefem_axi
