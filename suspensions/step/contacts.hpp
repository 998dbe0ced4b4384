// Contacts of a step, (9.13) to (9.16).
#pragma once

#include <algorithm>
#include <cstdint>

#include "viscontact/suspensions/values/lanes.hpp"

namespace viscontact::suspensions {

/// The multiplier of a contact in the augmented Lagrangian.
struct Contact {
  std::int32_t pair = 0;
  bool pushes = false;    // its load is above the least one
  double load = 0;        // ContactMemory::load
  double least_load = 0;  // ContactMemory::least_load
  double width = 0;       // of the film at contact [L]
  double stiffness = 0;   // [M/T]
  double beside = 0;      // what else resists a change of the gap, such as the film [M/T]

  // The load at the width `at` of the film.
  double trial_load(double at, double h) const { return load - stiffness * (at - width) / h; }
  // The load with which the gap would be that of contact.
  double next_load(double at, double h) const {
    return std::max(load - (stiffness + beside) * (at - width) / h, least_load);
  }
};

enum class ContactState : std::uint8_t { kOpen, kSticks, kSlides };

/// What a contact has besides if there is friction.
struct alignas(kLaneAlignment) FrictionContact {
  std::int32_t contact = 0, pair = 0;
  double borne_by_film = 0;  // part of the load that has no friction, (gamma - gamma_min)/h
  ContactState state = ContactState::kOpen;
  // [L]: l of the pair, by which forces across the normal turn it, and its parts.
  double arm = 0, arm_first = 0, arm_second = 0;
  double stiffness_across = 0;
  Lanes friction{};
  // Where friction was linearised: slip, friction, stiffness, and the direction without stiffness.
  bool slides = false;
  double given_bound = 0;  // of friction, unless it is that of the load
  Lanes at_slip{}, at_friction{}, direction{};
  Lanes at_load{};  // of friction without motion
  double at_stiffness = 0;
  double turn_first = 0, turn_mixed = 0, turn_second = 0;  // of the film
};

}  // namespace viscontact::suspensions
