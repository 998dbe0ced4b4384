// A case as a template in which numbers are replaced.
#include <gmock/gmock.h>

#include <array>
#include <filesystem>
#include <limits>
#include <utility>

#include "tests/case_file/edited_case.hpp"
#include "tests/common/failure.hpp"
#include "viscontact/case_file/case_file.hpp"
#include "viscontact/sweep/variation.hpp"

namespace viscontact::sweep {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// A template of a text in a folder of its own.
struct Template {
  explicit Template(const std::string& text) : path(folder.file("case.toml", text)), cases(path) {}
  case_file::Case with(const std::string& key, double value) const {
    return cases.with(std::array{std::pair(key, value)});
  }
  /// Expects a refusal that names file and key.
  void expect_refused(const std::string& key, double value, const std::string& named = "") const {
    EXPECT_THAT(bad_input([&] { with(key, value); }),
                AllOf(IsAt(path.string()), Names(key, named)));
  }

  TemporaryFolder folder;
  std::filesystem::path path;
  case_file::CaseTemplate<case_file::Case> cases;
};

TEST(CaseTemplate, ReplacesNumbersWhereverTheyStand) {
  const Template lecture(case_file::lecture_text());
  EXPECT_EQ(lecture.with("fluid.viscosity", 0.7).viscosity, 0.7);
  EXPECT_EQ(lecture.with("sphere.mass", 0.25).motion->mass, 0.25);
  EXPECT_EQ(lecture.with("viscous_contact.roughness[0]", 0.01).motion->roughness,
            (std::array{0.01, 0.0}));
  EXPECT_EQ(lecture.with("viscous_contact.roughness[1]", 0.01).motion->roughness,
            (std::array{0.0, 0.01}));
  const auto pulled = lecture.with("motion.external_force[1].value", 5).motion->external_force;
  EXPECT_EQ(pulled.value(1), -200);
  EXPECT_EQ(pulled.value(3), 5);
  const auto pushed = lecture.with("motion.external_force[0].until", 2.5).motion->external_force;
  EXPECT_THAT(pushed.jumps(), ElementsAre(2.5));
}

TEST(CaseTemplate, ReplacesIntegersByFractions) {
  auto text = case_file::with_text("mass = 20.0", "mass = 20").text;
  const auto force = text.find("until = 2.0, value = -200.0");
  ASSERT_NE(force, std::string::npos);
  text.replace(force, 27, "until = 2, value = -200");
  const auto roughness = text.find("[0.0, 0.0]");
  ASSERT_NE(roughness, std::string::npos);
  text.replace(roughness, 10, "[0, 0]");
  const Template integers(text);
  EXPECT_EQ(integers.with("sphere.mass", 0.25).motion->mass, 0.25);
  EXPECT_EQ(integers.with("motion.external_force[0].value", -0.5).motion->external_force.value(1),
            -0.5);
  for (const std::size_t i : {0U, 1U}) {
    std::array<double, 2> expected{};
    expected.at(i) = 0.125;
    EXPECT_EQ(integers.with("viscous_contact.roughness[" + std::to_string(i) + "]", 0.125)
                  .motion->roughness,
              expected);
  }
}

TEST(CaseTemplate, SeveralNumbersAndTheTemplateStaysAsItWas) {
  const Template lecture(case_file::lecture_text());
  const auto changed =
      lecture.cases.with(std::array{std::pair(std::string("fluid.viscosity"), 0.5),
                                    std::pair(std::string("motion.initial_gap"), 0.25),
                                    std::pair(std::string("viscous_contact.roughness[0]"), 0.125)});
  EXPECT_EQ(changed.viscosity, 0.5);
  EXPECT_EQ(changed.motion->initial_gap, 0.25);
  EXPECT_EQ(changed.motion->roughness[0], 0.125);
  const auto unchanged = lecture.cases.with({});
  EXPECT_EQ(unchanged.viscosity, 3);
  EXPECT_EQ(unchanged.motion->initial_gap, 1);
  EXPECT_EQ(unchanged.motion->roughness[0], 0);
  EXPECT_EQ(unchanged.text, case_file::lecture_text());
}

TEST(CaseTemplate, TakesAnOptionalKeyThatTheFileHasNot) {
  const Template lecture(case_file::lecture_text());
  ASSERT_THAT(case_file::lecture_text(), Not(HasSubstr("motion.mass")));
  const auto stretched = *lecture.with("motion.time_scale", 3).motion;
  EXPECT_EQ(stretched.end_time, 12);
  EXPECT_EQ(stretched.parameter(reduced_model::kContactTimeStep), 3 * 1e-3);
  EXPECT_EQ(stretched.parameter(reduced_model::kReferenceTimeStep), 3 * 1e-3);
  EXPECT_THAT(stretched.external_force.jumps(), ElementsAre(6));
  EXPECT_EQ(stretched.external_force.value(5), -200);
  EXPECT_EQ(lecture.cases.with({}).motion->end_time, 4);
}

TEST(CaseTemplate, SetsKeysOfSectionsThatTheCaseLeavesOut) {
  const std::string text = case_file::lecture_text();
  const Template shortened(text.substr(0, text.find("[reference]")));
  EXPECT_EQ(shortened.with("viscous_contact.time_step", 2e-3)
                .motion->parameter(reduced_model::kContactTimeStep),
            2e-3);
  EXPECT_EQ(shortened.with("reference.time_step", 2e-3)
                .motion->parameter(reduced_model::kReferenceTimeStep),
            2e-3);
  EXPECT_EQ(shortened.with("inertial.relative_tolerance", 1e-7)
                .motion->parameter(reduced_model::kContactTimeStep),
            1e-3);
}

TEST(CaseTemplate, RefusesKeysThatAreNone) {
  const Template lecture(case_file::lecture_text());
  for (const std::string key :
       {"fluid.viscosty", "viscosity", "mass", "motion.mass", "wheels.number",
        "motion.wheels.number", "fluid.viscosity.x", "fluid.viscosity[0]",
        "viscous_contact.roughness[2]", "motion.external_force[2].value",
        "motion.external_force[0].values", "motion.external_force[-1].value",
        "motion.external_force[.value", ".viscosity", "fluid.", "[0]", ""})
    lecture.expect_refused(key, 1);
  lecture.expect_refused("fluid.viscosty", 1, "viscosity");
}

TEST(CaseTemplate, RefusesWhatIsNoNumber) {
  const Template lecture(case_file::lecture_text());
  for (const std::string key : {"title", "fit.basis", "fluid", "viscous_contact.roughness",
                                "motion.external_force", "motion.external_force[0]"})
    lecture.expect_refused(key, 1);
}

TEST(CaseTemplate, RefusesValuesOutOfRangeWithWhatIsAllowed) {
  const Template lecture(case_file::lecture_text());
  lecture.expect_refused("fluid.viscosity", -1, "-1");
  lecture.expect_refused("inertial.relative_tolerance", 0.5, "0.5");
  lecture.expect_refused("motion.initial_velocity", std::numeric_limits<double>::infinity(), "inf");
  EXPECT_THAT(bad_input([&] { lecture.with("motion.external_force[1].until", 3.5); }),
              AllOf(IsAt("case.toml", "motion.external_force"), Names("3.5", "4")));
  EXPECT_THAT(bad_input([&] { lecture.with("viscous_contact.roughness[0]", 1); }),
              IsAt("case.toml", "viscous_contact.roughness"));
}

}  // namespace
}  // namespace viscontact::sweep
