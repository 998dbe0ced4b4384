// The case of a rolling sphere: what is read and what is refused.
#include "viscontact/rolling/case/rolling_case.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <string>

#include "tests/case_file/edited_case.hpp"
#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"

namespace viscontact::rolling {
namespace {

using ::testing::ElementsAre;

const std::string kIncline =
    std::string(VISCONTACT_SOURCE_FOLDER) + "/data/cases/rolling/incline.toml";

class RollingCaseFile : public ::testing::Test {
 protected:
  /// The shipped case with one text replaced by another one.
  RollingCase changed(const std::string& from, const std::string& to) const {
    return read_rolling_case(folder_.file("case.toml", case_file::text_with(kIncline, from, to)));
  }
  TemporaryFolder folder_;
};

TEST_F(RollingCaseFile, ShippedOneHasTheWeightAlongAndTowardsThePlane) {
  const auto c = read_rolling_case(kIncline);
  EXPECT_EQ(case_file::kind_of_case(kIncline), case_file::CaseKind::kRolling);
  EXPECT_EQ(c.radius, 1);
  EXPECT_EQ(c.motion.mass, 0.1);
  EXPECT_DOUBLE_EQ(c.motion.moment_of_inertia, 0.04);  // of a solid sphere, 2/5 m r^2
  EXPECT_DOUBLE_EQ(c.motion.force, std::sin(0.3));
  EXPECT_DOUBLE_EQ(c.motion.normal_force, -std::cos(0.3));
  EXPECT_EQ(c.motion.roughness, 1e-3);
  EXPECT_EQ(c.motion.velocity, 0);
  EXPECT_THAT(c.models, ElementsAre("smooth", "rough", "viscous_contact"));
  EXPECT_FALSE(c.tabulation);
  ASSERT_TRUE(c.fit);
  EXPECT_TRUE(std::filesystem::exists(*c.fit));
}

TEST_F(RollingCaseFile, ForceMayBeGivenByItsComponents) {
  const auto c = changed("weight = 1.0\nincline = 0.3", "force = [0.25, -2.0]\ntorque = 0.5");
  EXPECT_EQ(c.motion.force, 0.25);
  EXPECT_EQ(c.motion.normal_force, -2);
  EXPECT_EQ(c.motion.torque, 0.5);
}

TEST_F(RollingCaseFile, WeightMayFollowFromDensitiesAndGravity) {
  // The lines after the viscosity; the mass of the shipped case is replaced.
  const auto text = case_file::text_with(kIncline, "mass = 0.1", "density = 5.0");
  auto with_gravity = text;
  with_gravity.replace(with_gravity.find("weight = 1.0"), 12, "gravity = -10.0");
  with_gravity.replace(with_gravity.find("[sphere]"), 8, "density = 2.0\n[sphere]");
  const auto c = read_rolling_case(folder_.file("case.toml", with_gravity));
  const double volume = 4 * std::numbers::pi / 3;
  EXPECT_DOUBLE_EQ(c.motion.mass, 5 * volume);
  EXPECT_DOUBLE_EQ(c.motion.moment_of_inertia, 0.4 * 5 * volume);
  EXPECT_DOUBLE_EQ(c.motion.force, 30 * volume * std::sin(0.3));
  EXPECT_DOUBLE_EQ(c.motion.normal_force, -30 * volume * std::cos(0.3));
  EXPECT_THAT(bad_input([&] { (void)changed("weight = 1.0", "weight = 1.0\ngravity = -1.0"); }),
              IsAt("case.toml:21", "rolling.gravity"));
  EXPECT_THAT(bad_input([&] { (void)changed("weight = 1.0", ""); }),
              IsAt("case.toml:18", "rolling.force"));
  EXPECT_THAT(bad_input([&] { (void)changed("mass = 0.1", "mass = 0.1\ndensity = 5.0"); }),
              IsAt("case.toml:13", "sphere.mass"));
}

TEST_F(RollingCaseFile, TablesAreMadeOfTheMotionsThatItNeeds) {
  const auto with_tabulation = [&](const std::string& keys) {
    return changed("[fit]\nfile = \"../../fits/pairs/plane.json\"",
                   "[tabulation]\ngaps = [0.01, 0.1, 1.0]\nreference_velocities = [1.0]\n"
                   "container = \"unbounded\"\nrelative_accuracy = 1e-4\n" +
                       keys);
  };
  EXPECT_EQ(with_tabulation("motion = \"all\"").tabulation->motions.size(), 7U);
  EXPECT_THAT(bad_input([&] { (void)with_tabulation("motion = [\"approach\", \"slide\"]"); }),
              IsAt("case.toml:20", "tabulation.motion"));
  EXPECT_THAT(bad_input([&] {
                (void)with_tabulation("motion = \"all\"\ngeometry = { kind = \"free_surface\" }");
              }),
              IsAt("case.toml:21", "tabulation.geometry"));
}

struct RefusedRolling {
  std::string name, from, to, key;
};
std::ostream& operator<<(std::ostream& out, const RefusedRolling& refused) {
  return out << refused.name;
}

class RollingCaseRefusal : public RollingCaseFile,
                           public ::testing::WithParamInterface<RefusedRolling> {};

TEST_P(RollingCaseRefusal, NamesFileLineValueAndWhatIsAllowed) {
  const auto& p = GetParam();
  EXPECT_THAT(bad_input([&] { (void)changed(p.from, p.to); }), IsAt("case.toml", p.key));
}

INSTANTIATE_TEST_SUITE_P(
    Of, RollingCaseRefusal,
    ::testing::Values(
        RefusedRolling{"AnAngleInDegrees", "incline = 0.3", "incline = 17.0", "rolling.incline"},
        RefusedRolling{"InclineOfAForce", "weight = 1.0", "force = [1.0, -1.0]", "rolling.incline"},
        RefusedRolling{"ForceOfThreeNumbers", "weight = 1.0\nincline = 0.3",
                       "force = [1.0, 2.0, 3.0]", "rolling.force"},
        RefusedRolling{"RoughnessOfARadius", "roughness = 1e-3", "roughness = 1.0",
                       "rolling.roughness"},
        RefusedRolling{"GapInTheRoughness", "initial_gap = 0.5", "initial_gap = 5e-4",
                       "rolling.initial_gap"},
        RefusedRolling{"LongStep", "time_step = 0.01", "time_step = 30.0", "rolling.time_step"},
        RefusedRolling{"ModelTwice", "time_step = 0.01",
                       "time_step = 0.01\nmodels = [\"smooth\", \"smooth\"]", "rolling.models"},
        RefusedRolling{"Tolerance", "time_step = 0.01",
                       "time_step = 0.01\nrelative_tolerance = 0.5", "rolling.relative_tolerance"},
        RefusedRolling{"UnknownKey", "friction = 0.3", "frction = 0.3", "rolling.frction"},
        RefusedRolling{"FitWithoutName", "../../fits/pairs/plane.json", "", "fit.file"},
        RefusedRolling{"NoFit", "[fit]\nfile = \"../../fits/pairs/plane.json\"", "", "tabulation"}),
    [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace viscontact::rolling
