// Coulomb's friction of the contacts of a step, (9.15) and (9.16).
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "viscontact/common/index.hpp"
#include "viscontact/suspensions/step/contacts.hpp"
#include "viscontact/suspensions/step/films.hpp"
#include "viscontact/suspensions/step/step_parts.hpp"

namespace viscontact::suspensions {

void SuspensionStep::place_friction(FrictionContact& contact, const Lanes& friction) {
  const auto p = index_of(contact.pair);
  const auto& row = system_.resistance().pairs[p];
  const auto& normal = contacts_[index_of(contact.contact)];
  const double a = problem_.radii[index_of(row.first)], b = problem_.radii[index_of(row.second)];
  const auto of = sizes(p);
  contact.borne_by_film = 0;
  // Smooth spheres have no friction.
  if (is_kept_apart(p)) contact.borne_by_film = std::numeric_limits<double>::infinity();
  if (problem_.contact_film) {
    // Infinite for smooth spheres. Rounding errors may leave gamma just below gamma_min.
    const double carried =
        normal.least_load - problem_.contact_film->lowest_gamma(a, b) / problem_.h;
    contact.borne_by_film = std::max(carried, 0.0);
  }
  const double arm = 1 / row.inverse_arm;
  contact.arm_first = a * arm / of.contact_distance;
  contact.arm_second = of.has_plane ? 0 : b * arm / of.contact_distance;
  contact.arm = arm;
  contact.stiffness_across =
      StepTuning::kStiffnessAcross / StepTuning::kStiffnessWithFriction * normal.stiffness;
  contact.friction = cross(row.normal, friction);
  contact.turn_first = row.turn_first;
  contact.turn_mixed = row.turn_mixed;
  contact.turn_second = row.turn_second;
}

Lanes SuspensionStep::force_of(const FrictionContact& contact) const {
  return cross(contact.friction, system_.resistance().pairs[index_of(contact.pair)].normal);
}

Lanes SuspensionStep::slip_by_strain(const FrictionContact& contact,
                                     const SymmetricTensor& strain) const {
  const Lanes n = system_.resistance().pairs[index_of(contact.pair)].normal;
  return -contact.arm * cross(n, lanes_of(strain.times(vector_of(n))));
}

Lanes SuspensionStep::slip_by_motions(const FrictionContact& contact,
                                      const std::vector<Motion>& motions) const {
  const auto& row = system_.resistance().pairs[index_of(contact.pair)];
  const Lanes n = row.normal;
  const Motion &first = motions[index_of(row.first)], &second = motions[index_of(row.second)];
  const Lanes rotation = row.inverse_arm * cross(n, second.along - first.along);
  const Lanes sum =
      contact.arm_first * (first.turn - rotation) + contact.arm_second * (second.turn - rotation);
  return sum - dot(sum, n) * n;
}

Lanes SuspensionStep::slip(const FrictionContact& contact,
                           const std::vector<Motion>& motions) const {
  return slip_by_motions(contact, motions) + slip_by_strain(contact);
}

double SuspensionStep::friction_bound(const FrictionContact& contact) const {
  return bounds_ == Bounds::kOfLoads ? coulomb_bound(contact) : contact.given_bound;
}

double SuspensionStep::coulomb_bound(const FrictionContact& contact) const {
  return problem_.friction *
         std::max(contacts_[index_of(contact.contact)].load - contact.borne_by_film, 0.0);
}

void SuspensionStep::linearise_friction(FrictionContact& contact) {
  auto& resistance = system_.resistance();
  auto& row = resistance.pairs[index_of(contact.pair)];
  const Lanes here = slip(contact, motions_);
  const Lanes trial = contact.friction + contact.stiffness_across * here;
  const double size = std::sqrt(dot(trial, trial)), bound = friction_bound(contact);
  contact.slides = size > bound && !is_split_;
  const double share = contact.slides ? bound / size : 1;
  if (!is_split_) {
    const auto before = contact.state;
    contact.state = !contacts_[index_of(contact.contact)].pushes ? ContactState::kOpen
                    : contact.slides                             ? ContactState::kSlides
                                                                 : ContactState::kSticks;
    if (contact.state != before) unchanged_ = 0;
  }
  const double stiffness = share * contact.stiffness_across;
  row.turn_first = contact.turn_first + stiffness * contact.arm_first * contact.arm_first;
  row.turn_mixed = contact.turn_mixed + stiffness * contact.arm_first * contact.arm_second;
  row.turn_second = contact.turn_second + stiffness * contact.arm_second * contact.arm_second;
  contact.at_slip = here;
  contact.at_friction = share * trial;
  contact.at_stiffness = stiffness;
  contact.direction = contact.slides ? (1 / size) * trial : Lanes{};
  if (contact.slides)
    resistance.slips.push_back({row.normal, Packed(contact.direction), stiffness, contact.arm_first,
                                contact.arm_second, row.first, row.second});
  contact.at_load =
      contact.at_friction - change_of_friction(contact, here - slip_by_strain(contact));
}

Lanes SuspensionStep::change_of_friction(const FrictionContact& contact, const Lanes& change) {
  return contact.at_stiffness * (change - dot(contact.direction, change) * contact.direction);
}

Lanes SuspensionStep::friction_at(const FrictionContact& contact, const Lanes& at_slip) const {
  const Lanes trial = contact.friction + contact.stiffness_across * at_slip;
  const double size = std::sqrt(dot(trial, trial)), bound = friction_bound(contact);
  return (size > bound ? bound / size : 1) * trial;
}

std::vector<double> SuspensionStep::scaled_loads() const {
  std::vector<double> loads;
  loads.reserve(4 * contacts_.size());
  for (const auto& contact : frictions_) {
    const auto& normal = contacts_[index_of(contact.contact)];
    const double across = std::sqrt(contact.stiffness_across);
    loads.push_back(normal.load / std::sqrt(normal.stiffness));
    for (int d = 0; d < 3; ++d) loads.push_back(contact.friction[d] / across);
  }
  return loads;
}

void SuspensionStep::set_scaled_loads(const std::vector<double>& loads) {
  assert(loads.size() == 4 * contacts_.size());
  const double* next = loads.data();
  for (auto& contact : frictions_) {
    auto& normal = contacts_[index_of(contact.contact)];
    const double across = std::sqrt(contact.stiffness_across);
    normal.load = std::sqrt(normal.stiffness) * *next++;
    for (int d = 0; d < 3; ++d) contact.friction[d] = across * *next++;
  }
}

void SuspensionStep::obey_bounds() {
  for (auto& contact : frictions_) {
    auto& normal = contacts_[index_of(contact.contact)];
    normal.load = std::max(normal.load, normal.least_load);
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
  obey_bounds();
  if (rate_) {
    rate_->value = rate;
    set_rate();
  }
  find_gaps();
}

SuspensionStep::FrictionError SuspensionStep::friction_error() const {
  FrictionError error;
  if (!(problem_.friction > 0)) return error;
  for (const auto& contact : frictions_) {
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
  for (const auto& contact : frictions_) largest = std::max(largest, coulomb_bound(contact));
  return std::ranges::all_of(frictions_, [&](const FrictionContact& contact) {
    const double right = coulomb_bound(contact);
    return std::abs(friction_bound(contact) - right) <=
           StepTuning::kBoundTolerance * right + StepTuning::kLeastBound * largest;
  });
}

}  // namespace viscontact::suspensions
