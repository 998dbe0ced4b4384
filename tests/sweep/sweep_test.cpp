// Rows of a sweep, one by one and on several threads.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/sweep/sweep_rows.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/sweep/sphere_study.hpp"

namespace viscontact::sweep {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Expects of a row the digits that simulate and compare_trajectories give for a case.
void expect_row_of(const SpherePlan& plan, std::uint64_t index, const std::string& case_text,
                   const lubrication::LubricationForce& force) {
  const TemporaryFolder folder;
  const case_file::Case c = case_file::read_case(folder.file("case.toml", case_text));
  std::vector<reduced_model::Trajectory> trajectories;
  for (const auto& model : plan.models)
    trajectories.push_back(reduced_model::simulate(reduced_model::find_model(model),
                                                   case_file::required_motion(c), force));
  const auto comparison = reduced_model::compare_trajectories(trajectories, plan.reference);
  const auto& reference =
      *std::ranges::find(comparison.models, plan.reference, &reduced_model::ModelComparison::model);
  const auto thinnest = [](const reduced_model::ModelComparison& m) {
    return m.film_from_gamma ? *m.film_from_gamma : m.minimal_gap;
  };
  const auto row = row_of(plan, index);
  for (const auto& m : comparison.models) {
    const auto expect = [&](const std::string& name, const std::optional<double>& value) {
      EXPECT_EQ(row.at(m.model + "." + name), value ? format_number(*value) : "")
          << m.model << "." << name;
    };
    const auto contact = [&](std::size_t i) {
      return m.contact_interval ? std::optional(m.contact_interval->at(i)) : std::nullopt;
    };
    expect("minimal_gap", m.minimal_gap);
    expect("minimal_gap_time", m.minimal_gap_time);
    expect("film_from_gamma", m.film_from_gamma);
    expect("contact_from", contact(0));
    expect("contact_until", contact(1));
    expect("sup_gap_distance", m.sup_gap_distance);
    expect("l1_gap_distance", m.l1_gap_distance);
    expect("l1_velocity_distance", m.l1_velocity_distance);
    expect("film_ratio", thinnest(m) / thinnest(reference));
    expect("steps", static_cast<double>(m.steps));
  }
  EXPECT_EQ(row.at("failure"), "");
}

TEST(SweepRow, IsTheRunOfTheCaseWrittenByHand) {
  const auto plan =
      with_models(varied(shipped("vanishing_viscosity.toml"),
                         {"fluid.viscosity=0.5,0.1", "motion.external_force[0].value=-3,-1"}),
                  {"viscous_contact_exact", "inertial", "viscous_contact"}, "inertial");
  const TemporaryFolder folder;
  auto fit = read_file(data("fits/leading_term.json"));
  for (const auto& [from, to] : {std::pair("\"viscosity\": 1.0", "\"viscosity\": 0.1"),
                                 std::pair("\"coefficient\": 1.0", "\"coefficient\": 0.1")}) {
    ASSERT_NE(fit.find(from), std::string::npos);
    fit.replace(fit.find(from), std::string(from).size(), to);
  }
  const lubrication::LubricationForce force(lubrication::read_fit(folder.file("fit.json", fit)));
  const auto text = [&](const std::string& push) {
    return study_text("vanishing_viscosity.toml", {{"viscosity = 1.0", "viscosity = 0.1"},
                                                   {"value = -2.0", "value = " + push}});
  };
  expect_row_of(plan, 2, text("-3"), force);
  expect_row_of(plan, 3, text("-1"), force);
}

TEST(SweepRow, WithTheExactDragTooAndTimesDrawnOut) {
  const auto plan = varied(shipped("regime_map.toml"),
                           {"sphere.mass=0.5", "motion.time_scale=2.5", "sphere.radius=1,2"});
  expect_row_of(plan, 1,
                study_text("regime_map.toml", {{"mass = 1.0 ", "mass = 0.5 "},
                                               {"time_scale = 1.0", "time_scale = 2.5"},
                                               {"radius = 1.0", "radius = 2.0"}}),
                lubrication::LubricationForce::exact_plane(0.05305164769729845, 2));
}

TEST(SweepRow, BeginsWithTheNumbersThatWereVaried) {
  const auto plan =
      varied(shipped("time_step.toml"), {"fluid.viscosity=0.1,0.7", "motion.initial_gap=1,0.3"});
  const auto row = row_of(plan, 2);
  EXPECT_EQ(row.at("fluid.viscosity"), "0.7");
  EXPECT_EQ(row.at("motion.initial_gap"), "1");
  const auto columns = sphere_study(plan, "").columns();
  EXPECT_EQ(columns.front(), "fluid.viscosity");
  EXPECT_EQ(columns.at(1), "motion.initial_gap");
  EXPECT_EQ(columns.at(2), "viscous_contact_exact.minimal_gap");
  EXPECT_EQ(columns.back(), "failure");
}

TEST(SweepRow, ViscosityScalesTheFit) {
  const auto plan = varied(shipped("vanishing_viscosity.toml"), {"fluid.viscosity=0.25,0.5,1,2"});
  for (std::uint64_t i = 0; i < 4; ++i) {
    const auto row = row_of(plan, i);
    // gamma = -4 to round-off at the end of the push, k = mu, q0 = 1: exp(-4/mu), 4/mu being 16 at
    // most.
    EXPECT_NEAR(number(row, "viscous_contact_exact.film_from_gamma") /
                    std::exp(-4 / number(row, "fluid.viscosity")),
                1, 64 * kEpsilon);
  }
}

TEST(SweepRow, RandomSamplesHaveTheirOwnNumbers) {
  auto plan = varied(shipped("vanishing_viscosity.toml"), {"fluid.viscosity=0.1:1:log:2"});
  plan.points.samples = 3;
  plan.points.seed = 7;
  ASSERT_EQ(plan.points.rows(), 3U);
  for (std::uint64_t i = 0; i < 3; ++i)
    EXPECT_EQ(number(row_of(plan, i), "fluid.viscosity"),
              random_point(plan.points.variations, i, 7).at(0).second);
}

/// The leading term alone, for gaps down to 1e-3 only.
SpherePlan plan_of_short_fit() {
  auto plan = varied(shipped("vanishing_viscosity.toml"), {"fluid.viscosity=0.5"});
  plan.fit.gap_interval = {1e-3, 10};
  return plan;
}

/// What the inertial model says to that fit: its film is exp(-4/mu), 3.4e-4.
Error failure_of_inertial(const SpherePlan& plan) {
  const auto c = case_file::CaseTemplate<case_file::Case>(plan.case_path)
                     .with(std::array{std::pair(std::string("fluid.viscosity"), 0.5)});
  const lubrication::LubricationForce force(lubrication::with_viscosity(plan.fit, 0.5));
  return bad_input(
      [&] { reduced_model::simulate(reduced_model::find_model("inertial"), *c.motion, force); });
}

std::string without_commas(std::string text) {
  std::ranges::replace(text, ',', ';');
  return text;
}

TEST(SweepRow, ModelThatLeavesTheFitsIntervalLeavesItsFieldsEmptyAndSaysWhy) {
  const auto plan = plan_of_short_fit();
  ASSERT_EQ(plan.reference, "viscous_contact_exact");
  const auto row = row_of(plan, 0);
  const std::string message = failure_of_inertial(plan).what();
  ASSERT_THAT(message, AllOf(Names("inertial"), HasSubstr(",")));
  EXPECT_EQ(row.at("failure"), without_commas(message));
  const auto alone = row_of(with_models(plan, {"viscous_contact_exact"}, plan.reference), 0);
  for (const auto& [name, value] : row) {
    if (name.starts_with("inertial.")) {
      EXPECT_EQ(value, "") << name;
    } else if (name.starts_with("viscous_contact_exact.")) {
      EXPECT_EQ(value, alone.at(name)) << name;
    }
  }
  EXPECT_EQ(alone.at("viscous_contact_exact.minimal_gap"), "0");
}

TEST(SweepRow, WithoutItsReferenceAModelKeepsWhatIsItsOwn) {
  const auto plan =
      with_models(plan_of_short_fit(), {"viscous_contact_exact", "inertial"}, "inertial");
  const auto row = row_of(plan, 0);
  const auto alone =
      row_of(with_models(plan, {"viscous_contact_exact"}, "viscous_contact_exact"), 0);
  for (const std::string name : {"minimal_gap", "minimal_gap_time", "film_from_gamma",
                                 "contact_from", "contact_until", "steps"}) {
    EXPECT_EQ(row.at("viscous_contact_exact." + name), alone.at("viscous_contact_exact." + name));
    EXPECT_NE(row.at("viscous_contact_exact." + name), "") << name;
  }
  for (const std::string name :
       {"sup_gap_distance", "l1_gap_distance", "l1_velocity_distance", "film_ratio"})
    EXPECT_EQ(row.at("viscous_contact_exact." + name), "") << name;
}

TEST(SweepRow, AllFailuresAreNamed) {
  const auto plan = with_models(plan_of_short_fit(), {"inertial", "reference_exact"}, "inertial");
  EXPECT_THAT(row_of(plan, 0).at("failure"), Names("inertial", "reference_exact"));
}

TEST(SweepRow, PointInTheMiddleThatIsNoCaseIsARowThatSaysSo) {
  const auto sweep =
      sphere_study(varied(shipped("vanishing_viscosity.toml"), {"fluid.viscosity=1,-1,2"}), "");
  const auto row = fields_of(sweep, sweep.row(1));
  EXPECT_EQ(row.at("fluid.viscosity"), "-1");
  EXPECT_THAT(row.at("failure"), Names("vanishing_viscosity.toml", "fluid.viscosity", "-1"));
  for (const auto& [name, value] : row) {
    if (name != "fluid.viscosity" && name != "failure") {
      EXPECT_EQ(value, "") << name;
    }
  }
  EXPECT_EQ(fields_of(sweep, sweep.row(2)).at("failure"), "");
}

TEST(SweepRow, HasNumbersThatAreFiniteOrNothing) {
  // A film of 0.02 held by roughness, over exp(-4/0.0055), 1.4e-316: no double holds the quotient.
  const auto plan = with_models(
      varied(shipped("vanishing_viscosity.toml"),
             {"fluid.viscosity=0.0055", "viscous_contact.roughness[0]=0.02"}),
      {"viscous_contact_exact", "viscous_contact_exact_smooth"}, "viscous_contact_exact_smooth");
  const auto row = row_of(plan, 0);
  ASSERT_LT(number(row, "viscous_contact_exact_smooth.film_from_gamma"), 2e-316);
  ASSERT_GT(number(row, "viscous_contact_exact_smooth.film_from_gamma"), 0);
  for (const auto& [name, value] : row) {
    if (name != "failure") {
      EXPECT_TRUE(value.empty() || parse_number(value)) << name << " is " << value;
    }
  }
}

}  // namespace
}  // namespace viscontact::sweep
