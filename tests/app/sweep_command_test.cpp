// viscontact sweep: the shipped studies by their one command, the options, refusals, and interrupted runs that go on.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <sstream>

#include "tests/app/program.hpp"
#include "tests/app/sample_files.hpp"
#include "tests/app/undisturbed.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/csv.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::string data(const std::string& name) {
  return std::string(VISCONTACT_SOURCE_FOLDER) + "/data/" + name;
}

const std::string kVanishing = data("cases/vanishing_viscosity.toml");

/// Two rows that take no time.
const std::vector<std::string> kTwoRows = {"--vary",      "fluid.viscosity=0.5,1",
                                           "--models",    "viscous_contact_exact",
                                           "--reference", "viscous_contact_exact"};

class SweepCommand : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

  ProgramResult sweep(const std::string& case_file, const std::vector<std::string>& options,
                      const std::string& output = "rows.csv",
                      const std::string& shell_before = "") const {
    std::vector<std::string> arguments = {"sweep", case_file, "-o", path(output), "--jobs", "2"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_viscontact(arguments, {}, shell_before);
  }

  /// The header line and the rows.
  std::vector<std::string> lines(const std::string& output = "rows.csv") const {
    std::vector<std::string> found;
    std::istringstream text(read_file(path(output)));
    for (std::string line; std::getline(text, line);)
      if (!line.starts_with('#')) found.push_back(line);
    return found;
  }

  /// Expects the refusal, and that nothing is written.
  void expect_refused(const std::string& case_file, const std::vector<std::string>& options,
                      ErrorKind kind, const ::testing::Matcher<std::string>& message) const {
    const auto before = files_below(scratch_.path());
    expect_refusal(sweep(case_file, options), kind, message);
    EXPECT_TRUE(files_below(scratch_.path()) == before) << "something was written";
  }

  /// A shipped study, with its fit's path made absolute.
  std::string study(const std::string& name, const std::string& from, const std::string& to) const {
    auto text = replaced(read_file(data("cases/" + name)), from, to);
    if (text.find("\"../fits/") != std::string::npos)
      text = replaced(text, "\"../fits/", "\"" + data("fits/"));
    put_text(path("case.toml"), text);
    return path("case.toml");
  }

  TemporaryFolder scratch_;
};

TEST_F(SweepCommand, RunsAShippedStudyAndDrawsIt) {
  const auto result = sweep(kVanishing, {"--plot", path("picture.svg")});
  expect_done(result);
  EXPECT_THAT(result.errors, HasSubstr("sweep: 25 rows in " + path("rows.csv")));
  EXPECT_EQ(result.output, "");
  const auto csv = read_csv<1>(path("rows.csv"), {"inertial.sup_gap_distance"}, 1);
  EXPECT_EQ(csv.rows.size(), 25U);
  for (const auto& row : csv.rows) EXPECT_TRUE(row.fields[0]) << row.line;
  const auto svg = rest_of(path("picture.svg"));
  EXPECT_THAT(svg, AllOf(HasSubstr("<svg"), HasSubstr("</svg>"), HasSubstr("fluid.viscosity"),
                         Not(HasSubstr("nan")), Not(HasSubstr("warning"))));

  const auto rows = read_file(path("rows.csv"));
  const auto again = sweep(kVanishing, {"--plot", path("picture.svg")});
  expect_done(again);
  EXPECT_THAT(again.errors, HasSubstr("rows.csv is up to date"));
  EXPECT_EQ(read_file(path("rows.csv")), rows);
  EXPECT_EQ(rest_of(path("picture.svg")), svg);
  // Blank lines that an editor left at the end are no rows, here either.
  put_text(path("rows.csv"), rows + "\n\n");
  expect_done(sweep(kVanishing, {"--plot", path("picture.svg")}));
  EXPECT_EQ(rest_of(path("picture.svg")), svg);
}

TEST_F(SweepCommand, DrawsAMapOfTwoKeys) {
  const auto few = study("regime_map.toml", "1e3:log:33\", \"motion.time_scale=0.3:30:log:33",
                         "1e3:log:4\", \"motion.time_scale=0.3:30:log:3");
  expect_done(sweep(few, {"--plot", path("gap.svg")}));
  EXPECT_EQ(lines().size(), 13U);
  EXPECT_THAT(read_file(path("gap.svg")),
              AllOf(HasSubstr("log10 sphere.mass"), HasSubstr("data:image/png")));
  // The other picture of the same rows.
  const auto film =
      sweep(few, {"--plot", path("film.svg"), "--column", "viscous_contact.film_ratio"});
  expect_done(film);
  EXPECT_THAT(film.errors, HasSubstr("up to date"));
  EXPECT_NE(read_file(path("film.svg")), read_file(path("gap.svg")));
}

TEST_F(SweepCommand, CommandLineOverridesTheCase) {
  expect_done(sweep(kVanishing,
                    {"--vary", "motion.mass=1,2", "--vary", "fluid.viscosity=0.5,1,2", "--models",
                     "viscous_contact,viscous_contact_exact", "--reference", "viscous_contact"}));
  const auto found = lines();
  ASSERT_EQ(found.size(), 7U);
  EXPECT_THAT(found[0], StartsWith("sphere.mass,fluid.viscosity,viscous_contact.minimal_gap,"));
  EXPECT_THAT(found[0], Not(HasSubstr("inertial")));
  EXPECT_THAT(found[1], StartsWith("1,0.5,"));
  EXPECT_THAT(found[2], StartsWith("1,1,"));
  EXPECT_THAT(found[4], StartsWith("2,0.5,"));
  EXPECT_THAT(read_file(path("rows.csv")), HasSubstr("# reference: viscous_contact\n"));
}

TEST_F(SweepCommand, InWhichEveryPointFailedEndsWithAnErrorThatSaysWhy) {
  put_text(path("short.json"),
           replaced(read_file(data("fits/leading_term.json")), "\"gap_interval\": [1e-307, 1e+300]",
                    "\"gap_interval\": [1e-3, 0.5]"));
  const std::vector<std::string> options = {"--vary",   "fluid.viscosity=0.5,1", "--models",
                                            "inertial", "--reference",           "inertial",
                                            "--fit",    path("short.json")};
  // The same again when the file is up to date.
  for (const std::string said : {"2 rows in", "is up to date"}) {
    const auto result = sweep(kVanishing, options);
    EXPECT_EQ(result.exit_status, exit_code_of(ErrorKind::kNotConverged));
    EXPECT_THAT(result.errors,
                AllOf(HasSubstr(said), HasSubstr("every model failed at 2 points"),
                      HasSubstr("rows.csv: every model failed at every point"),
                      HasSubstr("gap 1 is outside the fitted interval"),
                      HasSubstr("above = \"stokes_limit\""), Not(HasSubstr("--stokes-limit")),
                      Not(HasSubstr("--lubrication-limit"))));
  }
  EXPECT_EQ(lines().size(), 3U);  // the rows are there, each with its reason
}

TEST_F(SweepCommand, SaysAtHowManyPointsModelsFailed) {
  // exp(-4/mu) is the thinnest film: at mu = 1 it is 0.018, at mu = 0.5 3.4e-4.
  put_text(path("short.json"),
           replaced(read_file(data("fits/leading_term.json")), "\"gap_interval\": [1e-307, 1e+300]",
                    "\"gap_interval\": [1e-3, 100]"));
  const auto result = sweep(kVanishing, {"--vary", "fluid.viscosity=1,-1,0.5,1", "--models",
                                         "inertial,viscous_contact_exact", "--reference",
                                         "inertial", "--fit", path("short.json")});
  expect_done(result);
  EXPECT_THAT(result.errors,
              AllOf(HasSubstr("4 rows in"), HasSubstr("every model failed at 1 point;"),
                    HasSubstr("some models failed at 1 point ("), HasSubstr("'failure'")));
  EXPECT_THAT(sweep(kVanishing, kTwoRows, "good.csv").errors, Not(HasSubstr("failed")));
}

TEST_F(SweepCommand, TakesRandomSamplesOfASeed) {
  const auto with_seed = [&](const std::string& seed, const std::string& output) {
    expect_done(sweep(kVanishing,
                      {"--vary", "fluid.viscosity=0.1:1:log:2", "--samples", "5", "--seed", seed},
                      output));
    return lines(output);
  };
  const auto one = with_seed("1", "one.csv");
  EXPECT_EQ(one.size(), 6U);
  EXPECT_EQ(with_seed("1", "again.csv"), one);
  const auto other = with_seed("2", "other.csv");
  for (std::size_t i = 1; i < one.size(); ++i) EXPECT_NE(other.at(i), one[i]);
}

TEST_F(SweepCommand, TakesAFitFromTheCommandLine) {
  auto arguments = kTwoRows;
  arguments.insert(arguments.end(), {"--fit", data("fits/leading_term.json")});
  expect_done(sweep(kVanishing, kTwoRows, "own.csv"));
  const auto fitless =
      study("vanishing_viscosity.toml", "[fit]\nfile = \"../fits/leading_term.json\"", "");
  expect_refused(fitless, kTwoRows, ErrorKind::kWrongUsage, HasSubstr("give a fit with --fit"));
  expect_done(sweep(fitless, arguments));
  EXPECT_EQ(lines(), lines("own.csv"));
}

TEST_F(SweepCommand, WrongUsageIsRefusedBeforeAnyWork) {
  const auto wrong = [&](const std::vector<std::string>& options, const std::string& words) {
    expect_refused(kVanishing, options, ErrorKind::kWrongUsage, HasSubstr(words));
  };
  expect_refused(data("cases/limit.toml"), {"--fit", data("fits/leading_term.json")},
                 ErrorKind::kWrongUsage, HasSubstr("give --vary"));
  wrong({"--vary", "fluid.viscosity=0:1:log:3"}, "must not reach 0");
  wrong({"--vary", "fluid.viscosity=1:2:many"}, "'many' is not a finite number");
  wrong({"--vary", "fluid.viscosity"}, "KEY= is missing");
  wrong({"--models", "inertia", "--reference", "inertia"}, "--models: no model is named 'inertia'");
  wrong({"--vary", "motion.mass=1,2", "--vary", "sphere.mass=1"}, "key sphere.mass is given twice");
  wrong({"--reference", "viscous_contact"}, "'viscous_contact' is not one of the models");
  wrong({"--models", "inertial,inertial", "--reference", "inertial"}, "inertial is given twice");
  wrong(
      {"--plot", path("picture.svg"), "--column", "inertial.gap"},
      "no column 'inertial.gap' to plot; the columns are: fluid.viscosity, viscous_contact_exact");
  wrong({"--plot", path("picture.svg"), "--column", "inertial.film_ratio/sphere.mass"},
        "no column 'sphere.mass'");
  wrong({"--plot", path("picture.svg"), "--x", "sphere.mass"}, "'sphere.mass' cannot be an axis");
  wrong({"--plot", path("rows.csv")}, "would be written twice");
  wrong({"--samples", "0"}, "--samples");
  wrong({"--samples", "2.5"}, "--samples");
  wrong({"--jobs", "0"}, "--jobs");
}

TEST_F(SweepCommand, BadInputIsRefusedBeforeAnyWork) {
  const auto bad = [&](const std::vector<std::string>& options, const std::string& words) {
    expect_refused(kVanishing, options, ErrorKind::kBadInput,
                   AllOf(HasSubstr("vanishing_viscosity.toml"), HasSubstr(words)));
  };
  bad({"--vary", "fluid.viscosty=1,2"}, "fluid.viscosty is not a key that is known here");
  bad({"--vary", "title=1,2"}, "title is not a number");
  bad({"--vary", "fluid.viscosity=1,-2"}, "fluid.viscosity is -2; it must be a number > 0");
  bad({"--vary", "sphere.radius=1,2"}, "the fit's radius is 0.23032943298089034");
  expect_refused(path("no_such.toml"), {}, ErrorKind::kBadInput, HasSubstr("no_such.toml"));
}

TEST_F(SweepCommand, KeyThatChangesNoRowIsRefused) {
  const auto refused = [&](const std::string& key, const std::string& models,
                           const std::string& words) {
    expect_refused(kVanishing,
                   {"--vary", key + "=1e-3,1e-2", "--models", models, "--reference",
                    models.substr(0, models.find(','))},
                   ErrorKind::kWrongUsage,
                   AllOf(HasSubstr(key + " cannot be varied"), HasSubstr(words)));
  };
  for (const std::string key :
       {"tabulation.relative_accuracy", "fit.fix", "published.minimal_gap", "sweep.samples"})
    refused(key, "inertial", "tabulates and fits nothing");
  const std::string none = "none of the models that are run depends on it (";
  refused("viscous_contact.threshold_gap", "inertial,viscous_contact",
          none + "inertial, viscous_contact)");
  refused("viscous_contact.roughness[1]", "inertial,viscous_contact_smooth", none);
  refused("viscous_contact.time_step", "inertial", none);
  refused("inertial.relative_tolerance", "viscous_contact", none);
  refused("reference.time_step", "viscous_contact", none);
  refused("fluid.viscosity", "inelastic_contact", none);
  refused("sphere.mass", "reference_exact", none);
  refused("motion.initial_velocity", "reference_exact", none);
  // With a model that does depend on the key the others are run beside it.
  expect_done(sweep(kVanishing,
                    {"--vary", "viscous_contact.roughness[0]=1e-3,1e-2", "--models",
                     "viscous_contact_smooth,viscous_contact", "--reference", "viscous_contact"}));
}

TEST_F(SweepCommand, SamplesOfACaseAreAWholeNumber) {
  for (const std::string samples : {"2.5", "0.5", "1e30"})
    expect_refused(
        study("vanishing_viscosity.toml", "[sweep]\n", "[sweep]\nsamples = " + samples + "\n"), {},
        ErrorKind::kBadInput, AllOf(HasSubstr("case.toml:"), HasSubstr("sweep.samples")));
}

TEST_F(SweepCommand, RangeOfTheCaseThatIsNoneIsTheCasesFault) {
  // In the file it is bad input at a line, as any other value there.
  expect_refused(study("vanishing_viscosity.toml", "0.006:1:log:25", "0:1:log:25"), {},
                 ErrorKind::kBadInput, AllOf(HasSubstr("case.toml:"), HasSubstr("sweep.vary")));
}

TEST_F(SweepCommand, AxisOfTheCommandLineIsTheOneThatIsDrawn) {
  auto arguments = kTwoRows;
  arguments.insert(arguments.end(),
                   {"--vary", "motion.initial_gap=1,2", "--vary", "sphere.mass=1,2,3", "--plot",
                    path("picture.svg"), "--y", "sphere.mass", "--column",
                    "viscous_contact_exact.contact_from"});
  expect_done(sweep(kVanishing, arguments));
  EXPECT_THAT(rest_of(path("picture.svg")),
              AllOf(HasSubstr("fluid.viscosity"), HasSubstr("sphere.mass"),
                    Not(HasSubstr("motion.initial"))));
}

TEST_F(SweepCommand, DoesNotReplaceAFileThatIsNoSweep) {
  put_text(path("rows.csv"), "time,gap\n1,2\n");
  expect_refused(kVanishing, kTwoRows, ErrorKind::kBadInput,
                 AllOf(HasSubstr("rows.csv"), HasSubstr("is no sweep")));
  std::filesystem::remove(path("rows.csv"));
  put_text(path("picture.svg"), "mine");
  auto arguments = kTwoRows;
  arguments.insert(arguments.end(),
                   {"--plot", path("picture.svg"), "--column", "viscous_contact_exact.film"});
  expect_refused(kVanishing, arguments, ErrorKind::kBadInput,
                 AllOf(HasSubstr("picture.svg"), HasSubstr("is no picture")));
  // A sweep it may replace, by another one.
  std::filesystem::remove(path("picture.svg"));
  put_text(path("rows.csv"), "# provenance: {\"command\":[]}\n# viscontact: sweep\nother\n");
  expect_done(sweep(kVanishing, arguments));
  EXPECT_EQ(lines().size(), 3U);
}

/// Runs that a signal ends.
class InterruptedSweep : public SweepCommand {
 protected:
  /// So many that a signal comes in time: on a machine with other work, the shell that sends it may
  /// look at the file only some tenths of a second after the rows it waits for were written.
  static constexpr int kRows = 10000;

  /// Some seconds of work.
  ProgramResult run(const std::string& output, const std::string& shell_before = "") const {
    return sweep(data("cases/time_step.toml"),
                 {"--vary", fmt::format("viscous_contact.time_step=1e-2:2e-2:{}", kRows)}, output,
                 shell_before);
  }

  /// Shell text that sends the signal to the program that the shell becomes, as soon as so many lines are in a file.
  static std::string signal_at(const std::string& file, int lines, const std::string& signal) {
    return fmt::format(
        "(while kill -0 $$ && ! [ \"$(wc -l < \"{}\")\" -ge {} ]; do sleep 0.005; done; kill -{} "
        "$$) >/dev/null 2>&1 & ",
        file, lines, signal);
  }

  /// Whole rows that an ended run has left.
  std::ptrdiff_t kept(const std::string& output) const {
    const auto part = read_file(path(output + ".part"));
    EXPECT_THAT(part, StartsWith("# provenance: "));
    // The last line is torn, or empty.
    std::ptrdiff_t whole = 0;
    std::istringstream text(part.substr(0, part.rfind('\n') + 1));
    for (std::string line; std::getline(text, line);) whole += line.starts_with('#') ? 0 : 1;
    return whole - 1;  // the columns' names
  }
};

TEST_F(InterruptedSweep, KilledAgainAndAgainItEndsWithTheFileOfAnUndisturbedOne) {
  expect_done(run("undisturbed.csv"));
  std::ptrdiff_t before = 0;
  for (const int at : {200, 700, 1200}) {
    const auto killed = run("rows.csv", signal_at(path("rows.csv.part"), at, "KILL"));
    ASSERT_EQ(killed.exit_status, 128 + SIGKILL) << killed.errors;
    EXPECT_FALSE(std::filesystem::exists(path("rows.csv")));
    EXPECT_GT(kept("rows.csv"), before);
    before = kept("rows.csv");
  }
  ASSERT_LT(before, kRows);
  const auto last = run("rows.csv");
  expect_done(last);
  EXPECT_THAT(last.errors, HasSubstr(fmt::format("{} of them from before", before)));
  EXPECT_EQ(rest_of(path("rows.csv")), rest_of(path("undisturbed.csv")));
  EXPECT_FALSE(std::filesystem::exists(path("rows.csv.part")));
}

TEST_F(InterruptedSweep, KeepsAllFinishedRowsOnCtrlC) {
  expect_done(run("undisturbed.csv"));
  for (const std::string signal : {"INT", "TERM"}) {
    const auto interrupted = run("rows.csv", signal_at(path("rows.csv.part"), 300, signal));
    const auto rows = kept("rows.csv");
    expect_refusal(
        interrupted, ErrorKind::kInterrupted,
        AllOf(HasSubstr(fmt::format("interrupted; {} of {} rows are kept in", rows, kRows)),
              HasSubstr("rows.csv.part")));
    EXPECT_FALSE(std::filesystem::exists(path("rows.csv")));
    EXPECT_GT(rows, 200);  // of 300 lines, with the header
    const auto last = run("rows.csv");
    expect_done(last);
    EXPECT_THAT(last.errors, HasSubstr(fmt::format("{} of them from before", rows)));
    EXPECT_EQ(rest_of(path("rows.csv")), rest_of(path("undisturbed.csv")));
    std::filesystem::remove(path("rows.csv"));
  }
}

}  // namespace
}  // namespace viscontact
