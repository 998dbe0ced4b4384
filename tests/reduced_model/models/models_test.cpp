#include "viscontact/reduced_model/models/models.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/reduced_model/cases.hpp"

namespace viscontact::reduced_model {
namespace {

using ::testing::UnorderedElementsAreArray;

// file-formats.md, "Trajectory".
const std::vector<std::string> kNames = {"reference",
                                         "reference_exact",
                                         "inertial",
                                         "viscous_contact",
                                         "viscous_contact_regular_drag",
                                         "viscous_contact_threshold",
                                         "viscous_contact_exact",
                                         "inelastic_contact",
                                         "explicit_euler",
                                         "viscous_contact_leapfrog",
                                         "inertial_rough"};

TEST(Models, AreThoseOfThePage) {
  std::vector<std::string> names;
  for (const auto& model : all_models()) names.emplace_back(model.name);
  EXPECT_THAT(names, UnorderedElementsAreArray(kNames));
}

TEST(Models, HaveOneUsualReference) {
  EXPECT_EQ(std::ranges::count(all_models(), true, &Model::usual_reference), 1);
  EXPECT_EQ(reference_of({"reference", "inertial"}), "inertial");
  EXPECT_EQ(reference_of({"reference", "viscous_contact"}), "reference");
  EXPECT_EQ(reference_of({}), "inertial");
}

TEST(Models, AreFoundByTheirNames) {
  for (const auto& name : kNames) {
    EXPECT_EQ(find_model(name).name, name);
    EXPECT_FALSE(find_model(name).model->description.empty());
  }
}

TEST(Models, ListTheirNamesToOneWhoAsksForAnother) {
  for (const auto* wrong : {"", "Inertial", "viscous", "inertial "}) {
    const auto message = bad_input([&] { find_model(wrong); });
    EXPECT_THAT(message, Names(wrong));
    for (const auto& name : kNames) EXPECT_THAT(message, Names(name));
  }
}

TEST(Models, WithGammaAreTheContactModels) {
  const Motion motion = lecture_motion();
  const auto force = lubrication::LubricationForce::exact_plane(3, 1);
  for (const auto& model : all_models()) {
    const bool is_viscous = model.name.starts_with("viscous_contact");
    const bool is_contact = is_viscous || model.name == "inelastic_contact";
    EXPECT_EQ(model.contact != nullptr, is_contact) << model.name;
    const auto trajectory = simulate(find_model(model.name), motion, force);
    for (const auto& row : trajectory.rows)
      ASSERT_EQ(row.gamma.has_value(), is_contact) << model.name;
    EXPECT_EQ(trajectory.film_from_gamma.has_value(), is_viscous) << model.name;
  }
}

TEST(Models, CoverTheMotionFromItsStartToItsEnd) {
  const Motion motion = lecture_motion();
  const lubrication::LubricationForce force(lecture_fit());
  for (const auto& model : all_models()) {
    if (model.name == "explicit_euler") continue;  // it ends where it goes through the plane
    const auto trajectory = simulate(find_model(model.name), motion, force);
    EXPECT_EQ(trajectory.model, model.name);
    EXPECT_GE(trajectory.seconds, 0);
    EXPECT_GT(trajectory.steps, 0);
    EXPECT_EQ(trajectory.rows.front().time, 0) << model.name;
    EXPECT_EQ(trajectory.rows.front().gap, 1) << model.name;
    EXPECT_EQ(trajectory.rows.back().time, 4) << model.name;
    for (const auto& row : trajectory.rows)
      ASSERT_TRUE(std::isfinite(row.gap) && std::isfinite(row.velocity) &&
                  std::isfinite(row.lubrication_force.value()) && row.external_force.has_value())
          << model.name << " at " << row.time;
  }
}

TEST(Models, PutTheirNameInFrontOfAnError) {
  const lubrication::LubricationForce force(
      brenner_fit("lecture", {1e-2, 2}));  // too short for the film
  for (const auto* name :
       {"reference", "reference_exact", "inertial", "viscous_contact_threshold"}) {
    const auto message = bad_input([&] { simulate(find_model(name), lecture_motion(), force); });
    EXPECT_THAT(message, Names(name, "0.01", "2"));
  }
}

TEST(Models, RunOnTheShippedLimitCase) {
  // Its fit reaches from 1e-300 to 1e300: nothing on the way may overflow.
  const auto fit = lubrication::read_fit(std::filesystem::path(VISCONTACT_SOURCE_FOLDER) /
                                         "data/fits/limit.json");
  const lubrication::LubricationForce force(fit);
  for (const auto* name :
       {"inertial", "viscous_contact", "viscous_contact_regular_drag", "viscous_contact_threshold"})
    EXPECT_GT(simulate(find_model(name), limit_motion(), force).rows.size(), 6000U) << name;
}

TEST(Models, HaveABudgetThatBalances) {
  const auto force = lubrication::LubricationForce::exact_plane(3, 1);
  for (const auto& model : all_models()) {
    Motion motion = lecture_motion();
    motion.roughness = {0.05, 0};
    const auto trajectory = simulate(find_model(model.name), motion, force);
    const auto& budget = trajectory.budget.value();
    const auto& last = trajectory.rows.back();
    const double m = model.inertia ? motion.mass : 0;
    // Up to 4000 steps of a few roundings of impulses of up to 400 and works of up to 1000.
    EXPECT_NEAR(
        budget.external_impulse + budget.film_impulse + budget.drag_impulse + budget.solid_impulse,
        m * last.velocity, 1e-9)
        << model.name;
    EXPECT_NEAR(budget.external_work + budget.film_work + budget.drag_work + budget.solid_work,
                m / 2 * last.velocity * last.velocity, 1e-9)
        << model.name;
    EXPECT_LE(budget.drag_work, 0) << model.name;
    EXPECT_LE(budget.solid_work, 0) << model.name;
    if (model.name.starts_with("viscous_contact") && model.name != "viscous_contact_exact") {
      EXPECT_GT(budget.solid_impulse, 0) << model.name;
    }
  }
  // What drag takes is int R u^2: by rows, to second order in their spacing of 1e-3.
  const auto rows = simulate(find_model("inertial"), lecture_motion(), force).rows;
  double dissipated = 0;
  for (std::size_t i = 1; i < rows.size(); ++i)
    dissipated += (rows[i].time - rows[i - 1].time) *
                  (*rows[i].lubrication_force * rows[i].velocity +
                   *rows[i - 1].lubrication_force * rows[i - 1].velocity) /
                  2;
  const auto budget = simulate(find_model("inertial"), lecture_motion(), force).budget.value();
  EXPECT_NEAR(budget.film_work / dissipated, 1, 1e-4);
}

TEST(Models, AreCheckedForAStartWithinTheRoughnessWithoutARun) {
  Motion motion = lecture_motion();
  motion.roughness = {motion.initial_gap, 0};
  const auto force = lubrication::LubricationForce::exact_plane(3, 1);
  EXPECT_THAT(bad_input([&] { check_model(find_model("inertial_rough"), motion, force); }),
              Names("inertial_rough", "motion.initial_gap", "1"));
  EXPECT_NO_THROW(check_model(find_model("inertial"), motion, force));
}

TEST(Models, SayWhenTheyLeaveTheNumbersOfADouble) {
  Motion motion = lecture_motion();
  motion.mass = 1e-300;
  motion.external_force = ExternalForce({{4, 1e200}});
  failure(ErrorKind::kNotConverged, [&] {
    simulate(find_model("viscous_contact"), motion,
             lubrication::LubricationForce::exact_plane(3, 1));
  });
}

TEST(Models, RunWithTheExactDragAndWithoutRoughnessByTheirSuffixes) {
  Motion motion = lecture_motion();
  motion.roughness = {0.05, 0};
  const lubrication::LubricationForce fitted(
      lecture_fit(),
      {lubrication::BelowInterval::kError, lubrication::AboveInterval::kStokesLimit});
  const auto film = [&](const char* name) {
    return simulate(find_model(name), motion, fitted).film_from_gamma.value();
  };
  EXPECT_NEAR(film("viscous_contact_threshold"), 0.05, 1e-14);
  // Gamma and its inverse, at impulses of 400 over k = 57.
  EXPECT_NEAR(film("viscous_contact_threshold_brenner_smooth") / kExactMinimalGap, 1,
              2e-9);  // printed so
  EXPECT_EQ(film("viscous_contact_threshold_brenner_smooth"),
            film("viscous_contact_threshold_smooth_brenner"));
  for (const auto* wrong : {"inertial_smooth", "brenner", "_brenner", "inertial_brenner_brenner"})
    EXPECT_THAT(bad_input([&] { find_model(wrong); }), Names(wrong));
}

}  // namespace
}  // namespace viscontact::reduced_model
