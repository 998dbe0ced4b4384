// A model that fails does not stop the others: what is written, what is said, and the exit code.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// The gentle case, pushed so that the sphere leaves the tabulated gaps, which end at 0.05.
class FailedModels : public ::testing::Test {
 protected:
  FailedModels() : fake_(scratch_.path()) { put_text(case_file(), pushed()); }

  static std::string pushed() {
    const auto text = replaced(gentle_case_text(), "[reference]\ntime_step = 1e-2",
                               "[reference]\ntime_step = 1e-3");
    return replaced(text, "value = -20.0", "value = -200.0");
  }
  ProgramResult run() const {
    return run_viscontact({"run", case_file(), "-o", folder().string(), "--jobs", "2"},
                          {"VISCONTACT_FREEFEM=" + fake_.executable()});
  }
  std::string case_file() const { return (scratch_.path() / "case.toml").string(); }
  fs::path folder() const { return scratch_.path() / "run"; }
  std::vector<std::string> trajectories() const {
    std::vector<std::string> names;
    for (const auto& [file, text] : files_below(folder() / "trajectories"))
      names.push_back(fs::path(file).stem());
    return names;
  }

  TemporaryFolder scratch_;
  freefem_axi::FakeFreeFem fake_;
};

const auto kComputed = ElementsAre("viscous_contact", "viscous_contact_regular_drag");

/// The gap that a message names after these words.
double gap_after(const std::string& text, const std::string& words) {
  const auto place = text.find(words);
  return place == std::string::npos ? -1 : std::stod(text.substr(place + words.size()));
}

TEST_F(FailedModels, DoNotStopTheOthersAndAreForeseenAndNotForgotten) {
  const auto first = run();
  expect_refusal(first, ErrorKind::kBadInput,
                 Names(case_file(), "0.05", "1.5", "3 more", "reference_exact",
                       "viscous_contact_threshold", "2 other"));
  EXPECT_THAT(trajectories(), kComputed);
  // The table, the comparison and the report say why.
  EXPECT_THAT(first.output, HasSubstr("\ninertial                       failed: gap "));
  const auto comparison = reduced_model::read_comparison(folder() / "comparison.json");
  EXPECT_EQ(comparison.reference_model, "viscous_contact");
  EXPECT_EQ(comparison.models.size(), 2U);
  ASSERT_EQ(comparison.failed_models.size(), 4U);
  EXPECT_EQ(comparison.failed_models[2].model, "inertial");
  const auto reason = comparison.failed_models[2].reason;
  EXPECT_THAT(reason, HasSubstr("is outside the fitted interval"));
  EXPECT_THAT(read_file(folder() / "report.html"),
              AllOf(HasSubstr("inertial failed and has no trajectory: gap "),
                    HasSubstr("<td>inertial</td><td colspan=10>failed: gap ")));

  // They are foreseen before the tabulation.
  const auto warning = first.errors.find(
      "simulate: warning: the motion will leave tabulation.gaps, and these models will fail: "
      "reference, reference_exact, inertial, viscous_contact_threshold.");
  ASSERT_NE(warning, std::string::npos) << first.errors;
  EXPECT_LT(warning, first.errors.find("tabulate: "));
  // docs/theory.md, section 3: 2.9708e-3 with the exact drag; reference's time step makes it 1 %
  // less.
  EXPECT_NEAR(gap_after(first.errors, "the gap falls to "), 2.9708e-3, 0.015 * 2.9708e-3);

  // They are not run again.
  const auto before = files_below(folder());
  const auto again = run();
  EXPECT_EQ(again.exit_status, 3);
  EXPECT_EQ(again.output, first.output);
  EXPECT_THAT(again.errors, AllOf(IsUpToDate("trajectories"), IsUpToDate("compare, report")));
  EXPECT_EQ(files_below(folder()), before);

  // If all fail, nothing is written.
  const auto folder_name = folder().string();
  expect_refusal(run_viscontact({"simulate", case_file(), "--fit", folder_name + "/fit.json", "-o",
                                 folder_name, "--models", "reference_exact,inertial"}),
                 ErrorKind::kBadInput,
                 AllOf(Names("reference_exact", "1 more"), Not(HasSubstr("computed and written"))));
  EXPECT_EQ(files_below(folder()), before);

  // With the drag below the fit the sphere goes as far as the reason said.
  const auto estimate = gap_after(reason, "would come down to a gap of about ");
  put_text(case_file(), replaced(pushed(), "weights = \"relative\"",
                                 "weights = \"relative\"\nbelow = \"lubrication_limit\""));
  expect_done(run());
  for (const auto& model : reduced_model::read_comparison(folder() / "comparison.json").models)
    if (model.model == "inertial") {
      EXPECT_NEAR(estimate / model.minimal_gap, 1, 5e-3);  // three digits are printed
    }

  // A push that the table can follow: the record of failures goes.
  put_text(case_file(), pushed());
  EXPECT_EQ(run().exit_status, 3);
  EXPECT_TRUE(fs::exists(folder() / "failed_models.json"));
  put_text(case_file(), gentle_case_text());
  const auto gentle = run();
  expect_done(gentle);
  EXPECT_THAT(gentle.errors, Not(Names("tabulation.gaps")));
  EXPECT_EQ(trajectories().size(), 6U);
  EXPECT_FALSE(fs::exists(folder() / "failed_models.json"));
  EXPECT_TRUE(reduced_model::read_comparison(folder() / "comparison.json").failed_models.empty());

  // Nothing of an earlier motion is left behind.
  put_text(case_file(), pushed());
  const auto later = run_viscontact(
      {"simulate", case_file(), "--fit", folder_name + "/fit.json", "-o", folder_name});
  EXPECT_EQ(later.exit_status, 3);
  EXPECT_THAT(trajectories(), kComputed);
}

TEST_F(FailedModels, OfSimulateAreToldByCompare) {
  (void)run();  // for its fit
  const auto fit = (folder() / "fit.json").string();
  const auto other = (scratch_.path() / "other").string();
  // One by one: what failed earlier with the same inputs stays recorded.
  const std::vector<std::string> simulate = {"simulate", case_file(), "--fit", fit, "-o", other};
  const auto with = [&](const std::string& models) {
    auto arguments = simulate;
    arguments.insert(arguments.end(), {"--models", models});
    return run_viscontact(arguments);
  };
  expect_refusal(with("inertial,viscous_contact"), ErrorKind::kBadInput, Names("1 other"));
  expect_done(with("viscous_contact_regular_drag"));
  const auto compared = run_viscontact({"compare", other});
  expect_done(compared);
  EXPECT_THAT(compared.output, AllOf(HasSubstr("\nviscous_contact_regular_drag "),
                                     HasSubstr("\ninertial                       failed: ")));
  expect_refusal(run_viscontact({"compare", other, "--reference", "inertial"}),
                 ErrorKind::kBadInput, Names("inertial"));
  // With the limit it is computed, and no failure is left.
  auto with_limit = simulate;
  with_limit.emplace_back("--lubrication-limit");
  expect_done(run_viscontact(with_limit));
  EXPECT_FALSE(fs::exists(fs::path(other) / "failed_models.json"));
}

TEST_F(FailedModels, ThatDoNotConvergeEndWithTheirExitCode) {
  // Explicit Euler steps over the film; the fit knows every gap.
  put_text(case_file(),
           replaced(replaced(replaced(pushed(), "weights = \"relative\"",
                                      "weights = \"relative\"\nbelow = \"lubrication_limit\""),
                             "[reference]\ntime_step = 1e-3", "[reference]\ntime_step = 0.5"),
                    "end_time = 4.0",
                    "end_time = 4.0\nmodels = [\"reference\", \"inertial\", \"viscous_contact\"]"));
  expect_refusal(run(), ErrorKind::kNotConverged, Names("2 other"));
  EXPECT_THAT(trajectories(), ElementsAre("inertial", "viscous_contact"));
  EXPECT_EQ(reduced_model::read_comparison(folder() / "comparison.json").reference_model,
            "inertial");
}

}  // namespace
}  // namespace viscontact
