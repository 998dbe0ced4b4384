// Boxes that are too small for the flow that strains them.
#pragma once

#include <optional>

#include "viscontact/particles/setting/setting_fault.hpp"
#include "viscontact/suspensions/cell/strained_lattice.hpp"

namespace viscontact::suspensions {

/// Opposite faces of the cell must stay twice `pair_length` [L] apart, the largest distance of a
/// pair, at all times (at the strain rate 1) and, before the start, from `lowest` <= 0 on. The
/// lattice is not kAsTheBox.
std::optional<particles::SettingFault> fault_of_lattice(const StrainedLattice& lattice,
                                                        double pair_length, double lowest);

}  // namespace viscontact::suspensions
