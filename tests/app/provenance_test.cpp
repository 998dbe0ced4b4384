// How a file was made stands in it, whatever its kind, and `viscontact rerun` repeats it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "tests/app/program.hpp"
#include "tests/app/sample_files.hpp"
#include "tests/app/undisturbed.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

/// As another program would read it, in whatever comment it stands.
Json provenance_of(const fs::path& file) {
  std::istringstream text(read_file(file));
  for (std::string line; std::getline(text, line);)
    if (line.find("provenance") != std::string::npos) {
      const auto begin = line.find("{\"command\":[");
      const auto end = line.rfind('}');
      if (begin != std::string::npos) return Json::parse(line.substr(begin, end + 1 - begin));
    }
  ADD_FAILURE() << file << " does not say how it was made";
  return {};
}

std::vector<std::string> inputs_of(const fs::path& file, bool intermediate = false) {
  std::vector<std::string> names;
  const Json provenance = provenance_of(file);
  for (const auto& input : provenance.at("inputs")) {
    if (input.value("intermediate", false) != intermediate) continue;
    names.push_back(input.at("file"));
    EXPECT_EQ(input.at("sha256"), sha256(read_file(input.at("file").get<std::string>()))) << file;
  }
  return names;
}

class Provenance : public ::testing::Test {
 protected:
  Provenance() {
    put_text(path("case.toml"), lecture_case_text());
    put_text(path("table.csv"), exact_table_text());
  }
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }
  ProgramResult run(const std::vector<std::string>& arguments) const {
    return run_viscontact(arguments, {"SOURCE_DATE_EPOCH=1000000000"});
  }
  void fit() const { expect_done(run({"fit", path("table.csv"), "-o", path("fit.json")})); }

  TemporaryFolder scratch_;
};

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
  const FakeFreeFem fake(scratch_.path());
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

class Rerun : public Provenance {};

TEST_F(Rerun, RepeatsWhatMadeAFileInAnotherPlace) {
  fit();
  const auto again = run({"rerun", path("fit.json"), "-o", path("again.json")});
  expect_done(again);
  EXPECT_THAT(again.errors, HasSubstr("rerun: cd "));
  EXPECT_EQ(rest_of(path("again.json")), rest_of(path("fit.json")));
  EXPECT_EQ(provenance_of(path("again.json")).at("command").back(), path("again.json"));
  // And that of the repetition.
  expect_done(run({"rerun", path("again.json"), "-o", path("third.json")}));
  EXPECT_EQ(rest_of(path("third.json")), rest_of(path("fit.json")));
}

TEST_F(Rerun, MakesALostFileAgainInItsOldPlace) {
  fit();
  expect_done(run({"simulate", path("case.toml"), "--fit", path("fit.json"), "-o", path("run")}));
  const auto rest_without_time = [&] {
    return std::regex_replace(rest_of(path("run/trajectories/inertial.csv")),
                              std::regex("# seconds: [^\n]*\n"), "");
  };
  const auto before = rest_without_time();
  fs::remove(path("run/trajectories/inertial.csv"));
  expect_done(run({"rerun", path("run/trajectories/reference.csv")}));
  EXPECT_EQ(rest_without_time(), before);
}

TEST_F(Rerun, GoesToTheFolderOfTheCommand) {
  const auto in_scratch = "cd '" + scratch_.path().string() + "'; ";
  expect_done(run_viscontact({"fit", "table.csv", "-o", "fit.json"}, {}, in_scratch));
  fs::copy(path("fit.json"), path("copy.json"));
  expect_done(run({"rerun", path("copy.json"), "-o", path("again.json")}));
  EXPECT_EQ(rest_of(path("again.json")), rest_of(path("fit.json")));
}

TEST_F(Rerun, GoesToAnotherFolderIfTheFilesHaveMoved) {
  fs::create_directory(path("old"));
  fs::copy(path("table.csv"), path("old/table.csv"));
  const auto in_old = "cd '" + path("old") + "'; ";
  expect_done(run_viscontact({"fit", "table.csv", "-o", "fit.json"}, {}, in_old));
  const auto first = rest_of(path("old/fit.json"));
  fs::rename(path("old"), path("new"));
  expect_refusal(run({"rerun", path("new/fit.json")}), ErrorKind::kBadInput,
                 AllOf(HasSubstr(path("old") + ": is no folder"), HasSubstr("--folder")));
  EXPECT_FALSE(fs::exists(path("old")));
  expect_done(
      run({"rerun", path("new/fit.json"), "--folder", path("new"), "-o", path("again.json")}));
  EXPECT_EQ(rest_of(path("again.json")), first);
  EXPECT_EQ(provenance_of(path("again.json")).at("folder"), path("new"));
  put_text(path("new/table.csv"), "changed");
  expect_refusal(run({"rerun", path("new/fit.json"), "--folder", path("new")}),
                 ErrorKind::kBadInput, HasSubstr(path("new/table.csv") + " has changed"));
}

TEST_F(Rerun, InAnotherFolderNeitherReadsNorWritesInTheOldOne) {
  const auto old_folder = path("old"), new_folder = path("new");
  fs::create_directory(old_folder);
  fs::copy(path("table.csv"), old_folder + "/table.csv");
  expect_done(
      run_viscontact({"fit", old_folder + "/table.csv", "--output=" + old_folder + "/fit.json"}, {},
                     "cd '" + old_folder + "'; "));
  fs::copy(old_folder, new_folder);
  const auto first = read_file(old_folder + "/fit.json");
  fs::remove(new_folder + "/fit.json");
  fs::remove(old_folder + "/table.csv");
  expect_done(run({"rerun", old_folder + "/fit.json", "--folder", new_folder}));
  EXPECT_EQ(read_file(old_folder + "/fit.json"), first);
  EXPECT_EQ(rest_of(new_folder + "/fit.json"), rest_of(old_folder + "/fit.json"));
}

TEST_F(Rerun, OfAPictureBesideAFitDrawsThePictureAlone) {
  expect_done(run({"fit", path("table.csv"), "-o", path("fit.json"), "--compare-bases"}));
  const auto picture = path("fit.bases.svg");
  const auto fit = read_file(path("fit.json"));
  expect_done(run({"rerun", picture, "-o", path("again.svg")}));
  EXPECT_EQ(rest_of(path("again.svg")), rest_of(picture));
  EXPECT_EQ(read_file(path("fit.json")), fit);
}

TEST_F(Rerun, RefusesChangedInputsUnlessAllowed) {
  fit();
  put_text(path("table.csv"),
           replaced(exact_table_text(), "# radius: 1\n", "# radius: 1\n# note: new\n"));
  expect_refusal(
      run({"rerun", path("fit.json"), "-o", path("again.json")}), ErrorKind::kBadInput,
      AllOf(HasSubstr(path("table.csv") + " has changed"), HasSubstr("--changed-inputs")));
  EXPECT_FALSE(fs::exists(path("again.json")));
  expect_done(run({"rerun", path("fit.json"), "-o", path("again.json"), "--changed-inputs"}));
  EXPECT_TRUE(fs::exists(path("again.json")));
  fs::remove(path("table.csv"));
  expect_refusal(run({"rerun", path("fit.json")}), ErrorKind::kBadInput,
                 HasSubstr("is not there any more"));
}

TEST_F(Rerun, OfASweepAndOfItsPictureLeavesTheFirstOnesAsTheyAre) {
  const std::string study = VISCONTACT_SOURCE_FOLDER "/data/cases/vanishing_viscosity.toml";
  expect_done(run({"sweep", study, "-o", path("rows.csv"), "--plot", path("rows.svg")}));
  const auto before = files_below(scratch_.path());
  expect_done(run({"rerun", path("rows.csv"), "-o", path("again.csv")}));
  EXPECT_EQ(rest_of(path("again.csv")), rest_of(path("rows.csv")));
  expect_done(run({"rerun", path("rows.svg"), "-o", path("again.svg")}));
  EXPECT_EQ(rest_of(path("again.svg")), rest_of(path("rows.svg")));
  for (const auto& [file, content] : before) EXPECT_EQ(read_file(file), content) << file;
}

TEST_F(Rerun, OfOneFileOfARunRepeatsTheRunIntoAFolder) {
  put_text(path("case.toml"),
           replaced(replaced(lecture_case_text(), "basis = \"lecture\"", "exact = \"plane\""),
                    "weights = \"relative\"", ""));
  expect_done(run({"run", path("case.toml"), "-o", path("run")}));
  expect_refusal(run({"rerun", path("run/fit.json"), "-o", path("fit.json")}),
                 ErrorKind::kWrongUsage, HasSubstr("-o must be a folder"));
  EXPECT_FALSE(fs::exists(path("fit.json")));
  expect_done(run_viscontact({"rerun", path("run/fit.json"), "-o", path("again")},
                             {"SOURCE_DATE_EPOCH=1000000001"}));
  // Equal but for how and how fast they were made.
  const std::regex seconds("\"?seconds\"?: [^\n]*\n|\"made\":\"[^\n]*");
  for (const auto& entry : fs::recursive_directory_iterator(path("run"))) {
    if (!entry.is_regular_file() || entry.path().extension() == ".html") continue;
    const auto twin = fs::path(path("again")) / entry.path().lexically_relative(path("run"));
    EXPECT_EQ(std::regex_replace(rest_of(twin), seconds, ""),
              std::regex_replace(rest_of(entry.path()), seconds, ""))
        << twin;
  }
}

TEST_F(Rerun, OfAGatheredTableComputesItsRows) {
  const FakeFreeFem fake(scratch_.path());
  const std::vector<std::string> environment = {"VISCONTACT_FREEFEM=" + fake.executable()};
  put_text(path("case.toml"), gentle_case_text());
  const std::vector<std::string> tabulate = {"tabulate", path("case.toml"), "-o", path("t.csv")};
  auto share = tabulate, gather = tabulate;
  share.insert(share.end(), {"--task", "0/1"});
  gather.emplace_back("--gather");
  expect_done(run_viscontact(share, environment));
  expect_done(run_viscontact(gather, environment));
  expect_done(run_viscontact({"rerun", path("t.csv"), "-o", path("again.csv")}, environment));
  EXPECT_EQ(without_seconds(path("again.csv")), without_seconds(path("t.csv")));
}

TEST_F(Rerun, DoesNothingButWriteFilesWhateverTheFileSays) {
  fit();
  const auto forged = [&](const std::string& command) {
    put_text(path("forged.json"),
             std::regex_replace(read_file(path("fit.json")),
                                std::regex("\"command\":\\[[^\\]]*\\]"), "\"command\":" + command));
    return run({"rerun", path("forged.json")});
  };
  for (const std::string command :
       {R"(["viscontact","rerun","forged.json"])", R"(["viscontact","init","x.toml"])",
        R"(["viscontact"])",
        R"(["viscontact","tabulate","case.toml","-o","t.csv","--launcher","slurm"])",
        R"(["viscontact","fit","a\u0000b","-o","f.json"])"})
    expect_refusal(forged(command), ErrorKind::kBadInput,
                   HasSubstr("holds a command that 'rerun' does not run"));
}

TEST_F(Rerun, FindsItInAJsonFileThatWasWrittenOutAgain) {
  fit();
  put_text(path("pretty.json"), Json::parse(read_file(path("fit.json"))).dump(4));
  expect_done(run({"rerun", path("pretty.json"), "-o", path("again.json")}));
  EXPECT_EQ(rest_of(path("again.json")), rest_of(path("fit.json")));
}

TEST_F(Provenance, OfAPipeHasNoHash) {
  expect_done(run_viscontact({"fit", "/dev/stdin", "-o", path("fit.json")}, {},
                             "cat '" + path("table.csv") + "' |"));
  EXPECT_EQ(provenance_of(path("fit.json")).at("inputs").at(0).at("sha256"), "");
  expect_refusal(run({"rerun", path("fit.json")}), ErrorKind::kBadInput, HasSubstr("pipe"));
}

TEST_F(Provenance, TimeThatIsNoneIsRefused) {
  for (const std::string time : {"-5", "1.5", "1e9", "abc", "99999999999999999999"})
    expect_refusal(run_viscontact({"fit", path("table.csv"), "-o", path("fit.json")},
                                  {"SOURCE_DATE_EPOCH=" + time}),
                   ErrorKind::kWrongUsage, HasSubstr("SOURCE_DATE_EPOCH is '" + time + "'"));
  EXPECT_FALSE(fs::exists(path("fit.json")));
}

TEST_F(Rerun, RefusesWhatDoesNotSayHowItWasMade) {
  fit();
  expect_refusal(run({"rerun", path("table.csv")}), ErrorKind::kBadInput,
                 HasSubstr("does not say how it was made"));
  expect_refusal(run({"rerun", path("nothing.csv")}), ErrorKind::kBadInput,
                 HasSubstr("nothing.csv"));
  put_text(path("torn.json"), replaced(read_file(path("fit.json")), "\"folder\":", "\"folder\""));
  expect_refusal(run({"rerun", path("torn.json")}), ErrorKind::kBadInput, HasSubstr("damaged"));
  expect_done(run({"simulate", path("case.toml"), "--fit", path("fit.json"), "-o", path("run")}));
  expect_done(run({"compare", path("run")}));
  expect_done(run({"report", path("run")}));
  expect_refusal(run({"rerun", path("run/report.html"), "-o", path("other")}),
                 ErrorKind::kWrongUsage, HasSubstr("leave out -o"));
}

}  // namespace
}  // namespace viscontact
