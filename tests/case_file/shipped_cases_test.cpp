// The case files that are shipped hold what the lecture says.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "tests/freefem_axi/tabulations.hpp"
#include "viscontact/case_file/case_file.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact_threshold.hpp"
#include "viscontact/reduced_model/models/inertial.hpp"

namespace viscontact::case_file {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

Case shipped(const char* name) {
  return read_case(std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "data/cases" / name);
}

TEST(LecturesCase, HasTheLecturesSphereAndFluid) {
  const Case c = shipped("lecture.toml");
  EXPECT_EQ(c.title, "Sphere pushed towards a plane for 2, pulled back after");
  EXPECT_EQ(c.viscosity, 3);
  EXPECT_EQ(c.radius, 1);
  EXPECT_EQ(required_motion(c).mass, 20);
}

TEST(LecturesCase, TabulatesFortyGapsInTheLargeContainer) {
  const Case c = shipped("lecture.toml");
  const auto& tabulation = required_tabulation(c);
  EXPECT_EQ(tabulation.viscosity, 3);
  EXPECT_EQ(tabulation.radius, 1);
  ASSERT_EQ(tabulation.gaps.size(), 40U);
  EXPECT_EQ(tabulation.gaps.front(), 1e-3);
  EXPECT_EQ(tabulation.gaps.back(), 2);
  for (std::size_t i = 1; i < tabulation.gaps.size(); ++i)
    // pow rounds once or twice.
    EXPECT_NEAR(tabulation.gaps[i] / tabulation.gaps[i - 1], std::pow(2000, 1.0 / 39), 1e-14) << i;
  EXPECT_THAT(tabulation.reference_velocities, ElementsAre(-1));
  EXPECT_EQ(tabulation.container.value().radius, 40);
  EXPECT_EQ(tabulation.container.value().height, 80);
  EXPECT_EQ(tabulation.relative_accuracy, 1e-5);
  EXPECT_EQ(tabulation.geometry, "plane");
}

TEST(ShippedTables, AreThoseOfTheirCases) {
  for (const std::string name : {"lecture", "plane", "free_surface", "equal_spheres"}) {
    const Case c = shipped((name + ".toml").c_str());
    const auto table = lubrication::read_force_table(std::string(VISCONTACT_SOURCE_FOLDER) +
                                                     "/data/tables/" + name + ".csv");
    EXPECT_EQ(table.case_hash, freefem_axi::force_table_plan(required_tabulation(c)).hash) << name;
    for (const auto& row : table.rows)
      EXPECT_LE(row.relative_error_estimate, required_tabulation(c).relative_accuracy)
          << name << ", gap " << row.gap;
  }
}

TEST(LecturesCase, FitsTheLecturesBasis) {
  const Case c = shipped("lecture.toml");
  const auto& fit = required_fit(c);
  EXPECT_EQ(fit.settings.basis.name, "lecture");
  EXPECT_EQ(fit.settings.weights, lubrication::Weights::kRelative);
  EXPECT_FALSE(fit.file.has_value());
}

TEST(LecturesCase, PushesForTwoAndPullsForTwo) {
  const Case c = shipped("lecture.toml");
  const auto& motion = required_motion(c);
  EXPECT_EQ(motion.initial_gap, 1);
  EXPECT_EQ(motion.initial_velocity, 0);
  EXPECT_EQ(motion.end_time, 4);
  EXPECT_EQ(motion.external_force.value(0), -200);
  EXPECT_EQ(motion.external_force.value(2), 200);
  EXPECT_THAT(motion.external_force.jumps(), ElementsAre(2));
  EXPECT_EQ(motion.parameter(reduced_model::kReferenceTimeStep), 1e-3);
  EXPECT_EQ(motion.parameter(reduced_model::kRelativeTolerance), 1e-9);
  EXPECT_EQ(motion.parameter(reduced_model::kContactTimeStep), 1e-3);
  EXPECT_THAT(motion.roughness, ElementsAre(0, 0));
  EXPECT_EQ(motion.parameter(reduced_model::kThresholdGap), 0.1);
  EXPECT_THAT(c.models, IsEmpty());
}

TEST(LecturesCase, KnowsThePrintedMinimalGap) {
  const Case c = shipped("lecture.toml");
  ASSERT_TRUE(c.published.has_value());
  EXPECT_EQ(c.published->minimal_gap, 3e-3);
  EXPECT_EQ(c.published->source, "Lefebvre 2008");
}

TEST(LimitCase, IsTheLecturesWithMuOfOneTenth) {
  const Case c = shipped("limit.toml");
  EXPECT_THAT(c.viscosity, DoubleEq(0.1 / (6 * std::numbers::pi)));
  EXPECT_EQ(c.radius, 1);
  const auto& motion = required_motion(c);
  EXPECT_EQ(motion.mass, 1);
  EXPECT_EQ(motion.initial_gap, 1);
  EXPECT_EQ(motion.initial_velocity, 0);
  EXPECT_EQ(motion.end_time, 6);
  EXPECT_EQ(motion.external_force.value(1), -2);
  EXPECT_EQ(motion.external_force.value(3), 2);
  EXPECT_THAT(motion.external_force.jumps(), ElementsAre(2));
  EXPECT_FALSE(c.tabulation.has_value());
  EXPECT_THAT(c.models, ElementsAre("inertial", "viscous_contact", "viscous_contact_regular_drag",
                                    "viscous_contact_threshold"));
}

TEST(LimitCase, GoesWithAFitOfKOverQAlone) {
  const Case c = shipped("limit.toml");
  ASSERT_TRUE(required_fit(c).file.has_value());
  const lubrication::LubricationForce force(lubrication::read_fit(*c.fit->file));
  EXPECT_EQ(force.leading_coefficient(), 0.1);
  EXPECT_EQ(force.viscosity(), c.viscosity);
  EXPECT_EQ(force.radius(), c.radius);
  EXPECT_EQ(force.regular_resistance(0.5), 0);
}

TEST(ShippedCases, AreAllRead) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "data/cases")) {
    if (entry.is_directory()) continue;  // forces that cases name
    EXPECT_NO_THROW(read_case(entry.path())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 2);
}

}  // namespace
}  // namespace viscontact::case_file
