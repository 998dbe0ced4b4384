// Integrates the displacement and the power of a swimmer along a stroke.
#include "viscontact/swimmer/swim.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "viscontact/common/error.hpp"

namespace viscontact::swimmer {
namespace {

/// Free choices of the quadrature over time.
struct SwimTuning {
  // Points on a leg for its sums. The integrands are analytic, so that each doubling of the points
  // squares the error. Legs of 1e-3 radii need 8 points, legs across the whole table 64.
  static constexpr int kFewest = 8, kMost = 512;
  // Relative change of energy and length at the last doubling. The change of the displacement over
  // the path of the arms must be a tenth of it.
  static constexpr double kTolerance = 1e-12;
  // Points between two rows, exact to round-off if rows are at most 1/100 of a stroke apart.
  static constexpr int kBetweenRows = 16;
  // Relative rounding error of a number of rows.
  static constexpr double kRounding = 1e-12;
};

/// Integrals over time on a leg or a part of it: displacement [L] and energy [M L^2/T^2].
struct Integrals {
  double displacement = 0, energy = 0;
  double length = 0;  ///< integral of the root of the power [M^(1/2) L/T^(1/2)]
  double towing = 0;  ///< integral of the towing resistance over time [M]
  double path = 0;    ///< length of the path of the arms [L], to which errors are relative

  Integrals& operator+=(const Integrals& other) {
    displacement += other.displacement;
    energy += other.energy;
    length += other.length;
    towing += other.towing;
    path += other.path;
    return *this;
  }
};

Integrals integrate(const Swimmer& swimmer, const StrokeLeg& leg, double from, double to,
                    const GaussRule& rule) {
  Integrals sum;
  for (Eigen::Index i = 0; i < rule.points.size(); ++i) {
    const auto state = leg.state(from + (to - from) * rule.points[i]);
    const auto mechanics = swimmer.at(state.arms);
    const double weight = rule.weights[i] * (to - from);
    const double velocity = mechanics.displacement_form * state.rates;
    const double power = state.rates.dot(mechanics.metric * state.rates);
    sum += {weight * velocity, weight * power, weight * std::sqrt(std::max(0.0, power)),
            weight * mechanics.towing_resistance, weight * state.rates.norm()};
  }
  return sum;
}

/// Integrates a leg with more and more points until the integrals no longer change.
Integrals integrate_leg(const Swimmer& swimmer, const StrokeLeg& leg) {
  auto before = integrate(swimmer, leg, leg.start, leg.end, gauss_rule(SwimTuning::kFewest));
  for (int count = 2 * SwimTuning::kFewest; count <= SwimTuning::kMost; count *= 2) {
    const auto sum = integrate(swimmer, leg, leg.start, leg.end, gauss_rule(count));
    if (std::abs(sum.displacement - before.displacement) <=
            SwimTuning::kTolerance / 10 * sum.path &&
        std::abs(sum.energy - before.energy) <= SwimTuning::kTolerance * sum.energy &&
        std::abs(sum.length - before.length) <= SwimTuning::kTolerance * sum.length)
      return sum;
    before = sum;
  }
  throw Error(ErrorKind::kNotConverged,
              "the displacement of the leg from time {:.6g} to {:.6g} does not converge with {} "
              "points of quadrature; divide the leg by more corners or rows",
              leg.start, leg.end, SwimTuning::kMost);
}

}  // namespace

SwimSums swim_sums(const Swimmer& swimmer, const Stroke& stroke) {
  Integrals sum;
  for (const auto& leg : stroke.legs) sum += integrate_leg(swimmer, leg);
  const double towing = sum.towing / stroke.period;
  return {sum.displacement, sum.energy, sum.length * sum.length / stroke.period,
          sum.energy > 0
              ? towing * sum.displacement * sum.displacement / (stroke.period * sum.energy)
              : 0};
}

std::vector<SwimRow> swim_rows(const Swimmer& swimmer, const Stroke& stroke, int intervals) {
  assert(intervals > 0 && stroke.period > 0);
  const auto rule = gauss_rule(SwimTuning::kBetweenRows);
  std::vector<SwimRow> rows;
  double position = 0;
  const auto add_row = [&](const StrokeLeg& leg, double time) {
    const auto state = leg.state(time);
    const auto mechanics = swimmer.at(state.arms);
    const Eigen::VectorXd velocities = mechanics.motion * state.rates;
    const Eigen::VectorXd forces = mechanics.resistance * velocities;
    rows.push_back({time, state.arms, position, forces, velocities.dot(forces)});
  };
  for (const auto& leg : stroke.legs) {
    const double share = (leg.end - leg.start) / stroke.period * intervals;
    const int parts = std::max(1, static_cast<int>(std::ceil(share * (1 - SwimTuning::kRounding))));
    for (int i = 0; i < parts; ++i) {
      const double from = std::lerp(leg.start, leg.end, static_cast<double>(i) / parts);
      const double to = std::lerp(leg.start, leg.end, static_cast<double>(i + 1) / parts);
      // At a corner of the stroke two rows have the same time, because forces jump there.
      add_row(leg, from);
      position += integrate(swimmer, leg, from, to, rule).displacement;
      if (i + 1 == parts) add_row(leg, to);
    }
  }
  return rows;
}

SwimErrors swim_errors(const SwimSums& sums, const Stroke& stroke,
                       const std::vector<ResistanceFit>& lower_degrees,
                       const std::vector<ResistanceFit>& table_errors, double multiplier) {
  const auto changes = [&](const ResistanceFit& fit) -> SwimErrors {
    const auto changed = swim_sums(Swimmer(fit), stroke);
    const double displacement = changed.displacement - sums.displacement;
    // The least energy for a given displacement changes, to first order, by the change of the
    // energy of this loop minus the multiplier times the change of its displacement.
    return {displacement, changed.energy - sums.energy - multiplier * displacement};
  };
  SwimErrors errors;
  for (const auto& fit : lower_degrees) {
    const auto change = changes(fit);
    errors.displacement += std::abs(change.displacement);
    errors.energy += std::abs(change.energy);
  }
  SwimErrors squares;
  for (const auto& fit : table_errors) {
    const auto change = changes(fit);
    squares.displacement += change.displacement * change.displacement;
    squares.energy += change.energy * change.energy;
  }
  if (!table_errors.empty()) {
    const auto count = static_cast<double>(table_errors.size());
    errors.displacement += 2 * std::sqrt(squares.displacement / count);
    errors.energy += 2 * std::sqrt(squares.energy / count);
  }
  return errors;
}

}  // namespace viscontact::swimmer
