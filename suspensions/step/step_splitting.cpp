// Contacts with friction by the splitting of Douglas & Rachford, (9.15).
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "viscontact/common/index.hpp"
#include "viscontact/suspensions/step/contacts.hpp"
#include "viscontact/suspensions/step/films.hpp"
#include "viscontact/suspensions/step/step_parts.hpp"

namespace viscontact::suspensions {
namespace {

struct SplittingTuning {
  // Stiffnesses along and across over that of the film at contact, and the most linear problems.
  // Loads that go in circles with the first row often do so no longer with the second one. Of 38
  // hard steps (200 spheres, 0.52 of the volume with the coefficient 1, 0.55 with 0.5) 8 are left
  // unsolved. The same rows with half of each change leave 12 of 46, and the second row alone, with
  // half, 49 of 102.
  struct Row {
    double along, across;
    int most;
  };
  static constexpr std::array<Row, 2> kRows{{{2, 0.5, 1500}, {1, 0.25, 2000}}};
  // Each linear problem reduces its residual by this factor. With a tenth of it twice as many
  // iterations are needed, with ten times it more steps are not solved.
  static constexpr double kReduction = 1e-2;
  // Factors of a linear problem serve so many, because stiffnesses hardly change.
  static constexpr int kFactorsFor = 20;
  // The power of the last change, over that of the residual that is allowed.
  static constexpr double kPower = 0.1;
  // Loads are accelerated after each fourth problem, if each contact has stayed open, stuck or slid
  // in so many; twice as many, to the most, after an acceleration that made the change larger.
  // Without acceleration two to three times as many iterations are needed, and with one that is
  // always kept each seventh step is not solved.
  static constexpr int kAcceleratedEach = 4, kUnchanged = 10, kMostUnchanged = 80;
};

}  // namespace

void SuspensionStep::set_stiffnesses(double along, double across) {
  for (auto& friction : frictions_) {
    auto& contact = contacts_[index_of(friction.contact)];
    place_contact(contact);
    const double resistance = contact.stiffness / StepTuning::kStiffnessWithFriction;
    contact.stiffness = along * resistance;
    friction.stiffness_across = across * resistance;
  }
}

void SuspensionStep::take_trial_loads() {
  for (auto& friction : frictions_) {
    auto& contact = contacts_[index_of(friction.contact)];
    contact.load = contact.trial_load(films_[index_of(contact.pair)].width, problem_.h);
    friction.friction += friction.stiffness_across * slip(friction, motions_);
  }
}

void SuspensionStep::find_states() {
  for (auto& friction : frictions_) {
    const auto& contact = contacts_[index_of(friction.contact)];
    const double bound = coulomb_bound(friction);
    const auto before = friction.state;
    friction.state = contact.load <= contact.least_load ? ContactState::kOpen
                     : dot(friction.friction, friction.friction) > bound * bound
                         ? ContactState::kSlides
                         : ContactState::kSticks;
    if (friction.state != before) unchanged_ = 0;
  }
}

bool SuspensionStep::split(StepSolution& solution, double allowed) {
  is_split_ = true;
  bool is_solved = false;
  for (const auto& [along, across, most] : SplittingTuning::kRows) {
    if (is_solved) break;
    set_stiffnesses(along, across);
    take_trial_loads();
    acceleration_.forget();
    unchanged_ = 0;
    int wait = SplittingTuning::kUnchanged;
    struct {
      std::vector<double> loads;
      std::vector<Motion> motions;
      double rate = 0, power = 0;
    } saved;
    for (int k = 0; k < most && !is_solved; ++k) {
      ++unchanged_;
      find_states();
      auto before = scaled_loads();
      obey_bounds();
      auto lawful = scaled_loads();
      auto loads = lawful;
      for (std::size_t l = 0; l < loads.size(); ++l) loads[l] += lawful[l] - before[l];
      set_scaled_loads(loads);
      linearise(false);
      if (rate_) linearise_rate();
      if (k % SplittingTuning::kFactorsFor == 0) has_factors_ = false;
      const auto result =
          solve_linear({StepTuning::kSolved * allowed, SplittingTuning::kReduction});
      ++solution.solutions;
      solution.iterations += result.iterations;
      if (rate_) set_rate();
      find_gaps();
      if (before.size() < 4 * contacts_.size()) {
        // Contacts that were not expected.
        set_stiffnesses(along, across);
        before.resize(4 * contacts_.size());
        lawful.resize(4 * contacts_.size());
        saved.loads.clear();
        acceleration_.forget();
        has_factors_ = false;
      }
      take_trial_loads();
      loads = scaled_loads();
      double power = 0;
      for (std::size_t l = 0; l < loads.size(); ++l) {
        const double change = loads[l] - lawful[l];
        power += change * change;
        loads[l] = before[l] + change;
      }
      set_scaled_loads(loads);
      is_solved = power <= SplittingTuning::kPower * allowed && (!rate_ || rate_->is_right);
      if (is_solved) break;
      if (!saved.loads.empty()) {
        const bool is_better = power <= saved.power;
        wait = is_better ? SplittingTuning::kUnchanged
                         : std::min(2 * wait, SplittingTuning::kMostUnchanged);
        if (!is_better) {
          set_scaled_loads(saved.loads);
          motions_ = saved.motions;
          if (rate_) {
            rate_->value = saved.rate;
            set_rate();
          }
          find_gaps();
          acceleration_.forget();
          unchanged_ = 0;
        }
        saved.loads.clear();
        if (!is_better) continue;
      }
      if (unchanged_ == 0) acceleration_.forget();
      double rate = rate_ ? rate_->value : 0;
      acceleration_.add(before, loads, motions_, rate);
      if (unchanged_ <= wait || k % SplittingTuning::kAcceleratedEach != 0 ||
          acceleration_.is_empty())
        continue;
      saved = {loads, motions_, rate, power};
      acceleration_.combine(loads, motions_, rate);
      set_scaled_loads(loads);
      if (rate_) {
        rate_->value = rate;
        set_rate();
      }
      find_gaps();
    }
    obey_bounds();
  }
  set_stiffnesses(StepTuning::kStiffnessWithFriction, StepTuning::kStiffnessAcross);
  is_split_ = has_factors_ = false;
  acceleration_.forget();
  return is_solved;
}

}  // namespace viscontact::suspensions
