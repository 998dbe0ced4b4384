// Flows, boxes and pieces of flows that spheres with lubrication cannot have.
#pragma once

#include <optional>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/setting/pair_lubrication.hpp"
#include "viscontact/particles/setting/setting_fault.hpp"

namespace viscontact::particles {

/// The flow must move each image of a sphere along its period. The key is that of a flow that has
/// not only a gradient.
std::optional<SettingFault> fault_of_flow(const PairLubrication& pairs, const Domain& domain);
/// A stress must be given without walls, if there are any.
std::optional<SettingFault> fault_of_stress(const PairLubrication& pairs, bool has_walls);
/// Inertia needs a given rate, and a fluid that accelerates all images of a sphere alike.
std::optional<SettingFault> fault_of_inertia(const PairLubrication& pairs, const Domain& domain);
/// Why no plane can stand there, whatever its place.
std::optional<SettingFault> fault_of_planes(const PairLubrication& pairs, const Domain& domain);
/// Each period must be at least twice `pair_length` [L], the largest distance of a pair, so that
/// each pair has one image that is so near.
std::optional<SettingFault> fault_of_periods(const Domain& domain, double pair_length);
/// A piece of the flow of this length must contain a step of the length h [T].
std::optional<SettingFault> fault_of_piece(double length, double h);

}  // namespace viscontact::particles
