// Tables and fits that several tests start from. Viscosity and radius are those of the tables;
// lengths, masses and times are in one unit each.
#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string>
#include <vector>

#include "tests/oracles/brenner.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::fitting {

/// `count` numbers from `from` to `to`, in geometric progression.
inline std::vector<double> log_spaced(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i)
    values.push_back(from * std::pow(to / from, static_cast<double>(i) / (count - 1)));
  values.back() = to;
  return values;
}

/// A table with the exact drag of a plane in a half-space, as a solver without errors would make
/// it.
inline lubrication::MotionTable exact_drag_table(const std::vector<double>& gaps,
                                                 const std::vector<double>& velocities,
                                                 double viscosity, double radius) {
  lubrication::MotionTable table;
  table.viscosity = viscosity;
  table.radius = radius;
  table.container = "unbounded";
  for (const double velocity : velocities)
    for (const double gap : gaps) {
      lubrication::MotionRow row;
      row.gap = gap;
      row.reference_velocity = velocity;
      row.force_factor = brenner_drag_factor(gap / radius);
      row.force = -6 * std::numbers::pi * viscosity * radius * row.force_factor * velocity;
      table.rows.push_back(row);
    }
  return table;
}

/// The 50 gaps of docs/theory.md's table of what the exact half-space drag allows (section 2).
inline std::vector<double> fifty_gaps() { return log_spaced(1e-3, 1, 50); }

/// The force F(q, u0) of a fit at the gap q, summed term by term without the code under test.
inline double fitted_force(const lubrication::Fit& fit, double gap) {
  double force = 0;
  for (const auto& term : fit.terms)
    force += term.coefficient * lubrication::find_term(term.name)->value(gap);
  return force;
}

struct NamedCoefficient {
  std::string term;
  double coefficient;
};

/// A fit with given coefficients at the velocity u0 = -1, so that its resistance is the sum of
/// coefficient * term.
inline lubrication::Fit planted_fit(std::initializer_list<NamedCoefficient> terms,
                                    double smallest_gap, double largest_gap) {
  lubrication::Fit fit;
  fit.basis = "planted";
  fit.reference_velocity = -1;
  fit.viscosity = 3;
  fit.radius = 1;
  fit.gap_interval = {smallest_gap, largest_gap};
  for (const auto& [term, coefficient] : terms) fit.terms.push_back({term, coefficient, 0});
  fit.covariance.assign(terms.size(), std::vector<double>(terms.size(), 0.0));
  return fit;
}

}  // namespace viscontact::fitting
