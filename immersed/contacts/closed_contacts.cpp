// Errors of impulses in a fluid, with a complete orthogonal decomposition of the scaled W.
#include "viscontact/immersed/contacts/closed_contacts.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "viscontact/common/matrices/decompositions.hpp"

namespace viscontact::particles {
namespace {

using Eigen::Index;

/// Free choices of the correction of impulses.
struct ClosedContactTuning {
  // Directions that are this near to each other count as one, far above rounding errors of places.
  static constexpr double kParallel = 1e-9;
  // Velocities by unit forces are sums with errors of this size; rows that are equal within them
  // are redundant, but only if their directions are.
  static constexpr double kEqual = 2e-11;
  // Each correction leaves about the relative error of W of the error.
  static constexpr int kMostCorrections = 4;
  // Below this part of the tolerance nothing is corrected: the rest is left for errors of the
  // velocities that the fluid solver computes from the final forces.
  static constexpr double kShare = 0.25;
};

constexpr double kRoundingOfDoubles = std::numeric_limits<double>::epsilon();

/// Rank of the rows as directions in the space of all motions that any of the `responses` has. With
/// equal mobilities of all motions, masses cannot hide what is redundant.
Index rank_of(const std::vector<std::vector<double>>& rows,
              const std::vector<const std::vector<double>*>& responses) {
  assert(!rows.empty());
  std::vector<std::size_t> moved;
  for (std::size_t i = 0; i < rows.front().size(); ++i)
    if (std::ranges::any_of(responses, [&](const auto* v) { return (*v)[i] != 0; }) &&
        std::ranges::any_of(rows, [&](const auto& row) { return row[i] != 0; }))
      moved.push_back(i);
  Eigen::MatrixXd directions(std::ssize(rows), std::ssize(moved));
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t m = 0; m < moved.size(); ++m)
      directions(static_cast<Index>(r), static_cast<Index>(m)) = rows[r][moved[m]];
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factor;
  factor.setThreshold(ClosedContactTuning::kParallel);
  factor.compute(directions.transpose());
  return factor.rank();
}

}  // namespace

ClosedContacts::ClosedContacts(const StepContacts& step, double mu_s,
                               std::span<const double> velocities,
                               const ContactConditions& conditions)
    : step_(step), conditions_(conditions) {
  assert(mu_s >= 0 && velocities.size() == conditions.free_velocities.size());
  add_rows(mu_s, velocities);
  if (!is_known_) return;
  find_values(velocities);
  if (is_known_ && !rows_.empty()) factorise();
}

double ClosedContacts::change(const Row& row, std::span<const double> velocities) const {
  const auto& contact = step_.contacts[row.contact];
  return row.is_slip ? step_.frictions[row.friction].slip_rate(contact, velocities.data(),
                                                               conditions_.layout)
                     : opening(contact, velocities.data(), conditions_.layout);
}

void ClosedContacts::add_rows(double mu_s, std::span<const double> velocities) {
  const auto& step = step_;
  const auto& contacts = step.contacts;
  std::size_t f = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const bool has_friction = f < step.frictions.size() && step.frictions[f].contact == c;
    const std::size_t friction = has_friction ? f++ : 0;
    const auto& contact = contacts[c];
    if (!(contact.w > 0)) continue;
    // A gap that the velocities close bears load, too.
    if (!(contact.impulse > contact.lowest) &&
        !(gap_after(contact, velocities.data(), conditions_.h, conditions_.layout) < 0))
      continue;
    const auto take = [&](const std::vector<std::vector<double>>& all, std::size_t n, Row row) {
      if (n >= all.size() || all[n].empty()) {
        is_known_ = false;
        return;
      }
      rows_.push_back(row);
      responses_.push_back(&all[n]);
    };
    take(step.of_gaps, c, {c, 0, false});
    if (!is_known_) return;
    if (!has_friction) continue;
    const auto& of = step.frictions[friction];
    if (!(of.solid_load(contact) > 0 && mu_s > 0 && of.w > 0)) continue;
    if (of.slides == 0 && !step.has_given_loads) {
      take(step.of_slips, friction, {c, friction, true});
    } else if (of.slides != 0 && !step.has_given_loads) {
      is_known_ = is_known_ && friction < step.of_slips.size() && !step.of_slips[friction].empty();
      const double slope = of.slides * mu_s;
      sliding_.push_back(
          {friction, rows_.size() - 1, slope, slope * of.solid_load(contact) - of.impulse});
    }
    if (!is_known_) return;
  }
}

void ClosedContacts::find_values(std::span<const double> velocities) {
  values_.resize(std::ssize(rows_));
  scales_.resize(std::ssize(rows_));
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const auto& row = rows_[r];
    double value =
        row.is_slip ? step_.frictions[row.friction].displacement : step_.contacts[row.contact].gap;
    value += conditions_.h * change(row, velocities);
    for (const auto& sliding : sliding_)
      value += change(row, step_.of_slips[sliding.friction]) * sliding.rest;
    const double w = change(row, *responses_[r]);
    if (!(w > 0)) is_known_ = false;
    values_[static_cast<Index>(r)] = value;
    scales_[static_cast<Index>(r)] = std::sqrt(w);
  }
}

void ClosedContacts::factorise() {
  const auto n = std::ssize(rows_);
  Eigen::MatrixXd matrix(n, n);
  for (Index r = 0; r < n; ++r) {
    const auto& row = rows_[static_cast<std::size_t>(r)];
    for (Index other = 0; other < n; ++other)
      matrix(r, other) = change(row, *responses_[static_cast<std::size_t>(other)]);
    for (const auto& sliding : sliding_)
      matrix(r, static_cast<Index>(sliding.row)) +=
          sliding.slope * change(row, step_.of_slips[sliding.friction]);
  }
  matrix = matrix.cwiseQuotient(scales_ * scales_.transpose()).eval();
  factor_.setThreshold(ClosedContactTuning::kEqual);
  factor_.compute(matrix);
  if (factor_.rank() == n) return;
  std::vector<std::vector<double>> directions;
  for (const auto& row : rows_) {
    const auto& contact = step_.contacts[row.contact];
    auto& direction = directions.emplace_back(responses_.front()->size());
    if (row.is_slip)
      step_.frictions[row.friction].add_force(contact, 1, direction, conditions_.layout);
    else
      add_contact_force(contact, 1, direction, conditions_.layout);
  }
  if (factor_.rank() >= rank_of(directions, responses_)) return;
  factor_.setThreshold(kRoundingOfDoubles * static_cast<double>(n));
  factor_.compute(matrix);
}

ClosedContacts::Impulses ClosedContacts::in_order(const Eigen::VectorXd& scaled) const {
  Impulses impulses{std::vector<double>(step_.contacts.size()),
                    std::vector<double>(step_.frictions.size())};
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const auto i = static_cast<Index>(r);
    auto& entry = rows_[r].is_slip ? impulses.of_frictions[rows_[r].friction]
                                   : impulses.of_contacts[rows_[r].contact];
    entry = scaled[i] / scales_[i];
  }
  return impulses;
}

ClosedContacts::Impulses ClosedContacts::corrections() const {
  assert(is_known_);
  if (rows_.empty()) return in_order({});
  const Eigen::VectorXd right = -values_.cwiseQuotient(scales_);
  auto impulses = in_order(factor_.solve(right));
  for (const auto& sliding : sliding_)
    impulses.of_frictions[sliding.friction] =
        sliding.slope * impulses.of_contacts[rows_[sliding.row].contact] + sliding.rest;
  return impulses;
}

ClosedContacts::Impulses ClosedContacts::changes_by(double error) const {
  assert(is_known_ && !(error < 0));
  if (rows_.empty()) return in_order({});
  auto impulses = in_order(factor_.pseudoInverse().cwiseAbs() * (error * scales_.cwiseInverse()));
  for (const auto& sliding : sliding_)
    impulses.of_frictions[sliding.friction] =
        std::abs(sliding.slope) * impulses.of_contacts[rows_[sliding.row].contact];
  return impulses;
}

void correct_impulses(StepContacts& step, double mu_s, const Mobility& mobility,
                      const ContactConditions& conditions) {
  if (!step.is_solved) return;
  // The largest error over the impulse at work.
  const auto error_of = [&](const ClosedContacts::Impulses& errors,
                            std::span<const double> at_work) {
    double largest = 0;
    for (std::size_t c = 0; c < at_work.size(); ++c)
      if (at_work[c] > 0) largest = std::max(largest, std::abs(errors.of_contacts[c]) / at_work[c]);
    for (std::size_t f = 0; f < step.frictions.size(); ++f)
      if (const double work = at_work[step.frictions[f].contact]; work > 0)
        largest = std::max(largest, std::abs(errors.of_frictions[f]) / work);
    return largest;
  };
  double before = std::numeric_limits<double>::infinity();
  std::optional<StepContacts> best;  // the allowed step with the smallest error
  for (int n = 0;; ++n) {
    const auto at_work = set_allowed(step.contacts, conditions);
    const ClosedContacts closed(step, mu_s, step.velocities, conditions);
    if (!closed.is_known()) break;
    const auto changes = closed.corrections();
    const double error = error_of(changes, at_work);
    auto residuals = measure_residuals(step.contacts, step.velocities, conditions);
    if (mu_s > 0) take_residuals_of_friction(step, mu_s, step.velocities, conditions, residuals);
    // A correction may close further contacts, which the next one takes into account.
    if (n == 0 || (residuals.converged && error < before)) {
      if (error <= ClosedContactTuning::kShare * conditions.solver.impulse_tolerance) return;
      best = step;
      before = error;
    }
    if (n == ClosedContactTuning::kMostCorrections) break;
    for (std::size_t c = 0; c < step.contacts.size(); ++c) {
      auto& contact = step.contacts[c];
      if (contact.w > 0)
        contact.impulse = std::max(contact.lowest, contact.impulse + changes.of_contacts[c]);
    }
    for (std::size_t f = 0; f < step.frictions.size(); ++f)
      step.frictions[f].impulse += changes.of_frictions[f];
    std::vector<double> loads(step.loads.size());
    for (const auto& contact : step.contacts)
      if (contact.w > 0)
        add_contact_force(contact, contact.impulse / conditions.h, loads, conditions.layout);
    for (const auto& friction : step.frictions)
      if (friction.impulse != 0)
        friction.add_force(step.contacts[friction.contact], friction.impulse / conditions.h, loads,
                           conditions.layout);
    const auto moved = mobility(loads);
    ++step.iterations;
    for (std::size_t i = 0; i < loads.size(); ++i)
      step.velocities[i] = conditions.free_velocities[i] + moved[i];
    step.loads = std::move(loads);
  }
  if (best) step = std::move(*best);
}

void take_errors_of_impulses(StepContacts& step, double mu_s, std::span<const double> velocities,
                             const ContactConditions& conditions, StepResiduals& residuals) {
  auto& contacts = step.contacts;
  const auto at_work = set_allowed(contacts, conditions);
  const ClosedContacts closed(step, mu_s, velocities, conditions);
  const double rounding = rounding_error_of_gaps(conditions);
  auto& errors = residuals.impulse_errors;
  if (!closed.is_known()) {
    double largest = 0;
    for (std::size_t c = 0; c < contacts.size(); ++c)
      if (contacts[c].w > 0) largest = std::max(largest, errors[c] * std::sqrt(contacts[c].w));
    for (std::size_t c = 0; c < contacts.size(); ++c)
      if (contacts[c].w > 0 && contacts[c].impulse > contacts[c].lowest) {
        const double root = std::sqrt(contacts[c].w);
        errors[c] = std::max(errors[c], step.amplification * largest / root);
        residuals.take_impulse(errors[c], at_work[c]);
        residuals.take_error(
            errors[c], std::max({conditions.solver.impulse_tolerance * at_work[c],
                                 step.amplification * rounding / contacts[c].w,
                                 // A contact without impulses at work has nothing to be wrong.
                                 std::numeric_limits<double>::min()}));
      }
    return;
  }
  const auto found = closed.corrections();
  const auto allowed = closed.changes_by(rounding);
  // The size of the gaps and motions whose sums are the values of the rows.
  double size = conditions.h * std::max(fastest(velocities, conditions.layout),
                                        fastest(conditions.free_velocities, conditions.layout));
  for (const auto& contact : contacts)
    if (contact.w > 0 && contact.impulse > contact.lowest)
      size = std::max(size, std::abs(contact.gap));
  const auto by_rounding = closed.changes_by(kRoundingOfDoubles * size);
  const auto take = [&](double correction, double rounded, double impulse, double most,
                        double work) {
    const double error = std::abs(correction) + rounded + kRoundingOfDoubles * std::abs(impulse);
    residuals.take_impulse(std::abs(correction), work);
    residuals.take_error(std::abs(correction),
                         std::max({conditions.solver.impulse_tolerance * work, most,
                                   std::numeric_limits<double>::min()}));
    return error;
  };
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (allowed.of_contacts[c] > 0)
      errors[c] = take(found.of_contacts[c], by_rounding.of_contacts[c], contacts[c].impulse,
                       allowed.of_contacts[c], at_work[c]);
  for (std::size_t f = 0; f < step.frictions.size(); ++f)
    if (found.of_frictions[f] != 0)
      take(found.of_frictions[f], 0, 0, allowed.of_frictions[f],
           at_work[step.frictions[f].contact]);
}

}  // namespace viscontact::particles
