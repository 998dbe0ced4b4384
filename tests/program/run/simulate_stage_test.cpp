// `simulate`: where its drag comes from, and what it writes.
#include <gmock/gmock.h>

#include <sstream>

#include "tests/program/program.hpp"
#include "tests/program/run/stages.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/program/undisturbed.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/fit_uncertainty.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(Stages, SimulateSaysWhatTheFitsErrorsDoToTheAnswer) {
  simulate();
  const auto uncertainty = reduced_model::read_uncertainty(path("run/uncertainty.json"));
  EXPECT_EQ(uncertainty.draws, 10000U);
  EXPECT_LT(uncertainty.smallest.misfit[0], 2.97084661e-3);
  EXPECT_GT(uncertainty.smallest.misfit[1], 2.97084661e-3);
  expect_done(run_viscontact({"compare", path("run")}));
  expect_done(run_viscontact({"report", path("run")}));
  EXPECT_THAT(read_file(path("run/report.html")),
              HasSubstr("How errors of the fit change the motion"));
}

TEST_F(Stages, GapAboveTheFitIsAnErrorUnlessStokesLimitIsAskedFor) {
  put("case.toml", replaced(lecture_case_text(), "initial_gap = 1.0", "initial_gap = 2.5"));
  fit("asymptotic");
  const std::vector<std::string> arguments = {
      "simulate", path("case.toml"), "--fit",    path("fit.json"),
      "-o",       path("run"),       "--models", "reference_exact"};
  expect_refusal(run_viscontact(arguments), ErrorKind::kBadInput, Names("stokes_limit", "[fit]"));
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

TEST_F(Stages, GravityAwayFromTheWallIsAWarning) {
  fit("asymptotic");
  for (const auto& [gravity, warns] : {std::pair("0.01", true), std::pair("-0.01", false)}) {
    put("case.toml", replaced(lecture_case_text(), "initial_gap = 1.0",
                              std::string("initial_gap = 1.0\ngravity = ") + gravity));
    const auto result = run_viscontact({"simulate", path("case.toml"), "--fit", path("fit.json"),
                                        "-o", path("run"), "--models", "viscous_contact"});
    expect_done(result);
    const auto warning = Names("motion.gravity", "0.01", "0 and");
    if (warns)
      EXPECT_THAT(result.errors, warning);
    else
      EXPECT_THAT(result.errors, ::testing::Not(HasSubstr("gravity")));
  }
}

TEST_F(Stages, SimulateWritesOneTrajectoryForEachModelAndCopiesCaseAndFit) {
  simulate();
  for (const auto& model : reduced_model::default_models()) {
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

TEST_F(Stages, SimulateTakesTheExactDragOfTheCase) {
  put("exact.toml",
      replaced(replaced(lecture_case_text(), "basis = \"lecture\"", "exact = \"plane\""),
               "weights = \"relative\"", ""));
  const auto result = run_viscontact(
      {"simulate", path("exact.toml"), "-o", path("run"), "--models", "reference_exact,inertial"});
  expect_done(result);
  EXPECT_EQ(lubrication::read_fit(path("run/fit.json")).basis, lubrication::kExactPlane);
  expect_done(run_viscontact({"compare", path("run")}));
  // docs/theory.md, section 3: the digits that are given there, and a row's distance from the
  // minimum.
  EXPECT_NEAR(comparison_of("reference_exact").minimal_gap / 2.97084661e-3, 1, 1e-8);
  // `run` finds nothing to compute again.
  const auto again = run_viscontact(
      {"simulate", path("exact.toml"), "-o", path("run"), "--models", "reference_exact,inertial"});
  expect_done(again);
  EXPECT_EQ(lubrication::read_fit(path("run/fit.json")).basis, lubrication::kExactPlane);
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
    return reduced_model::read_trajectory(path(folder + "/trajectories/reference_exact.csv"))
        .rows.back()
        .gap;
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
                 Names("folder/fit.json", "--fit"));
  EXPECT_FALSE(std::filesystem::exists(path("folder")));
  std::filesystem::create_directory(path("folder"));
  std::filesystem::copy_file(path("fit.json"), path("folder/fit.json"));
  const auto result = simulate("case.toml", "folder");
  expect_done(result);
  EXPECT_THAT(result.errors, Names(path("folder/fit.json")));
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
  for (const auto& model : reduced_model::default_models()) {
    const auto name = std::string(model.name);
    const auto whole = reduced_model::read_trajectory(path("whole/trajectories/" + name + ".csv"));
    EXPECT_EQ(trajectory(name).rows.back().gap, whole.rows.back().gap) << name;
    EXPECT_EQ(trajectory(name).rows.size(), whole.rows.size()) << name;
  }
}

TEST_F(Stages, SimulateTakesAFitWhoseViscosityDiffersByRounding) {
  fit("asymptotic");
  const auto simulate_with = [&](const std::string& viscosity) {
    put("other.toml", replaced(lecture_case_text(), "viscosity = 3.0", "viscosity = " + viscosity));
    return run_viscontact({"simulate", path("other.toml"), "--fit", path("fit.json"), "-o",
                           path("run"), "--models", "inertial"});
  };
  // The double next to 3, and 1e-11 away, which no conversion of units explains.
  const auto rounded = simulate_with("3.0000000000000004"), other = simulate_with("3.00000000003");
  expect_done(rounded);
  EXPECT_THAT(rounded.errors, ::testing::Not(HasSubstr("scaled")));
  expect_done(other);
  EXPECT_THAT(other.errors, Names("1 and", "3"));
}

TEST_F(Stages, FitIsScaledToACaseInOtherUnits) {
  // The lecture's case with 0.5 mm for the radius and 0.1 Pa s for the viscosity: the unit of
  // length is 5e-4 m, that of time 1 s, and that of mass 5e-4 0.1/3 kg.
  fit("asymptotic");
  simulate();
  auto text = lecture_case_text();
  text.erase(text.find("[tabulation]"), text.find("[fit]") - text.find("[tabulation]"));
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"viscosity = 3.0", "viscosity = 0.1"},
           {"radius = 1.0", "radius = 5e-4"},
           {"mass = 20.0", "mass = 3.3333333333333333e-4"},
           {"initial_gap = 1.0", "initial_gap = 5e-4"},
           {"value = -200.0", "value = -1.6666666666666667e-6"},
           {"value = 200.0", "value = 1.6666666666666667e-6"},
           {"threshold_gap = 0.1", "threshold_gap = 5e-5"}})
    text = replaced(text, from, to);
  put("si.toml", text);
  expect_done(
      run_viscontact({"simulate", path("si.toml"), "--fit", path("fit.json"), "-o", path("si")}));
  expect_done(run_viscontact({"compare", path("si")}));
  expect_done(run_viscontact({"report", path("si")}));
  for (const auto& model : reduced_model::default_models()) {
    const std::string name(model.name);
    const auto small = reduced_model::read_trajectory(path("si/trajectories/" + name + ".csv"));
    const auto rows = trajectory(name).rows;
    ASSERT_EQ(small.rows.size(), rows.size()) << name;
    // The tolerance of inertial is 1e-9; in the others roundings grow in 4000 steps.
    for (std::size_t i = 0; i < rows.size(); i += 100)
      EXPECT_NEAR(small.rows[i].gap / 5e-4, rows[i].gap, 1e-8 * (1e-2 + rows[i].gap))
          << name << " " << i;
  }
  EXPECT_THAT(read_file(path("si/report.html")),
              HasSubstr("scaled to the radius and the viscosity of the case"));
}

TEST_F(Stages, FitThatIsScaledHasTheGeometryOfTheCaseInRadii) {
  fit("asymptotic");
  put("other.toml",
      replaced(replaced(lecture_case_text(), "radius = 1.0", "radius = 0.5"),
               "geometry = { kind = \"plane\" }", "geometry = { kind = \"free_surface\" }"));
  expect_refusal(run_viscontact({"simulate", path("other.toml"), "--fit", path("fit.json"), "-o",
                                 path("other"), "--models", "inertial"}),
                 ErrorKind::kBadInput, Names(path("fit.json"), "container"));
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
  expect_refusal(run_viscontact(arguments), ErrorKind::kBadInput,
                 Names("case.toml", "model reference", "lubrication_limit"));

  auto with_limit = arguments;
  with_limit.emplace_back("--lubrication-limit");
  expect_done(run_viscontact(with_limit));
  expect_done(run_viscontact({"compare", path("run")}));
  // What k/q plus a constant leaves out below 0.01 is (1/5) ln(q/0.01) of 1/q: 0.1 % at 3e-3, and
  // as much of the drag's whole impulse near the minimum. The exact minimum is 2.97846e-3
  // (docs/theory.md, section 3).
  EXPECT_NEAR(comparison_of("inertial").minimal_gap, 2.97845928e-3, 0.02 * 2.97845928e-3);
}

}  // namespace
}  // namespace viscontact
