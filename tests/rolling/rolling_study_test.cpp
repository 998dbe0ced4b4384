// The sweep of a rolling sphere, beside the velocities at which forces balance.
#include "viscontact/rolling/case/rolling_study.hpp"

#include <gmock/gmock.h>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/rolling/rolling_resistance.hpp"

namespace viscontact::rolling {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kFit = std::string(VISCONTACT_SOURCE_FOLDER) + "/data/fits/pairs/plane.json";

class RollingStudy : public ::testing::Test {
 protected:
  /// A sphere at the gap 0.5, which stays the same, because nothing pushes or pulls the sphere.
  RollingPlan plan(const std::vector<std::string>& vary, const std::string& more = "",
                   const std::string& sections = "") const {
    const auto path = scratch_.file(
        "case.toml",
        "[fluid]\nviscosity = 2.0\n[sphere]\nradius = 1.0\nmass = 0.1\n[fit]\nfile = \"" + kFit +
            "\"\n[rolling]\ninitial_gap = 0.5\nforce = [1.0, 0.0]\nend_time = 2.0\n"
            "time_step = 0.1\n" +
            more + sections);
    auto plan = planned_rolling(read_rolling_case(path));
    for (const auto& text : vary) plan.points.variations.push_back(sweep::parse_variation(text));
    return plan;
  }
  Error refusal(const RollingPlan& plan) const {
    return failure(ErrorKind::kWrongUsage, [&] { (void)rolling_study(plan, ""); });
  }

  TemporaryFolder scratch_;
};

TEST_F(RollingStudy, SphereEndsAtTheVelocitiesAtWhichTheFluidBalancesTheForce) {
  const auto study = rolling_study(
      plan({"fluid.viscosity=1,4", "rolling.force[0]=0.5,3"}, "models = [\"smooth\"]\n"), "");
  ASSERT_EQ(study.size(), 4U);
  const auto r = RollingFluid(motions::read_pair_fit(kFit)).at(0.5);
  const double determinant = r.slide * r.roll - r.slide_roll * r.slide_roll;
  for (std::uint64_t i = 0; i < study.size(); ++i) {
    const auto numbers = study.points.numbers(i);
    const auto row = study.run(i, {});
    EXPECT_EQ(row.failure, "");
    // The fit has the viscosity 1, to which all resistances are proportional. The sphere comes to
    // its velocity as exp(-t R/m), where R/m > 180; CVODE's tolerance is a relative 1e-9.
    const double impulse = numbers[1].second / numbers[0].second / determinant;
    const double velocity = r.roll * impulse, angular_velocity = r.slide_roll * impulse;
    EXPECT_NEAR(row.values.at("smooth.velocity") / velocity, 1, 1e-6);
    EXPECT_NEAR(row.values.at("smooth.angular_velocity") / angular_velocity, 1, 1e-6);
    EXPECT_NEAR(row.values.at("smooth.slip") / (velocity - angular_velocity), 1, 1e-6);
    EXPECT_NEAR(row.values.at("smooth.gap"), 0.5, 1e-12);
    EXPECT_EQ(row.numbers.at("smooth.contact"), 0U);
    EXPECT_FALSE(row.values.contains("smooth.contact_time"));
  }
}

TEST_F(RollingStudy, RowHasTheColumnsOfEachModelAndTheReasonsOfThoseThatFail) {
  // The fit is known up to the gap 1.
  const auto study =
      rolling_study(plan({"rolling.normal_velocity=0,1e3"}, "models = [\"smooth\"]\n"), "");
  EXPECT_THAT(
      study.columns(),
      ElementsAre("rolling.normal_velocity", "smooth.gap", "smooth.smallest_gap", "smooth.position",
                  "smooth.angle", "smooth.velocity", "smooth.angular_velocity", "smooth.slip",
                  "smooth.contact", "smooth.contact_time", "failure"));
  EXPECT_THAT(study.row(1), ::testing::StartsWith("1000,,,,,,,,,,"));
  EXPECT_THAT(study.row(1), HasSubstr("model"));
}

TEST_F(RollingStudy, SectionOfTheCaseGivesThePlan) {
  const auto planned = plan({}, "", "[sweep]\nvary = [\"sphere.mass=0.1:0.2:3\"]\nsamples = 2\n");
  const auto study = rolling_study(planned, "");
  EXPECT_EQ(study.size(), 2U);
  EXPECT_EQ(study.points.keys(), std::vector<std::string>{"sphere.mass"});
  EXPECT_EQ(study.results.size(), 27U);
}

TEST_F(RollingStudy, WrongPlansAreRefused) {
  EXPECT_THAT(refusal(plan({})), Names("--vary"));
  EXPECT_THAT(refusal(plan({"tabulation.relative_accuracy=1e-3,1e-4"})),
              Names("tabulation.relative_accuracy"));
  EXPECT_THAT(refusal(plan({"sphere.mass=1,2", "motion.mass=1,2"})), Names("sphere.mass"));
  auto other = plan({"sphere.mass=1,2"});
  other.models = {"inertial"};
  EXPECT_THAT(refusal(other), Names("viscous_contact"));
  other.models = {"rough", "rough"};
  EXPECT_THAT(refusal(other), Names("rough"));
  EXPECT_THAT(refusal(plan({"rolling.friction=0.1,0.2"}, "models = [\"smooth\"]\n")),
              AllOf(Names("--vary", "rolling.friction"), Not(Names("at the point"))));
  EXPECT_THAT(bad_input([&] { (void)rolling_study(plan({"rolling.friction=0,-1"}), ""); }),
              AllOf(IsAt("case.toml", "rolling.friction"), Names("-1")));
}

}  // namespace
}  // namespace viscontact::rolling
