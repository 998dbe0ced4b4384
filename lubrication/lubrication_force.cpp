// R(q), its derivative, its primitive Gamma, and the inverse of Gamma (docs/physics.md (4.2)).
#include "viscontact/lubrication/lubrication_force.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/root_finding.hpp"
#include "viscontact/lubrication/plane_drag.hpp"
#include "viscontact/lubrication/stokes_drag.hpp"

namespace viscontact::lubrication {
namespace {

// The range of gap/radius [1] in which the exact drag and its integral are computed, because both
// are doubles of full precision there.
constexpr std::array kExactRange = {1e-300, 1e300};

}  // namespace

LubricationForce::LubricationForce(double viscosity, double radius)
    : exact_(true),
      radius_(radius),
      viscosity_(viscosity),
      leading_(stokes_resistance(viscosity, radius) * radius),
      fitted_interval_{kExactRange[0] * radius, kExactRange[1] * radius},
      impulses_at_ends_{impulse(fitted_interval_[0]), impulse(fitted_interval_[1])} {
  assert(viscosity > 0 && radius > 0);
}

LubricationForce LubricationForce::exact_plane(double viscosity, double radius) {
  return {viscosity, radius};
}

LubricationForce LubricationForce::below_wall(double largest_gap) const {
  assert(largest_gap > 0);
  LubricationForce bounded = *this;
  bounded.largest_gap_ = std::min(largest_gap_, largest_gap);
  return bounded;
}

OutsideInterval OutsideInterval::with_limits() const {
  return {below == BelowInterval::kError ? BelowInterval::kLubricationLimit : below,
          AboveInterval::kStokesLimit};
}

LubricationForce::LubricationForce(const Fit& fit, const OutsideInterval& outside)
    : radius_(fit.radius),
      viscosity_(fit.viscosity),
      fitted_interval_(fit.gap_interval),
      outside_(outside) {
  assert(fit.reference_velocity != 0 && fit.viscosity > 0 && fit.radius > 0);
  if (is_exact_plane(fit)) {
    *this = exact_plane(fit.viscosity, fit.radius);
    return;
  }
  weights_.assign(terms_beside_walls().size(), 0.0);
  for (const auto& term : fit.terms)
    weights_[place_of(term.name)] = -term.coefficient / fit.reference_velocity;
  leading_ = weights_[place_of(kLeadingTerm)];
  regular_weights_ = weights_;
  regular_weights_[place_of(kLeadingTerm)] = 0;
  if (const auto wall = second_wall_of(fit)) {
    largest_gap_ = wall->largest_gap;
    wall_leading_ = wall->leading_factor * stokes_resistance(viscosity_, radius_) * radius_;
  }
  for (const auto& term : fit.terms)
    if (needs_second_wall(term.name) && !(largest_gap_ < kNoWall))
      throw Error(ErrorKind::kBadInput,
                  "the fit has the term {}, but its words for geometry and container name no wall "
                  "at a gap L above its interval",
                  term.name);
  impulse_offset_ = sum_antiderivatives(weights_, zero_of_impulse(fit), largest_gap_);
  // The models of motion invert Gamma. Its derivative, the resistance, must therefore be > 0.
  for (const double gap : spread_gaps(fitted_interval_))
    if (!(resistance(gap) > 0 && std::isfinite(resistance(gap))))
      throw Error(ErrorKind::kBadInput,
                  "the fit's resistance is {:.6g} at gap {:.6g}, inside its interval; a drag must "
                  "be positive and finite: fit again with another basis or other weights",
                  resistance(gap), gap);
  set_limits(fit);
  impulses_at_ends_ = {impulse(fitted_interval_[0]), impulse(fitted_interval_[1])};
}

void LubricationForce::set_limits(const Fit& fit) {
  const auto [smallest, largest] = fitted_interval_;
  if (outside_.below == BelowInterval::kLubricationLimit && leading_ > 0)
    limit_ = {leading_, regular_resistance(smallest)};
  if (outside_.below == BelowInterval::kTheoryLimit) {
    if (!fit.leading_coefficient || !(*fit.leading_coefficient > 0))
      throw Error(
          ErrorKind::kBadInput,
          "the fit does not say what theory's coefficient k of k/q is (its key leading_coefficient "
          "must be > 0); fit a table that says it, or use the fitted coefficient");
    limit_ = {*fit.leading_coefficient, resistance(smallest) - *fit.leading_coefficient / smallest};
  }
  image_ = (resistance(largest) / stokes_resistance(viscosity_, radius_) - 1) * (largest + radius_);
}

std::array<double, 2> LubricationForce::interval() const {
  return {outside_.below == BelowInterval::kError ? fitted_interval_[0] : 0.0,
          outside_.above == AboveInterval::kError ? fitted_interval_[1] : largest_gap_};
}

void LubricationForce::check_gap(double gap) const {
  const auto [smallest, largest] = fitted_interval_;
  const bool allowed =
      gap >= largest_gap_ ? false
      : gap >= smallest
          ? gap <= largest || (outside_.above != AboveInterval::kError && std::isfinite(gap))
          : outside_.below != BelowInterval::kError && gap > 0;
  if (allowed) return;
  std::string remedy;
  if (gap >= largest_gap_ && std::isfinite(largest_gap_))
    throw Error(ErrorKind::kBadInput,
                "gap {} is not less than {}, at which the sphere touches the wall opposite", gap,
                largest_gap_);
  if (exact_ && gap >= 0 && gap < smallest)
    throw Error(ErrorKind::kNotConverged,
                "the film is thinner than the smallest number that a double can hold");
  if (exact_)
    throw Error(ErrorKind::kBadInput,
                "gap {} is outside [{}, {}], the gaps at which the exact drag can be computed", gap,
                smallest, largest);
  if (gap < smallest && outside_.below == BelowInterval::kError)
    remedy =
        ", or let the drag follow the lubrication limit below it (below = \"lubrication_limit\" in "
        "the section [fit] of the case)";
  if (gap > largest) remedy = remedy_above();
  throw Error(ErrorKind::kBadInput,
              "gap {} is outside the fitted interval [{}, {}]; tabulate and fit further{}", gap,
              smallest, largest, remedy);
}

std::string LubricationForce::remedy_above() const {
  return fmt::format(
      ", or let the drag {} above it (above = \"stokes_limit\" in the section [fit] of the case)",
      largest_gap_ < kNoWall
          ? fmt::format("follow a limit up to the wall opposite, which is at the gap {:.6g},",
                        largest_gap_)
          : "tend to Stokes' drag");
}

double LubricationForce::leading_coefficient() const {
  if (!(leading_ > 0))
    throw Error(ErrorKind::kBadInput,
                "the fit's coefficient of 1/q in the resistance is {}; it must be > 0 for a "
                "contact model and for the lubrication limit",
                leading_);
  return leading_;
}

LubricationForce::LubricationLimit LubricationForce::limit() const {
  if (!(limit_.k > 0)) (void)leading_coefficient();  // throws if the fit has no k
  return limit_;
}

double LubricationForce::regular_resistance(double gap) const {
  const double from = gap < 0 ? gap : std::max(gap, fitted_interval_[0]);
  check_gap(from);
  if (exact_) return leading_ / radius_ * plane_drag_factor_regular(from / radius_);
  if (from > fitted_interval_[1]) return resistance(from) - leading_ / from;
  return sum_values(regular_weights_, from, largest_gap_);
}

double LubricationForce::regular_impulse(double gap) const {
  const auto [smallest, largest] = fitted_interval_;
  if (gap >= 0 && gap <= smallest) return gap * regular_resistance(smallest);
  check_gap(gap);
  if (exact_) return leading_ * plane_drag_regular_integral(gap / radius_);
  const double to_smallest = smallest * regular_resistance(smallest);
  const double within = std::min(gap, largest);
  const double in_interval = sum_antiderivatives(regular_weights_, within, largest_gap_) -
                             sum_antiderivatives(regular_weights_, smallest, largest_gap_);
  const double above =
      gap > largest ? impulse(gap) - impulse(largest) - leading_ * std::log(gap / largest) : 0;
  return to_smallest + in_interval + above;
}

double LubricationForce::resistance(double gap) const {
  check_gap(gap);
  if (exact_) return leading_ / radius_ * plane_drag_factor(gap / radius_);
  if (gap < fitted_interval_[0]) {
    const double resistance = limit().k / gap + limit().constant;
    if (!std::isfinite(resistance))
      throw Error(ErrorKind::kNotConverged,
                  "the resistance at gap {} is larger than a double can hold", gap);
    return resistance;
  }
  if (gap > fitted_interval_[1])
    return stokes_resistance(viscosity_, radius_) * (1 + image_ / (gap + radius_)) +
           wall_leading_ * (1 / (largest_gap_ - gap) - 1 / (largest_gap_ - fitted_interval_[1]));
  return sum_values(weights_, gap, largest_gap_);
}

double LubricationForce::resistance_log_slope(double gap) const {
  check_gap(gap);
  if (exact_) return leading_ / radius_ * plane_drag_factor_log_slope(gap / radius_);
  if (gap < fitted_interval_[0]) return -limit().k / gap;
  if (gap > fitted_interval_[1])
    return -stokes_resistance(viscosity_, radius_) * image_ * gap /
               ((gap + radius_) * (gap + radius_)) +
           wall_leading_ * (gap / (largest_gap_ - gap)) / (largest_gap_ - gap);
  return sum_log_slopes(weights_, gap, largest_gap_);
}

double LubricationForce::impulse(double gap) const {
  check_gap(gap);
  if (exact_) return leading_ * plane_drag_integral(gap / radius_);
  const auto [smallest, largest] = fitted_interval_;
  if (gap < smallest)
    return impulse(smallest) + limit().k * std::log(gap / smallest) +
           limit().constant * (gap - smallest);
  if (gap > largest) {
    double by_wall = 0;
    if (largest_gap_ < kNoWall) {
      const double left = largest_gap_ - largest;
      by_wall = wall_leading_ * (std::log(left / (largest_gap_ - gap)) - (gap - largest) / left);
    }
    return impulse(largest) +
           stokes_resistance(viscosity_, radius_) *
               (gap - largest + image_ * std::log((gap + radius_) / (largest + radius_))) +
           by_wall;
  }
  return sum_antiderivatives(weights_, gap, largest_gap_) - impulse_offset_;
}

double LubricationForce::widest() const { return std::nextafter(largest_gap_, 0.0); }

std::array<double, 2> LubricationForce::bracket_of_impulse(double impulse_wanted) const {
  if (!std::isfinite(impulse_wanted))
    throw Error(ErrorKind::kBadInput,
                "the film would have to absorb an impulse of {}; it must be finite",
                impulse_wanted);
  const auto [smallest, largest] = fitted_interval_;
  const double low = std::log(smallest / radius_);
  const double high = std::log(largest / radius_);
  const auto [least, most] = impulses_at_ends_;
  if (exact_ && impulse_wanted > least && impulse_wanted < most) {
    // Gamma/k = int_1^eps K(s) ds with eps = gap/radius and the drag factor K of a plane. K is
    // larger than 1/s and larger than 1, so Gamma/k < ln eps if eps < 1; if eps > 1, Gamma/k is
    // larger than ln eps and than eps - 1.
    const double scaled = impulse_wanted / leading_;
    if (scaled < 0) return {std::max(scaled, low), 0.0};
    return {0.0, std::min(scaled, std::log1p(scaled))};
  }
  if (impulse_wanted < least) {
    if (exact_)
      throw Error(ErrorKind::kNotConverged,
                  "the film is thinner than the smallest number that a double can hold");
    if (outside_.below == BelowInterval::kError)
      throw Error(ErrorKind::kBadInput,
                  "the film would be thinner than the fitted interval [{:.6g}, {:.6g}]; tabulate "
                  "and fit further, or let the drag follow the lubrication limit below it (below = "
                  "\"lubrication_limit\" in the section [fit] of the case)",
                  smallest, largest);
    // Below the interval R = k/q + c. With s = ln q, Gamma(q) = impulse is the equation
    // k (s - ln q1) + c (e^s - q1) = impulse - Gamma(q1). Without the term with c, s would be
    // known; this term changes s by less than |c| q1/k.
    const auto [k, constant] = limit();
    const double by_leading_term = low + (impulse_wanted - least) / k;
    const double by_constant = constant * smallest / k;
    const double above = std::min(low, by_leading_term + std::max(0.0, by_constant));
    const double thinnest = std::log(std::numeric_limits<double>::min()) - std::log(radius_);
    if (!(above >= thinnest))
      throw Error(ErrorKind::kNotConverged,
                  "the film is thinner than the smallest number that a double can hold");
    return {std::max(thinnest, by_leading_term + std::min(0.0, by_constant)), above};
  }
  const double beyond = impulse_wanted - most;
  if (!(beyond > 0)) return {low, high};
  if (outside_.above == AboveInterval::kError)
    throw Error(ErrorKind::kBadInput,
                "the gap would be wider than the fitted interval [{:.6g}, {:.6g}]; tabulate and "
                "fit further{}",
                smallest, largest, remedy_above());
  if (largest_gap_ < kNoWall) return {high, std::log(widest() / radius_)};
  // Above the interval R lies between its values at q2 and at infinity.
  const double stokes = stokes_resistance(viscosity_, radius_);
  return {high, std::log((largest + beyond / std::min(stokes, resistance(largest))) / radius_)};
}

double LubricationForce::gap_of_impulse(double impulse_wanted, double near) const {
  assert(near > 0);
  // Near contact Gamma is almost linear in s = ln(q/r), so Newton's method in s converges fast. ln
  // q instead of ln(q/r) would make rounding errors depend on the unit of length.
  const auto [low, high] = bracket_of_impulse(impulse_wanted);
  // At an end of the interval, rounding of ln and exp may give a gap just outside it.
  const auto gap_at = [this](double log_gap) {
    return std::clamp(radius_ * std::exp(log_gap), interval()[0],
                      std::min(interval()[1], widest()));
  };
  if (largest_gap_ < kNoWall && interval()[1] >= widest() && impulse_wanted >= impulse(widest()))
    return widest();
  const auto excess_and_slope = [&](double s) {
    const double gap = gap_at(s);
    return std::pair(impulse(gap) - impulse_wanted, resistance(gap) * gap);
  };
  // A step below the rounding of s does not change the result.
  const auto settled = [](double s, double next) {
    return std::abs(next - s) <=
           2 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(s));
  };
  const double start = std::isfinite(near) ? std::clamp(std::log(near / radius_), low, high)
                                           : high - (high - low) / 2;
  return gap_at(bracketed_newton(start, low, high, Bracket::kOpen, excess_and_slope, settled));
}

}  // namespace viscontact::lubrication
