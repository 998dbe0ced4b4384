// What a newcomer types first: init, --dry-run, --json, completion, man; and colours, where a
// terminal is.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/common/regular_expressions.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/system/process.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

class FirstSteps : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }
  std::string data(const std::string& name) const {
    return std::string(VISCONTACT_SOURCE_FOLDER) + "/data/" + name;
  }
  TemporaryFolder scratch_;
};

TEST_F(FirstSteps, InitWritesACaseThatRuns) {
  const auto result = run_viscontact({"init", path("mine.toml")});
  expect_done(result);
  EXPECT_THAT(result.errors, Names(path("mine.toml")));
  const case_file::Case c = case_file::read_case(path("mine.toml"));
  EXPECT_TRUE(c.tabulation && c.fit && c.motion);
  // Its motion, with a drag that needs no FreeFEM.
  const auto text = read_file(path("mine.toml"));
  put_text(path("exact.toml"), replaced(text, "\n# exact = ", "\nexact = "));
  expect_done(run_viscontact({"run", path("exact.toml"), "-o", path("run")}));
}

TEST_F(FirstSteps, WhatInitCommentsOutIsRightToo) {
  expect_done(run_viscontact({"init", path("mine.toml")}));
  const auto text = read_file(path("mine.toml"));
  const auto keys = matches_in(text, "\n# (\\w+ = [^\n]*)", 1);
  for (const auto& key : keys) {
    put_text(path("one.toml"), replaced(text, "\n# " + key, "\n" + key));
    EXPECT_NO_THROW(case_file::read_case(path("one.toml"))) << key;
  }
  EXPECT_GT(keys.size(), 15U);  // every optional key of the sections that it has
}

TEST_F(FirstSteps, InitReplacesNothing) {
  put_text(path("mine.toml"), "precious");
  expect_refusal(run_viscontact({"init", path("mine.toml")}), ErrorKind::kBadInput,
                 Names("mine.toml"));
  EXPECT_EQ(read_file(path("mine.toml")), "precious");
  fs::create_symlink(path("nowhere"), path("link.toml"));
  expect_refusal(run_viscontact({"init", path("link.toml")}), ErrorKind::kBadInput,
                 Names("link.toml"));
  EXPECT_FALSE(fs::exists(path("nowhere")));
}

TEST_F(FirstSteps, DryRunOfATabulationCountsRowsAndComputesNone) {
  const freefem_axi::FakeFreeFem fake(scratch_.path());
  put_text(path("case.toml"), gentle_case_text());
  const std::vector<std::string> dry = {
      "tabulate", path("case.toml"), "-o", path("table.csv"), "--jobs", "2", "--dry-run"};
  const auto files = files_below(scratch_.path());
  const auto result = run_viscontact(dry, {"VISCONTACT_FREEFEM=/nowhere"});
  expect_done(result);
  EXPECT_THAT(result.output, AllOf(HasSubstr("table.csv: 6 rows, 0 of them finished"),
                                   HasSubstr("shipped tables"), HasSubstr("with 2 at once")));
  EXPECT_TRUE(files_below(scratch_.path()) == files);

  // From its own rows, when there are some.
  expect_done(run_viscontact({"tabulate", path("case.toml"), "-o", path("table.csv")},
                             {"VISCONTACT_FREEFEM=" + fake.executable()}));
  auto with_json = dry;
  with_json.emplace_back("--json");
  const auto json = Json::parse(run_viscontact(with_json).output);
  EXPECT_EQ(json.at("jobs"), 2);
  EXPECT_EQ(json.at("seconds"), 0);
  EXPECT_EQ(json.at("outputs").at(0).at("rows"), 6);
  EXPECT_EQ(json.at("outputs").at(0).at("finished"), 6);
  EXPECT_EQ(json.at("outputs").at(0).at("estimated_from"), "its finished rows");
}

TEST_F(FirstSteps, HelpSeparatesNamesFromMeanings) {
  EXPECT_THAT(run_viscontact({"--help"}).output,
              HasSubstr("  VISCONTACT_FREEFEM_TIME_LIMIT seconds after which"));
}

TEST_F(FirstSteps, DryRunOfASweepCountsRowsAndWritesNone) {
  const std::vector<std::string> dry = {"sweep",     data("cases/vanishing_viscosity.toml"),
                                        "-o",        path("rows.csv"),
                                        "--dry-run", "--json"};
  const auto json = Json::parse(run_viscontact(dry).output);
  EXPECT_EQ(json.at("outputs").at(0).at("rows"), 25);
  EXPECT_EQ(json.at("outputs").at(0).at("finished"), 0);
  EXPECT_GT(json.at("seconds"), 0);
  EXPECT_TRUE(files_below(scratch_.path()).empty());
  expect_done(
      run_viscontact({"sweep", data("cases/vanishing_viscosity.toml"), "-o", path("rows.csv")}));
  EXPECT_EQ(Json::parse(run_viscontact(dry).output).at("outputs").at(0).at("finished"), 25);
}

TEST_F(FirstSteps, TablesArePrintedAsJson) {
  expect_done(
      run_viscontact({"simulate", data("cases/lecture.toml"), "--fit", data("fits/lecture.json"),
                      "-o", path("run"), "--models", "inertial,viscous_contact"}));
  const auto compared = run_viscontact({"compare", path("run"), "--json"});
  auto file = Json::parse(read_file(path("run/comparison.json")));
  file.erase("provenance");
  EXPECT_EQ(Json::parse(compared.output), file);

  const auto bases =
      Json::parse(run_viscontact({"fit", data("tables/lecture.csv"), "--compare-bases", "--plot",
                                  path("bases.svg"), "--json"})
                      .output);
  // The table of the lecture has a lid opposite the plane.
  const auto& known = lubrication::bases_beside_walls();
  ASSERT_EQ(bases.size(), known.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    EXPECT_EQ(bases[i].at("basis").get<std::string>(), known[i].name);
    EXPECT_GT(bases[i].at("largest_relative_residual"), 0);
  }

  const auto doctor = Json::parse(run_viscontact({"doctor", "--json"}).output);
  for (const auto& finding : doctor) EXPECT_TRUE(finding.at("ok")) << finding;
  EXPECT_THAT(doctor.dump(), HasSubstr("FreeFEM solves gap 0.1"));
}

TEST_F(FirstSteps, BashCompletesCommandsOptionsWordsAndFiles) {
  put_text(path("completion"), run_viscontact({"completion", "bash"}).output);
  put_text(path("some case.toml"), "");
  const auto complete = [&](const std::string& words) {
    return run_process({"bash", "-c",
                        "source completion; compopt() { :; }; COMP_WORDS=(" + words +
                            "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _viscontact; "
                            "printf '%s;' \"${COMPREPLY[@]}\""},
                       {}, "", scratch_.path().string())
        .output;
  };
  EXPECT_EQ(complete("viscontact sw"), "sweep;swimmer;");
  EXPECT_EQ(complete("viscontact fit --ba"), "--basis;");
  EXPECT_EQ(complete("viscontact fit --basis asymptotic_"), "asymptotic_extended;");
  EXPECT_EQ(complete("viscontact export fit.json --to f"), "fortran;");
  EXPECT_EQ(complete("viscontact simulate x --models inertial,viscous_contact_t"),
            "inertial,viscous_contact_threshold;");
  EXPECT_EQ(complete("viscontact run some"), "some case.toml;");
  EXPECT_EQ(complete("viscontact run x -o som"), ";");  // a folder is asked for
}

TEST_F(FirstSteps, ZshCompletionNamesAllCommands) {
  const auto text = run_viscontact({"completion", "zsh"}).output;
  EXPECT_THAT(text, AllOf(HasSubstr("#compdef viscontact"), HasSubstr("'run:"),
                          HasSubstr("'--basis["), HasSubstr("'rerun:")));
}

TEST_F(FirstSteps, ManualHasEveryCommandAndOptionOfHelp) {
  const auto manual = run_viscontact({"man"}).output;
  const auto help = run_viscontact({"--help"}).output;
  const auto from = help.find("Subcommands:");
  const auto until = help.find("Exit codes:");
  const auto commands = matches_in(help.substr(from, until - from), "\n  (\\w+)  +[^\n]*", 1);
  for (const auto& name : commands) {
    const auto begin = manual.find("\n.SS " + name);
    ASSERT_NE(begin, std::string::npos) << name;
    // Its own part of the page only.
    const auto part = manual.substr(
        begin,
        std::min(manual.find("\n.SS ", begin + 1), manual.find("\n.SH ", begin + 1)) - begin);
    const auto own_help = run_viscontact({name, "--help"});
    expect_done(own_help);
    EXPECT_EQ(own_help.errors, "");
    EXPECT_THAT(own_help.output, HasSubstr("Usage: viscontact " + name));
    for (const auto& option : matches_in(own_help.output, "--[\\w-]+", 0))
      EXPECT_THAT(part, HasSubstr(replaced_matches(option, "-", "\\-"))) << name;
  }
  EXPECT_EQ(commands.size(), 17U);
  EXPECT_THAT(manual, AllOf(HasSubstr(".SH EXIT STATUS"), HasSubstr("NO_COLOR")));
}

/// What a terminal would be sent.
std::string on_terminal(const std::string& environment, const std::string& arguments) {
  return run_process({"script", "-qec",
                      "env " + environment + " " VISCONTACT_EXECUTABLE " " + arguments,
                      "/dev/null"})
      .output;
}

TEST_F(FirstSteps, ColoursAreForTerminalsAndNotIfRefused) {
  const std::string wrong = "fit /nowhere.csv -o /tmp/nowhere.json";
  const std::string red = "\033[31mviscontact:\033[0m";
  EXPECT_THAT(on_terminal("-u NO_COLOR TERM=xterm", wrong), HasSubstr(red));
  EXPECT_THAT(on_terminal("TERM=xterm NO_COLOR=", wrong), HasSubstr(red));  // empty: not set
  EXPECT_THAT(on_terminal("TERM=xterm NO_COLOR=1", wrong),
              AllOf(HasSubstr("viscontact: /nowhere.csv"), Not(HasSubstr("\033[31m"))));
  EXPECT_THAT(on_terminal("-u NO_COLOR TERM=dumb", wrong), Not(HasSubstr("\033")));
  EXPECT_THAT(run_viscontact({"fit", "/nowhere.csv", "-o", path("fit.json")}).errors,
              Not(HasSubstr("\033")));
}

}  // namespace
}  // namespace viscontact
