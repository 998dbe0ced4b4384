// Coulomb's friction of the contacts of a step, (9.16).
#include <algorithm>
#include <cassert>
#include <cmath>

#include "viscontact/common/index.hpp"
#include "viscontact/suspensions/step/step_parts.hpp"

namespace viscontact::suspensions {

Lanes SuspensionStep::slip_by_strain(const Contact& contact, const SymmetricTensor& strain) const {
  const Lanes n = system_.resistance().pairs[contact.pair].normal;
  return -contact.arm * cross(n, lanes_of(strain.times(vector_of(n))));
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

void SuspensionStep::linearise_friction(Contact& contact) {
  auto& resistance = system_.resistance();
  auto& row = resistance.pairs[contact.pair];
  const Lanes here = slip(contact, motions_);
  const Lanes trial = contact.friction + contact.stiffness_across * here;
  const double size = std::sqrt(dot(trial, trial)), bound = friction_bound(contact);
  contact.slides = size > bound;
  const double share = contact.slides ? bound / size : 1;
  const auto before = contact.state;
  contact.state = !contact.pushes  ? ContactState::kOpen
                  : contact.slides ? ContactState::kSlides
                                   : ContactState::kSticks;
  if (contact.state != before) unchanged_ = 0;
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
  contact.at_load =
      contact.at_friction - change_of_friction(contact, here - slip_by_strain(contact));
}

Lanes SuspensionStep::change_of_friction(const Contact& contact, const Lanes& change) {
  return contact.at_stiffness * (change - dot(contact.direction, change) * contact.direction);
}

Lanes SuspensionStep::friction_at(const Contact& contact, const Lanes& at_slip) const {
  const Lanes trial = contact.friction + contact.stiffness_across * at_slip;
  const double size = std::sqrt(dot(trial, trial)), bound = friction_bound(contact);
  return (size > bound ? bound / size : 1) * trial;
}

std::vector<double> SuspensionStep::scaled_loads() const {
  std::vector<double> loads;
  loads.reserve(4 * contacts_.size());
  for (const auto& contact : contacts_) {
    const double across = std::sqrt(contact.stiffness_across);
    loads.push_back(contact.memory.load / std::sqrt(contact.stiffness));
    for (int d = 0; d < 3; ++d) loads.push_back(contact.friction[d] / across);
  }
  return loads;
}

void SuspensionStep::set_scaled_loads(const std::vector<double>& loads) {
  assert(loads.size() == 4 * contacts_.size());
  const double* next = loads.data();
  for (auto& contact : contacts_) {
    const double across = std::sqrt(contact.stiffness_across);
    contact.memory.load =
        std::max(std::sqrt(contact.stiffness) * *next++, contact.memory.least_load);
    for (int d = 0; d < 3; ++d) contact.friction[d] = across * *next++;
    const double size = std::sqrt(dot(contact.friction, contact.friction)),
                 bound = friction_bound(contact);
    if (size > bound) contact.friction *= bound / size;
  }
}

void SuspensionStep::update_friction(int solutions) {
  const bool is_early = solutions < StepTuning::kMostAccelerated;
  if (unchanged_ == 0 && !is_early) acceleration_.forget();
  const auto before = scaled_loads();
  update_contacts();
  auto loads = scaled_loads();
  double rate = rate_ ? rate_->value : 0;
  acceleration_.add(before, loads, motions_, rate);
  if (solutions < StepTuning::kFirstAccelerated) return;
  if (!is_early && unchanged_ < StepTuning::kUnchanged) return;
  if (++updates_ % StepTuning::kAcceleratedEach != 0 || acceleration_.is_empty()) return;
  acceleration_.combine(loads, motions_, rate);
  set_scaled_loads(loads);
  if (rate_) {
    rate_->value = rate;
    set_rate();
  }
  find_gaps();
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
