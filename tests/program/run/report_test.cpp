// report.html as text: what it warns of, and where its links lead.
#include "tests/program/run/report.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <set>

#include "tests/common/regular_expressions.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

void expect_live_links(const fs::path& folder, const std::string& page) {
  std::set<std::string> targets;
  for (const auto& target : matches_in(page, "href=\"([^\"#][^\"]*)\"", 1)) {
    EXPECT_TRUE(fs::exists(folder / target)) << target;
    targets.insert(target);
  }
  EXPECT_GE(targets.size(), 8U);
}

TEST_F(Report, LinksTheFileOfEveryNumberAndIsSmall) {
  run_lecture();
  const auto text = page();
  for (const auto* file : {"table.csv", "fit.json", "comparison.json", "uncertainty.json",
                           "case.toml", "trajectories/inertial.csv", "plots/gap.svg"})
    EXPECT_THAT(text, HasSubstr("href=\"" + std::string(file) + "\""));
  expect_live_links(folder(), text);
  constexpr std::size_t kTwoMegabytes = 2'000'000;
  EXPECT_LT(text.size(), kTwoMegabytes);
  // The browser fetches nothing.
  EXPECT_FALSE(has_match(text, "(src|href|action|data)=[\"']?(https?:)?//"));
  EXPECT_FALSE(has_match(text, "url\\([\"']?(https?:)?//|@import"));
  EXPECT_THAT(text, HasSubstr("default-src 'none'"));
}

TEST_F(Report, NamesOfModelsAreTextToGnuplotAndToTheBrowser) {
  // A user's file names its model: what the name holds must not be run.
  run_lecture();
  const std::string canary = (scratch_.path() / "canary").string();
  const std::string name = "a' 1); system(\"touch " + canary + "\"); set ytics ('`touch " + canary +
                           "` 50% #<!--<script>";
  put_text(folder() / "trajectories/own.csv",
           "# model: " + name + "\ntime,gap,velocity\n0,1,0\n1,0.5,-1\n4,0.5,0\n");
  expect_done(run_viscontact({"compare", folder().string()}));
  expect_done(run_viscontact({"report", folder().string()}));
  EXPECT_FALSE(std::filesystem::exists(canary));
  EXPECT_THAT(page(), AllOf(Not(HasSubstr("<!--<script>")), HasSubstr("50% #")));
}

TEST_F(Report, SaysThatThereIsNothingToWarnOf) {
  // The exact drag, and models whose film stays thicker than nothing.
  auto text = replaced(lecture_case_text(), "basis = \"lecture\"", "exact = \"plane\"");
  run(replaced(text, "weights = \"relative\"", ""));
  EXPECT_THAT(page(), AllOf(HasSubstr("No warnings"), Not(HasSubstr("<h2>Warnings"))));
}

TEST_F(Report, OfASmoothModelIsMadeWhereTheRoughModelWouldBeRefused) {
  // The heights of the roughness together are above the threshold gap.
  std::filesystem::create_directories(folder());
  put_text(folder() / "table.csv", read_file(VISCONTACT_SOURCE_FOLDER "/data/tables/lecture.csv"));
  const auto rough =
      replaced(lecture_case_text(), "roughness = [0.0, 0.0]", "roughness = [0.06, 0.06]");
  run(replaced(rough, "end_time = 4.0",
               "end_time = 4.0\nmodels = [\"inertial\", \"viscous_contact_threshold_smooth\"]"));
  EXPECT_THAT(page(), HasSubstr("film from gamma"));
  expect_done(run_viscontact({"report", folder().string()}));
}

TEST_F(Report, WarnsOfTheFilmBelowTheTableAndOfTheFit) {
  run_lecture();
  EXPECT_THAT(page(),
              AllOf(HasSubstr("Extrapolation: viscous_contact gets down to a film of 0.00087"),
                    HasSubstr("below the smallest fitted gap, 0.001"),
                    HasSubstr("Fit: the coefficient of 1/q"),
                    HasSubstr("The fit is coarser than the table: 40 of 40 rows have a relative "
                              "residual above their own error estimate"),
                    HasSubstr("beyond an end (an extrapolation)"), Not(HasSubstr("Poor fit")),
                    Not(HasSubstr("Accuracy not met"))));
}

TEST_F(Report, WarnsOfEachThingThatIsWrong) {
  run_lecture();
  replace_in("case.toml", "relative_accuracy = 1e-5", "relative_accuracy = 1e-6");
  put_text(folder() / "fit.json",
           replaced_matches(replaced_matches(read_file(folder() / "fit.json"),
                                             "\"largest_relative_residual\": [^,]*",
                                             "\"largest_relative_residual\": 0.02"),
                            "\"gap_interval\": \\[[^\\]]*\\]", "\"gap_interval\": [0.1, 0.5]"));
  put_text(folder() / "table.csv", "# note: touched\n" + read_file(folder() / "table.csv"));
  put_text(folder() / "uncertainty.json",
           replaced_matches(read_file(folder() / "uncertainty.json"), "\"refused_draws\": 0",
                            "\"refused_draws\": 500"));
  const auto reference = folder() / "trajectories" / "reference.csv";
  put_text(reference, replaced_matches(read_file(reference), "\n4,[^,]*,", "\n4,0,"));
  fs::remove(folder() / "trajectories" / "viscous_contact_threshold.csv");
  expect_done(run_viscontact({"report", folder().string()}));
  for (const auto* warning :
       {"Accuracy not met: ", "Poor fit: the largest relative residual is 0.02",
        "Extrapolation: inertial gets down to a gap of 0.002967, below the smallest fitted gap, "
        "0.1",
        "Extrapolation: inertial gets up to a gap of 1, above the largest fitted gap, 0.5",
        "The sphere of reference goes through the plane at time 4", "500 of 10000 draws",
        "inertial was made from another case", "inertial was made from another fit",
        "The fit was made from another table",
        "The trajectory of viscous_contact_threshold is not in this folder",
        "The comparison was made from another trajectory of reference than the one in this folder"})
    EXPECT_THAT(page(), HasSubstr(warning));
  EXPECT_THAT(page(), Not(HasSubstr("made from another trajectory of inertial")));
  // viscous_contact has no drag at a distance to extrapolate.
  EXPECT_THAT(page(), Not(HasSubstr("viscous_contact gets up to")));
  expect_live_links(folder(), page());
}

}  // namespace
}  // namespace viscontact
