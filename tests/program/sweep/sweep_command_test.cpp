// `viscontact sweep`: the shipped studies by one command each, the options, and refusals.
#include "tests/program/sweep/sweep_command.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>

#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/program/undisturbed.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/system/process.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/results/exit_code.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string kVanishing = data("cases/vanishing_viscosity.toml");

/// Two rows that take no time.
const std::vector<std::string> kTwoRows = {"--vary",      "fluid.viscosity=0.5,1",
                                           "--models",    "viscous_contact_exact",
                                           "--reference", "viscous_contact_exact"};

TEST_F(SweepCommand, RunsAShippedStudyAndDrawsIt) {
  const auto result = sweep(kVanishing, {"--plot", path("picture.svg")});
  expect_done(result);
  EXPECT_THAT(result.errors, Names("25 rows", path("rows.csv")));
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
  EXPECT_THAT(again.errors, IsUpToDate("rows.csv"));
  EXPECT_EQ(read_file(path("rows.csv")), rows);
  EXPECT_EQ(rest_of(path("picture.svg")), svg);
  // Blank lines that an editor left at the end are no rows, here either.
  put_text(path("rows.csv"), rows + "\n\n");
  expect_done(sweep(kVanishing, {"--plot", path("picture.svg")}));
  EXPECT_EQ(rest_of(path("picture.svg")), svg);
}

// A picture of each kind says how it was made, is made again by `rerun`, and is the only file that
// another picture replaces.
TEST_F(SweepCommand, DrawsPdfAndPngAsWell) {
  const std::vector<std::string> begins = {"%PDF-", "\x89PNG\r\n"};
  for (std::size_t i = 0; i < begins.size(); ++i) {
    const auto picture = path(i == 0 ? "picture.pdf" : "picture.png");
    auto options = kTwoRows;
    options.insert(options.end(), {"--plot", picture});
    expect_done(sweep(kVanishing, options));
    const auto first = read_file(picture);
    EXPECT_THAT(first, StartsWith(begins[i]));
    EXPECT_GT(first.size(), 2000U);
    const auto provenance = results::read_provenance(picture);
    ASSERT_TRUE(provenance.has_value());
    EXPECT_EQ(provenance->output, picture);
    // Our own picture is replaced.
    expect_done(run_viscontact({"rerun", picture}, {"SOURCE_DATE_EPOCH=1000000000"}));
    // Cairo 1.18 may compress the date, so that it is not found and keeps its value.
    if (const auto again = read_file(picture); again.find("/CreationDate (") != std::string::npos) {
      EXPECT_THAT(again, HasSubstr("/CreationDate (D:20010909014640"));
    }
    put_text(picture, begins[i] + " of someone else");
    expect_refusal(sweep(kVanishing, options), ErrorKind::kBadInput, Names(picture));
    put_text(picture, read_file(path("rows.csv")));  // ours, but no picture
    expect_refusal(sweep(kVanishing, options), ErrorKind::kBadInput, Names(picture));
  }
}

TEST_F(SweepCommand, PictureHasTheWidthAndLettersThatAreAskedFor) {
  const auto with = [](std::vector<std::string> more) {
    auto options = kTwoRows;
    options.insert(options.end(), more.begin(), more.end());
    return options;
  };
  expect_done(sweep(kVanishing, with({"--plot", path("plain.svg")})));
  EXPECT_THAT(read_file(path("plain.svg")),
              AllOf(HasSubstr("viewBox=\"0 0 860 520\""), HasSubstr("font-size=\"14.00\"")));
  const auto wide = with({"--plot", path("wide.svg"), "--width", "1720", "--font-size", "20"});
  expect_done(sweep(kVanishing, wide));
  EXPECT_THAT(read_file(path("wide.svg")),
              AllOf(HasSubstr("viewBox=\"0 0 1720 1040\""), HasSubstr("font-size=\"20.00\"")));
  const auto first = rest_of(path("wide.svg"));
  std::filesystem::remove(path("plain.svg"));
  expect_done(run_viscontact({"rerun", path("wide.svg")}));
  EXPECT_EQ(rest_of(path("wide.svg")), first);
  // The table alone, without its picture.
  std::filesystem::remove(path("wide.svg"));
  expect_done(run_viscontact({"rerun", path("rows.csv"), "-o", path("again.csv")}));
  EXPECT_TRUE(std::filesystem::exists(path("again.csv")));
  EXPECT_FALSE(std::filesystem::exists(path("wide.svg")));
  expect_refusal(sweep(kVanishing, with({"--width", "900"})), ErrorKind::kWrongUsage,
                 Names("--plot"));
  expect_refusal(sweep(kVanishing, with({"--plot", path("x.svg"), "--font-size", "nan"})),
                 ErrorKind::kWrongUsage, Names("nan"));
}

TEST_F(SweepCommand, LinesOverOneKeyOfAGridAreOneForEachValueOfTheOther) {
  auto options = kTwoRows;
  options.insert(options.end(),
                 {"--vary", "sphere.mass=1,2,3", "--plot", path("lines.svg"), "--x",
                  "fluid.viscosity", "--column", "viscous_contact_exact.minimal_gap"});
  expect_done(sweep(kVanishing, options));
  const auto svg = read_file(path("lines.svg"));
  EXPECT_THAT(svg, AllOf(HasSubstr(">sphere.mass = 1<"), HasSubstr(">sphere.mass = 2<"),
                         HasSubstr(">sphere.mass = 3<"), HasSubstr("gnuplot_plot_3\""),
                         ::testing::Not(HasSubstr("gnuplot_plot_4\""))));
  for (auto& option : options)
    if (option == "sphere.mass=1,2,3") option = "sphere.mass=1:2:15";
  expect_refusal(sweep(kVanishing, options, "many.csv"), ErrorKind::kWrongUsage,
                 Names("15 lines", "fluid.viscosity", "14 are"));
}

TEST_F(SweepCommand, ScriptOfAPictureDrawsIt) {
  auto options = kTwoRows;
  options.insert(options.end(), {"--plot", path("picture.gp")});
  expect_done(sweep(kVanishing, options));
  const auto script = read_file(path("picture.gp"));
  EXPECT_THAT(script, AllOf(HasSubstr("# provenance"), HasSubstr("END_OF_CURVE")));
  options.back() = path("picture.svg");
  expect_done(sweep(kVanishing, options));
  const auto drawn = run_process({"gnuplot", path("picture.gp")}, {"LC_ALL=C"});
  EXPECT_EQ(drawn.exit_status, 0) << drawn.output;
  EXPECT_THAT(rest_of(path("picture.svg")),
              HasSubstr(drawn.output.substr(drawn.output.find("<svg"), 2000)));
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
  EXPECT_THAT(film.errors, IsUpToDate(""));
  EXPECT_NE(read_file(path("film.svg")), read_file(path("gap.svg")));
}

TEST_F(SweepCommand, CommandLineOverridesTheCase) {
  expect_done(sweep(kVanishing,
                    {"--vary", "sphere.mass=1,2", "--vary", "fluid.viscosity=0.5,1,2", "--models",
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
    EXPECT_EQ(result.exit_status, results::exit_code_of(ErrorKind::kNotConverged));
    EXPECT_THAT(result.errors,
                AllOf(Names(said, "2 points", "rows.csv", "stokes_limit"),
                      Not(HasSubstr("--stokes-limit")), Not(HasSubstr("--lubrication-limit"))));
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
  EXPECT_THAT(result.errors, Names("4 rows", "1 point", "'failure'"));
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
  expect_refused(fitless, kTwoRows, ErrorKind::kWrongUsage, Names("--fit"));
  expect_done(sweep(fitless, arguments));
  EXPECT_EQ(lines(), lines("own.csv"));
}

TEST_F(SweepCommand, WrongUsageIsRefusedBeforeAnyWork) {
  const auto wrong = [&](const std::vector<std::string>& options, const std::string& words) {
    expect_refused(kVanishing, options, ErrorKind::kWrongUsage, Names(words));
  };
  expect_refused(data("cases/limit.toml"), {"--fit", data("fits/leading_term.json")},
                 ErrorKind::kWrongUsage, Names("--vary"));
  wrong({"--vary", "fluid.viscosity=0:1:log:3"}, "0");
  wrong({"--vary", "fluid.viscosity=1:2:many"}, "'many'");
  wrong({"--vary", "fluid.viscosity"}, "KEY=");
  wrong({"--models", "inertia", "--reference", "inertia"}, "'inertia'");
  wrong({"--vary", "sphere.mass=1,2", "--vary", "sphere.mass=1"}, "sphere.mass");
  wrong({"--reference", "viscous_contact"}, "'viscous_contact'");
  wrong({"--models", "inertial,inertial", "--reference", "inertial"}, "inertial");
  wrong({"--plot", path("picture.svg"), "--column", "inertial.gap"}, "viscous_contact_exact");
  wrong({"--plot", path("picture.svg"), "--column", "inertial.film_ratio/sphere.mass"},
        "'sphere.mass'");
  wrong({"--plot", path("picture.svg"), "--x", "sphere.mass"}, "'sphere.mass'");
  wrong({"--plot", path("rows.csv")}, path("rows.csv"));
  wrong({"--samples", "0"}, "--samples");
  for (const std::string number : {"2.5", "1e3", "-1"})
    for (const std::string option : {"--samples", "--seed", "--draws"})
      wrong({option + "=" + number}, option + ": is " + number);
  // 2^64, one more than the largest seed.
  wrong({"--seed=18446744073709551616"}, "18446744073709551615");
  wrong({"--vary", "fluid.viscosity=1:2:1"}, "2");
  wrong({"--vary", "tabulation.gaps=1,2"}, "tabulation.gaps");
  wrong({"--jobs", "0"}, "--jobs");
}

TEST_F(SweepCommand, LargestSeedIsTaken) {
  auto options = kTwoRows;
  options.insert(options.end(), {"--samples", "1", "--seed", "18446744073709551615"});
  expect_done(sweep(kVanishing, options));
  EXPECT_EQ(lines().size(), 2U);
}

TEST_F(SweepCommand, BadInputIsRefusedBeforeAnyWork) {
  const auto bad = [&](const std::vector<std::string>& options, const std::string& words) {
    expect_refused(kVanishing, options, ErrorKind::kBadInput,
                   Names("vanishing_viscosity.toml", words));
    expect_refused(kVanishing, options, ErrorKind::kBadInput, Names("--vary"));
  };
  bad({"--vary", "fluid.viscosty=1,2"}, "fluid.viscosty");
  bad({"--vary", "title=1,2"}, "title");
  bad({"--vary", "fluid.viscosity=1,-2"}, "fluid.viscosity");
  bad({"--vary", "sphere.radius=-1,2"}, "sphere.radius");
  bad({"--vary", "sphere.density=1,2"}, "sphere.mass");
  expect_refused(path("no_such.toml"), {}, ErrorKind::kBadInput, Names("no_such.toml"));
  expect_refused(study("vanishing_viscosity.toml", "../fits/leading_term.json", ""), kTwoRows,
                 ErrorKind::kBadInput, Names("fit.file"));
}

TEST_F(SweepCommand, KeyThatChangesNoRowIsRefused) {
  const auto refused = [&](const std::string& key, const std::string& models,
                           const std::string& words) {
    expect_refused(kVanishing,
                   {"--vary", key + "=1e-3,1e-2", "--models", models, "--reference",
                    models.substr(0, models.find(','))},
                   ErrorKind::kWrongUsage,
                   AllOf(Names("--vary", key, words), Not(HasSubstr("at the point"))));
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
  refused("motion.rows", "inertial", "changes only files of trajectories");
  // With a model that does depend on the key the others are run beside it.
  expect_done(sweep(kVanishing,
                    {"--vary", "viscous_contact.roughness[0]=1e-3,1e-2", "--models",
                     "viscous_contact_smooth,viscous_contact", "--reference", "viscous_contact"}));
}

TEST_F(SweepCommand, SamplesOfACaseAreAWholeNumber) {
  for (const std::string samples : {"2.5", "0.5", "1e30"})
    expect_refused(
        study("vanishing_viscosity.toml", "[sweep]\n", "[sweep]\nsamples = " + samples + "\n"), {},
        ErrorKind::kBadInput, Names("case.toml", "sweep.samples"));
}

TEST_F(SweepCommand, RangeOfTheCaseThatIsNoneIsTheCasesFault) {
  // In the file it is bad input at a line, as any other value there.
  for (const std::string range : {"0:1:log:25", "1,-2", "1:2:1"}) {
    const auto file = study("vanishing_viscosity.toml", "0.006:1:log:25", range);
    expect_refused(file, {}, ErrorKind::kBadInput,
                   ContainsRegex("case.toml:[0-9]+: sweep.vary: .*fluid.viscosity"));
  }
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

TEST_F(SweepCommand, ReadsNoPipe) {
  // A case in a pipe could be read only once.
  expect_refusal(sweep("/dev/stdin", {}, "rows.csv", "cat '" + kVanishing + "' |"),
                 ErrorKind::kBadInput, Names("/dev/stdin"));
  // An output that is a pipe would wait for itself.
  ASSERT_EQ(::mkfifo(path("pipe.csv").c_str(), 0600), 0);
  expect_refusal(sweep(kVanishing, kTwoRows, "pipe.csv"), ErrorKind::kBadInput, Names("pipe.csv"));
}

TEST_F(SweepCommand, DoesNotReplaceAFileThatIsNoSweep) {
  put_text(path("rows.csv"), "time,gap\n1,2\n");
  expect_refused(kVanishing, kTwoRows, ErrorKind::kBadInput, Names("rows.csv"));
  std::filesystem::remove(path("rows.csv"));
  put_text(path("picture.svg"), "mine");
  auto arguments = kTwoRows;
  arguments.insert(arguments.end(), {"--plot", path("picture.svg"), "--column",
                                     "viscous_contact_exact.film_from_gamma"});
  expect_refused(kVanishing, arguments, ErrorKind::kBadInput, Names("picture.svg"));
  // A sweep it may replace, by another one.
  std::filesystem::remove(path("picture.svg"));
  put_text(path("rows.csv"), "# provenance: {\"command\":[]}\n# viscontact: sweep\nother\n");
  expect_done(sweep(kVanishing, arguments));
  EXPECT_EQ(lines().size(), 3U);
  EXPECT_THAT(lines().front(), HasSubstr(",viscous_contact_exact.film_from_gamma,"));
  EXPECT_THAT(rest_of(path("picture.svg")), HasSubstr("viscous_contact_exact.film_from_gamma"));
}

}  // namespace
}  // namespace viscontact
