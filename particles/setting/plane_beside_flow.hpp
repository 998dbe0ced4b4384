// Which planes may stand beside spheres with lubrication: the undisturbed flow must stick to them.
#pragma once

#include <optional>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/setting/pair_lubrication.hpp"
#include "viscontact/particles/setting/setting_fault.hpp"

namespace viscontact::particles {

/// What of the `[[plane]]` makes its film unknown: a load, a turn, or a flow that changes along the
/// plane or goes through it. `is_wall` says that it belongs to the domain and moves with the flow.
std::optional<SettingFault> fault_of_plane(const Plane& plane, const PairLubrication& pairs,
                                           bool is_wall);

/// The plane must have the mean velocity of the flow between two times [T], whose mean gradient
/// [1/T] is given.
std::optional<SettingFault> fault_of_motion(const Plane& plane, const Gradient& gradient,
                                            double from, double to);

}  // namespace viscontact::particles
