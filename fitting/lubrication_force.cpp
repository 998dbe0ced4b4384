#include "fitting/lubrication_force.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.hpp"

namespace viscontact {

LubricationForce::LubricationForce(const Fit& fit, BelowInterval below)
    : radius_(fit.radius),
      viscosity_(fit.viscosity),
      fitted_interval_(fit.gap_interval),
      below_(below) {
  for (const auto& term : fit.terms) {
    terms_.push_back({find_term(term.name).value(), -term.coefficient / fit.reference_velocity});
    if (term.name == kLeadingTerm) leading_ = terms_.back().weight;
  }
  impulse_at_radius_ = sum(&Term::antiderivative, radius_);
  // A drag that changes sign has no Gamma to invert; such a fit is of no use to any model.
  constexpr int kProbes = 200;
  for (int i = 0; i <= kProbes; ++i) {
    const auto [smallest, largest] = fitted_interval_;
    const double gap = i == 0         ? smallest
                       : i == kProbes ? largest
                                      : std::exp(std::lerp(std::log(smallest), std::log(largest),
                                                           static_cast<double>(i) / kProbes));
    if (!(resistance(gap) > 0))
      throw Error(ExitCode::kBadInput, fmt::format("the fit's resistance is {:.6g} at gap {:.6g}, "
                                                   "inside its interval; a drag must be positive: "
                                                   "fit again with another basis or other weights",
                                                   resistance(gap), gap));
  }
}

double LubricationForce::sum(double (*Term::*function)(double), double gap) const {
  double total = 0;
  for (const auto& [term, weight] : terms_) total += weight * (term.*function)(gap);
  return total;
}

std::array<double, 2> LubricationForce::interval() const {
  return {below_ == BelowInterval::kLubricationLimit ? 0.0 : fitted_interval_[0],
          fitted_interval_[1]};
}

void LubricationForce::check_gap(double gap) const {
  const auto [smallest, largest] = fitted_interval_;
  const bool allowed = gap <= largest &&
                       (gap >= smallest || (below_ == BelowInterval::kLubricationLimit && gap > 0));
  if (!allowed)
    throw Error(
        ExitCode::kBadInput,
        fmt::format(
            "gap {} is outside the fitted interval [{}, {}]; tabulate "
            "and fit further{}",
            gap, smallest, largest,
            gap < smallest
                ? ", or ask for the lubrication limit below it (simulate --lubrication-limit)"
                : ""));
}

double LubricationForce::leading_coefficient() const {
  if (!(leading_ > 0))
    throw Error(ExitCode::kBadInput, fmt::format("the fit's coefficient of 1/q in the resistance "
                                                 "is {}; a contact model and the lubrication limit "
                                                 "need it > 0",
                                                 leading_));
  return leading_;
}

double LubricationForce::regular_resistance(double gap) const {
  const double from = std::max(gap, fitted_interval_[0]);
  check_gap(from);
  double total = 0;
  for (const auto& [term, weight] : terms_)
    if (term.name != kLeadingTerm) total += weight * term.value(from);
  return total;
}

double LubricationForce::resistance(double gap) const {
  check_gap(gap);
  if (gap < fitted_interval_[0]) return leading_coefficient() / gap + regular_resistance(gap);
  return sum(&Term::value, gap);
}

double LubricationForce::resistance_log_slope(double gap) const {
  check_gap(gap);
  if (gap < fitted_interval_[0]) return -leading_coefficient() / gap;
  return sum(&Term::log_slope, gap);
}

double LubricationForce::impulse(double gap) const {
  check_gap(gap);
  const double smallest = fitted_interval_[0];
  if (gap < smallest)
    return impulse(smallest) + leading_coefficient() * std::log(gap / smallest) +
           regular_resistance(smallest) * (gap - smallest);
  return sum(&Term::antiderivative, gap) - impulse_at_radius_;
}

double LubricationForce::gap_of_impulse(double impulse_wanted) const {
  // In s = ln q, Gamma is close to linear near contact: Newton's method there, kept inside a
  // bracket that shrinks.
  const auto [smallest, largest] = fitted_interval_;
  double low = std::log(smallest);
  double high = std::log(largest);
  if (impulse_wanted < impulse(smallest)) {
    if (below_ == BelowInterval::kError)
      throw Error(
          ExitCode::kBadInput,
          fmt::format("the film would be thinner than the fitted interval [{:.6g}, "
                      "{:.6g}]; tabulate and fit further, "
                      "or ask for the lubrication limit below it (simulate --lubrication-limit)",
                      smallest, largest));
    // k (s - ln q_min) + R_reg (e^s - q_min) = what is wanted beyond Gamma(q_min): the second term moves s by less than R_reg q_min / k.
    const double k = leading_coefficient();
    const double by_leading_term = low + (impulse_wanted - impulse(smallest)) / k;
    const double by_regular_part = regular_resistance(smallest) * smallest / k;
    high = std::min(low, by_leading_term + std::max(0.0, by_regular_part));
    const double thinnest = std::log(std::numeric_limits<double>::min());
    if (!(high >= thinnest))
      throw Error(ExitCode::kNotConverged,
                  "the film is thinner than the smallest number that a double can hold");
    low = std::max(thinnest, by_leading_term + std::min(0.0, by_regular_part));
  } else if (!(impulse_wanted <= impulse(largest))) {
    throw Error(ExitCode::kBadInput, fmt::format("the gap would be wider than the fitted interval "
                                                 "[{:.6g}, {:.6g}]; tabulate and fit further",
                                                 smallest, largest));
  }
  double s = high - (high - low) / 2;
  constexpr int kMaxSteps = 200;  // bisection alone needs about 60
  for (int step = 0; step < kMaxSteps; ++step) {
    const double gap = std::clamp(std::exp(s), std::exp(low), std::exp(high));
    const double excess = impulse(gap) - impulse_wanted;
    if (excess == 0) return gap;
    (excess > 0 ? high : low) = s;
    const double newton = s - excess / (resistance(gap) * gap);
    const double next = newton > low && newton < high ? newton : low + (high - low) / 2;
    // Steps below the rounding of s change nothing any more.
    if (std::abs(next - s) <=
        2 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(s)))
      return std::clamp(std::exp(next), interval()[0], largest);
    s = next;
  }
  return std::exp(s);
}

}  // namespace viscontact
