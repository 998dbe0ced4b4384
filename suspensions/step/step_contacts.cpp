// The contacts of a step, (9.13) to (9.15): a multiplier and a stiffness each.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "viscontact/common/index.hpp"
#include "viscontact/suspensions/pairs/row_blocks.hpp"
#include "viscontact/suspensions/step/contacts.hpp"
#include "viscontact/suspensions/step/films.hpp"
#include "viscontact/suspensions/step/step_parts.hpp"

namespace viscontact::suspensions {

void SuspensionStep::add_contacts() {
  auto memory = problem_.memories.begin();
  const auto& rows = system_.resistance().pairs;
  for (std::size_t p = 0; p < rows.size(); ++p) {
    const auto& row = rows[p];
    const auto before = [&](const ContactMemory& m) {
      return m.first < row.first || (m.first == row.first && m.second < row.second);
    };
    while (memory != problem_.memories.end() && before(*memory)) ++memory;
    if (memory != problem_.memories.end() && memory->first == row.first &&
        memory->second == row.second)
      add_contact(p, *memory);
    else if (!is_kept_apart(p) &&
             films_[p].start - delta(p) <
                 (problem_.lubrication.roughness + StepTuning::kNearGap) * sizes(p).mean)
      add_contact(p, {row.first, row.second});
  }
  // Contacts that are found later are few.
  contacts_.shrink_to_fit();
  contacts_.reserve(contacts_.size() + contacts_.size() / 16);
}

void SuspensionStep::add_contact(std::size_t p, const ContactMemory& memory) {
  assert(memory.least_load <= 0);
  const auto c = static_cast<std::int32_t>(contacts_.size());
  films_[p].contact = c;
  auto& contact = contacts_.emplace_back();
  contact.pair = static_cast<std::int32_t>(p);
  contact.load = memory.load;
  contact.least_load = memory.least_load;
  place_contact(contact);
  if (!(problem_.friction > 0)) return;
  auto& friction = frictions_.emplace_back();
  friction.contact = c;
  friction.pair = contact.pair;
  place_friction(friction, lanes_of(memory.friction));
}

void SuspensionStep::place_contact(Contact& contact) {
  const auto p = index_of(contact.pair);
  const auto& pair = problem_.pairs[p];
  const auto& lubrication = problem_.lubrication;
  const auto of = sizes(p);
  const bool is_smooth = is_kept_apart(p);
  contact.width = is_smooth ? solid_width() : lubrication.roughness * of.mean + delta(p);
  const double least_width =
      lubrication.pairs == particles::PairTerms::kNone
          ? StepTuning::kWidthWithoutFilm
          : (problem_.friction > 0 ? StepTuning::kLeastWidthWithFriction : StepTuning::kLeastWidth);
  const double width = is_smooth ? contact.width : std::max(contact.width, least_width * of.mean);
  const double film_at_contact =
      6 * std::numbers::pi * lubrication.viscosity * of.reduced * of.reduced / width;
  const double resistance = film_at_contact + inertia_of(pair.first, pair.second);
  const bool has_film = films_[p].alpha > 0;
  if (problem_.friction > 0) {
    contact.stiffness = StepTuning::kStiffnessWithFriction * resistance;
  } else {
    contact.stiffness =
        (has_film && !is_stiff_ ? StepTuning::kStiffness : StepTuning::kLargeStiffness) *
        resistance;
    contact.beside = has_film ? resistance : 0;
  }
}

bool SuspensionStep::is_changed(const Contact& contact, double width) const {
  // Loads of this part of a stiffness are rounding errors of gaps, which may change for ever.
  const double rounding = StepTuning::kGapRounding * problem_.mean_radius / problem_.h;
  const double over = contact.trial_load(width, problem_.h) - contact.least_load;
  return (over > 0) != contact.pushes && std::abs(over) > rounding * contact.stiffness;
}

std::size_t SuspensionStep::count_changes() const {
  return problem_.pool->sum_of_blocks<std::size_t>(
      contacts_.size(),
      [&](std::size_t begin, std::size_t end) {
        std::size_t changes = 0;
        for (std::size_t c = begin; c < end; ++c) {
          const auto p = index_of(contacts_[c].pair);
          if (is_changed(contacts_[c], films_[p].base + problem_.h * opening(p, motions_)))
            ++changes;
        }
        return changes;
      },
      kPairsInBlock);
}

void SuspensionStep::update_contacts() {
  for (auto& contact : contacts_)
    contact.load = contact.next_load(films_[index_of(contact.pair)].width, problem_.h);
  for (auto& contact : frictions_) contact.friction = friction_at(contact, slip(contact, motions_));
}

void SuspensionStep::settle_contacts() {
  for (auto& contact : frictions_) contact.friction = friction_at(contact, slip(contact, motions_));
  for (auto& contact : contacts_)
    contact.load = std::max(contact.trial_load(films_[index_of(contact.pair)].width, problem_.h),
                            contact.least_load);
}

std::vector<ContactMemory> SuspensionStep::memories() const {
  std::vector<ContactMemory> result;
  result.reserve(contacts_.size());
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const auto& contact = contacts_[c];
    if (contact.load == 0 && contact.least_load == 0) continue;
    const auto& pair = problem_.pairs[index_of(contact.pair)];
    ContactMemory memory{pair.first, pair.second, contact.load, contact.least_load};
    if (!frictions_.empty()) memory.friction = vector_of(force_of(frictions_[c]));
    result.push_back(memory);
  }
  std::ranges::sort(result, [](const ContactMemory& a, const ContactMemory& b) {
    return a.first < b.first || (a.first == b.first && a.second < b.second);
  });
  return result;
}

}  // namespace viscontact::suspensions
