// Bad files and values for each command: exit code 3, an error that says where and what, and
// nothing written. The tests of the readers have all that can be wrong in a file.
#include <gmock/gmock.h>

#include <ostream>

#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

struct BadInputCase {
  std::string name;
  std::vector<std::string> arguments;  ///< "@name" is a file of the folder below
  std::string said;
};

// What GoogleTest shows of the parameter.
std::ostream& operator<<(std::ostream& out, const BadInputCase& bad) { return out << bad.name; }

/// Good files and one of each kind of bad one.
void fill(const std::filesystem::path& folder) {
  const std::string good_case = lecture_case_text();
  const std::string table = exact_table_text();
  const auto put = [&](const std::string& name, const std::string& text) {
    put_text(folder / name, text);
  };
  put("case.toml", good_case);
  put("table.csv", table);
  expect_done(run_viscontact(
      {"fit", (folder / "table.csv").string(), "-o", (folder / "fit.json").string()}));
  const std::string fit = read_file(folder / "fit.json");

  put("empty", "");
  std::filesystem::create_directory(folder / "folder");
  put("nan.toml", replaced(good_case, "viscosity = 3.0", "viscosity = nan"));
  put("unknown_key.toml", replaced(good_case, "end_time", "ende_time"));
  put("no_motion.toml", good_case.substr(0, good_case.find("[motion]")));
  put("no_tabulation.toml",
      replaced(read_file(VISCONTACT_SOURCE_FOLDER "/data/cases/limit.toml"), "../fits/", "no/"));
  put("unknown_model.toml",
      replaced(good_case, "end_time = 4.0", "end_time = 4.0\nmodels = [\"inertial\", \"magic\"]"));
  put("nan.csv", replaced(table, "\n2,-1,", "\n2,nan,"));
  put("other_radius.json", replaced(fit, "\"radius\": 1.0", "\"radius\": 2.0"));
  put("unknown_key.json", replaced(fit, "\"radius\"", "\"radios\": 1.0, \"radius\""));
  std::filesystem::create_directories(folder / "run" / "trajectories");
  put("run/trajectories/inertial.csv", "time,gap,velocity\n0,1,0\n1,1,0\n");
  std::filesystem::create_directories(folder / "nan_run" / "trajectories");
  put("nan_run/trajectories/inertial.csv", "time,gap,velocity\n0,1,0\n1,nan,0\n");
}

class BadInput : public ::testing::TestWithParam<BadInputCase> {};

TEST_P(BadInput, EndsWithExitCode3SaysWhatAndLeavesEveryFileAsItWas) {
  const TemporaryFolder scratch;
  const TemporaryFolder elsewhere;
  fill(scratch.path());
  const freefem_axi::FakeFreeFem fake(elsewhere.path());
  std::vector<std::string> arguments;
  for (const auto& word : GetParam().arguments)
    arguments.push_back(word.starts_with("@") ? (scratch.path() / word.substr(1)).string() : word);
  const auto before = files_below(scratch.path());
  const auto result = run_viscontact(arguments, {"VISCONTACT_FREEFEM=" + fake.executable()});
  expect_refusal(result, ErrorKind::kBadInput, Names(GetParam().said));
  EXPECT_EQ(result.output, "");
  EXPECT_EQ(files_below(scratch.path()), before);
  EXPECT_TRUE(fake.answered().empty());  // what can be refused is refused before it costs anything
}

using Cases = std::vector<BadInputCase>;

std::string name_of(const ::testing::TestParamInfo<BadInputCase>& test) { return test.param.name; }

const Cases kTabulate = {
    {"MissingCase", {"tabulate", "@no.toml", "-o", "@t.csv"}, "no.toml"},
    {"NotANumberInCase", {"tabulate", "@nan.toml", "-o", "@t.csv"}, "fluid.viscosity"},
    {"UnknownKey", {"tabulate", "@unknown_key.toml", "-o", "@t.csv"}, "end_time"},
    {"NoTabulation", {"tabulate", "@no_tabulation.toml", "-o", "@t.csv"}, "[tabulation]"},
    {"OutputBelowAFile", {"tabulate", "@case.toml", "-o", "@empty/t.csv"}, "empty"},
    {"OutputIsAFolder", {"tabulate", "@case.toml", "-o", "@folder"}, "folder"},
    {"OutputIsAnotherFile", {"tabulate", "@case.toml", "-o", "@fit.json"}, "fit.json"},
};
INSTANTIATE_TEST_SUITE_P(Tabulate, BadInput, ::testing::ValuesIn(kTabulate), name_of);

const Cases kFit = {
    {"MissingTable", {"fit", "@no.csv", "-o", "@f.json"}, "no.csv"},
    {"FolderAsTable", {"fit", "@folder", "-o", "@f.json"}, "folder"},
    {"NotANumberInTable", {"fit", "@nan.csv", "-o", "@f.json"}, "reference_velocity"},
    {"OutputBelowAFile", {"fit", "@table.csv", "-o", "@empty/f.json"}, "empty"},
    {"OutputIsAFolder", {"fit", "@table.csv", "-o", "@folder"}, "folder"},
    {"OutputIsItsInput", {"fit", "@table.csv", "-o", "@table.csv"}, "table.csv"},
};
INSTANTIATE_TEST_SUITE_P(Fit, BadInput, ::testing::ValuesIn(kFit), name_of);

const Cases kSimulate = {
    {"MissingCase", {"simulate", "@no.toml", "--fit", "@fit.json", "-o", "@out"}, "no.toml"},
    {"NoMotion", {"simulate", "@no_motion.toml", "--fit", "@fit.json", "-o", "@out"}, "[motion]"},
    {"UnknownModelInCase",
     {"simulate", "@unknown_model.toml", "--fit", "@fit.json", "-o", "@out"},
     "'magic'"},
    {"MissingFit", {"simulate", "@case.toml", "--fit", "@no.json", "-o", "@out"}, "no.json"},
    {"UnknownKeyInFit",
     {"simulate", "@case.toml", "--fit", "@unknown_key.json", "-o", "@out"},
     "radios"},
    {"FitOfAnotherRadius",
     {"simulate", "@case.toml", "--fit", "@other_radius.json", "-o", "@out"},
     "radius 2"},
    {"OutputBelowAFile",
     {"simulate", "@case.toml", "--fit", "@fit.json", "-o", "@empty/out"},
     "empty"},
    {"OutputIsAFile", {"simulate", "@case.toml", "--fit", "@fit.json", "-o", "@empty"}, "empty"},
};
INSTANTIATE_TEST_SUITE_P(Simulate, BadInput, ::testing::ValuesIn(kSimulate), name_of);

const Cases kCompareAndReport = {
    {"CompareMissingFolder", {"compare", "@no", "-o", "@c.json"}, "/no:"},
    {"CompareAFile", {"compare", "@case.toml", "-o", "@c.json"}, "case.toml"},
    {"CompareFolderWithoutTrajectories", {"compare", "@folder", "-o", "@c.json"}, "folder"},
    {"CompareNotANumber", {"compare", "@nan_run", "-o", "@c.json"}, "inertial.csv:3"},
    {"CompareUnknownReference",
     {"compare", "@run", "--reference", "magic", "-o", "@c.json"},
     "'magic'"},
    {"CompareMissingTrajectory", {"compare", "@run", "@no.csv", "-o", "@c.json"}, "no.csv"},
    {"CompareOutputBelowAFile", {"compare", "@run", "-o", "@empty/c.json"}, "empty"},
    {"ReportMissingFolder", {"report", "@no"}, "/no:"},
    {"ReportOfAFolderWithoutCase", {"report", "@run"}, "case.toml"},
    {"ReportOfAFile", {"report", "@table.csv"}, "table.csv"},
};
INSTANTIATE_TEST_SUITE_P(CompareAndReport, BadInput, ::testing::ValuesIn(kCompareAndReport),
                         name_of);

const Cases kRun = {
    {"MissingCase", {"run", "@no.toml", "-o", "@out"}, "no.toml"},
    {"NoMotion", {"run", "@no_motion.toml", "-o", "@out"}, "[motion]"},
    {"UnknownModel", {"run", "@unknown_model.toml", "-o", "@out"}, "'magic'"},
    {"FitFileMissing", {"run", "@no_tabulation.toml", "-o", "@out"}, "limit.json"},
    {"OutputIsAFile", {"run", "@case.toml", "-o", "@empty"}, "empty"},
};
INSTANTIATE_TEST_SUITE_P(Run, BadInput, ::testing::ValuesIn(kRun), name_of);

}  // namespace
}  // namespace viscontact
