// fit, simulate, compare and report one by one, on a table from the exact drag.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "tests/app/program.hpp"
#include "tests/app/sample_files.hpp"
#include "tests/app/undisturbed.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/csv.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/number.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/force_table.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/fit_uncertainty.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class Stages : public ::testing::Test {
 protected:
  Stages() {
    put("case.toml", lecture_case_text());
    put("table.csv", exact_table_text());
  }
  void put(const std::string& name, const std::string& text) const { put_text(path(name), text); }
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

  void fit(const std::string& basis) const {
    expect_done(
        run_viscontact({"fit", path("table.csv"), "-o", path("fit.json"), "--basis", basis}));
  }
  /// Six trajectories in run/, from the fit of the asymptotic basis.
  void simulate() const {
    fit("asymptotic");
    simulate_into("run");
  }
  /// From the fit that was made.
  void simulate_into(const std::string& folder) const {
    expect_done(run_viscontact(
        {"simulate", path("case.toml"), "--fit", path("fit.json"), "-o", path(folder)}));
  }
  Trajectory trajectory(const std::string& model) const {
    return read_trajectory(path("run/trajectories/" + model + ".csv"));
  }
  ModelComparison comparison_of(const std::string& model) const {
    for (const auto& entry : read_comparison(path("run/comparison.json")).models)
      if (entry.model == model) return entry;
    throw std::invalid_argument("not compared: " + model);
  }

  TemporaryFolder scratch_;
};

TEST_F(Stages, FitFileSaysBasisWeightsTableAndVersions) {
  expect_done(run_viscontact({"fit", path("table.csv"), "-o", path("new/folder/fit.json"),
                              "--basis", "asymptotic", "--weights", "absolute"}));
  const auto fit = read_fit(path("new/folder/fit.json"));
  EXPECT_EQ(fit.basis, "asymptotic");
  EXPECT_EQ(fit.weights, Weights::kAbsolute);
  EXPECT_EQ(fit.table_sha256, sha256(read_file(path("table.csv"))));
  EXPECT_EQ(fit.gap_interval, (std::array{1e-3, 2.0}));
  for (const auto* program : {"Viscontact", "Ceres", "Eigen"})
    EXPECT_TRUE(fit.versions.contains(program)) << program;
}

TEST_F(Stages, FitOfTheLecturesBasisIsTheDefaultAndOfThePublishedQuality) {
  expect_done(run_viscontact({"fit", path("table.csv"), "-o", path("fit.json")}));
  const auto fit = read_fit(path("fit.json"));
  EXPECT_EQ(fit.basis, "lecture");
  EXPECT_EQ(fit.weights, Weights::kRelative);
  // docs/theory.md, section 2: 2.5e-3 over [1e-3, 1]; to 2 it is less than twice as far from a cubic.
  EXPECT_LT(fit.largest_relative_residual, 5e-3);
}

TEST_F(Stages, FitTakesOwnTermsALossAndAHeldCoefficient) {
  expect_done(run_viscontact({"fit", path("table.csv"), "-o", path("fit.json"), "--terms",
                              "1/q, ln q, 1", "--loss", "cauchy", "--fix", "1/q=56.5"}));
  auto fit = read_fit(path("fit.json"));
  EXPECT_EQ(fit.basis, "terms");
  EXPECT_EQ(fit.loss, Loss::kCauchy);
  ASSERT_EQ(fit.terms.size(), 3U);
  EXPECT_TRUE(fit.terms[0].held);
  EXPECT_EQ(fit.terms[0].coefficient, 56.5);
  EXPECT_EQ(fit.terms[0].standard_error, 0);
  // The table does not say theory's value; then it does.
  expect_refusal(run_viscontact({"fit", path("table.csv"), "-o", path("new.json"), "--fix"}),
                 ErrorKind::kBadInput, HasSubstr("leading_coefficient"));
  put("table.csv", "# leading_coefficient: 56.548667764616276\n" + read_file(path("table.csv")));
  expect_done(run_viscontact({"fit", path("table.csv"), "-o", path("new.json"), "--fix"}));
  fit = read_fit(path("new.json"));
  EXPECT_EQ(fit.terms[0].coefficient, 56.548667764616276);  // u0 = -1
  EXPECT_EQ(fit.leading_coefficient, 56.548667764616276);
}

TEST_F(Stages, CompareBasesPrintsThemSideBySideAndDrawsThem) {
  const auto result = run_viscontact({"fit", path("table.csv"), "--compare-bases", "--plot",
                                      path("bases.svg"), "--terms", "1/q, 1"});
  expect_done(result);
  for (const auto* word : {"lecture", "asymptotic_extended", "terms", "AICc", "least AICc: "})
    EXPECT_THAT(result.output, HasSubstr(word));
  EXPECT_THAT(read_file(path("bases.svg")), HasSubstr("<svg"));
  EXPECT_FALSE(std::filesystem::exists(path("fit.json")));
  expect_done(
      run_viscontact({"fit", path("table.csv"), "--compare-bases", "-o", path("fit.json")}));
  EXPECT_EQ(read_fit(path("fit.json")).basis, "lecture");
  EXPECT_TRUE(std::filesystem::exists(path("fit.bases.svg")));
}

TEST_F(Stages, ShiftOfAShiftedSmoothWallIsPrintedWrittenAndDrawn) {
  fit("lecture");
  const LubricationForce smooth(read_fit(path("fit.json")));
  ForceTable rough = read_force_table(path("table.csv"));
  constexpr double kShift = 0.005;
  rough.rows.resize(20);  // gaps that are within the fit when they are shifted
  for (auto& row : rough.rows) row.force = smooth.resistance(row.gap + kShift);
  put("rough.csv", write_force_table(rough));
  const auto result = run_viscontact({"shift", path("rough.csv"), "--fit", path("fit.json"), "-o",
                                      path("shift.csv"), "--plot", path("shift.svg")});
  expect_done(result);
  EXPECT_THAT(result.output, HasSubstr("shift 0.005;"));
  EXPECT_THAT(read_file(path("shift.svg")), HasSubstr("</svg>"));
  const auto rows = read_csv<2>(path("shift.csv"), {"gap", "shift"}, 2);
  EXPECT_EQ(rows.rows.size(), 20U);
  EXPECT_EQ(rows.comments.at("geometry"), rough.geometry);
  // Forces have all their digits in the file: round-off over the force's slope, as in wall_shift_test.cpp.
  for (const auto& row : rows.rows) EXPECT_NEAR(*row.fields[1], kShift, 1e-13);
  // A fit of another fluid names both files.
  put("rough.csv", replaced(read_file(path("rough.csv")), "# viscosity: 3", "# viscosity: 4"));
  expect_refusal(run_viscontact({"shift", path("rough.csv"), "--fit", path("fit.json"), "-o",
                                 path("shift.csv")}),
                 ErrorKind::kBadInput, AllOf(HasSubstr("rough.csv"), HasSubstr("fit.json")));
}

TEST_F(Stages, ExportIsPrintedOrWritten) {
  fit("asymptotic");
  const auto printed = run_viscontact({"export", path("fit.json"), "--to", "c-header"});
  expect_done(printed);
  EXPECT_THAT(printed.output, HasSubstr("viscontact_resistance"));
  expect_done(run_viscontact({"export", path("fit.json"), "--to", "c-header", "-o", path("f.h")}));
  EXPECT_EQ(rest_of(path("f.h")), printed.output);
  expect_refusal(run_viscontact({"export", path("fit.json"), "--to", "cobol"}),
                 ErrorKind::kWrongUsage, HasSubstr("cobol"));
  expect_refusal(
      run_viscontact({"export", path("fit.json"), "--to", "csv", "-o", path("case.toml")}),
      ErrorKind::kBadInput, HasSubstr("case.toml"));
}

TEST_F(Stages, SimulateSaysWhatTheFitsErrorsDoToTheAnswer) {
  simulate();
  const auto uncertainty = read_uncertainty(path("run/uncertainty.json"));
  EXPECT_EQ(uncertainty.draws, 10000U);
  EXPECT_LT(uncertainty.smallest.misfit[0], 2.97084661e-3);
  EXPECT_GT(uncertainty.smallest.misfit[1], 2.97084661e-3);
  expect_done(run_viscontact({"compare", path("run")}));
  expect_done(run_viscontact({"report", path("run")}));
  EXPECT_THAT(read_file(path("run/report.html")), HasSubstr("What the fit does to the answer"));
}

TEST_F(Stages, GapAboveTheFitIsAnErrorUnlessStokesLimitIsAskedFor) {
  put("case.toml", replaced(lecture_case_text(), "initial_gap = 1.0", "initial_gap = 2.5"));
  fit("asymptotic");
  const std::vector<std::string> arguments = {
      "simulate", path("case.toml"), "--fit",    path("fit.json"),
      "-o",       path("run"),       "--models", "reference_exact"};
  expect_refusal(run_viscontact(arguments), ErrorKind::kBadInput,
                 HasSubstr("above = \"stokes_limit\" in the section [fit] of the case"));
  // As the message says; or by the option.
  auto in_case = arguments;
  in_case[1] = path("limit.toml");
  in_case[5] = path("limit_run");
  put("limit.toml", replaced(read_file(path("case.toml")), "weights = \"relative\"",
                             "weights = \"relative\"\nabove = \"stokes_limit\""));
  expect_done(run_viscontact(in_case));
  auto with_limit = arguments;
  with_limit.emplace_back("--stokes-limit");
  expect_done(run_viscontact(with_limit));
  EXPECT_NEAR(trajectory("reference_exact").rows.back().gap, 2.5, 1e-9);  // the push is given back
}

TEST_F(Stages, SameFitIsNotMadeAgainAnotherIs) {
  fit("lecture");
  const auto made = std::filesystem::last_write_time(path("fit.json"));
  const auto again =
      run_viscontact({"fit", path("table.csv"), "-o", path("fit.json"), "--basis", "lecture"});
  EXPECT_THAT(again.errors, HasSubstr("up to date"));
  EXPECT_EQ(std::filesystem::last_write_time(path("fit.json")), made);
  fit("asymptotic");
  EXPECT_EQ(read_fit(path("fit.json")).basis, "asymptotic");
}

std::size_t number_of_models() {
  return static_cast<std::size_t>(std::ranges::distance(default_models()));
}

TEST_F(Stages, SimulateWritesOneTrajectoryForEachModelAndCopiesCaseAndFit) {
  simulate();
  for (const auto& model : default_models()) {
    const auto result = trajectory(std::string(model.name));
    EXPECT_EQ(result.model, model.name);
    EXPECT_EQ(result.rows.front().time, 0);
    EXPECT_EQ(result.rows.front().gap, 1);
    EXPECT_EQ(result.rows.back().time, 4);
    EXPECT_EQ(result.provenance.at("case"), sha256(lecture_case_text()));
    EXPECT_EQ(result.provenance.at("fit"), sha256(rest_of(path("fit.json"))));
    EXPECT_EQ(result.rows.back().gamma.has_value(), model.contact != nullptr);
  }
  EXPECT_EQ(files_below(path("run/trajectories")).size(), number_of_models());
  EXPECT_EQ(read_file(path("run/case.toml")), lecture_case_text());
  EXPECT_EQ(read_file(path("run/fit.json")), read_file(path("fit.json")));
}

TEST_F(Stages, FixLeavesTheTableBehindItToItsCommand) {
  put("table.csv", replaced(exact_table_text(), "# radius: 1\n",
                            "# radius: 1\n# leading_coefficient: 56.548667764616276\n"));
  const auto fixed = [&](const std::vector<std::string>& arguments) {
    expect_done(run_viscontact(arguments));
    return rest_of(arguments.back());
  };
  const auto by_theory = fixed({"fit", path("table.csv"), "--fix", "-o", path("a.json")});
  EXPECT_THAT(by_theory, HasSubstr("\"held\": true"));
  EXPECT_EQ(fixed({"fit", "--fix", path("table.csv"), "-o", path("b.json")}), by_theory);
  EXPECT_EQ(fixed({"fit", "--fix", "theory", path("table.csv"), "-o", path("c.json")}), by_theory);
  const auto given = fixed({"fit", "--fix", "1/q=56.5", path("table.csv"), "-o", path("d.json")});
  EXPECT_THAT(given, HasSubstr("\"coefficient\": 56.5"));
  // The table is looked for, and not taken for the value of --fix, if it is not there either.
  expect_refusal(run_viscontact({"fit", "--fix", path("no.csv"), "-o", path("e.json")}),
                 ErrorKind::kBadInput, HasSubstr("no.csv: cannot be read"));
}

TEST_F(Stages, SimulateTakesTheExactDragOfTheCase) {
  put("exact.toml",
      replaced(replaced(lecture_case_text(), "basis = \"lecture\"", "exact = \"plane\""),
               "weights = \"relative\"", ""));
  const auto result = run_viscontact(
      {"simulate", path("exact.toml"), "-o", path("run"), "--models", "reference_exact,inertial"});
  expect_done(result);
  EXPECT_THAT(result.errors, HasSubstr("the drag is the exact one near a plane"));
  EXPECT_EQ(read_fit(path("run/fit.json")).basis, kExactPlane);
  expect_done(run_viscontact({"compare", path("run")}));
  // docs/theory.md, section 3: the digits that are given there, and a row's distance from the minimum.
  EXPECT_NEAR(comparison_of("reference_exact").minimal_gap / 2.97084661e-3, 1, 1e-8);
  // `run` finds nothing to compute again.
  const auto again = run_viscontact(
      {"simulate", path("exact.toml"), "-o", path("run"), "--models", "reference_exact,inertial"});
  expect_done(again);
  EXPECT_EQ(read_fit(path("run/fit.json")).basis, kExactPlane);
}

TEST_F(Stages, SimulateTakesTheFitFileOfTheCaseOrOfItsFolder) {
  fit("asymptotic");
  const auto simulate = [&](const std::string& case_file, const std::string& folder,
                            std::vector<std::string> further = {}) {
    std::vector<std::string> arguments = {"simulate",   path(case_file), "-o",
                                          path(folder), "--models",      "reference_exact"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return run_viscontact(arguments);
  };
  const auto rows = [&](const std::string& folder) {
    return read_trajectory(path(folder + "/trajectories/reference_exact.csv")).rows.back().gap;
  };
  expect_done(simulate("case.toml", "given", {"--fit", path("fit.json")}));
  // Relative to the case, as for `run`.
  put("file.toml",
      replaced(replaced(lecture_case_text(), "basis = \"lecture\"", "file = \"fit.json\""),
               "weights = \"relative\"", ""));
  expect_done(simulate("file.toml", "file"));
  EXPECT_EQ(rows("file"), rows("given"));
  // No fit anywhere: said before anything is written.
  expect_refusal(simulate("case.toml", "folder"), ErrorKind::kWrongUsage,
                 AllOf(HasSubstr("folder/fit.json"), HasSubstr("--fit")));
  EXPECT_FALSE(std::filesystem::exists(path("folder")));
  std::filesystem::create_directory(path("folder"));
  std::filesystem::copy_file(path("fit.json"), path("folder/fit.json"));
  const auto result = simulate("case.toml", "folder");
  expect_done(result);
  EXPECT_THAT(result.errors, HasSubstr("the drag is that of " + path("folder/fit.json")));
  EXPECT_EQ(rows("folder"), rows("given"));
  // Repeated into another folder, where there is no fit.
  expect_done(run_viscontact(
      {"rerun", path("folder/trajectories/reference_exact.csv"), "-o", path("again")}));
  EXPECT_EQ(rows("again"), rows("given"));
}

TEST_F(Stages, SimulateNeedsNoSectionOfNumericalSettings) {
  fit("asymptotic");
  const auto text = lecture_case_text();
  put("short.toml", text.substr(0, text.find("[reference]")));
  expect_done(run_viscontact(
      {"simulate", path("short.toml"), "--fit", path("fit.json"), "-o", path("run")}));
  simulate_into("whole");
  for (const auto& model : default_models()) {
    const auto name = std::string(model.name);
    const auto whole = read_trajectory(path("whole/trajectories/" + name + ".csv"));
    EXPECT_EQ(trajectory(name).rows.back().gap, whole.rows.back().gap) << name;
    EXPECT_EQ(trajectory(name).rows.size(), whole.rows.size()) << name;
  }
}

TEST_F(Stages, SimulateRunsTheAskedModelsOnly) {
  fit("asymptotic");
  expect_done(run_viscontact({"simulate", path("case.toml"), "--fit", path("fit.json"), "-o",
                              path("run"), "--models", "viscous_contact,reference"}));
  std::vector<std::string> names;
  for (const auto& [file, text] : files_below(path("run/trajectories")))
    names.push_back(std::filesystem::path(file).stem());
  EXPECT_THAT(names, ElementsAre("reference", "viscous_contact"));
}

TEST_F(Stages, GapBelowTheFitIsAnErrorUnlessTheLubricationLimitIsAskedFor) {
  // From q = 1, the push ends near 3e-3: below a table that starts at 0.01.
  std::string table = exact_table_text();
  const auto header_end = table.find('\n', table.find("gap,reference_velocity")) + 1;
  std::istringstream rows(table.substr(header_end));
  std::string kept = table.substr(0, header_end);
  int count = 0;
  for (std::string line; std::getline(rows, line);)
    if (parse_number(line.substr(0, line.find(','))).value() > 0.01) {
      kept += line + "\n";
      ++count;
    }
  put("table.csv", replaced(kept, "# rows: 30", "# rows: " + std::to_string(count)));
  fit("asymptotic");
  const std::vector<std::string> arguments = {
      "simulate", path("case.toml"), "--fit", path("fit.json"), "-o", path("run")};
  expect_refusal(run_viscontact(arguments), ErrorKind::kBadInput, HasSubstr("0.01"));

  auto with_limit = arguments;
  with_limit.emplace_back("--lubrication-limit");
  expect_done(run_viscontact(with_limit));
  expect_done(run_viscontact({"compare", path("run")}));
  // What k/q plus a constant leaves out below 0.01 is (1/5) ln(q/0.01) of 1/q: 0.1 % at 3e-3, and as much of the drag's whole
  // impulse near the minimum. The exact minimum is 2.97846e-3 (docs/theory.md, section 3).
  EXPECT_NEAR(comparison_of("inertial").minimal_gap, 2.97845928e-3, 0.02 * 2.97845928e-3);
}

TEST_F(Stages, MinimalGapsAreTheLecturesNumbers) {
  put("case.toml", replaced(lecture_case_text(), "[viscous_contact]\ntime_step = 1e-3",
                            "[viscous_contact]\ntime_step = 1e-4"));
  simulate();
  expect_done(run_viscontact({"compare", path("run")}));
  EXPECT_EQ(read_comparison(path("run/comparison.json")).reference_model, "inertial");
  // docs/theory.md, section 3, with the exact drag; the fit (6e-6 relative) changes them in the fifth digit, and Euler at
  // h = 1e-3 is 8.9e-3 below. A quarter of that as tolerance.
  EXPECT_NEAR(comparison_of("reference_exact").minimal_gap / 2.97084661e-3, 1, 1e-3);
  EXPECT_NEAR(comparison_of("inertial").minimal_gap / 2.97845928e-3, 1, 1e-3);
  EXPECT_NEAR(comparison_of("inertial").minimal_gap_time, 2.00072819, 1e-3);  // one row's spacing
  EXPECT_NEAR(comparison_of("reference").minimal_gap / 2.97084661e-3, 1 - 8.9e-3, 2e-3);
  ASSERT_TRUE(comparison_of("viscous_contact_regular_drag").recovered_minimal_gap);
  EXPECT_NEAR(*comparison_of("viscous_contact_regular_drag").recovered_minimal_gap / 3e-3, 1,
              0.03);  // the exact drag gives 3.004e-3 as h -> 0
}

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
  EXPECT_EQ(read_comparison(path("run/comparison.json")).models.size(), number_of_models() + 1);
  const auto mine = comparison_of("mine");
  // Round-off of sums over 4000 rows.
  EXPECT_NEAR(mine.sup_gap_distance, kShift, 1e-12);
  EXPECT_NEAR(mine.l1_gap_distance, kShift * 4, 1e-10);
  EXPECT_EQ(mine.l1_velocity_distance, 0);
  EXPECT_FALSE(mine.recovered_minimal_gap || mine.contact_interval);
}

TEST_F(Stages, CompareTakesAnotherReferenceAndAnotherOutput) {
  simulate();
  expect_done(run_viscontact(
      {"compare", path("run"), "--reference", "reference_exact", "-o", path("elsewhere/c.json")}));
  const auto comparison = read_comparison(path("elsewhere/c.json"));
  EXPECT_EQ(comparison.reference_model, "reference_exact");
  for (const auto& model : comparison.models)
    EXPECT_EQ(model.sup_gap_distance == 0, model.model == "reference_exact") << model.model;
}

TEST_F(Stages, ReportIsOneSelfContainedPageWithSevenPlots) {
  put("case.toml", replaced(lecture_case_text(), "title = \"Sphere", "title = \"<script>&"));
  simulate();
  expect_done(run_viscontact({"compare", path("run")}));
  std::filesystem::copy_file(path("table.csv"), path("run/table.csv"));
  expect_done(run_viscontact({"report", path("run")}));
  const std::string page = read_file(path("run/report.html"));

  // Each plot is a file of its own too.
  EXPECT_EQ(files_below(path("run/plots")).size(), 7U);
  for (const auto& [file, svg] : files_below(path("run/plots")))
    EXPECT_THAT(page, HasSubstr("plots/" + std::filesystem::path(file).filename().string()));
  EXPECT_THAT(page, AllOf(Not(HasSubstr("@import")), Not(HasSubstr("<link")),
                          Not(HasSubstr("<img")), Not(HasSubstr("<script src"))));

  EXPECT_THAT(page, AllOf(HasSubstr("<title>&lt;script&gt;&amp;"), HasSubstr("Lefebvre 2008"),
                          HasSubstr("q ln q"), HasSubstr("0.00297")));
  for (const auto& model : default_models()) EXPECT_THAT(page, HasSubstr(std::string(model.name)));
  EXPECT_THAT(page, Not(::testing::ContainsRegex("[>, ]-?nan[<, ]")));
}

}  // namespace
}  // namespace viscontact
