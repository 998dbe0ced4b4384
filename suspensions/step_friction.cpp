// Coulomb's friction of the contacts of a step, (9.16).
#include <algorithm>
#include <cmath>

#include "viscontact/common/index.hpp"
#include "viscontact/suspensions/step_parts.hpp"

namespace viscontact::suspensions {

Lanes SuspensionStep::slip_by_strain(const Contact& contact) const {
  const Lanes n = system_.resistance().pairs[contact.pair].normal;
  return -contact.arm * cross(n, lanes_of(strain_.times(vector_of(n))));
}

Lanes SuspensionStep::slip_by_motions(const Contact& contact,
                                      const std::vector<Motion>& motions) const {
  const auto& row = system_.resistance().pairs[contact.pair];
  const Lanes n = row.normal;
  const Motion &first = motions[index_of(row.first)], &second = motions[index_of(row.second)];
  const Lanes rotation = row.inverse_arm * cross(n, second.along - first.along);
  const Lanes sum =
      contact.arm_first * (first.turn - rotation) + contact.arm_second * (second.turn - rotation);
  return sum - dot(sum, n) * n;
}

Lanes SuspensionStep::slip(const Contact& contact, const std::vector<Motion>& motions) const {
  return slip_by_motions(contact, motions) + slip_by_strain(contact);
}

double SuspensionStep::friction_bound(const Contact& contact) const {
  return bounds_ == Bounds::kOfLoads ? coulomb_bound(contact) : contact.given_bound;
}

double SuspensionStep::coulomb_bound(const Contact& contact) const {
  return problem_.friction * std::max(contact.memory.load - contact.borne_by_film, 0.0);
}

void SuspensionStep::linearise_friction(Contact& contact, Lanes& turn1, Lanes& turn2) {
  auto& resistance = system_.resistance();
  auto& row = resistance.pairs[contact.pair];
  const Lanes here = slip(contact, motions_);
  const Lanes trial = contact.friction + contact.stiffness_across * here;
  const double size = std::sqrt(dot(trial, trial)), bound = friction_bound(contact);
  contact.slides = size > bound;
  const double share = contact.slides ? bound / size : 1;
  const double stiffness = share * contact.stiffness_across;
  row.turn_first = contact.turn_first + stiffness * contact.arm_first * contact.arm_first;
  row.turn_mixed = contact.turn_mixed + stiffness * contact.arm_first * contact.arm_second;
  row.turn_second = contact.turn_second + stiffness * contact.arm_second * contact.arm_second;
  contact.at_slip = here;
  contact.at_friction = share * trial;
  contact.at_stiffness = stiffness;
  contact.direction = contact.slides ? (1 / size) * trial : Lanes{};
  if (contact.slides)
    resistance.slips.push_back({row.normal, contact.direction, stiffness, contact.arm_first,
                                contact.arm_second, row.first, row.second});
  const Lanes load =
      contact.at_friction - change_of_friction(contact, here - slip_by_strain(contact));
  turn1 = contact.arm_first * load;
  turn2 = contact.arm_second * load;
}

Lanes SuspensionStep::change_of_friction(const Contact& contact, const Lanes& change) {
  return contact.at_stiffness * (change - dot(contact.direction, change) * contact.direction);
}

Lanes SuspensionStep::friction_at(const Contact& contact, const Lanes& at_slip) const {
  const Lanes trial = contact.friction + contact.stiffness_across * at_slip;
  const double size = std::sqrt(dot(trial, trial)), bound = friction_bound(contact);
  return (size > bound ? bound / size : 1) * trial;
}

SuspensionStep::FrictionError SuspensionStep::friction_error() const {
  FrictionError error;
  if (!(problem_.friction > 0)) return error;
  for (const auto& contact : contacts_) {
    const Lanes here = slip(contact, motions_), force = friction_at(contact, here);
    const Lanes trial = force + contact.stiffness_across * here;
    const double size = std::sqrt(dot(trial, trial));
    const auto error_of = [&](double bound) {
      const Lanes wrong = force - (size > bound ? bound / size : 1) * trial;
      return problem_.h * std::sqrt(dot(wrong, wrong)) / contact.stiffness_across;
    };
    error.with_bounds = std::max(error.with_bounds, error_of(friction_bound(contact)));
    error.with_loads = std::max(error.with_loads, error_of(coulomb_bound(contact)));
  }
  return error;
}

bool SuspensionStep::are_bounds_right() const {
  double largest = 0;
  for (const auto& contact : contacts_) largest = std::max(largest, coulomb_bound(contact));
  return std::ranges::all_of(contacts_, [&](const Contact& contact) {
    const double right = coulomb_bound(contact);
    return std::abs(friction_bound(contact) - right) <=
           StepTuning::kBoundTolerance * right + StepTuning::kLeastBound * largest;
  });
}

}  // namespace viscontact::suspensions
