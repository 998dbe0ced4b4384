#include "tests/reduced_model/cases.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "tests/oracles/brenner.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact_threshold.hpp"
#include "viscontact/reduced_model/models/inertial.hpp"

namespace viscontact::reduced_model {
namespace {

constexpr double kViscosity = 3;
constexpr double kRadius = 1;

Motion motion_with_settings(double mass, double end_time,
                            std::vector<ExternalForce::Piece> pieces) {
  Motion motion{mass, 1, 0, end_time, ExternalForce(std::move(pieces))};
  motion.set(kReferenceTimeStep, 1e-3);
  motion.set(kRelativeTolerance, 1e-9);
  motion.set(kContactTimeStep, 1e-3);
  motion.set(kThresholdGap, 0.1);
  return motion;
}

/// A fit that was not fitted: these terms, as they are.
lubrication::Fit planted_fit(double k, std::array<double, 2> gap_interval,
                             std::vector<lubrication::FitTerm> terms) {
  lubrication::Fit fit;
  fit.basis = "planted";
  fit.reference_velocity = -1;
  fit.viscosity = k / (6 * std::numbers::pi * kRadius * kRadius);
  fit.radius = kRadius;
  fit.gap_interval = gap_interval;
  fit.covariance.assign(terms.size(), std::vector<double>(terms.size(), 0.0));
  fit.terms = std::move(terms);
  return fit;
}

}  // namespace

Motion lecture_motion() { return motion_with_settings(20, 4, {{2, -200}, {4, 200}}); }

Motion limit_motion() { return motion_with_settings(1, 6, {{2, -2}, {6, 2}}); }

lubrication::Fit brenner_fit(std::string_view basis, std::array<double, 2> gaps) {
  constexpr int kRows = 40;
  lubrication::MotionTable table;
  table.viscosity = kViscosity;
  table.radius = kRadius;
  for (int i = 0; i < kRows; ++i) {
    lubrication::MotionRow row;
    row.gap = gaps[0] * std::pow(gaps[1] / gaps[0], static_cast<double>(i) / (kRows - 1));
    if (i == kRows - 1) row.gap = gaps[1];
    row.reference_velocity = -1;
    row.force =
        6 * std::numbers::pi * kViscosity * kRadius * brenner_drag_factor(row.gap / kRadius);
    table.rows.push_back(row);
  }
  return fitting::fit_force_table(table, basis, lubrication::Weights::kRelative);
}

lubrication::Fit lecture_fit() { return brenner_fit("lecture", {1e-3, 2}); }

lubrication::Fit close_fit() { return brenner_fit("asymptotic", {1e-3, 1.01}); }

lubrication::Fit leading_term_fit(double k) {
  return planted_fit(k, {1e-200, 1e20}, {{"1/q", k, 0}});
}

lubrication::Fit shifted_fit(double k) {
  return planted_fit(k, {1e-200, 1e200}, {{"1/q", k, 0}, {"1", k, 0}});
}

RandomCase random_case(std::mt19937_64& generator) {
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution(from, to)(generator);
  };
  const auto decades = [&](double from, double to) { return std::pow(10, uniform(from, to)); };
  const double mass = decades(-5, 5);
  std::vector<ExternalForce::Piece> pieces;
  const int count = std::uniform_int_distribution(1, 7)(generator);
  for (int i = 1; i <= count; ++i)
    pieces.push_back({10.0 * i / count, mass * decades(-2, 2) * (uniform(0, 1) < 0.6 ? -1 : 1)});
  Motion motion{mass, decades(-1, 1), uniform(-3, 1), 10, ExternalForce(pieces)};
  if (uniform(0, 3) < 1)
    motion.external_force += ExternalForce::sinusoidal(
        {mass * decades(-2, 2), decades(-1, 1), uniform(0, 2 * std::numbers::pi)});
  motion.set(kContactTimeStep, decades(-2, -1));
  motion.set(kReferenceTimeStep, 0.1);
  motion.set(kRelativeTolerance, 1e-9);
  motion.set(kThresholdGap, motion.initial_gap * uniform(0.01, 0.9));
  if (uniform(0, 1) < 0.5)
    motion.roughness = {motion.parameter(kThresholdGap) * decades(-6, -1), 0};
  return {motion, decades(-5, 5)};
}

const TrajectoryRow& lowest_row(const Trajectory& trajectory) {
  return *std::ranges::min_element(trajectory.rows, {}, &TrajectoryRow::gap);
}

const TrajectoryRow& row_at(const Trajectory& trajectory, double time) {
  const auto found = std::ranges::find(trajectory.rows, time, &TrajectoryRow::time);
  if (found == trajectory.rows.end())
    throw std::out_of_range("no row at time " + std::to_string(time));
  return *found;
}

}  // namespace viscontact::reduced_model
