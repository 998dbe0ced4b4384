// `viscontact rerun` repeats the command that made a file.
#include <gmock/gmock.h>

#include "tests/common/regular_expressions.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/command_line/provenance.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/program/undisturbed.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class Rerun : public Provenance {};

TEST_F(Rerun, RepeatsWhatMadeAFileInAnotherPlace) {
  fit();
  const auto again = run({"rerun", path("fit.json"), "-o", path("again.json")});
  expect_done(again);
  EXPECT_THAT(again.errors, Names("rerun", "cd"));
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
    return replaced_matches(rest_of(path("run/trajectories/inertial.csv")), "# seconds: [^\n]*\n",
                            "");
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
  // A copy under another name does not say where its inputs are now.
  fs::copy(path("new/fit.json"), path("copy.json"));
  expect_refusal(run({"rerun", path("copy.json")}), ErrorKind::kBadInput,
                 Names(path("old"), "--folder"));
  EXPECT_FALSE(fs::exists(path("old")));
  expect_done(
      run({"rerun", path("new/fit.json"), "--folder", path("new"), "-o", path("again.json")}));
  EXPECT_EQ(rest_of(path("again.json")), first);
  EXPECT_EQ(provenance_of(path("again.json")).at("folder"), path("new"));
  put_text(path("new/table.csv"), "changed");
  expect_refusal(run({"rerun", path("new/fit.json"), "--folder", path("new")}),
                 ErrorKind::kBadInput, Names(path("new/table.csv")));
}

TEST_F(Rerun, GoesToTheFolderInWhichTheFileAndItsInputsAreNow) {
  fs::create_directories(path("project/tables"));
  fs::copy(path("table.csv"), path("project/tables/table.csv"));
  expect_done(run_viscontact({"fit", "tables/table.csv", "-o", "fit.json"}, {},
                             "cd '" + path("project") + "'; "));
  fs::copy(path("project"), path("clone"), fs::copy_options::recursive);
  const auto folder_of = [&](const std::string& file) {
    const auto dry = run({"rerun", file, "--dry-run"});
    expect_done(dry);
    return dry.output.substr(0, dry.output.find(" && "));
  };
  EXPECT_EQ(folder_of(path("clone/fit.json")), "cd " + path("clone"));
  // Without its inputs, a copy is made again where the command ran.
  fs::remove_all(path("clone/tables"));
  EXPECT_EQ(folder_of(path("clone/fit.json")), "cd " + path("project"));
}

TEST_F(Rerun, GoesToTheFolderInWhichTheCaseIsNowIfTheFitIsElsewhere) {
  fit();
  // The case is named from its folder, or by its whole path.
  for (const bool is_whole : {false, true}) {
    const auto named = [&](const std::string& place) {
      return is_whole ? path(place + "/case.toml") : std::string("case.toml");
    };
    fs::create_directory(path("old"));
    fs::copy(path("case.toml"), path("old/case.toml"));
    expect_done(run_viscontact({"simulate", named("old"), "--fit", path("fit.json"), "-o", "run"},
                               {}, "cd '" + path("old") + "'; "));
    fs::remove_all(path("new"));
    fs::rename(path("old"), path("new"));
    const auto dry = run({"rerun", path("new/run/trajectories/inertial.csv"), "--dry-run"});
    expect_done(dry);
    EXPECT_THAT(dry.output, HasSubstr("cd " + path("new") + " && viscontact simulate " +
                                      named("new") + " --fit " + path("fit.json")));
  }
  // A fit alone, of a table elsewhere, does not tell that anything has moved.
  fs::create_directory(path("copy"));
  fs::copy(path("fit.json"), path("copy/fit.json"));
  EXPECT_THAT(run({"rerun", path("copy/fit.json"), "--dry-run"}).output,
              Not(HasSubstr("cd " + path("copy"))));
}

/// The tables and fits below data/ that a command makes. Both fits of exact laws are written by
/// hand.
std::vector<std::string> shipped_results() {
  std::vector<std::string> files;
  for (const char* part : {"tables", "fits"})
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(VISCONTACT_SOURCE_FOLDER) / "data" / part))
      if (entry.is_regular_file() && entry.path().filename() != "limit.json" &&
          entry.path().filename() != "leading_term.json")
        files.push_back(entry.path().lexically_relative(VISCONTACT_SOURCE_FOLDER).string());
  return files;
}

// As in a clone on another machine: the inputs must be those that the files name, and the command
// must find every result up to date, which is tried with FreeFEM out of reach.
TEST_F(Rerun, WorksOnEveryShippedTableAndFit) {
  const auto clone = path("clone");
  fs::create_directory(clone);
  fs::copy(fs::path(VISCONTACT_SOURCE_FOLDER) / "data", clone + "/data",
           fs::copy_options::recursive);
  const auto before = files_below(clone);
  const auto files = shipped_results();
  EXPECT_GE(files.size(), 31U);
  for (const auto& file : files) {
    SCOPED_TRACE(file);
    // A file that others get names no folder of the machine on which it was made.
    EXPECT_EQ(provenance_of(clone + "/" + file).at("folder"), "");
    const auto again =
        run_viscontact({"rerun", clone + "/" + file}, {"VISCONTACT_FREEFEM=no-freefem-is-needed"});
    expect_done(again);
    EXPECT_THAT(again.errors, IsUpToDate(""));
  }
  EXPECT_EQ(files_below(clone), before);
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
  expect_refusal(run({"rerun", path("fit.json"), "-o", path("again.json")}), ErrorKind::kBadInput,
                 Names(path("table.csv"), "--changed-inputs"));
  EXPECT_FALSE(fs::exists(path("again.json")));
  expect_done(run({"rerun", path("fit.json"), "-o", path("again.json"), "--changed-inputs"}));
  EXPECT_TRUE(fs::exists(path("again.json")));
  fs::remove(path("table.csv"));
  expect_refusal(run({"rerun", path("fit.json")}), ErrorKind::kBadInput, Names(path("table.csv")));
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
                 ErrorKind::kWrongUsage, Names("-o"));
  EXPECT_FALSE(fs::exists(path("fit.json")));
  expect_done(run_viscontact({"rerun", path("run/fit.json"), "-o", path("again")},
                             {"SOURCE_DATE_EPOCH=1000000001"}));
  // Equal but for how and how fast they were made.
  const std::string seconds = "\"?seconds\"?: [^\n]*\n|\"made\":\"[^\n]*";
  for (const auto& entry : fs::recursive_directory_iterator(path("run"))) {
    if (!entry.is_regular_file() || entry.path().extension() == ".html") continue;
    const auto twin = fs::path(path("again")) / entry.path().lexically_relative(path("run"));
    EXPECT_EQ(replaced_matches(rest_of(twin), seconds, ""),
              replaced_matches(rest_of(entry.path()), seconds, ""))
        << twin;
  }
}

TEST_F(Rerun, OfAGatheredTableComputesItsRows) {
  const freefem_axi::FakeFreeFem fake(scratch_.path());
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
             replaced_matches(read_file(path("fit.json")), "\"command\":\\[[^\\]]*\\]",
                              "\"command\":" + command));
    return run({"rerun", path("forged.json")});
  };
  for (const std::string command :
       {R"(["viscontact","rerun","forged.json"])", R"(["viscontact","init","x.toml"])",
        R"(["viscontact"])",
        R"(["viscontact","tabulate","case.toml","-o","t.csv","--launcher","slurm"])",
        R"(["viscontact","fit","a\u0000b","-o","f.json"])"})
    expect_refusal(forged(command), ErrorKind::kBadInput, Names("'rerun'"));
}

TEST_F(Provenance, OfAPipeHasNoHash) {
  expect_done(run_viscontact({"fit", "/dev/stdin", "-o", path("fit.json")}, {},
                             "cat '" + path("table.csv") + "' |"));
  EXPECT_EQ(provenance_of(path("fit.json")).at("inputs").at(0).at("sha256"), "");
  expect_refusal(run({"rerun", path("fit.json")}), ErrorKind::kBadInput, Names("pipe"));
}

TEST_F(Provenance, TimeThatIsNoneIsRefused) {
  for (const std::string time : {"-5", "1.5", "1e9", "abc", "99999999999999999999"})
    expect_refusal(run_viscontact({"fit", path("table.csv"), "-o", path("fit.json")},
                                  {"SOURCE_DATE_EPOCH=" + time}),
                   ErrorKind::kWrongUsage, Names("SOURCE_DATE_EPOCH", time));
  EXPECT_FALSE(fs::exists(path("fit.json")));
}

TEST_F(Rerun, RefusesWhatDoesNotSayHowItWasMade) {
  fit();
  expect_refusal(run({"rerun", path("table.csv")}), ErrorKind::kBadInput, Names("table.csv"));
  expect_refusal(run({"rerun", path("nothing.csv")}), ErrorKind::kBadInput, Names("nothing.csv"));
  put_text(path("torn.json"), replaced(read_file(path("fit.json")), "\"folder\":", "\"folder\""));
  expect_refusal(run({"rerun", path("torn.json")}), ErrorKind::kBadInput, Names("damaged"));
  expect_done(run({"simulate", path("case.toml"), "--fit", path("fit.json"), "-o", path("run")}));
  expect_done(run({"compare", path("run")}));
  expect_done(run({"report", path("run")}));
  expect_refusal(run({"rerun", path("run/report.html"), "-o", path("other")}),
                 ErrorKind::kWrongUsage, Names("-o"));
}

}  // namespace
}  // namespace viscontact
