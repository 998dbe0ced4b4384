// `tabulate`, `fit` and `export` of several motions, and `rolling`, with FreeFEM once and with the
// shipped tables.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>

#include "tests/common/temporary_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/program/undisturbed.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/lubrication/motion_table.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kData = std::string(VISCONTACT_SOURCE_FOLDER) + "/data/";
const std::string kIncline = kData + "cases/rolling/incline.toml";

class MotionsCommand : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

  /// A case of a few rows.
  std::string small_case(const std::string& motion, const std::string& geometry = "") const {
    return scratch_
        .file("small.toml",
              "title = \"small\"\n[fluid]\nviscosity = 2.0\n"
              "[sphere]\nradius = 0.5\nmass = 1.0\n[tabulation]\n" +
                  motion +
                  "\ngaps = [0.05, 0.1, 0.2]\nreference_velocities = [1.0, -3.0]\n"
                  "relative_accuracy = 1e-2\n" +
                  (geometry.empty() ? std::string("container = \"unbounded\"\n") : geometry))
        .string();
  }
  /// The shipped incline with one text replaced, and with the fit by its whole path.
  std::string incline(const std::string& from, const std::string& to) const {
    auto text = read_file(kIncline);
    for (const auto& [old_text, new_text] :
         {std::pair(std::string("../../fits"), kData + "fits"), std::pair(from, to)}) {
      const auto at = text.find(old_text);
      if (at == std::string::npos) throw std::logic_error("the case has no " + old_text);
      text.replace(at, old_text.size(), new_text);
    }
    return scratch_.file("incline.toml", text).string();
  }

  TemporaryFolder scratch_;
};

const std::string kFourMotions = "motion = [\"approach\", \"slide\", \"roll\", \"spin\"]";

/// A shell script in FreeFEM's place beside a plane, which answers every motion at once: forces and
/// torques are sums of the leading terms of theory and constants, and the matrix is symmetric.
/// `before` is shell text that runs before a row is answered, with $gap and $motion (empty for the
/// approach) set, unless the file `mended` is in the folder.
std::string fake_motions(const TemporaryFolder& folder, const std::string& before) {
  const auto file = folder.file("freefem", R"sh(#!/bin/sh
case $4 in *version.edp) echo "viscontact-version 0-fake"; exit 0 ;; esac
for word in "$@"; do
  case $previous in -gap) gap=$word ;; -velocity) velocity=$word ;; -motion) motion=$word ;;
    -strains) strains=$word ;; esac
  previous=$word
done
[ -e ')sh" + (folder.path() / "mended").string() +
                                               "' ] || {\n" + before + R"sh(
:; }
awk "BEGIN { l = log($gap)
  if (\"$strains\" == \"1\") {
    kinds = \"$motion\" < 2 ? 3 : 1; solutions = \"$motion\" == 0 ? 2 : kinds
    for (m = 0; m < solutions; m++) for (k = 0; k < kinds; k++)
      printf \"viscontact-entry %d 0 %d %.17g 1e-6 4\\n\", m, k, k == m ? -20 + l : 1
  } else if (\"$motion\" == \"1\") {
    printf \"viscontact-action 0 0 %.17g %.17g 1e-6 1e-6 4\\n\", -20 + 10 * l, 3 + 2 * l
    printf \"viscontact-action 1 0 %.17g %.17g 1e-6 1e-6 4\\n\", 3 + 2 * l, -20 + 10 * l
  } else if (\"$motion\" == \"2\")
    printf \"viscontact-action 0 0 0 %.17g 1e-6 1e-6 4\\n\", -25 + 6 * $gap * l
  printf \"viscontact-result %.17g 1e-6 1000 4 1e-4\\n\", -($velocity) * (1 / $gap + 1) }"
)sh");
  make_executable(file);
  return "VISCONTACT_FREEFEM=" + file.string();
}

TEST_F(MotionsCommand, TabulateWritesATableForEachMotionAndKeepsThem) {
  const auto file = small_case("motion = \"all\"");
  put_text(file, std::regex_replace(read_file(file), std::regex("gaps = .*"), "gaps = [0.1]"));
  expect_done(run_viscontact({"tabulate", file, "-o", path("out")}));
  for (const auto& [name, kind] : lubrication::all_motions()) {
    const std::string motion(name);
    SCOPED_TRACE(motion);
    const auto table = lubrication::read_motion_table(path("out/") + motion + ".csv");
    EXPECT_EQ(table.motion, kind);
    EXPECT_TRUE(table.rows.at(0).has_stresslets);
    ASSERT_EQ(table.rows.size(), 2U);
    EXPECT_EQ(table.rows[1].gap, 0.1);
    EXPECT_EQ(table.rows[1].reference_velocity, -3);
    EXPECT_EQ(table.rows[1].torque_factor, table.rows[0].torque_factor);
    EXPECT_DOUBLE_EQ(table.rows[1].stresslet, -3 * table.rows[0].stresslet);
    EXPECT_FALSE(fs::exists(path("out/") + motion + ".csv.rows"));
  }
  // A second call computes nothing, not even with FreeFEM out of reach.
  const auto before = files_below(path("out"));
  const auto again = run_viscontact({"tabulate", file, "-o", path("out")},
                                    {"VISCONTACT_FREEFEM=no-freefem-is-needed"});
  expect_done(again);
  EXPECT_THAT(again.errors, AllOf(IsUpToDate("slide.csv"), IsUpToDate("twofold_strain.csv")));
  EXPECT_EQ(files_below(path("out")), before);
  // The tables can be fitted and exported as one pair, with coarse errors and few terms.
  const auto fit = run_viscontact({"fit", path("out/slide.csv"), path("out/roll.csv"), "--basis",
                                   "asymptotic", "-o", path("pair.json")});
  expect_refusal(fit, ErrorKind::kBadInput, Names("slide.csv"));
}

TEST_F(MotionsCommand, OneMotionIsAFileAndTheOptionReplacesThatOfTheCase) {
  const auto file = small_case(kFourMotions);
  expect_done(run_viscontact({"tabulate", file, "--motion", "spin", "-o", path("spin.csv")},
                             {fake_motions(scratch_, "")}));
  const auto table = lubrication::read_motion_table(path("spin.csv"));
  EXPECT_EQ(to_string(table.motion), "spin");
  EXPECT_NEAR(table.leading_torque_factor.value(), 0.5 / 0.5, 1e-15);
  expect_refusal(run_viscontact({"tabulate", file, "--motion", "glide", "-o", path("x.csv")}),
                 ErrorKind::kBadInput, Names("--motion", "'glide'"));
}

TEST_F(MotionsCommand, SharesOfTasksAreGatheredIntoTheTablesOfAllMotions) {
  const auto file = small_case("motion = [\"slide\", \"roll\", \"spin\"]");
  const auto freefem = fake_motions(scratch_, "");
  for (const char* task : {"0/2", "1/2"})
    expect_done(run_viscontact({"tabulate", file, "-o", path("out"), "--task", task}, {freefem}));
  EXPECT_FALSE(fs::exists(path("out/slide.csv")));
  const auto gather = run_viscontact({"tabulate", file, "-o", path("out"), "--gather"},
                                     {"VISCONTACT_FREEFEM=no-freefem-is-needed"});
  expect_done(gather);
  for (const char* motion : {"slide", "roll", "spin"})
    EXPECT_EQ(lubrication::read_motion_table(path("out/") + motion + ".csv").rows.size(), 6U);
  // A table that is lost is made again from the companion's rows and those of FreeFEM.
  fs::remove(path("out/roll.csv"));
  expect_done(run_viscontact({"tabulate", file, "-o", path("out")}, {freefem}));
  EXPECT_TRUE(fs::exists(path("out/roll.csv")));
}

TEST_F(MotionsCommand, RunNeedsTheApproachAlone) {
  expect_refusal(run_viscontact({"run", small_case(kFourMotions), "-o", path("run")}),
                 ErrorKind::kBadInput, Names("small.toml"));
}

TEST_F(MotionsCommand, RefusesMotionsThatThereAreNot) {
  const auto rough = small_case(
      "motion = \"slide\"",
      "container = \"unbounded\"\ngeometry = { kind = \"rough_plane\", amplitude = 0.01, "
      "wavelength = 0.1 }\n");
  expect_refusal(run_viscontact({"tabulate", rough, "-o", path("x.csv")}), ErrorKind::kBadInput,
                 Names("tabulation.motion", "rough_plane"));
  EXPECT_FALSE(fs::exists(path("x.csv")));
}

TEST_F(MotionsCommand, FitsAndExportsAPair) {
  const auto fit = run_viscontact({"fit", kData + "tables/pairs/plane", "-o", path("pair.json")});
  expect_done(fit);
  EXPECT_THAT(fit.errors, AllOf(Names("5 entries", "0.001"), HasSubstr("ln q: -10.053")));
  const auto code = run_viscontact({"export", path("pair.json"), "--to", "c-header"});
  expect_done(code);
  EXPECT_THAT(code.output, AllOf(HasSubstr("viscontact_slide_roll(double gap)"),
                                 HasSubstr("viscontact_spin(double gap)")));
  const auto bases =
      run_viscontact({"fit", kData + "tables/pairs/plane", "--compare-bases", "--json"});
  expect_done(bases);
  const auto json = nlohmann::json::parse(bases.output);
  EXPECT_LT(json["asymptotic_cubic"]["roll"]["largest_relative_residual"].get<double>(), 1e-6);
  EXPECT_GT(json["asymptotic"]["roll"]["largest_relative_residual"].get<double>(), 1e-4);
  expect_refusal(run_viscontact({"fit", kData + "tables/pairs/plane", "--terms", "1", "-o",
                                 path("pair.json")}),
                 ErrorKind::kWrongUsage, Names("--basis"));
  expect_refusal(run_viscontact({"fit", path(""), "-o", path("x.json")}), ErrorKind::kBadInput,
                 Names("approach.csv"));
}

// An interrupted tabulation leaves the tables of some motions: the user types Ctrl-C during the
// second table.
TEST_F(MotionsCommand, FitOfAFolderNamesTheTablesThatAnInterruptedTabulationLeftOut) {
  const auto file = small_case(kFourMotions);
  const auto freefem =
      fake_motions(scratch_, "[ \"$motion\" ] && { kill -INT $PPID; exec sleep 60; }");
  const auto interrupted = run_viscontact({"tabulate", file, "-o", path("out")}, {freefem});
  EXPECT_EQ(interrupted.exit_status, 130) << interrupted.errors;
  EXPECT_EQ(lubrication::read_force_table(path("out/approach.csv")).tabulated_motions.size(), 4U);
  expect_refusal(
      run_viscontact({"fit", path("out"), "-o", path("pair.json")}), ErrorKind::kBadInput,
      Names("slide.csv", "roll.csv", "spin.csv", "approach.csv", path("out/approach.csv")));
  EXPECT_FALSE(fs::exists(path("pair.json")));
  // The command of the message completes the folder.
  put_text(path("mended"), "");
  expect_done(run_viscontact({"rerun", path("out/approach.csv")}, {freefem}));
  for (const std::string motion : {"approach", "slide", "roll", "spin"})
    EXPECT_THAT(read_file(path("out/" + motion + ".csv")),
                HasSubstr("# motions: approach, slide, roll, spin\n"));
}

// All motions and strains of a group are one row of the journal, which is not computed again.
TEST_F(MotionsCommand, AnInterruptedTabulationOfStrainsGoesOnWithTheRowsThatItHas) {
  const auto file = small_case("motion = \"all\"");
  const auto interrupted = run_viscontact(
      {"tabulate", file, "-o", path("out"), "--jobs", "1"},
      {fake_motions(scratch_,
                    "[ \"$motion $gap\" = '1 0.1' ] && { kill -INT $PPID; exec sleep 60; }")});
  EXPECT_EQ(interrupted.exit_status, 130) << interrupted.errors;
  EXPECT_TRUE(fs::exists(path("out/axial_strain.csv")));
  EXPECT_FALSE(fs::exists(path("out/slide.csv")));
  const auto rest = run_viscontact(
      {"tabulate", file, "-o", path("out"), "--jobs", "1"},
      {fake_motions(scratch_, "case \"$motion $gap\" in '0 '*|'1 0.05') exit 5 ;; esac")});
  expect_done(rest);
  for (const auto& [name, kind] : lubrication::all_motions())
    EXPECT_EQ(lubrication::read_motion_table(path("out/") + std::string(name) + ".csv").rows.size(),
              6U);
}

// The tables of some motions were copied into another folder.
TEST_F(MotionsCommand, FitOfAFolderNamesTheTablesThatWereNotCopiedIntoIt) {
  const auto file = small_case(kFourMotions);
  const auto freefem = fake_motions(scratch_, "");
  expect_done(run_viscontact({"tabulate", file, "-o", path("out")}, {freefem}));
  fs::create_directory(path("part"));
  for (const std::string motion : {"slide", "roll"})
    fs::copy_file(path("out/" + motion + ".csv"), path("part/" + motion + ".csv"));
  expect_refusal(
      run_viscontact({"fit", path("part"), "-o", path("pair.json")}), ErrorKind::kBadInput,
      AllOf(Names("approach.csv", "spin.csv", "slide.csv", path("part/slide.csv"), path("part")),
            Not(HasSubstr("has not ended"))));
  // The command of the message completes the folder, after which it can be fitted.
  expect_done(run_viscontact({"rerun", path("part/slide.csv"), "-o", path("part")}, {freefem}));
  for (const std::string motion : {"approach", "slide", "roll", "spin"})
    EXPECT_EQ(without_seconds(path("part/" + motion + ".csv")),
              without_seconds(path("out/" + motion + ".csv")));
}

// A table that is alone in a folder is fitted in the basis of pairs, as the others of its folder.
TEST_F(MotionsCommand, FitOfAFolderIsThatOfAPairWhateverTablesItHas) {
  fs::create_directory(path("pair"));
  fs::copy(kData + "tables/pairs/plane/approach.csv", path("pair/approach.csv"));
  // Another program wrote it: it does not name the motions of a tabulation.
  put_text(path("pair/approach.csv"), std::regex_replace(read_file(path("pair/approach.csv")),
                                                         std::regex("# motions: [^\n]*\n"), ""));
  expect_done(run_viscontact({"fit", path("pair"), "-o", path("pair.json")}));
  const auto json = nlohmann::json::parse(read_file(path("pair.json")));
  EXPECT_EQ(json.at("kind"), "pair fit");
  EXPECT_EQ(json.at("entries").at("squeeze").at("basis"), "asymptotic_cubic");
}

// Sliding and rolling share their rows, so that both tables lack a row that failed.
TEST_F(MotionsCommand, ARowThatFailedIsMissingInTheTablesOfItsMotionsAndTheFitGoesOn) {
  const auto freefem =
      fake_motions(scratch_, "[ $gap = 0.1 ] && { echo viscontact-error no solution; exit 4; }");
  const auto file = small_case("motion = [\"slide\", \"roll\"]");
  put_text(file, std::regex_replace(read_file(file), std::regex("gaps = .*"),
                                    "gaps = [0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5]"));
  const auto failed = run_viscontact({"tabulate", file, "-o", path("out")}, {freefem});
  expect_refusal(failed, ErrorKind::kExternalProgram, Names("1 of 7"));
  for (const char* motion : {"slide", "roll"}) {
    const auto table = lubrication::read_motion_table(path("out/") + motion + ".csv");
    EXPECT_EQ(table.rows.size(), 12U);
    EXPECT_EQ(table.failed_rows.count("gap 0.1"), 1U);
  }
  const auto fit =
      run_viscontact({"fit", path("out"), "--basis", "asymptotic", "-o", path("pair.json")});
  expect_done(fit);
  EXPECT_THAT(fit.errors, Names("slide_roll", "1 of 13"));
  const auto entries = nlohmann::json::parse(read_file(path("pair.json"))).at("entries");
  for (const char* entry : {"slide", "roll", "slide_roll"})
    EXPECT_EQ(entries.at(entry).at("diagnostics").at("failed_rows"), 1) << entry;
  put_text(path("mended"), "");
  expect_done(run_viscontact({"tabulate", file, "-o", path("out")}, {freefem}));
  EXPECT_EQ(lubrication::read_motion_table(path("out/roll.csv")).rows.size(), 14U);
}

TEST_F(MotionsCommand, RollingWritesTrajectoriesResultsAndAReport) {
  const auto result = run_viscontact({"rolling", kIncline, "-o", path("out"), "--json"});
  expect_done(result);
  const auto json = nlohmann::json::parse(read_file(path("out/rolling.json")));
  EXPECT_EQ(nlohmann::json::parse(result.output)["models"], json["models"]);
  // A sphere that rolls without slip at q = 0.001: f / (slide - 2 slide_roll + roll) with the exact
  // resistances of data/reference/sphere_plane_modes.csv, in units of 6 pi mu.
  const double resistance =
      4.640038165209212 - 2 * 4. / 3 * 0.49911184477374975 + 4. / 3 * 3.137983756794614;
  for (const char* model : {"rough", "viscous_contact"}) {
    const auto& end = json["models"][model];
    EXPECT_NEAR(end["velocity"].get<double>() * resistance / std::sin(0.3), 1, 1e-6) << model;
    EXPECT_NEAR(end["slip"].get<double>(), 0, 1e-12);
    EXPECT_EQ(end["contact"], 1);
  }
  EXPECT_EQ(json["models"]["smooth"]["contact_time"], nullptr);
  const auto rows = read_csv<3>(path("out/rough.csv"), {"time", "gap", "velocity"}, 3);
  ASSERT_EQ(rows.rows.size(), 2001U);
  EXPECT_EQ(*rows.rows.back().fields[0], 20);
  EXPECT_THAT(read_file(path("out/report.html")),
              AllOf(HasSubstr("A sphere rolls down an incline"), HasSubstr("plots/slip.svg")));
  const auto rough = read_file(path("out/rough.csv"));
  for (const std::string contact : {"3", "0.5", "-1"}) {
    put_text(path("out/rough.csv"), replaced(rough, ",0\n", "," + contact + "\n"));
    expect_refusal(run_viscontact({"report", path("out")}), ErrorKind::kBadInput,
                   Names("rough.csv:6", contact));
  }
}

TEST_F(MotionsCommand, TheReportOfARollingSphereHasTheUnitsOfItsCase) {
  put_text(path("case.toml"),
           "units = { length = \"mm\", time = \"s\", mass = \"g\" }\n" +
               replaced(read_file(kIncline), "file = \"", "file = \"" + kData + "cases/rolling/"));
  expect_done(run_viscontact({"rolling", path("case.toml"), "-o", path("out")}));
  EXPECT_THAT(read_file(path("out/report.html")),
              AllOf(HasSubstr("gap [mm]"), HasSubstr("viscosity [g/(mm s)]"),
                    HasSubstr("torque [g mm<sup>2</sup>/s<sup>2</sup>]")));
  EXPECT_THAT(read_file(path("out/plots/velocity.svg")),
              AllOf(HasSubstr("time [s]"), HasSubstr("velocity [mm/s]")));
}

TEST_F(MotionsCommand, RollingTabulatesMotionsAndNoStrains) {
  const auto with_tables =
      incline("[fit]\nfile = \"" + kData + "fits/pairs/plane.json\"",
              "[tabulation]\nmotion = \"all\"\ncontainer = \"unbounded\"\n"
              "gaps = { from = 1e-3, to = 1.0, count = 12, spacing = \"log\" }\n"
              "reference_velocities = [1.0]\nrelative_accuracy = 1e-2\n");
  expect_done(
      run_viscontact({"rolling", with_tables, "-o", path("out")}, {fake_motions(scratch_, "")}));
  for (const auto& [name, kind] : lubrication::all_motions()) {
    const auto table = path("out/tables/") + std::string(name) + ".csv";
    ASSERT_EQ(fs::exists(table), !lubrication::is_strain(kind)) << table;
    if (fs::exists(table)) {
      EXPECT_FALSE(lubrication::read_motion_table(table).rows.at(0).has_stresslets);
    }
  }
}

TEST_F(MotionsCommand, RollingSaysWhereItContinuesTheFit) {
  // The smooth sphere sinks for ever; the fit begins at the smallest gap of its table.
  const auto result = run_viscontact({"rolling", kIncline, "-o", path("out")});
  expect_done(result);
  const auto json = nlohmann::json::parse(read_file(path("out/rolling.json")));
  const double smallest = json["models"]["smooth"]["smallest_gap"];
  const double low =
      nlohmann::json::parse(read_file(kData + "fits/pairs/plane.json"))["gap_interval"][0];
  ASSERT_LT(smallest, low);
  const auto warning =
      Names("Extrapolation", "smooth", fmt::format("{:.4g}", smallest), fmt::format("{:.4g}", low));
  EXPECT_THAT(result.errors, warning);
  // The other models stop at the roughness. Viscous contact touches at 6.51 and the rough sphere,
  // whose drag is resolved, at 7.22: 10 % too early.
  EXPECT_THAT(json["warnings"].get<std::vector<std::string>>(),
              ::testing::ElementsAre(warning, Names("momentum", "film")));
  const double viscous = json["models"]["viscous_contact"]["contact_time"];
  EXPECT_NEAR(viscous / json["models"]["rough"]["contact_time"].get<double>(), 0.9, 0.005);
  EXPECT_THAT(read_file(path("out/report.html")), warning);
}

TEST_F(MotionsCommand, RollingHasTheReynoldsAndStokesNumbersOfItsRows) {
  constexpr double kMu = 0.05305164769729845, kMass = 0.1, kDensity = 0.25, kPlane = -0.4;
  auto text = read_file(incline("friction = 0.3", "friction = 0.3\nplane_velocity = -0.4"));
  text = replaced(text, "[sphere]", "density = 0.25\n[sphere]");
  expect_done(
      run_viscontact({"rolling", scratch_.file("fast.toml", text).string(), "-o", path("out")}));
  const auto json = nlohmann::json::parse(read_file(path("out/rolling.json")));
  for (const std::string model : {"smooth", "rough", "viscous_contact"}) {
    double speed = 0;
    for (const auto& row :
         read_csv<2>(path("out/" + model + ".csv"), {"velocity", "normal_velocity"}, 2).rows)
      speed = std::max(speed, std::hypot(*row.fields[0] - kPlane, *row.fields[1]));
    ASSERT_GT(speed, 0.39);  // at least the sphere at rest at the start
    const auto& found = json["models"][model];
    // The radius is 1. The rounding errors of the quotients.
    constexpr double kRounding = 1e-14;
    EXPECT_NEAR(found["reynolds_number"].get<double>() / (kDensity * 2 * speed / kMu), 1,
                kRounding);
    EXPECT_NEAR(
        found["stokes_number"].get<double>() / (kMass * speed / (6 * std::numbers::pi * kMu)), 1,
        kRounding);
    EXPECT_THAT(json["warnings"].dump(), HasSubstr(model + ": the Reynolds number reaches "));
  }
}

TEST_F(MotionsCommand, RollingWarnsOfGravityAwayFromThePlane) {
  const auto errors = [&](const std::string& gravity) {
    const auto result = run_viscontact(
        {"rolling", incline("weight = 1.0", "gravity = " + gravity), "-o", path("out")});
    expect_done(result);
    return result.errors;
  };
  EXPECT_THAT(errors("0.5"), Names("rolling.gravity", "0.5", "0 and"));
  EXPECT_THAT(errors("-10.0"), ::testing::Not(HasSubstr("gravity")));
}

TEST_F(MotionsCommand, RollingRefusesWhatIsWrongWithItsLine) {
  const auto refused = [&](const std::string& from, const std::string& to,
                           const std::string& named) {
    expect_refusal(run_viscontact({"rolling", incline(from, to), "-o", path("out")}),
                   ErrorKind::kBadInput, Names(named));
    EXPECT_FALSE(fs::exists(path("out/rolling.json")));
  };
  refused("friction = 0.3", "friction = -1.0", "rolling.friction");
  refused("weight = 1.0", "weight = 1.0\nforce = [1.0, 2.0]", "rolling.weight");
  refused("initial_gap = 0.5", "initial_gap = 1e-4", "rolling.initial_gap");
  expect_done(run_viscontact(
      {"rolling", incline("radius = 1.0", "radius = 1.0000000000000002"), "-o", path("same")}));
  const auto scaled =
      run_viscontact({"rolling", incline("radius = 1.0", "radius = 2.0"), "-o", path("scaled")});
  expect_done(scaled);
  EXPECT_THAT(scaled.errors, Names("radius 2"));
  refused("time_step = 0.01", "time_step = 0.01\nmodels = [\"rigid\"]", "rolling.models");
  refused("plane.json", "equal_spheres.json", "equal_spheres.json");
}

TEST_F(MotionsCommand, SweepOfARollingSphereHasTheEndsThatRollingHas) {
  const auto steep =
      scratch_.file("steep.toml", read_file(incline("incline = 0.3", "incline = 0.9")));
  const auto file = incline("friction = 0.3", "friction = 0.3\nmodels = [\"rough\"]");
  const auto sweep = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"sweep", file, "-o", path("rows.csv")});
    return run_viscontact(more);
  };
  const auto done = sweep({"--vary", "rolling.incline=0.1,0.9", "--models",
                           "smooth,viscous_contact", "--plot", path("rows.svg")});
  expect_done(done);
  EXPECT_THAT(done.errors, Names("2 rows", path("rows.csv")));
  EXPECT_THAT(read_file(path("rows.svg")), HasSubstr("</svg>"));
  expect_done(run_viscontact({"rolling", steep.string(), "-o", path("out")}));
  const auto json = nlohmann::json::parse(read_file(path("out/rolling.json")));
  for (const std::string model : {"smooth", "viscous_contact"})
    for (const std::string column : {"gap", "smallest_gap", "position", "angle", "velocity",
                                     "angular_velocity", "slip", "contact", "contact_time"}) {
      const auto rows = read_csv<1>(path("rows.csv"), {model + "." + column}, 1);
      ASSERT_EQ(rows.rows.size(), 2U);
      const auto& expected = json["models"][model][column];
      EXPECT_EQ(rows.rows[1].fields[0].has_value(), !expected.is_null()) << model << column;
      if (!expected.is_null()) {
        EXPECT_EQ(*rows.rows[1].fields[0], expected.get<double>()) << model << column;
      }
    }
  EXPECT_THAT(
      sweep({"--vary", "rolling.incline=0.1,0.9", "--models", "smooth,viscous_contact"}).errors,
      IsUpToDate(""));
  expect_refusal(sweep({"--vary", "tabulation.relative_accuracy=1e-3,1e-4"}),
                 ErrorKind::kWrongUsage, Names("--vary", "tabulation.relative_accuracy"));
  expect_refusal(sweep({"--vary", "rolling.incline=0,1", "--draws", "2"}), ErrorKind::kWrongUsage,
                 Names("--draws"));
  expect_refusal(sweep({"--vary", "rolling.friction=0.1,0.2", "--models", "smooth"}),
                 ErrorKind::kWrongUsage, Names("--vary", "rolling.friction"));
  expect_refusal(sweep({"--vary", "fluid.density=0.1,0.2"}), ErrorKind::kWrongUsage,
                 Names("rolling.gravity"));
  expect_refusal(sweep({"--vary", "rolling.incline=0,1", "--models", "inertia"}),
                 ErrorKind::kWrongUsage, Names("viscous_contact"));
  const auto tables = small_case("motion = \"all\"",
                                 "container = \"unbounded\"\n[rolling]\ninitial_gap = 0.1\n"
                                 "weight = 1.0\nend_time = 1.0\ntime_step = 0.1\n");
  expect_refusal(
      run_viscontact({"sweep", tables, "-o", path("rows.csv"), "--vary", "rolling.incline=0,1"}),
      ErrorKind::kWrongUsage, Names("--fit", "fit.json"));
}

TEST_F(MotionsCommand, RollingWritesTheModelsThatDoNotFail) {
  // Only viscous contact has no film above the gaps of the fit.
  const auto run = run_viscontact(
      {"rolling", incline("initial_gap = 0.5", "initial_gap = 2.0"), "-o", path("out")});
  expect_refusal(run, ErrorKind::kBadInput, Names("1 more", "1 other"));
  const auto json = nlohmann::json::parse(read_file(path("out/rolling.json")));
  EXPECT_TRUE(json.at("models").contains("viscous_contact"));
  EXPECT_THAT(json.at("failed_models").at("rough").get<std::string>(), HasSubstr("rises above"));
  EXPECT_FALSE(fs::exists(path("out/rough.csv")));
  EXPECT_TRUE(fs::exists(path("out/viscous_contact.csv")));
  EXPECT_THAT(read_file(path("out/report.html")), HasSubstr("failed: the sphere rises"));
}

TEST_F(MotionsCommand, RollingWritesNoNumbersBeyondADouble) {
  expect_refusal(
      run_viscontact({"rolling", incline("radius = 1.0", "radius = 1e300"), "-o", path("out")}),
      ErrorKind::kBadInput, Names("2 more", "viscous_contact"));
  EXPECT_FALSE(fs::exists(path("out/viscous_contact.csv")));
}

}  // namespace
}  // namespace viscontact
