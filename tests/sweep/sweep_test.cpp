// Rows of a sweep, one by one and on several threads.
#include "viscontact/sweep/sweep.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/sweep/sweep_rows.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/number.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Expects of a row the digits that simulate and compare_trajectories give for a case.
void expect_row_of(const SweepPlan& plan, std::uint64_t index, const std::string& case_text,
                   const LubricationForce& force) {
  const TemporaryFolder folder;
  const Case c = read_case(folder.file("case.toml", case_text));
  std::vector<Trajectory> trajectories;
  for (const auto& model : plan.models)
    trajectories.push_back(simulate(find_model(model), required_motion(c), force));
  const auto comparison = compare_trajectories(trajectories, plan.reference);
  const auto& reference =
      *std::ranges::find(comparison.models, plan.reference, &ModelComparison::model);
  const auto thinnest = [](const ModelComparison& m) {
    return m.recovered_minimal_gap ? *m.recovered_minimal_gap : m.minimal_gap;
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
    expect("film", m.recovered_minimal_gap);
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
  const LubricationForce force(read_fit(folder.file("fit.json", fit)));
  const auto text = [&](const std::string& push) {
    return study_text("vanishing_viscosity.toml", {{"viscosity = 1.0", "viscosity = 0.1"},
                                                   {"value = -2.0", "value = " + push}});
  };
  expect_row_of(plan, 2, text("-3"), force);
  expect_row_of(plan, 3, text("-1"), force);
}

TEST(SweepRow, WithTheExactDragTooAndTimesDrawnOut) {
  const auto plan = varied(shipped("regime_map.toml"),
                           {"motion.mass=0.5", "motion.time_scale=2.5", "sphere.radius=1,2"});
  expect_row_of(plan, 1,
                study_text("regime_map.toml", {{"mass = 1.0 ", "mass = 0.5 "},
                                               {"time_scale = 1.0", "time_scale = 2.5"},
                                               {"radius = 1.0", "radius = 2.0"}}),
                LubricationForce::exact_plane(0.05305164769729845, 2));
}

TEST(SweepRow, BeginsWithTheNumbersThatWereVaried) {
  const auto plan =
      varied(shipped("time_step.toml"), {"fluid.viscosity=0.1,0.7", "motion.initial_gap=1,0.3"});
  const auto row = row_of(plan, 2);
  EXPECT_EQ(row.at("fluid.viscosity"), "0.7");
  EXPECT_EQ(row.at("motion.initial_gap"), "1");
  const auto columns = sweep_columns(plan);
  EXPECT_EQ(columns.front(), "fluid.viscosity");
  EXPECT_EQ(columns.at(1), "motion.initial_gap");
  EXPECT_EQ(columns.at(2), "viscous_contact_exact.minimal_gap");
  EXPECT_EQ(columns.back(), "failure");
}

TEST(SweepRow, ViscosityScalesTheFit) {
  const auto plan = varied(shipped("vanishing_viscosity.toml"), {"fluid.viscosity=0.25,0.5,1,2"});
  for (std::uint64_t i = 0; i < 4; ++i) {
    const auto row = row_of(plan, i);
    // gamma = -4 to round-off at the end of the push, k = mu, q0 = 1: exp(-4/mu), 4/mu being 16 at most.
    EXPECT_NEAR(
        number(row, "viscous_contact_exact.film") / std::exp(-4 / number(row, "fluid.viscosity")),
        1, 64 * kEpsilon);
  }
}

TEST(SweepRow, RandomSamplesHaveTheirOwnNumbers) {
  auto plan = varied(shipped("vanishing_viscosity.toml"), {"fluid.viscosity=0.1:1:log:2"});
  plan.samples = 3;
  plan.seed = 7;
  ASSERT_EQ(sweep_size(plan), 3U);
  for (std::uint64_t i = 0; i < 3; ++i)
    EXPECT_EQ(number(row_of(plan, i), "fluid.viscosity"),
              random_point(plan.variations, i, 7).at(0).second);
}

/// The leading term alone, for gaps down to 1e-3 only.
SweepPlan plan_of_short_fit() {
  auto plan = varied(shipped("vanishing_viscosity.toml"), {"fluid.viscosity=0.5"});
  plan.fit.gap_interval = {1e-3, 10};
  return plan;
}

/// What the inertial model says to that fit: its film is exp(-4/mu), 3.4e-4.
std::string failure_of_inertial(const SweepPlan& plan) {
  const auto c =
      CaseTemplate(plan.case_path).with(std::array{std::pair(std::string("fluid.viscosity"), 0.5)});
  const LubricationForce force(with_viscosity(plan.fit, 0.5));
  return bad_input([&] { simulate(find_model("inertial"), *c.motion, force); });
}

std::string without_commas(std::string text) {
  std::ranges::replace(text, ',', ';');
  return text;
}

TEST(SweepRow, ModelThatLeavesTheFitsIntervalLeavesItsFieldsEmptyAndSaysWhy) {
  const auto plan = plan_of_short_fit();
  ASSERT_EQ(plan.reference, "viscous_contact_exact");
  const auto row = row_of(plan, 0);
  const auto message = failure_of_inertial(plan);
  ASSERT_THAT(message, AllOf(HasSubstr("model inertial: "), HasSubstr(",")));
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
  for (const std::string name :
       {"minimal_gap", "minimal_gap_time", "film", "contact_from", "contact_until", "steps"}) {
    EXPECT_EQ(row.at("viscous_contact_exact." + name), alone.at("viscous_contact_exact." + name));
    EXPECT_NE(row.at("viscous_contact_exact." + name), "") << name;
  }
  for (const std::string name :
       {"sup_gap_distance", "l1_gap_distance", "l1_velocity_distance", "film_ratio"})
    EXPECT_EQ(row.at("viscous_contact_exact." + name), "") << name;
}

TEST(SweepRow, AllFailuresAreNamed) {
  const auto plan = with_models(plan_of_short_fit(), {"inertial", "reference_exact"}, "inertial");
  EXPECT_THAT(row_of(plan, 0).at("failure"),
              AllOf(HasSubstr("model inertial: "), HasSubstr(" | model reference_exact: ")));
}

TEST(SweepRow, PointInTheMiddleThatIsNoCaseIsARowThatSaysSo) {
  const Sweep sweep(varied(shipped("vanishing_viscosity.toml"), {"fluid.viscosity=1,-1,2"}));
  const auto row = fields_of(sweep.plan(), sweep.row(1));
  EXPECT_EQ(row.at("fluid.viscosity"), "-1");
  EXPECT_THAT(row.at("failure"), HasSubstr("fluid.viscosity is -1; it must be a number > 0"));
  for (const auto& [name, value] : row) {
    if (name != "fluid.viscosity" && name != "failure") {
      EXPECT_EQ(value, "") << name;
    }
  }
  EXPECT_EQ(fields_of(sweep.plan(), sweep.row(2)).at("failure"), "");
}

TEST(SweepRow, HasNumbersThatAreFiniteOrNothing) {
  // A film of 0.02 held by roughness, over exp(-4/0.0055), 1.4e-316: no double holds the quotient.
  const auto plan = with_models(
      varied(shipped("vanishing_viscosity.toml"),
             {"fluid.viscosity=0.0055", "viscous_contact.roughness[0]=0.02"}),
      {"viscous_contact_exact", "viscous_contact_exact_smooth"}, "viscous_contact_exact_smooth");
  const auto row = row_of(plan, 0);
  ASSERT_LT(number(row, "viscous_contact_exact_smooth.film"), 2e-316);
  ASSERT_GT(number(row, "viscous_contact_exact_smooth.film"), 0);
  for (const auto& [name, value] : row) {
    if (name != "failure") {
      EXPECT_TRUE(value.empty() || parse_number(value)) << name << " is " << value;
    }
  }
}

TEST(SweepPlanCheck, FirstAndLastPointMustBeCases) {
  for (const std::string values : {"-1,1", "1,-1"})
    EXPECT_THAT(bad_input([&] {
                  Sweep(varied(shipped("vanishing_viscosity.toml"), {"fluid.viscosity=" + values}));
                }),
                AllOf(HasSubstr("vanishing_viscosity.toml"), HasSubstr("fluid.viscosity is -1"),
                      HasSubstr("must be a number > 0"), HasSubstr("with fluid.viscosity = -1")));
  EXPECT_THAT(
      bad_input([] { Sweep(varied(shipped("vanishing_viscosity.toml"), {"fluid.viscosty=1,2"})); }),
      HasSubstr("fluid.viscosty"));
}

TEST(SweepPlanCheck, CaseNeedsAMotion) {
  const TemporaryFolder folder;
  auto text = read_file(data("cases/vanishing_viscosity.toml"));
  text.erase(text.find("[motion]"));
  auto plan = shipped("vanishing_viscosity.toml");
  plan.case_path = folder.file("case.toml", text);
  EXPECT_THAT(bad_input([&] { Sweep sweep(plan); }), HasSubstr("[motion]"));
}

TEST(SweepPlanCheck, RadiusIsThatOfTheFitUnlessTheDragIsExact) {
  EXPECT_THAT(bad_input([] {
                Sweep(varied(shipped("vanishing_viscosity.toml"), {"sphere.radius=0.3:0.4:3"}));
              }),
              AllOf(HasSubstr("sphere.radius is 0.3"),
                    HasSubstr("the fit's radius is 0.23032943298089034"), HasSubstr("exact drag")));
  EXPECT_THAT(bad_input([] {
                Sweep(varied(shipped("vanishing_viscosity.toml"),
                             {"sphere.radius=0.23032943298089034,0.4"}));
              }),
              HasSubstr("sphere.radius is 0.4"));
  // k = 6 pi mu r^2 = 4, and gamma is -1 at the end of the push, q0 = 1: exp(gamma/k), to the round-off of 1000 sums.
  const auto row =
      row_of(varied(shipped("regime_map.toml"), {"sphere.radius=1,2", "sphere.mass=0.1"}), 1);
  EXPECT_NEAR(number(row, "viscous_contact.film") / std::exp(-0.25), 1, 1e-12);
}

TEST(SweepPlanCheck, RadiusInTheMiddleIsThatOfTheFitToo) {
  // Refused at once or as a row: not run with the drag of another sphere.
  auto plan = varied(shipped("vanishing_viscosity.toml"),
                     {"sphere.radius=0.23032943298089034,1,0.23032943298089034"});
  try {
    EXPECT_THAT(row_of(plan, 1).at("failure"), HasSubstr("sphere.radius"));
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("sphere.radius is 1"));
  }
}

TEST(SweepPlanCheck, NothingIsThereTwiceAndTheReferenceIsOneOfTheModels) {
  const auto plan = shipped("vanishing_viscosity.toml");
  const auto wrong = [](const SweepPlan& p) {
    return failure(ErrorKind::kWrongUsage, [&] { Sweep sweep(p); });
  };
  EXPECT_THAT(wrong(varied(plan, {"sphere.mass=1,2", "fluid.viscosity=1", "motion.mass=3"})),
              HasSubstr("the key sphere.mass is given twice"));
  EXPECT_THAT(wrong(with_models(plan, {"inertial", "inertial"}, "inertial")),
              HasSubstr("the model inertial is given twice"));
  EXPECT_THAT(
      wrong(with_models(plan, {"inertial"}, "viscous_contact")),
      AllOf(HasSubstr("'viscous_contact' is not one of the models"), HasSubstr("inertial")));
  EXPECT_THAT(bad_input([&] { Sweep sweep(with_models(plan, {"inertia"}, "inertia")); }),
              HasSubstr("inertia"));
}

class RunSweep : public ::testing::Test {
 protected:
  using Taken = std::vector<std::pair<std::uint64_t, std::string>>;
  /// The first rows take a hundred times as long as the last, which so are done first; more of them than any thread may run ahead.
  const Sweep sweep_{
      varied(shipped("time_step.toml"), {"viscous_contact.time_step=1e-3:1e-1:log:200"})};
  Taken run(std::uint64_t begin, int jobs) const {
    Taken taken;
    const auto end = run_sweep(
        sweep_, begin, jobs,
        [&](std::uint64_t index, const std::string& row) { taken.emplace_back(index, row); });
    EXPECT_EQ(end, 200U);
    return taken;
  }
};

TEST_F(RunSweep, HandsTheSameRowsOverInOrderOnAnyNumberOfThreads) {
  const auto one = run(0, 1);
  ASSERT_EQ(one.size(), 200U);
  for (std::uint64_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].first, i);
  for (const std::uint64_t i : {0U, 7U, 199U}) EXPECT_EQ(one[i].second, sweep_.row(i));
  for (const int jobs : {2, 5}) EXPECT_EQ(run(0, jobs), one) << jobs;
}

TEST_F(RunSweep, BeginsWhereItIsTold) {
  const auto taken = run(197, 2);
  ASSERT_EQ(taken.size(), 3U);
  for (std::uint64_t i = 0; i < 3; ++i) {
    EXPECT_EQ(taken[i].first, 197 + i);
    EXPECT_EQ(taken[i].second, sweep_.row(197 + i));
  }
  EXPECT_TRUE(run(200, 2).empty());
}

TEST_F(RunSweep, StopsWhenARowIsNotTaken) {
  for (const int jobs : {1, 2, 5}) {
    std::vector<std::uint64_t> offered;
    const auto take = [&](std::uint64_t index, const std::string&) {
      offered.push_back(index);
      if (index == 5) throw std::domain_error("full");
    };
    EXPECT_THROW(run_sweep(sweep_, 0, jobs, take), std::domain_error) << jobs;
    EXPECT_THAT(offered, ElementsAre(0, 1, 2, 3, 4, 5)) << jobs;
  }
}

}  // namespace
}  // namespace viscontact
