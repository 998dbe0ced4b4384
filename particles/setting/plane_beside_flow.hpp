// Which planes may stand beside spheres with lubrication: the undisturbed flow must stick to them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/setting/pair_lubrication.hpp"

namespace viscontact::particles {

struct PlaneFault {
  std::string_view key;  ///< of `[[plane]]`
  std::string message;   ///< goes on after the name of the key or of the plane
};

/// What of the plane makes its film unknown: a load, a turn, or a flow that changes along the plane
/// or goes through it. `is_wall` says that it belongs to the domain and moves with the flow.
std::optional<PlaneFault> fault_of_plane(const Plane& plane, const PairLubrication& pairs,
                                         bool is_wall);

/// The plane must have the mean velocity of the flow between two times [T], whose mean gradient
/// [1/T] is given.
std::optional<PlaneFault> fault_of_motion(const Plane& plane, const Gradient& gradient, double from,
                                          double to);

}  // namespace viscontact::particles
