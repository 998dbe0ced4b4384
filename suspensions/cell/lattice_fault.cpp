#include "viscontact/suspensions/cell/lattice_fault.hpp"

#include <fmt/core.h>

#include <cassert>

namespace viscontact::suspensions {

using particles::SettingFault;

std::optional<SettingFault> fault_of_lattice(const StrainedLattice& lattice, double pair_length,
                                             double lowest) {
  assert(lattice.kind() != StrainedLattice::Kind::kAsTheBox);
  const double least = 2 * pair_length, height = lattice.least_height();
  if (height < least)
    return SettingFault{
        "to", fmt::format("makes a box whose faces come as near as {:.6g} while the flow strains "
                          "it; they must stay {:.6g} apart, twice the largest distance of a pair, "
                          "so that the edges must be at least {:.3g} times as long",
                          height, least, least / height)};
  if (lattice.least_height(lowest) < least)
    return SettingFault{
        "strain_rate",
        fmt::format("goes back by the strain {:.6g} beyond its start, where opposite faces of the "
                    "strained cell come nearer than {:.6g}, twice the largest distance of a pair; "
                    "the edges of the box in the plane of the flow must be equal and the flow "
                    "without rotation, or it must go back less far",
                    -lowest, least)};
  return {};
}

}  // namespace viscontact::suspensions
