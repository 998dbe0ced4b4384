// The films of a step: their places, gaps and linear problems, (9.12).
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "viscontact/common/index.hpp"
#include "viscontact/suspensions/pairs/row_blocks.hpp"
#include "viscontact/suspensions/step/contacts.hpp"
#include "viscontact/suspensions/step/films.hpp"
#include "viscontact/suspensions/step/step_parts.hpp"

namespace viscontact::suspensions {

double SuspensionStep::delta(std::size_t p) const {
  return problem_.lubrication.regularisation * sizes(p).mean;
}

bool SuspensionStep::is_kept_apart(std::size_t p) const {
  return films_[p].alpha > 0 && solid_width() > 0;
}

double SuspensionStep::solid_width() const {
  const auto& of = problem_.lubrication;
  return of.regularisation == 0 && of.roughness == 0 ? StepTuning::kSolidGap * problem_.mean_radius
                                                     : 0;
}

void SuspensionStep::place_films() {
  auto& rows = system_.resistance().pairs;
  assert(rows.size() == films_.size());
  for_each_pair([&](std::size_t p) {
    auto& row = rows[p];
    auto& film = films_[p];
    // The resistance at half of the step, as if it were alpha/(q + delta) at all gaps nearby.
    film.alpha = row.squeeze > 0 ? row.squeeze * (row.gap + delta(p)) : 0;
    film.constant = 0;
    row.squeeze = 0;
  });
  if (rate_) place_rate();
  set_flow();
}

FilmStrain SuspensionStep::film_strain(std::size_t p) const {
  const auto& film = films_[p];
  if (!(film.alpha > 0)) return {};
  const double gap = system_.resistance().pairs[p].gap;
  const double squeeze = film.alpha / (gap + delta(p));
  const auto strain = system_.strain_terms(p);
  const double arm = strain.squeeze / squeeze;
  // The flow opens the gap by r nEn, and the surfaces by arm nEn.
  return {arm, strain.squeeze - squeeze * (sizes(p).contact_distance + gap),
          strain.stress_axial - arm * strain.squeeze};
}

void SuspensionStep::set_flow() {
  const auto& rows = system_.resistance().pairs;
  for_each_pair([&](std::size_t p) {
    if (!(films_[p].alpha > 0)) return;
    const Vector n = vector_of(rows[p].normal);
    films_[p].constant = film_strain(p).excess * dot(n, strain_.times(n));
  });
  given_loads_.assign(motions_.size(), {});
  std::ranges::copy(problem_.loads, given_loads_.begin());
  add_momentum(given_loads_);
  system_.subtract_strain_loads(strain_, given_loads_);
}

void SuspensionStep::find_gaps() {
  const auto& rows = system_.resistance().pairs;
  const double h = problem_.h, solid = solid_width();
  const Matrix carry = matrix_of(carried, problem_.gradient, h),
               mean = matrix_of(mean_carried, problem_.gradient, h);
  struct Found : Gaps {
    std::vector<std::size_t> touching;  // pairs that have no contact yet
    Found& operator+=(const Found& other) {
      error = std::max(error, other.error);
      smallest = std::min(smallest, other.smallest);
      stiffness += other.stiffness;
      changes += other.changes;
      power_of_changes += other.power_of_changes;
      touching.insert(touching.end(), other.touching.begin(), other.touching.end());
      return *this;
    }
  };
  const auto add_contact_to = [&](const Contact& contact, double width, Found& found) {
    // Where the load is the least one the gap may be open.
    const double over = width - contact.width;
    const bool is_pressed = contact.load > contact.least_load;
    found.error = std::max(found.error, is_pressed ? std::abs(over) : std::max(-over, 0.0));
    found.stiffness += contact.stiffness;
    if (is_changed(contact, width)) ++found.changes;
    const double change = std::max(contact.trial_load(width, h), contact.least_load) - contact.load;
    found.power_of_changes += change * change / contact.stiffness;
  };
  const auto find_gap = [&](std::size_t p, Found& found) {
    auto& film = films_[p];
    const auto& pair = problem_.pairs[p];
    const Vector n = vector_of(rows[p].normal);
    const Vector change =
        vector_of(motions_[index_of(pair.second)].along - motions_[index_of(pair.first)].along);
    const Vector apart = times(carry, pair.apart) + h * times(mean, change);
    const auto of = sizes(p);
    const double distance = (of.has_plane ? dot(n, apart) : norm(apart)) - of.contact_distance;
    // The gap itself: one along the normal closes by r theta^2/8 in a step in which a pair turns by
    // theta, so that films push pairs apart that only turn, and steps are of the first order.
    film.width = distance + problem_.lubrication.regularisation * of.mean;
    film.base = film.width - h * dot(n, change);
    found.smallest = std::min(found.smallest, distance);
    if (film.alpha > 0) found.stiffness += film.alpha / film.at;
    if (film.contact >= 0) {
      add_contact_to(contacts_[index_of(film.contact)], film.width, found);
    } else if (is_kept_apart(p) ? distance < solid && film.at <= solid
                                : distance < problem_.lubrication.roughness * of.mean) {
      found.touching.push_back(p);
    }
  };
  auto found = problem_.pool->sum_of_blocks<Found>(
      rows.size(),
      [&](std::size_t begin, std::size_t end) {
        Found part;
        for (std::size_t p = begin; p < end; ++p) find_gap(p, part);
        return part;
      },
      kPairsInBlock);
  for (const auto p : found.touching) {
    add_contact(p, {problem_.pairs[p].first, problem_.pairs[p].second});
    add_contact_to(contacts_.back(), films_[p].width, found);
  }
  gaps_ = found;
}

void SuspensionStep::linearise(bool is_first) {
  auto& rows = system_.resistance().pairs;
  right_ = given_loads_;
  system_.resistance().slips.clear();
  struct Linearised {
    std::size_t inexact = 0, changed = 0;
    Linearised& operator+=(const Linearised& other) {
      inexact += other.inexact;
      changed += other.changed;
      return *this;
    }
  };
  const auto pairs = problem_.pool->sum_of_blocks<Linearised>(
      rows.size(),
      [&](std::size_t begin, std::size_t end) {
        Linearised part;
        for (std::size_t p = begin; p < end; ++p) {
          const double before = rows[p].squeeze;
          if (!linearise_pair(p, is_first)) ++part.inexact;
          const double change = std::abs(rows[p].squeeze - before);
          if (change > StepTuning::kChanged * std::max(rows[p].squeeze, before)) ++part.changed;
        }
        return part;
      },
      kPairsInBlock);
  is_film_exact_ = pairs.inexact == 0;
  changed_since_factors_ += pairs.changed;
  // Slips are in the order of the pairs.
  if (!frictions_.empty())
    for (const auto& film : films_)
      if (film.contact >= 0) linearise_friction(frictions_[index_of(film.contact)]);
  add_by_blocks(system_.resistance().blocks, rows, *problem_.pool,
                [&](std::size_t p, bool to_first, bool to_second) {
                  const auto& row = rows[p];
                  const auto& film = films_[p];
                  Lanes turn1{}, turn2{};
                  if (film.contact >= 0 && !frictions_.empty()) {
                    const auto& contact = frictions_[index_of(film.contact)];
                    turn1 = contact.arm_first * contact.at_load;
                    turn2 = contact.arm_second * contact.at_load;
                  }
                  const Lanes along = film.load * lanes_of(row.normal) +
                                      row.inverse_arm * cross(row.normal, turn1 + turn2);
                  if (to_first) {
                    auto& first = right_[index_of(row.first)];
                    first.along += along;
                    first.turn -= turn1;
                  }
                  if (to_second) {
                    auto& second = right_[index_of(row.second)];
                    second.along -= along;
                    second.turn -= turn2;
                  }
                });
}

bool SuspensionStep::linearise_pair(std::size_t p, bool is_first) {
  auto& film = films_[p];
  bool is_exact = true;
  const double h = problem_.h;
  double squeeze = 0;
  film.load = 0;
  if (film.alpha > 0) {
    const double solid = solid_width(), least = film.least(solid);
    is_exact = film.width >= least || least <= solid;
    film.at = std::max(film.width, least);
    squeeze = film.alpha / film.at;
    film.load = film.force(h) + squeeze * (film.base - film.at) / h;
  }
  if (film.contact >= 0) {
    auto& contact = contacts_[index_of(film.contact)];
    contact.pushes = is_split_ || (is_first && contact.load > contact.least_load) ||
                     contact.trial_load(film.width, h) > contact.least_load;
    if (contact.pushes) {
      squeeze += contact.stiffness;
      film.load += contact.stiffness * (film.base - contact.width) / h - contact.load;
    } else {
      film.load -= contact.least_load;
    }
  }
  system_.resistance().pairs[p].squeeze = squeeze;
  return is_exact;
}

}  // namespace viscontact::suspensions
