// Outputs beside the inputs, and outputs in an input's place: what the user wrote stays as it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/file.hpp"
#include "tests/app/program.hpp"
#include "tests/app/sample_files.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/hostile/whole_outputs.hpp"

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
  FakeFreeFem fake_;
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
    expect_refusal(run(command), ExitCode::kBadInput, HasSubstr("is there and is no "));
    expect_given_untouched();
  }
}

TEST_F(OwnFolder, ACopyNeverTakesThePlaceOfAnotherCaseOrFit) {
  given("other.toml", quick_case_text());
  given("case.toml", lecture_case_text());
  expect_refusal(run({"run", path("other.toml"), "-o", scratch_.path().string()}),
                 ExitCode::kBadInput, HasSubstr("case.toml: is there and is another case"));
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
  expect_refusal(simulate(scratch_.path().string()), ExitCode::kBadInput,
                 HasSubstr("fit.json: is there and is another fit"));
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
                 ExitCode::kBadInput, HasSubstr("push.csv: is there and is another force"));
  expect_given_untouched();
}

}  // namespace
}  // namespace viscontact
