// `viscontact run`: the whole pipeline with FreeFEM, then what the same command makes again.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/common/regular_expressions.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/run/run.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(RunWithFreeFem, MakesEveryFileAndThenNothingAgain) {
  const TemporaryFolder scratch;
  const auto folder = scratch.path() / "run";
  put_text(scratch.path() / "case.toml",
           replaced(gentle_case_text(), "relative_accuracy = 1e-3", "relative_accuracy = 1e-2"));
  const std::vector<std::string> arguments = {
      "run", (scratch.path() / "case.toml").string(), "-o", folder.string(), "--jobs", "2"};
  expect_done(run_viscontact(arguments));

  std::vector<std::string> expected = {"case.toml",       "table.csv",   "fit.json",
                                       "comparison.json", "report.html", "uncertainty.json",
                                       "trajectories",    "plots"};
  for (const auto* plot : {"thinnest_film", "gap", "gap_logarithmic", "external_force",
                           "lubrication_force", "gamma", "fit", "uncertainty"})
    expected.push_back(fmt::format("plots/{}.svg", plot));
  for (const auto& model : reduced_model::default_models())
    expected.push_back("trajectories/" + std::string(model.name) + ".csv");
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    found.push_back(entry.path().lexically_relative(folder));
  EXPECT_THAT(found, ::testing::UnorderedElementsAreArray(expected));  // no journal, no *.tmp

  const auto table = lubrication::read_force_table(folder / "table.csv");
  ASSERT_EQ(table.rows.size(), 6U);
  for (const auto& row : table.rows)
    EXPECT_LE(row.relative_error_estimate, 1e-2);  // asked by the case
  for (const auto* program : {"FreeFEM", "Viscontact"})
    EXPECT_TRUE(table.versions.contains(program)) << program;
  // Six gaps and five terms: nearly interpolation. The basis lacks ln q, which it makes up for to a
  // few parts in a thousand.
  EXPECT_LT(lubrication::read_fit(folder / "fit.json").largest_relative_residual, 1e-2);
  for (const auto& model : reduced_model::read_comparison(folder / "comparison.json").models)
    if (!model.contact_interval) {
      EXPECT_GT(model.minimal_gap, 0.05) << model.model;  // within the table
    }

  const auto made = write_times(folder);
  const auto again = run_viscontact(arguments, {"VISCONTACT_FREEFEM=no-such-freefem"});
  expect_done(again);
  EXPECT_EQ(write_times(folder), made);
  EXPECT_THAT(again.errors, AllOf(IsUpToDate("table.csv"), IsUpToDate("fit.json"),
                                  IsUpToDate("trajectories"), IsUpToDate("report")));
}

TEST_F(Run, OfAChangedCaseMakesAgainWhatDependsOnTheChange) {
  expect_done(run());
  const auto made = write_times(folder());
  // The motion: it is simulated again, but not tabulated.
  put_text(case_file(), replaced(gentle_case_text(), "value = -20.0", "value = -10.0"));
  expect_done(run());
  EXPECT_EQ(fake_.answered().size(), 6U);
  const auto now = write_times(folder());
  EXPECT_EQ(now.size(), made.size());
  for (const auto& [file, time] : now) {
    const bool kept = file.ends_with("table.csv") || file.ends_with("run/fit.json");
    // simulate copies the fit onto itself; its bytes are the same.
    if (!file.ends_with("fit.json")) {
      EXPECT_EQ(time == made.at(file), kept) << file;
    }
  }
  EXPECT_EQ(read_file(folder() / "case.toml"), read_file(case_file()));
  // Models that the case no longer names are gone.
  put_text(case_file(), replaced(gentle_case_text(), "end_time = 4.0",
                                 "end_time = 4.0\nmodels = [\"inertial\", \"reference\"]"));
  expect_done(run());
  EXPECT_EQ(files_below(folder() / "trajectories").size(), 2U);
  EXPECT_EQ(reduced_model::read_comparison(folder() / "comparison.json").models.size(), 2U);
  // The basis: the table is fitted again, but not made.
  put_text(case_file(), replaced(gentle_case_text(), "\"lecture\"", "\"asymptotic\""));
  expect_done(run());
  EXPECT_EQ(fake_.answered().size(), 6U);
  EXPECT_EQ(lubrication::read_fit(folder() / "fit.json").basis, "asymptotic");
  // The tabulation.
  const std::string table = read_file(folder() / "table.csv");
  put_text(case_file(), replaced(gentle_case_text(), "radius = 5.0", "radius = 6.0"));
  expect_done(run());
  EXPECT_EQ(fake_.answered().size(), 12U);
  EXPECT_NE(read_file(folder() / "table.csv"), table);
}

TEST_F(Run, DamagedOrMissingFileIsMadeAgainWithAllThatIsMadeFromIt) {
  expect_done(run());
  const auto complete = files_below(folder());
  std::size_t answered = 6;
  for (const fs::path name :
       {"table.csv", "fit.json", "trajectories/inertial.csv", "comparison.json"}) {
    const auto file = folder() / name;
    const std::string whole = read_file(file);
    for (const auto& damaged : {whole.substr(0, whole.size() / 2), std::string()}) {
      SCOPED_TRACE(name.string() + " of " + std::to_string(damaged.size()) + " bytes");
      put_text(file, damaged);
      expect_done(run());
      // Times of solves and steps differ from run to run; the length of all else, and the last
      // line, do not.
      const std::string now = read_file(file);
      const auto last_line = [](const std::string& text) {
        return text.size() < 2 ? text : text.substr(text.rfind('\n', text.size() - 2) + 1);
      };
      if (name.extension() == ".csv") {
        EXPECT_EQ(std::ranges::count(now, '\n'), std::ranges::count(whole, '\n'));
      }
      if (name == "table.csv") {
        answered += 6;
      } else {
        EXPECT_EQ(last_line(now), last_line(whole));
      }
      EXPECT_EQ(fake_.answered().size(), answered);
    }
  }
  for (const auto* name : {"fit.json", "trajectories/viscous_contact.csv", "comparison.json",
                           "report.html", "case.toml", "plots/gap.svg", "uncertainty.json"}) {
    fs::remove(folder() / name);
    expect_done(run());
    EXPECT_TRUE(fs::exists(folder() / name)) << name;
    EXPECT_EQ(files_below(folder()).size(), complete.size()) << name;
  }
  EXPECT_EQ(fake_.answered().size(), answered);
}

TEST_F(Run, WhatWasMadeFromAnotherFitOrWithAnotherDragIsMadeAgain) {
  expect_done(run());
  const auto fit = read_file(folder() / "fit.json");
  put_text(folder() / "fit.json",
           replaced(fit, "\"reference_velocity\": -1.0", "\"reference_velocity\": -1.5"));
  expect_done(run_viscontact({"report", folder().string()}));
  EXPECT_THAT(read_file(folder() / "report.html"), HasSubstr("another fit"));
  const auto again = run();
  expect_done(again);
  EXPECT_THAT(read_file(folder() / "report.html"), Not(HasSubstr("another fit")));
  // Trajectories with another drag outside the fit.
  const auto fit_file = (folder() / "fit.json").string();
  expect_done(run_viscontact({"simulate", case_file().string(), "--fit", fit_file, "-o",
                              folder().string(), "--lubrication-limit", "--stokes-limit"}));
  EXPECT_THAT(read_file(trajectory("inertial")),
              AllOf(HasSubstr("# drag below the fit: lubrication limit\n"),
                    HasSubstr("# drag above the fit: Stokes' limit\n")));
  EXPECT_THAT(run().errors, Names("6 models"));
  EXPECT_THAT(read_file(trajectory("inertial")), Not(HasSubstr("# drag below")));
}

TEST_F(Run, TableOfACaseThatNowHasTheExactDragIsKeptButNotShownAsItsOwn) {
  expect_done(run());
  const std::string table = read_file(folder() / "table.csv");
  EXPECT_THAT(read_file(folder() / "report.html"), HasSubstr("href=\"table.csv\""));
  put_text(case_file(), exact_case_text());
  expect_done(run());
  EXPECT_THAT(read_file(folder() / "report.html"), Not(HasSubstr("table.csv")));
  EXPECT_FALSE(fs::exists(folder() / "plots/fit.svg"));
  EXPECT_FALSE(fs::exists(folder() / "uncertainty.json"));
  expect_done(run_viscontact({"report", folder().string()}));
  EXPECT_THAT(read_file(folder() / "report.html"), Not(HasSubstr("table.csv")));
  // Its rows took minutes to compute: it is there for the day when the case is changed back.
  EXPECT_EQ(read_file(folder() / "table.csv"), table);
  put_text(case_file(), gentle_case_text());
  expect_done(run());
  EXPECT_EQ(fake_.answered().size(), 6U);
  EXPECT_THAT(read_file(folder() / "report.html"), HasSubstr("href=\"table.csv\""));
}

TEST_F(Run, TableOfACaseThatNowNamesAFitFileIsNotShownAsItsOwn) {
  expect_done(run());
  // The same formula from the same table: then the table is the fit's own.
  const auto fit = (scratch_.path() / "my_fit.json").string();
  fs::copy_file(folder() / "fit.json", fit);
  const auto with_file = [&](const std::string& text) {
    return replaced(replaced(text, "basis = \"lecture\"", "file = \"my_fit.json\""),
                    "weights = \"relative\"", "");
  };
  put_text(case_file(), with_file(gentle_case_text()));
  expect_done(run());
  EXPECT_THAT(read_file(folder() / "report.html"), HasSubstr("href=\"table.csv\""));
  // A fit of another table.
  put_text(fit, replaced_matches(read_file(fit), "\"table_sha256\": \"[0-9a-f]*\"",
                                 "\"table_sha256\": \"" + std::string(64, '0') + "\""));
  expect_done(run());
  EXPECT_THAT(read_file(folder() / "report.html"), Not(HasSubstr("href=\"table.csv\"")));
}

}  // namespace
}  // namespace viscontact
