// `compare` and `report`, on simulations with the exact drag.
#include <gmock/gmock.h>

#include <set>
#include <sstream>

#include "tests/program/program.hpp"
#include "tests/program/run/stages.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(Stages, CompareTakesATrajectoryOfTheUsersOwn) {
  simulate();
  constexpr double kShift = 0.01;
  std::string text = "time,gap,velocity\n";
  for (const auto& row : trajectory("inertial").rows)
    text += format_number(row.time) + "," + format_number(row.gap + kShift) + "," +
            format_number(row.velocity) + "\n";
  put("mine.csv", text);
  expect_done(run_viscontact(
      {"compare", path("run"), path("mine.csv"), "-o", path("run/comparison.json")}));
  EXPECT_EQ(reduced_model::read_comparison(path("run/comparison.json")).models.size(),
            number_of_models() + 1);
  const auto mine = comparison_of("mine");
  // Round-off of sums over 4000 rows.
  EXPECT_NEAR(mine.sup_gap_distance, kShift, 1e-12);
  EXPECT_NEAR(mine.l1_gap_distance, kShift * 4, 1e-10);
  EXPECT_EQ(mine.l1_velocity_distance, 0);
  EXPECT_FALSE(mine.film_from_gamma || mine.contact_interval);
}

TEST_F(Stages, CompareKeepsItsColumnsBesideALongName) {
  simulate();
  const std::string file = path("viscous_contact_of_another_program.csv");
  std::filesystem::copy_file(path("run/trajectories/viscous_contact.csv"), file);
  put_text(file, replaced(read_file(file), "# model: viscous_contact\n", ""));
  const auto result = run_viscontact({"compare", path("run"), file, "-o", path("c.json")});
  expect_done(result);
  std::set<std::size_t> lengths;
  std::istringstream lines(result.output);
  std::string below;  // what is no row of the table
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("largest Stokes number "))
      below += line;
    else
      lengths.insert(line.size());
  EXPECT_THAT(below, HasSubstr(", Reynolds number not known"));
  EXPECT_THAT(lengths, ::testing::SizeIs(1)) << result.output;
}

TEST_F(Stages, CompareTakesAnotherReferenceAndAnotherOutput) {
  simulate();
  expect_done(run_viscontact(
      {"compare", path("run"), "--reference", "reference_exact", "-o", path("elsewhere/c.json")}));
  const auto comparison = reduced_model::read_comparison(path("elsewhere/c.json"));
  EXPECT_EQ(comparison.reference_model, "reference_exact");
  for (const auto& model : comparison.models)
    EXPECT_EQ(model.sup_gap_distance == 0, model.model == "reference_exact") << model.model;
}

TEST_F(Stages, ReportIsOneSelfContainedPageWithEightPlots) {
  put("case.toml", replaced(lecture_case_text(), "title = \"Sphere", "title = \"<script>&"));
  simulate();
  expect_done(run_viscontact({"compare", path("run")}));
  std::filesystem::copy_file(path("table.csv"), path("run/table.csv"));
  expect_done(run_viscontact({"report", path("run")}));
  const std::string page = read_file(path("run/report.html"));

  // Each plot is a file of its own too.
  EXPECT_EQ(files_below(path("run/plots")).size(), 8U);
  for (const auto& [file, svg] : files_below(path("run/plots")))
    EXPECT_THAT(page, HasSubstr("plots/" + std::filesystem::path(file).filename().string()));
  EXPECT_THAT(page, AllOf(Not(HasSubstr("@import")), Not(HasSubstr("<link")),
                          Not(HasSubstr("<img")), Not(HasSubstr("<script src"))));

  EXPECT_THAT(page, AllOf(HasSubstr("<title>&lt;script&gt;&amp;"), HasSubstr("Lefebvre 2008"),
                          HasSubstr("q ln q"), HasSubstr("0.00297")));
  for (const auto& model : reduced_model::default_models())
    EXPECT_THAT(page, HasSubstr(std::string(model.name)));
  EXPECT_THAT(page, Not(::testing::ContainsRegex("[>, ]-?nan[<, ]")));
}

}  // namespace
}  // namespace viscontact
