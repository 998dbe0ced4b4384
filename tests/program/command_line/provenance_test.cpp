// Every kind of output says how it was made.
#include "tests/program/command_line/provenance.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/program/undisturbed.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

TEST_F(Provenance, NamesCommandFolderInputsVersionsAndTime) {
  fit();
  const auto json = provenance_of(path("fit.json"));
  EXPECT_EQ(json.at("command"),
            Json({VISCONTACT_EXECUTABLE, "fit", path("table.csv"), "-o", path("fit.json")}));
  EXPECT_EQ(json.at("folder"), fs::current_path().string());
  EXPECT_EQ(json.at("made"), "2001-09-09T01:46:40Z");
  for (const auto* program : {"Viscontact", "Ceres", "Eigen", "SUNDIALS"})
    EXPECT_TRUE(json.at("versions").contains(program)) << program;
  EXPECT_THAT(inputs_of(path("fit.json")), ElementsAre(path("table.csv")));
}

TEST_F(Provenance, StandsInEveryOutputOfASimulation) {
  fit();
  expect_done(run({"simulate", path("case.toml"), "--fit", path("fit.json"), "-o", path("run")}));
  expect_done(run({"compare", path("run")}));
  expect_done(run({"report", path("run")}));
  for (const auto& entry : fs::recursive_directory_iterator(path("run"))) {
    if (!entry.is_regular_file() || entry.path().filename() == "case.toml") continue;
    const auto json = provenance_of(entry.path());
    EXPECT_FALSE(json.at("inputs").empty()) << entry.path();
    if (entry.path().parent_path().filename() == "trajectories") {
      EXPECT_THAT(inputs_of(entry.path()), ElementsAre(path("case.toml"), path("fit.json")));
    }
  }
  EXPECT_THAT(inputs_of(path("run/comparison.json")).size(), 6U);           // the default models
  EXPECT_EQ(read_file(path("run/fit.json")), read_file(path("fit.json")));  // a copy
}

TEST_F(Provenance, OfARunTellsTheUsersFilesFromItsOwn) {
  const freefem_axi::FakeFreeFem fake(scratch_.path());
  put_text(path("case.toml"), gentle_case_text());
  expect_done(run_viscontact({"run", path("case.toml"), "-o", path("run")},
                             {"VISCONTACT_FREEFEM=" + fake.executable()}));
  EXPECT_THAT(inputs_of(path("run/table.csv")), ElementsAre(path("case.toml")));
  EXPECT_THAT(inputs_of(path("run/fit.json")), ElementsAre(path("case.toml")));
  EXPECT_THAT(inputs_of(path("run/fit.json"), true), ElementsAre(path("run/table.csv")));
  EXPECT_THAT(inputs_of(path("run/trajectories/inertial.csv"), true),
              ElementsAre(path("run/fit.json")));
  EXPECT_THAT(inputs_of(path("run/report.html")), ElementsAre(path("case.toml")));
  // Its own files may be gone: it makes them again.
  fs::remove_all(path("run/trajectories"));
  fs::remove(path("run/fit.json"));
  EXPECT_THAT(run({"rerun", path("run/report.html"), "--dry-run"}).output,
              HasSubstr("viscontact run " + path("case.toml") + " -o " + path("run")));
  EXPECT_THAT(run({"rerun", path("run/report.html"), "--dry-run"}).errors, "");
}

TEST_F(Provenance, StandsInEveryExportAndLeavesItWhole) {
  fit();
  for (const auto& [target, checker] : std::map<std::string, std::string>{
           {"c-header", "gcc -x c -fsyntax-only -Wall -Werror "},
           {"fortran",
            "gfortran -x f95 -fsyntax-only -Wall -J '" + scratch_.path().string() + "' "},
           {"python", "python3 -c 'import ast,sys; ast.parse(open(sys.argv[1]).read())' "},
           {"json", "python3 -m json.tool "},
           {"csv", "test -s "}}) {
    const auto file = path("a --b */ & <i>.txt");  // what a comment or an element must survive
    expect_done(run({"export", path("fit.json"), "--to", target, "-o", file}));
    EXPECT_EQ(provenance_of(file).at("command").back(), fs::path(file).filename().string())
        << target;
    EXPECT_EQ(std::system((checker + "'" + file + "' >/dev/null").c_str()), 0) << target;
    fs::remove(file);
  }
}

TEST_F(Provenance, OfAnExportNamesItsSourceAndNoFolderOfTheMachine) {
  fit();
  const auto folder = scratch_.path().string();
  fs::create_directory(path("include"));
  for (const std::string target : {"c-header", "fortran", "python", "json", "csv"})
    for (const bool absolute : {false, true}) {
      SCOPED_TRACE(target + (absolute ? ", absolute paths" : ""));
      const auto word = [&](const std::string& name) { return absolute ? path(name) : name; };
      expect_done(run_viscontact(
          {"export", word("fit.json"), "--to", target, "--output=" + word("include/film.txt")}, {},
          "cd '" + folder + "'; "));
      const auto text = read_file(path("include/film.txt"));
      EXPECT_THAT(text,
                  AllOf(HasSubstr("Exported from the fit in fit.json."), Not(HasSubstr(folder)),
                        Not(HasSubstr(fs::path(VISCONTACT_EXECUTABLE).parent_path().string()))));
      const auto json = provenance_of(path("include/film.txt"));
      EXPECT_EQ(json.at("command"), Json({"viscontact", "export", "fit.json", "--to", target,
                                          "--output=include/film.txt"}));
      EXPECT_EQ(json.at("folder"), "");
      EXPECT_EQ(json.at("inputs").at(0).at("file"), "fit.json");
      EXPECT_EQ(json.at("output"), "include/film.txt");
      // It can be made again all the same, where it lies.
      expect_done(run({"rerun", path("include/film.txt"), "-o", path("again.txt")}));
      EXPECT_EQ(rest_of(path("again.txt")), rest_of(path("include/film.txt")));
      fs::remove(path("include/film.txt"));
      fs::remove(path("again.txt"));
    }
}

TEST_F(Provenance, PictureStaysWellFormedXml) {
  const auto picture = path("a --b */ & <i>.svg");
  expect_done(run({"fit", path("table.csv"), "--compare-bases", "--plot", picture}));
  EXPECT_EQ(provenance_of(picture).at("command").back(), picture);
  EXPECT_EQ(std::system(("python3 -c 'import sys,xml.dom.minidom as d; d.parse(sys.argv[1])' '" +
                         picture + "'")
                            .c_str()),
            0);
}

}  // namespace
}  // namespace viscontact
