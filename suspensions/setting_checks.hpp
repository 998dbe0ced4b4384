// Settings and starts that a suspension cannot have.
#pragma once

#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

/// Throws Error(kBadInput) if a period is shorter than two pairs of the length `pair_length` [L],
/// if the flow does not carry the images of spheres, if spheres with inertia or pieces of the flow
/// cannot be computed, or if a stress is given beside a motion that needs a given rate.
void check_setting(const Setting& setting, double pair_length);

/// Throws Error(kBadInput) if spheres with inertia go on from `state` in a flow that has another
/// gradient along a period, because their velocities would not be those of their images.
void check_flow_before(const Setting& setting, const State& state);

/// Throws Error(kBadInput) if motions are given, if spheres overlap, where `smallest_gap` [L] is
/// that of all pairs, or if one has no mass with inertia.
void check_spheres(const Setting& setting, const Particles& particles, double smallest_gap);

}  // namespace viscontact::particles
