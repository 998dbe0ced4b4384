// What needs no input: wrong command lines, --help, --version, doctor.
#include <gmock/gmock.h>

#include <ostream>

#include "tests/common/temporary_folder.hpp"
#include "tests/program/program.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

struct WrongUsage {
  std::string name;
  std::vector<std::string> arguments;
  std::string said;
};

// What GoogleTest shows of the parameter.
std::ostream& operator<<(std::ostream& out, const WrongUsage& usage) { return out << usage.name; }

class WrongCommandLine : public ::testing::TestWithParam<WrongUsage> {};

TEST_P(WrongCommandLine, EndsWithExitCode2AndPointsToHelp) {
  const auto result = run_viscontact(GetParam().arguments);
  expect_refusal(result, ErrorKind::kWrongUsage, Names(GetParam().said, "--help"));
  EXPECT_EQ(result.output, "");
}

// None of the files exists: the command line is refused before anything is read.
INSTANTIATE_TEST_SUITE_P(
    Each, WrongCommandLine,
    ::testing::Values(
        WrongUsage{"NoCommand", {}, "subcommand"},
        WrongUsage{"UnknownCommand", {"tabulte", "case.toml"}, "'tabulte'"},
        WrongUsage{"OutputTwiceUnderTwoNames",
                   {"sweep", "case.toml", "-o", "a.csv", "--plot", "./a.csv"},
                   "./a.csv"},
        WrongUsage{"SweepPictureAsEps",
                   {"sweep", "case.toml", "-o", "a.csv", "--plot", "a.eps"},
                   "--plot"},
        WrongUsage{"ShiftPictureAsJpeg",
                   {"shift", "table.csv", "--fit", "f.json", "-o", "s.csv", "--plot", "s.jpg"},
                   "--plot"},
        WrongUsage{"PictureOfBasesWithoutEnding",
                   {"fit", "table.csv", "--compare-bases", "--plot", "bases"},
                   "--plot"},
        WrongUsage{
            "UnknownOption", {"fit", "table.csv", "-o", "fit.json", "--base", "lecture"}, "--base"},
        WrongUsage{"UnknownOptionOfTheProgram", {"--verbose"}, "subcommand"},
        WrongUsage{
            "ArgumentTooMany", {"export", "fit.json", "other.json", "--to", "json"}, "other.json"},
        WrongUsage{"MissingOutput", {"tabulate", "case.toml"}, "--output"},
        WrongUsage{
            "UnknownBasis", {"fit", "table.csv", "-o", "f.json", "--basis", "cubic"}, "'cubic'"},
        WrongUsage{
            "UnknownTerm", {"fit", "table.csv", "-o", "f.json", "--terms", "1/q, q^9"}, "'q^9'"},
        WrongUsage{"UnknownWeights",
                   {"fit", "table.csv", "-o", "f.json", "--weights", "heavy"},
                   "'heavy'"},
        WrongUsage{"UnknownLoss", {"fit", "table.csv", "-o", "f.json", "--loss", "l1"}, "'l1'"},
        WrongUsage{"UnknownExportTarget", {"export", "fit.json", "--to", "cobol"}, "'cobol'"},
        WrongUsage{"UnknownModelToSimulate",
                   {"simulate", "case.toml", "-o", "out", "--models", "inertial,magic"},
                   "'magic'"},
        WrongUsage{"UnknownModelToSweep",
                   {"sweep", "case.toml", "-o", "rows.csv", "--models", "magic"},
                   "'magic'"},
        WrongUsage{"MissingCase", {"run", "-o", "out"}, "CASE"},
        WrongUsage{"MissingFolder", {"report"}, "DIR"},
        WrongUsage{"OptionWithoutValue", {"compare", "out", "--reference"}, "--reference"},
        WrongUsage{
            "ZeroJobs", {"tabulate", "case.toml", "-o", "table.csv", "--jobs", "0"}, "--jobs"},
        WrongUsage{"NegativeJobs", {"run", "case.toml", "-o", "out", "--jobs", "-1"}, "--jobs"},
        WrongUsage{"JobsNotANumber",
                   {"tabulate", "case.toml", "-o", "table.csv", "--jobs", "x"},
                   "--jobs"},
        WrongUsage{"JobsAFraction",
                   {"tabulate", "case.toml", "-o", "table.csv", "--jobs", "1.5"},
                   "--jobs"},
        WrongUsage{"CasesOfEqualNames",
                   {"tabulate", "a/case.toml", "b/case.toml", "-o", "out"},
                   "out/case.csv"},
        WrongUsage{"TaskBeyondTheLast",
                   {"tabulate", "case.toml", "-o", "table.csv", "--task", "4/4"},
                   "'4/4'"},
        WrongUsage{
            "TaskWithoutCount", {"tabulate", "case.toml", "-o", "table.csv", "--task", "4"}, "'4'"},
        WrongUsage{"FitWithoutOutput", {"fit", "table.csv"}, "--output"},
        WrongUsage{"FitWithTwoBases",
                   {"fit", "table.csv", "-o", "f.json", "--basis", "lecture", "--terms", "1/q"},
                   "--terms"},
        WrongUsage{
            "FixOfAnotherTerm", {"fit", "table.csv", "-o", "f.json", "--fix", "q^2=1"}, "'q^2=1'"},
        WrongUsage{
            "FixOfNoNumber", {"fit", "table.csv", "-o", "f.json", "--fix", "1/q=x"}, "'1/q=x'"},
        WrongUsage{
            "PictureOfOneFit", {"fit", "table.csv", "-o", "f.json", "--plot", "p.svg"}, "--plot"},
        WrongUsage{"FitAndPictureInOneFile",
                   {"fit", "table.csv", "-o", "f.json", "--compare-bases", "--plot", "f.json"},
                   "f.json"},
        WrongUsage{"OutputWithoutAName",
                   {"tabulate", "case.toml", "-o", ""},
                   "the name of an output is empty"},
        WrongUsage{"UnknownLauncher",
                   {"tabulate", "case.toml", "-o", "table.csv", "--launcher", "pbs"},
                   "--launcher"},
        WrongUsage{"GatherAndSubmit",
                   {"tabulate", "case.toml", "-o", "table.csv", "--gather", "--launcher", "slurm"},
                   "--gather"},
        WrongUsage{
            "TasksHere", {"tabulate", "case.toml", "-o", "table.csv", "--tasks", "4"}, "--tasks"}),
    [](const auto& test) { return test.param.name; });

TEST(CommandLine, TakesWordsBehindTwoDashesForFiles) {
  // table.csv is the name of a file, and would be taken from the option --fix in front of --.
  expect_refusal(run_viscontact({"fit", "-o", "fit.json", "--", "--fix", "table.csv"}),
                 ErrorKind::kBadInput, Names("--fix"));
}

TEST(SimulateHelp, TellsModelsThatRunByDefaultFromThoseOnRequest) {
  // Its lines are broken in the middle of a list.
  std::string words;
  for (const char c : run_viscontact({"simulate", "--help"}).output)
    if (c != '\n' && (c != ' ' || !words.ends_with(' '))) words += c;
  const auto by_default = words.find("else reference");
  const auto on_request = words.find("on request: ");
  ASSERT_NE(by_default, std::string::npos) << words;
  ASSERT_NE(on_request, std::string::npos) << words;
  for (const auto& model : reduced_model::all_models())
    EXPECT_NE(words.find(model.name, model.by_default ? by_default : on_request), std::string::npos)
        << model.name;
  EXPECT_GT(words.find("inelastic_contact"), on_request);
}

TEST(Version, NamesTheProgramsThatMakeAResult) {
  const auto result = run_viscontact({"--version"});
  expect_done(result);
  EXPECT_THAT(result.output, StartsWith("viscontact "));
  for (const auto* program : {"\nFreeFEM ", "\nCeres ", "\nSUNDIALS ", "\nEigen "})
    EXPECT_THAT(result.output, ::testing::ContainsRegex(std::string(program) + "[0-9]+\\.[0-9]+"));
}

TEST(Version, IsPrintedWithoutFreeFem) {
  const auto result = run_viscontact({"--version"}, {"VISCONTACT_FREEFEM=no-such-freefem"});
  expect_done(result);
  EXPECT_THAT(result.output, HasSubstr("FreeFEM not found"));
}

TEST(Doctor, FindsNothingMissingAndSolvesAKnownRow) {
  const auto result = run_viscontact({"doctor"});
  expect_done(result);
  EXPECT_THAT(result.output,
              AllOf(HasSubstr("FreeFEM solves"), HasSubstr("gnuplot"), HasSubstr("Ceres"),
                    HasSubstr("SUNDIALS"), Not(HasSubstr("MISSING"))));
}

TEST(Doctor, SaysHowToMendWhatIsMissing) {
  const TemporaryFolder empty;
  const auto result = run_viscontact({"doctor"}, {"PATH=" + empty.path().string()});
  EXPECT_EQ(result.exit_status, results::exit_code_of(ErrorKind::kExternalProgram));
  EXPECT_THAT(result.output, AllOf(HasSubstr("apt-get install freefem++"),
                                   HasSubstr("apt-get install gnuplot-nox")));
}

}  // namespace
}  // namespace viscontact
