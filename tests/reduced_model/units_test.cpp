// The same motion written in other units of length, mass and time must give the same numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/oracles/brenner.hpp"
#include "tests/reduced_model/cases.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact_threshold.hpp"
#include "viscontact/reduced_model/models/inertial.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact::reduced_model {
namespace {

/// How many new units one old unit is.
struct Units {
  double length, mass, time;
  double velocity() const { return length / time; }
  double force() const { return mass * length / (time * time); }
  double impulse() const { return mass * length / time; }
  double viscosity() const { return mass / (length * time); }
};

constexpr Units kOld = {1, 1, 1};
/// Factors far from 1 of the kind that users have (metres to micrometres, grams to picograms).
constexpr Units kDecimal[] = {{1e-6, 1, 1},       {1e3, 1, 1},         {1, 1e-6, 1},
                              {1, 1, 1e3},        {1e-6, 1e-15, 1e-3}, {1e3, 1e6, 1e-6},
                              {7.3e-7, 3e4, 11e5}};
/// With powers of 2 no number is rounded when its unit is changed.
constexpr Units kBinary[] = {
    {0x1p-20, 1, 1}, {0x1p10, 1, 1}, {0x1p-20, 0x1p-50, 0x1p-10}, {0x1p10, 0x1p-20, 0x1p10}};

/// The lubrication force on the lecture's sphere in these units: `kind` is a basis, fitted to the
/// exact drag, or "exact".
lubrication::LubricationForce force_in(const Units& units, const std::string& kind) {
  const double viscosity = 3 * units.viscosity();
  const double radius = units.length;
  if (kind == "exact") return lubrication::LubricationForce::exact_plane(viscosity, radius);
  constexpr int kRows = 40;
  constexpr double kSmallest = 1e-3, kLargest = 2;
  lubrication::MotionTable table;
  table.viscosity = viscosity;
  table.radius = radius;
  for (int i = 0; i < kRows; ++i) {
    const double gap = i + 1 == kRows ? kLargest
                                      : kSmallest * std::pow(kLargest / kSmallest,
                                                             static_cast<double>(i) / (kRows - 1));
    lubrication::MotionRow row;
    row.gap = gap * units.length;
    row.reference_velocity = -units.velocity();
    row.force = 6 * std::numbers::pi * 3 * brenner_drag_factor(gap) * units.force();
    table.rows.push_back(row);
  }
  return lubrication::LubricationForce(
      fitting::fit_force_table(table, kind, lubrication::Weights::kRelative),
      lubrication::OutsideInterval{}.with_limits());
}

struct Push {
  double mass, velocity, force;
};

/// The lecture's motion with this push; the force turns at t = 2.
Motion motion_in(const Units& units, const Push& push) {
  Motion motion{push.mass * units.mass, units.length, push.velocity * units.velocity(),
                4 * units.time,
                ExternalForce({{2 * units.time, -push.force * units.force()},
                               {4 * units.time, push.force * units.force()}})};
  motion.set(kReferenceTimeStep, 1e-3 * units.time);
  motion.set(kRelativeTolerance, 1e-9);
  motion.set(kContactTimeStep, 1e-3 * units.time);
  motion.set(kThresholdGap, 0.1 * units.length);
  motion.roughness = {1e-3 * units.length, 1e-3 * units.length};
  return motion;
}

constexpr Push kPushes[] = {{20, 0, 200}, {1e-3, 0, 200}, {500, -2, 50}};

struct Column {
  const char* name;
  double unit;
  double (*value)(const TrajectoryRow&);
};

std::vector<Column> columns_in(const Units& units) {
  return {
      {"time", units.time, [](const TrajectoryRow& row) { return row.time; }},
      {"gap", units.length, [](const TrajectoryRow& row) { return row.gap; }},
      {"velocity", units.velocity(), [](const TrajectoryRow& row) { return row.velocity; }},
      {"lubrication_force", units.force(),
       [](const TrajectoryRow& row) { return row.lubrication_force ? *row.lubrication_force : 0; }},
      {"gamma", units.impulse(),
       [](const TrajectoryRow& row) { return row.gamma ? *row.gamma : 0; }}};
}

/// The largest difference of a column between two twins, over the largest value of that column.
double difference(const Trajectory& old_one, const Trajectory& other, const Column& column) {
  double largest = 0, difference = 0;
  for (std::size_t i = 0; i < old_one.rows.size(); ++i) {
    const double value = column.value(old_one.rows[i]);
    largest = std::max(largest, std::abs(value));
    difference = std::max(difference, std::abs(column.value(other.rows[i]) / column.unit - value));
  }
  return largest > 0 ? difference / largest : difference;
}

/// Expects all columns and the film from gamma of two twins to agree to within `tolerance`.
void expect_twins(const Trajectory& old_one, const Trajectory& other, const Units& units,
                  double tolerance) {
  SCOPED_TRACE(::testing::Message() << old_one.model << ", units of " << units.length << ", "
                                    << units.mass << ", " << units.time);
  ASSERT_EQ(old_one.rows.size(), other.rows.size());
  for (const auto& column : columns_in(units))
    EXPECT_LE(difference(old_one, other, column), tolerance) << column.name;
  ASSERT_EQ(old_one.solid_contact_from.has_value(), other.solid_contact_from.has_value());
  if (const auto& touch = old_one.solid_contact_from) {
    EXPECT_NEAR(other.solid_contact_from->time / units.time / touch->time, 1, tolerance);
    EXPECT_NEAR(other.solid_contact_from->velocity / units.velocity() / touch->velocity, 1,
                tolerance);
  }
  ASSERT_EQ(old_one.film_from_gamma.has_value(), other.film_from_gamma.has_value());
  if (old_one.film_from_gamma) {
    EXPECT_NEAR(*other.film_from_gamma / units.length / *old_one.film_from_gamma, 1, tolerance);
  }
}

TEST(Units, ThatArePowersOfTwoChangeNoBitOfAnyModelWithTheExactDrag) {
  for (const Push& push : kPushes)
    for (const auto& units : kBinary)
      for (const auto& model : all_models()) {
        const auto old_one =
            simulate(find_model(model.name), motion_in(kOld, push), force_in(kOld, "exact"));
        const auto other =
            simulate(find_model(model.name), motion_in(units, push), force_in(units, "exact"));
        EXPECT_EQ(old_one.steps, other.steps) << model.name;
        expect_twins(old_one, other, units, 0);
      }
}

TEST(Units, ChangeTheModelsOfFixedStepsByRoundingOnly) {
  // A rounding, multiplied by thousands of steps; the force in the step of a landing is the most
  // sensitive column.
  constexpr double kRounding = 1e-10;
  for (const auto* kind : {"exact", "lecture", "asymptotic"})
    for (const Push& push : kPushes)
      for (const auto& units : kDecimal)
        for (const auto& model : all_models()) {
          if (model.name.starts_with("inertial")) continue;  // its steps are chosen: below
          SCOPED_TRACE(kind);
          const auto old_one =
              simulate(find_model(model.name), motion_in(kOld, push), force_in(kOld, kind));
          const auto other =
              simulate(find_model(model.name), motion_in(units, push), force_in(units, kind));
          if (model.name != "viscous_contact_exact") {
            expect_twins(old_one, other, units, kRounding);
            continue;
          }
          // An event that rounding alone sets apart from the time of a row has a row of its own, so
          // rows are not compared.
          for (const std::size_t i : {0U, 1U})
            EXPECT_NEAR((*other.contact_interval)[i] / units.time, (*old_one.contact_interval)[i],
                        1e-12);
          EXPECT_NEAR(*other.film_from_gamma / units.length, *old_one.film_from_gamma,
                      1e-12 * *old_one.film_from_gamma);
        }
}

/// The largest relative difference of the gap of `inertial` between twins, row by row.
double inertial_gap_difference(const std::string& kind, double tolerance) {
  double difference = 0;
  for (const auto& units : kDecimal) {
    const auto gaps_in = [&](const Units& in) {
      Motion motion = motion_in(in, kPushes[0]);
      motion.set(kRelativeTolerance, tolerance);
      return simulate(find_model("inertial"), motion, force_in(in, kind)).rows;
    };
    const auto old_rows = gaps_in(kOld), rows = gaps_in(units);
    EXPECT_EQ(old_rows.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      difference = std::max(difference, std::abs(rows[i].gap / units.length / old_rows[i].gap - 1));
  }
  return difference;
}

TEST(Units, ChangeTheInertialGapByLessThanItsTolerance) {
  // A rounding of an input, by another unit, makes CVODE take other steps, each within the
  // tolerance.
  for (const auto* kind : {"exact", "lecture", "asymptotic"}) {
    EXPECT_LT(inertial_gap_difference(kind, 1e-9), 2e-9) << kind;
    EXPECT_LT(inertial_gap_difference(kind, 1e-13), 1e-12) << kind;
  }
}

TEST(Units, LeaveTheInverseOfGammaAsItIs) {
  const auto old_force = force_in(kOld, "exact");
  for (const auto& units : kBinary) {
    const auto force = force_in(units, "exact");
    for (const double impulse : {-1e4, -600.0, -3.0, 0.5, 40.0, 3e5})
      EXPECT_EQ(force.gap_of_impulse(impulse * units.impulse()) / units.length,
                old_force.gap_of_impulse(impulse))
          << impulse;
  }
}

}  // namespace
}  // namespace viscontact::reduced_model
