// Outputs beside the inputs, and outputs in an input's place: what the user wrote stays as it is.
#include <gmock/gmock.h>

#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/robustness/whole_outputs.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

using ::testing::HasSubstr;

class OwnFolder : public ::testing::Test {
 protected:
  OwnFolder() : fake_(elsewhere_.path()) {}

  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }
  void given(const std::string& name, const std::string& text) {
    put_text(path(name), text);
    given_[name] = text;
  }
  ProgramResult run(const std::vector<std::string>& arguments) const {
    return run_viscontact(arguments, {"VISCONTACT_FREEFEM=" + fake_.executable()});
  }
  void expect_given_untouched() const {
    for (const auto& [name, text] : given_) EXPECT_EQ(read_file(path(name)), text) << name;
  }

  TemporaryFolder scratch_, elsewhere_;
  freefem_axi::FakeFreeFem fake_;
  std::map<std::string, std::string> given_;
};

TEST_F(OwnFolder, RunBesideItsCaseAndForceFile) {
  given("case.toml", replaced(quick_case_text(),
                              "[ { until = 2.0, value = -20.0 }, { until = 4.0, value = 20.0 } ]",
                              "[ { file = \"push.csv\" } ]"));
  given("push.csv", "time,force\n0,-20\n2,-20\n2,20\n4,20\n");
  for (int n = 0; n < 2; ++n) {
    expect_done(run({"run", path("case.toml"), "-o", scratch_.path().string()}));
    expect_given_untouched();
    EXPECT_TRUE(std::filesystem::exists(path("report.html")));
  }
}

TEST_F(OwnFolder, SimulateBesideItsFit) {
  given("case.toml", quick_case_text());
  given("table.csv", exact_table_text());
  expect_done(run({"fit", path("table.csv"), "-o", path("fit.json")}));
  given("fit.json", read_file(path("fit.json")));
  expect_done(run(
      {"simulate", path("case.toml"), "--fit", path("fit.json"), "-o", scratch_.path().string()}));
  expect_given_untouched();
}

TEST_F(OwnFolder, AnOutputInPlaceOfItsOwnInputIsRefused) {
  given("case.toml", quick_case_text());
  given("table.csv", exact_table_text());
  const std::vector<std::vector<std::string>> commands = {
      {"tabulate", path("case.toml"), "-o", path("case.toml")},
      {"fit", path("table.csv"), "-o", path("table.csv")},
      {"fit", path("table.csv"), "-o",
       path("../") + scratch_.path().filename().string() + "/table.csv"}};
  for (const auto& command : commands) {
    expect_refusal(run(command), ErrorKind::kBadInput, HasSubstr("is not a "));
    expect_given_untouched();
  }
}

TEST_F(OwnFolder, ACopyNeverTakesThePlaceOfAnotherCaseOrFit) {
  given("other.toml", quick_case_text());
  given("case.toml", lecture_case_text());
  expect_refusal(run({"run", path("other.toml"), "-o", scratch_.path().string()}),
                 ErrorKind::kBadInput, HasSubstr("case.toml: is another case"));
  expect_given_untouched();
  std::filesystem::remove(path("case.toml"));
  given_.erase("case.toml");

  given("fit.json", read_file(VISCONTACT_SOURCE_FOLDER "/data/fits/lecture.json"));
  given("table.csv", exact_table_text());
  expect_done(run({"fit", path("table.csv"), "-o", path("used.json")}));
  given("used.json", read_file(path("used.json")));
  const auto simulate = [&](const std::string& folder) {
    return run({"simulate", path("other.toml"), "--fit", path("used.json"), "-o", folder});
  };
  expect_refusal(simulate(scratch_.path().string()), ErrorKind::kBadInput,
                 HasSubstr("fit.json: is another fit"));
  expect_given_untouched();

  // A copy of an earlier run is replaced when the case has been edited.
  expect_done(simulate(path("out")));
  put_text(path("other.toml"), quick_case_text() + "# edited\n");
  expect_done(simulate(path("out")));
  EXPECT_EQ(read_file(path("out/case.toml")), quick_case_text() + "# edited\n");
}

TEST_F(OwnFolder, ACopyNeverTakesThePlaceOfAnotherForce) {
  const std::string forces = "[ { until = 2.0, value = -20.0 }, { until = 4.0, value = 20.0 } ]";
  std::filesystem::create_directory(path("sub"));
  given("sub/push.csv", "time,force\n0,-20\n2,-20\n2,20\n4,20\n");
  given("push.csv", "time,force\n0,-1\n9,-1\n");
  given("other.toml", replaced(quick_case_text(), forces, "[ { file = \"sub/push.csv\" } ]"));
  expect_refusal(run({"run", path("other.toml"), "-o", scratch_.path().string()}),
                 ErrorKind::kBadInput, HasSubstr("push.csv: is another force"));
  expect_given_untouched();
}

// Files that a user made, of the very kind of an output: Viscontact did not write them.
constexpr const char* kUsersPicture =
    "<svg xmlns=\"http://www.w3.org/2000/svg\"><title>provenance of my data</title></svg>\n";
constexpr const char* kUsersFlow = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Unknown\"/>\n";
constexpr const char* kUsersUncertainty = "{\"minimal_gap\": {}, \"refused_draws\": 0}\n";
constexpr const char* kUsersTrajectory = "time,gap,velocity\n0,1,0\n4,0.5,0\n";

std::string exact_case_text() {
  return replaced(replaced(quick_case_text(), "terms = \"1/q\"", "exact = \"plane\""),
                  "weights = \"relative\"", "");
}

class UsersFile : public OwnFolder {
 protected:
  /// Expects that the command is refused because of that file, which stays, and that it wrote
  /// nothing and computed no row.
  void expect_in_the_way(const std::string& name, const std::string& text,
                         const std::vector<std::string>& command) {
    SCOPED_TRACE(name);
    std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
    put_text(path(name), text);
    const auto before = files_below(scratch_.path());
    const auto answered = fake_.answered();
    expect_refusal(run(command), ErrorKind::kBadInput, HasSubstr(name + ": is not a"));
    EXPECT_TRUE(files_below(scratch_.path()) == before) << "something was written or deleted";
    EXPECT_EQ(fake_.answered(), answered);
    std::filesystem::remove(path(name));
  }
};

TEST_F(UsersFile, OfThePicturesNameIsNotReplaced) {
  put_text(path("table.csv"), exact_table_text());
  expect_done(run({"fit", path("table.csv"), "-o", path("fit.json")}));
  put_text(path("exact.toml"), exact_case_text());
  expect_in_the_way("my.svg", kUsersPicture,
                    {"fit", path("table.csv"), "--compare-bases", "--plot", path("my.svg")});
  expect_in_the_way("new.bases.svg", kUsersPicture,
                    {"fit", path("table.csv"), "--compare-bases", "-o", path("new.json")});
  expect_in_the_way("my.svg", kUsersPicture,
                    {"shift", path("table.csv"), "--fit", path("fit.json"), "-o", path("shift.csv"),
                     "--plot", path("my.svg")});
  expect_in_the_way("my.svg", kUsersPicture,
                    {"sweep", path("exact.toml"), "--vary", "fluid.viscosity=0.5,1", "-o",
                     path("sweep.csv"), "--plot", path("my.svg")});
  // A picture that an earlier command drew is replaced.
  const std::vector<std::string> compare = {"fit", path("table.csv"), "--compare-bases", "--plot",
                                            path("my.svg")};
  expect_done(run(compare));
  expect_done(run(compare));
}

TEST_F(UsersFile, OfAFitWrittenByHandIsNotReplaced) {
  put_text(path("table.csv"), exact_table_text());
  expect_in_the_way("hand.json", read_file(VISCONTACT_SOURCE_FOLDER "/data/fits/leading_term.json"),
                    {"fit", path("table.csv"), "-o", path("hand.json")});
}

TEST_F(UsersFile, InTheFolderOfATablesPicturesIsNotReplaced) {
  put_text(path("case.toml"), quick_case_text());
  const std::vector<std::string> command = {"tabulate",        path("case.toml"), "-o",
                                            path("table.csv"), "--plot",          "0.1"};
  expect_in_the_way("table.plots/gap_0.1.vtu", kUsersFlow, command);
  for (const auto* picture : {"mesh", "flow", "film"})
    expect_in_the_way(std::string("table.plots/gap_0.1_") + picture + ".svg", kUsersPicture,
                      command);
}

TEST_F(UsersFile, InARunsFolderIsNeitherReplacedNorDeleted) {
  put_text(path("case.toml"), quick_case_text());
  put_text(path("exact.toml"), exact_case_text());
  for (const auto* name : {"case.toml", "exact.toml"}) {
    const std::vector<std::string> command = {"run", path(name), "-o", path("out")};
    expect_in_the_way("out/uncertainty.json", kUsersUncertainty, command);
    for (const auto* plot : {"gap", "fit", "solid_force"})
      expect_in_the_way(std::string("out/plots/") + plot + ".svg", kUsersPicture, command);
    expect_in_the_way("out/trajectories/inertial.csv", kUsersTrajectory, command);
  }
}

TEST_F(UsersFile, OfAReportsNameIsNotReplacedByReport) {
  put_text(path("exact.toml"), exact_case_text());
  expect_done(run({"run", path("exact.toml"), "-o", path("out")}));
  std::filesystem::remove(path("out/report.html"));
  std::filesystem::remove_all(path("out/plots"));
  const std::vector<std::string> report = {"report", path("out")};
  expect_in_the_way("out/report.html", "<html><head></head>mine</html>\n", report);
  expect_in_the_way("out/plots/gap.svg", kUsersPicture, report);
  expect_done(run(report));
}

TEST_F(UsersFile, OfASimulationsNameIsNotReplaced) {
  put_text(path("case.toml"), quick_case_text());
  put_text(path("table.csv"), exact_table_text());
  expect_done(run({"fit", path("table.csv"), "-o", path("fit.json")}));
  const std::vector<std::string> simulate = {
      "simulate", path("case.toml"), "--fit", path("fit.json"), "-o", path("out")};
  expect_in_the_way("out/uncertainty.json", kUsersUncertainty, simulate);
  expect_in_the_way("out/trajectories/inertial.csv", kUsersTrajectory, simulate);
}

TEST_F(UsersFile, OfACasesNameBesideTrajectoriesOfTheUsersOwnIsNotReplaced) {
  // A folder of measured trajectories is not the folder of an earlier run.
  put_text(path("exact.toml"), exact_case_text());
  std::filesystem::create_directories(path("out/trajectories"));
  put_text(path("out/trajectories/measured.csv"), kUsersTrajectory);
  put_text(path("out/case.toml"), "title = \"mine\"\n");
  const auto before = files_below(path("out"));
  expect_refusal(run({"run", path("exact.toml"), "-o", path("out")}), ErrorKind::kBadInput,
                 HasSubstr("case.toml: is another case"));
  EXPECT_TRUE(files_below(path("out")) == before);
}

}  // namespace
}  // namespace viscontact
