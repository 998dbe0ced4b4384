// What a case file may hold besides the lecture's: other forms of its values, and parts left out.
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "tests/case_file/edited_case.hpp"
#include "tests/common/failure.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact_threshold.hpp"
#include "viscontact/reduced_model/models/inertial.hpp"

namespace viscontact::case_file {
namespace {

using ::testing::ElementsAre;

constexpr LectureKey kForce = {
    "motion.external_force", "[ { until = 2.0, value = -200.0 }, { until = 4.0, value = 200.0 } ]"};
constexpr LectureKey kRoughness = {"viscous_contact.roughness", "[0.0, 0.0]"};

const std::string kFitKeys =
    "basis = \"lecture\"               # a/q + b + c q + d q^2 + e q^3\nweights = \"relative\"\n";

/// The text of the lecture's case without [NAME] and all that follows up to the next header.
std::string without_section(const std::string& name) {
  std::string text = lecture_text();
  const auto from = text.find("[" + name + "]\n");
  const auto next = text.find("\n[", from);
  return text.erase(from, next == std::string::npos ? next : next + 1 - from);
}

TEST(FitSection, MayNameOwnTermsALossAndAHeldCoefficient) {
  const auto settings = [](const std::string& keys) {
    return read_text(with_text(kFitKeys, keys).text).fit->settings;
  };
  auto read =
      settings("terms = \"1/q, ln q, 1\"\nweights = \"relative\"\nloss = \"huber\"\nfix = 56.5\n");
  EXPECT_EQ(read.basis.name, lubrication::kOwnTerms);
  EXPECT_EQ(read.basis.terms.size(), 3U);
  EXPECT_EQ(read.loss, lubrication::Loss::kHuber);
  EXPECT_TRUE(read.fix_leading);
  EXPECT_EQ(read.leading_value, 56.5);
  read = settings("basis = \"lecture\"\nweights = \"relative\"\nfix = \"theory\"\n");
  EXPECT_TRUE(read.fix_leading);
  EXPECT_FALSE(read.leading_value.has_value());
  read = settings(kFitKeys);
  EXPECT_FALSE(read.fix_leading);
  EXPECT_EQ(read.loss, lubrication::Loss::kSquared);
}

TEST(FitSection, RefusesWhatItDoesNotKnow) {
  const std::string weights = "weights = \"relative\"\n";
  expect_refused(with_text(kFitKeys, "terms = \"1/q, q^9\"\n" + weights), "fit.terms");
  expect_refused(with_text(kFitKeys, kFitKeys + "terms = \"1/q\"\n"), "fit.basis");
  expect_refused(with_text(kFitKeys, "loss = \"tukey\"\n" + kFitKeys), "fit.loss");
  expect_refused(with_text(kFitKeys, "fix = \"free\"\n" + kFitKeys), "fit.fix");
  expect_refused(with_text(kFitKeys, "fix = true\n" + kFitKeys), "fit.fix");
}

TEST(CaseValues, MayBeWholeNumbers) {
  const Case c = read_text(with_value({"sphere.mass", "20.0"}, "7").text);
  EXPECT_EQ(required_motion(c).mass, 7);
}

TEST(CaseValues, MayBeNegativeWhereThatHasAMeaning) {
  EXPECT_EQ(required_motion(read_text(with_value({"motion.initial_velocity", "0.0"}, "-2.5").text))
                .initial_velocity,
            -2.5);
}

TEST(ExternalForceOfACase, MayLastLongerThanTheMotion) {
  const Case c = read_text(with_value(kForce, "[ { until = 100, value = -3 } ]").text);
  EXPECT_EQ(required_motion(c).external_force.value(50), -3);
}

TEST(ExternalForceOfACase, MustLastToTheEndOfTheMotion) {
  expect_refused(with_value(kForce, "[ { until = 3.5, value = -3 } ]"), kForce.path);
}

TEST(ExternalForceOfACase, MayBeWrittenAsTables) {
  const auto edited = with_text("\n[reference]\n",
                                "\n[[motion.external_force]]\nuntil = 1\nvalue = 5\n"
                                "[[motion.external_force]]\nuntil = 4\nvalue = 6\n\n[reference]\n");
  std::string text = edited.text;
  const auto at = text.find("external_force = ");
  text.erase(at, text.find('\n', at) - at);
  EXPECT_THAT(required_motion(read_text(text)).external_force.jumps(), ElementsAre(1));
}

TEST(ExternalForceOfACase, MayBePolynomialsSinusoidsAndFilesInSum) {
  const TemporaryFolder folder;
  folder.file("rig.csv", "time,force\n0,1\n5,6\n");
  const auto text =
      with_value(kForce,
                 "[ { until = 1, polynomial = [ 2, 3 ] }, { until = 4, value = -1 }, "
                 "{ amplitude = 10, angular_frequency = 2, phase = 0.5 }, { file = \"rig.csv\" } ]")
          .text;
  const Case c = read_case(folder.file("case.toml", text));
  const auto& force = required_motion(c).external_force;
  // Sums of four terms of size 10.
  EXPECT_NEAR(force.value(0.5), 3.5 + 10 * std::sin(1.5) + 1.5, 1e-14);
  EXPECT_NEAR(force.value(3), -1 + 10 * std::sin(6.5) + 4, 1e-14);
  EXPECT_THAT(c.force_files, ElementsAre(folder.path() / "rig.csv"));
}

TEST(ExternalForceOfACase, IsFoundBesideTheCaseWhereARunKeepsItsCopies) {
  const TemporaryFolder folder;
  folder.file("rig.csv", "time,force\n0,1\n5,6\n");
  const auto text = with_value(kForce, "[ { file = \"../forces/rig.csv\" } ]").text;
  EXPECT_EQ(required_motion(read_case(folder.file("case.toml", text))).external_force.value(1), 2);
}

TEST(ExternalForceOfACase, SaysWhatIsWrongInAnEntry) {
  const std::string entry = std::string(kForce.path) + "[0]";
  expect_refused(with_value(kForce, "[ { until = 4, value = 1, polynomial = [ 1 ] } ]"),
                 entry + ".value");
  expect_refused(with_value(kForce, "[ { amplitude = 1, angular_frequency = 0 } ]"),
                 entry + ".angular_frequency");
  expect_refused(with_value(kForce, "[ { amplitude = 1, angular_frequency = 1, until = 3 } ]"),
                 entry + ".until");
  expect_refused(with_value(kForce, "[ { until = 4, polynomial = [] } ]"), entry + ".polynomial");
}

TEST(TimeScale, DrawsOutForceEndAndSteps) {
  const auto text = with_text("end_time = 4.0", "end_time = 4.0\ntime_scale = 2.5").text;
  const Case c = read_text(text);
  const auto& motion = required_motion(c);
  EXPECT_EQ(motion.end_time, 10);
  EXPECT_EQ(motion.parameter(reduced_model::kReferenceTimeStep), 2.5e-3);
  EXPECT_EQ(motion.parameter(reduced_model::kContactTimeStep), 2.5e-3);
  EXPECT_EQ(motion.external_force.value(4.9), -200);
  EXPECT_EQ(motion.external_force.value(5.1), 200);
  EXPECT_EQ(motion.external_force.impulse(10), 0);
}

TEST(FitOfACase, MayBeTheExactDrag) {
  const Case c = read_text(with_text(kFitKeys, "exact = \"plane\"\n").text);
  EXPECT_TRUE(required_fit(c).exact);
  expect_refused(with_text(kFitKeys, "exact = \"sphere\"\n"), "fit.exact");
}

TEST(FitOfACase, MayReachBeyondItsInterval) {
  const auto with_limits = [](const std::string& keys) {
    return with_text(kFitKeys, "file = \"a.json\"\n" + keys);
  };
  const Case c =
      read_text(with_limits("below = \"theory_limit\"\nabove = \"stokes_limit\"\n").text);
  EXPECT_EQ(required_fit(c).outside.below, lubrication::BelowInterval::kTheoryLimit);
  EXPECT_EQ(required_fit(c).outside.above, lubrication::AboveInterval::kStokesLimit);
  auto refused = with_limits("below = \"no\"\n");
  ++refused.line;
  expect_refused(refused, "fit.below");
}

TEST(SweepOfACase, IsRead) {
  const auto text =
      with_text("[published]",
                "[sweep]\nvary = [\"sphere.mass=1:2:3\"]\nmodels = [\"inertial\"]\n[published]")
          .text;
  const Case c = read_text(text);
  ASSERT_TRUE(c.sweep.has_value());
  EXPECT_THAT(c.sweep->vary, ElementsAre("sphere.mass=1:2:3"));
  EXPECT_THAT(c.sweep->models, ElementsAre("inertial"));
}

TEST(Roughness, MayBeAnythingBelowTheRadius) {
  EXPECT_THAT(required_motion(read_text(with_value(kRoughness, "[0.25, 0.5]").text)).roughness,
              ElementsAre(0.25, 0.5));
}

TEST(Roughness, SaysWhatItsTwoNumbersAre) {
  expect_refused(with_value(kRoughness, "[0.1]"), kRoughness.path);
}

TEST(Restitution, NeedsARoughness) {
  const auto with = [](const char* roughness, const char* restitution) {
    auto edited = with_value(kRoughness, std::string(roughness) + "\nrestitution = " + restitution);
    ++edited.line;  // the restitution is below the roughness
    return edited;
  };
  EXPECT_EQ(required_motion(read_text(with("[1e-3, 0.0]", "0.97").text)).restitution(), 0.97);
  EXPECT_EQ(required_motion(read_text(with("[0.0, 0.0]", "0.0").text)).restitution(), 0);
  constexpr LectureKey kRestitution = {"viscous_contact.restitution", "0.97"};
  expect_refused(with("[0.0, 0.0]", "0.97"), kRestitution.path);
  expect_refused(with("[1e-3, 0.0]", "1.1"), kRestitution.path);
  expect_refused(with("[1e-3, 0.0]", "-0.1"), kRestitution.path);
}

TEST(FitOfACase, MayBeAFileBesideTheCase) {
  const TemporaryFolder folder;
  const auto text = with_text(kFitKeys, "file = \"fits/mine.json\"\n").text;
  const Case c = read_case(folder.file("case.toml", text));
  EXPECT_EQ(required_fit(c).file, folder.path() / "fits/mine.json");
}

TEST(FitOfACase, MayBeAFileElsewhere) {
  const TemporaryFolder folder;
  const auto elsewhere = folder.path() / "mine.json";
  const Case c = read_text(with_text(kFitKeys, "file = '" + elsewhere.string() + "'\n").text);
  EXPECT_EQ(required_fit(c).file, elsewhere);
}

TEST(FitOfACase, IsEitherAFileOrABasis) {
  expect_refused(with_text(kFitKeys, "basis = \"lecture\"\nfile = \"a.json\"\n"), "fit.basis");
}

TEST(FitOfACase, HasAFileThatIsText) {
  expect_refused(with_text(kFitKeys, "file = 3\n"), "fit.file");
}

TEST(FitOfACase, ListsTheBasesThereAre) {
  expect_refused(with_value({"fit.basis", "\"lecture\""}, "\"cubic\""), "fit.basis");
  expect_refused(with_value({"fit.weights", "\"relative\""}, "\"none\""), "fit.weights");
}

TEST(ModelsOfACase, AreAListOfNames) {
  const auto edited =
      with_text("end_time = 4.0\n", "end_time = 4.0\nmodels = [\"inertial\", \"reference\"]\n");
  EXPECT_THAT(read_text(edited.text).models, ElementsAre("inertial", "reference"));
}

TEST(ModelsOfACase, AreRefusedWhenThereIsNoneOfThatName) {
  for (const auto* value : {"[\"inertial\", \"gluey\"]", "[]", "\"inertial\"", "[1]",
                            "[\"inertial\", 2]", "{ inertial = true }"}) {
    SCOPED_TRACE(value);
    auto edited =
        with_text("end_time = 4.0\n", std::string("models = ") + value + "\nend_time = 4.0\n");
    expect_refused(edited, "motion.models");
  }
  expect_refused(with_text("end_time = 4.0\n", "models = [\"gluey\"]\nend_time = 4.0\n"),
                 "motion.models", "gluey");
}

TEST(CaseParts, AreAskedForByTheCommandsThatNeedThem) {
  const auto expect_missing = [](const std::string& section, const auto& ask) {
    const Case c = read_text(without_section(section));
    EXPECT_THAT(bad_input([&] { ask(c); }), IsAt(c.path.string(), section));
  };
  expect_missing("tabulation", [](const Case& c) { required_tabulation(c); });
  expect_missing("fit", [](const Case& c) { required_fit(c); });
  expect_missing("motion", [](const Case& c) { required_motion(c); });
}

TEST(CaseParts, NumericalSettingsHaveDefaults) {
  std::string text = lecture_text();
  text = text.substr(0, text.find("[reference]"));
  const Case c = read_text(text);
  ASSERT_TRUE(c.motion);
  // docs/case-file.md: end_time/4000, 1e-9, smooth, a tenth of the smaller of radius and initial
  // gap.
  EXPECT_EQ(c.motion->parameter(reduced_model::kReferenceTimeStep), 1e-3);
  EXPECT_EQ(c.motion->parameter(reduced_model::kContactTimeStep), 1e-3);
  EXPECT_EQ(c.motion->parameter(reduced_model::kRelativeTolerance), 1e-9);
  EXPECT_THAT(c.motion->roughness, ElementsAre(0, 0));
  EXPECT_EQ(c.motion->parameter(reduced_model::kThresholdGap), 0.1);
  // One key of a section leaves the others at their defaults.
  const Case thin = read_text(text + "[viscous_contact]\ntime_step = 2e-3\n");
  EXPECT_EQ(thin.motion->parameter(reduced_model::kContactTimeStep), 2e-3);
  EXPECT_EQ(thin.motion->parameter(reduced_model::kReferenceTimeStep), 1e-3);
  EXPECT_EQ(thin.motion->parameter(reduced_model::kThresholdGap), 0.1);
  // A sphere that starts near the plane starts above its threshold, too.
  const auto near = text.replace(text.find("initial_gap = 1.0"), 17, "initial_gap = 0.02");
  EXPECT_EQ(read_text(near).motion->parameter(reduced_model::kThresholdGap), 0.002);
}

TEST(CaseParts, FitIsTheLecturesByDefault) {
  const Case c = read_text(with_text("basis = \"lecture\"", "").text);
  EXPECT_EQ(c.fit->settings.basis.name, "lecture");
  EXPECT_EQ(c.fit->settings.weights, lubrication::Weights::kRelative);
}

TEST(CaseParts, MayAllBeLeftOutButTheFluidAndTheSphere) {
  const Case c = read_text("title = \"t\"\n[fluid]\nviscosity = 1\n[sphere]\nradius = 2\n");
  EXPECT_EQ(c.radius, 2);
  EXPECT_FALSE(c.tabulation || c.fit || c.motion || c.published);
}

}  // namespace
}  // namespace viscontact::case_file
