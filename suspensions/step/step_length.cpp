// The length of a step of the iteration: shorter where the function to be minimised rises.
#include <algorithm>
#include <vector>

#include "viscontact/common/index.hpp"
#include "viscontact/suspensions/pairs/row_blocks.hpp"
#include "viscontact/suspensions/step/contacts.hpp"
#include "viscontact/suspensions/step/films.hpp"
#include "viscontact/suspensions/step/step_parts.hpp"

namespace viscontact::suspensions {

void SuspensionStep::shorten(std::vector<Motion>& before, double rate_before, double curvature) {
  const std::size_t count = motions_.size();
  auto& change = before;
  for (std::size_t k = 0; k < count; ++k) {
    change[k].along = motions_[k].along - before[k].along;
    change[k].turn = motions_[k].turn - before[k].turn;
  }
  const double rate_change = rate_ ? rate_->value - rate_before : 0;
  if (rate_) {
    std::vector<Motion> product(count);
    system_.resistance().multiply(change, product);
    curvature = rate_->resistance * rate_change * rate_change;
    for (std::size_t k = 0; k < count; ++k)
      curvature += dot(change[k].along, product[k].along) + dot(change[k].turn, product[k].turn);
    for (std::size_t k = 0; k < count; ++k)
      curvature +=
          2 * rate_change *
          (dot(change[k].along, rate_->loads[k].along) + dot(change[k].turn, rate_->loads[k].turn));
  }
  const auto& rows = system_.resistance().pairs;
  const double h = problem_.h;
  // The slope of the function to be minimised at a part of the change: that of the linear problem,
  // and what films, contacts and friction differ from it.
  const auto slope_at = [&](double part) {
    const auto slope_of = [&](std::size_t p) {
      const auto& film = films_[p];
      double slope = 0;
      if (film.alpha == 0 && film.contact < 0) return slope;
      const double rate = opening(p, change) + (rate_ ? rate_change * rate_->opening[p] : 0);
      const double at = (film.width - film.base) / h + part * rate;
      const double width = film.base + h * at;
      double force = film.alpha > 0 ? film.force_at(width, solid_width(), h) : 0;
      if (film.contact >= 0) {
        const auto& contact = contacts_[index_of(film.contact)];
        force -= std::max(contact.trial_load(width, h), contact.least_load);
        if (problem_.friction > 0) {
          const auto& friction = frictions_[index_of(film.contact)];
          Lanes turned = slip_by_motions(friction, change);
          if (rate_) turned += rate_change * slip_by_strain(friction, rate_->strain);
          slope +=
              dot(turned, friction_at(friction, friction.at_slip + part * turned) -
                              friction.at_friction - change_of_friction(friction, part * turned));
        }
      }
      return slope + rate * (force - film.load - rows[p].squeeze * at);
    };
    return problem_.pool->sum_of_blocks<double>(
               rows.size(),
               [&](std::size_t begin, std::size_t end) {
                 double sum = 0;
                 for (std::size_t p = begin; p < end; ++p) sum += slope_of(p);
                 return sum;
               },
               kPairsInBlock) -
           (1 - part) * curvature;
  };
  if (slope_at(1) <= StepTuning::kLargestSlope * curvature) return;
  double low = 0, high = 1;
  for (int k = 0; k < StepTuning::kBisections; ++k) {
    const double middle = (low + high) / 2;
    (slope_at(middle) > 0 ? high : low) = middle;
  }
  for (std::size_t k = 0; k < count; ++k) {
    motions_[k].along -= (1 - high) * change[k].along;
    motions_[k].turn -= (1 - high) * change[k].turn;
  }
  if (rate_) rate_->value = rate_before + high * rate_change;
}

}  // namespace viscontact::suspensions
