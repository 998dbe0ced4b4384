// FreeFEM missing or failing, played by shell scripts.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <ostream>
#include <string>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/freefem_axi/tabulations.hpp"
#include "viscontact/common/system/process.hpp"
#include "viscontact/freefem/freefem_command.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact::freefem_axi {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

namespace fs = std::filesystem;

const Tabulation kTabulation = unit_tabulation({0.25}, 5, 1e-3);

TEST(MissingFreeFem, ErrorSaysHowToInstallIt) {
  const FreeFem missing{"no-such-freefem", "."};
  const auto said = Names("no-such-freefem", "apt-get install", "VISCONTACT_FREEFEM");
  EXPECT_THAT(failure(ErrorKind::kExternalProgram,
                      [&] { (void)solve_row(missing, kTabulation, 0.25, -1); }),
              said);
  EXPECT_THAT(failure(ErrorKind::kExternalProgram, [&] { (void)freefem_version(missing); }), said);
}

TEST(MissingFreeFem, FileThatIsNoProgramIsAnError) {
  const TemporaryFolder scratch;
  put_text(scratch.path() / "text", "not a program");
  const FreeFem text{(scratch.path() / "text").string(), scratch.path()};
  EXPECT_THAT(
      failure(ErrorKind::kExternalProgram, [&] { (void)solve_row(text, kTabulation, 0.25, -1); }),
      Names("text"));
}

TEST(FreeFemVersion, IsThatOfTheDebianPackageIfItHasInstalledTheProgram) {
  const auto result =
      run_process({"dpkg-query", "--show", "--showformat=${Version} (Debian package ${Package}; ",
                   "freefem++"});
  ASSERT_EQ(result.exit_status, 0) << "scripts/setup installs FreeFEM from its Debian package";
  EXPECT_THAT(freefem_version(default_freefem()), StartsWith(result.output + "FreeFEM says "));
}

TEST(FreeFemVersion, IsWhatFreeFemStatesIfNoPackageHasInstalledIt) {
  const TemporaryFolder scratch;
  EXPECT_EQ(freefem_version(FakeFreeFem(scratch.path()).freefem()), "0-fake");
}

/// What a dpkg-query that answers `answer` to --search says of a program: the package, or "none".
/// The version it gives is "1 of PACKAGE".
std::string package_by(const std::string& answer, const std::string& program) {
  const TemporaryFolder scratch;
  fs::create_directory(scratch.path() / "bin");
  const auto file = scratch.path() / program;
  put_text(file, "");
  std::string lines;
  for (std::size_t i = 0; i < answer.size(); ++i)
    lines += answer[i] == '@' ? fs::canonical(file).string() : std::string(1, answer[i]);
  put_text(scratch.path() / "answer", lines);
  // What is asked for must match the path of the program as a pattern, and nothing else.
  const auto dpkg = scratch.path() / "bin/dpkg-query";
  put_text(dpkg, "#!/bin/sh\ncase $1 in\n--search)\n  case '" + fs::canonical(file).string() +
                     "' in $2) cat '" + (scratch.path() / "answer").string() +
                     "' ;; *) exit 1 ;; esac ;;\n--show) echo \"1 of $3\" ;;\nesac\n");
  make_executable(dpkg);
  const std::string before = std::getenv("PATH");
  ::setenv("PATH", ((scratch.path() / "bin").string() + ":" + before).c_str(), 1);
  const auto package = freefem::package_of(file.string());
  ::setenv("PATH", before.c_str(), 1);
  if (package) {
    EXPECT_EQ(package->version, "1 of " + package->name + "\n");
  }
  return package ? package->name : "none";
}

TEST(PackageOfAProgram, IsTheFirstThatHasItsPath) {
  EXPECT_EQ(package_by("freefem++: @\n", "FreeFem++"), "freefem++");
  EXPECT_EQ(package_by("freefem++:amd64: @\n", "FreeFem++"), "freefem++:amd64");
  EXPECT_EQ(package_by("freefem++-mpi, freefem++: @\n", "FreeFem++"), "freefem++-mpi");
  EXPECT_EQ(package_by("other: @.old\nfreefem++: @\n", "FreeFem++"), "freefem++");
  EXPECT_EQ(package_by("diversion by mine from: @\ndiversion by mine to: @.real\nfreefem++: @\n",
                       "FreeFem++"),
            "mine");
  EXPECT_EQ(package_by("", "FreeFem++"), "none");
}

TEST(PackageOfAProgram, IsFoundIfThePathHasCharactersOfPatterns) {
  for (const auto* name : {"Free[Fem]", "Free*Fem", "Free?Fem", "Free\\Fem"})
    EXPECT_EQ(package_by("mine: @\n", name), "mine") << name;
}

TEST(FakeFreeFem, AnswersAsARowOfTheTable) {
  const TemporaryFolder scratch;
  const FakeFreeFem fake(scratch.path());
  const auto row = solve_row(fake.freefem(), kTabulation, 0.25, -2);
  EXPECT_NEAR(row.force / FakeFreeFem::force(1, 1, 0.25, -2), 1,
              1e-15);                       // 17 digits printed by awk
  EXPECT_NEAR(row.force_factor, 5, 1e-14);  // r/q + 1, round-off
  EXPECT_EQ(row.relative_error_estimate, 1e-6);
  EXPECT_EQ(row.degrees_of_freedom, 1000);
  EXPECT_GE(row.seconds, 0);
}

struct Failure {
  std::string name;
  std::string script;             ///< what the fake does when it is asked for a row
  std::vector<std::string> said;  ///< parts of the error
};

// What GoogleTest shows of the parameter.
std::ostream& operator<<(std::ostream& out, const Failure& failure) { return out << failure.name; }

class FailingFreeFem : public ::testing::TestWithParam<Failure> {};

TEST_P(FailingFreeFem, ErrorNamesTheRowAndItsLastLines) {
  const TemporaryFolder scratch;
  const FakeFreeFem fake(scratch.path(), GetParam().script);
  auto said = GetParam().said;
  said.insert(said.end(), {"gap 0.25", "velocity -1"});
  for (const auto& part : said)
    EXPECT_THAT(failure(ErrorKind::kExternalProgram,
                        [&] { (void)solve_row(fake.freefem(), kTabulation, 0.25, -1); }),
                AllOf(Says(part), Not(Says("\n"))));
}

INSTANTIATE_TEST_SUITE_P(
    Each, FailingFreeFem,
    ::testing::Values(
        Failure{"GarbageAndExitStatus3",
                "for i in 1 2 3 4 5 6 7 8 9; do echo \"garbage $i\"; done; exit 3\n",
                {"exit status 3", "garbage 6 | garbage 7 | garbage 8 | garbage 9"}},
        Failure{"ErrorOfTheScript",
                "echo 'viscontact-error the linear solve failed'; echo 'exit(4)'; exit 4\n",
                {"exit status 4", ": the linear solve failed"}},
        Failure{"NothingAndExitStatus0", "exit 0\n", {"exit status 0"}},
        Failure{"KilledByASignal",
                "echo 'out of memory'; kill -KILL $$\n",
                {"exit status 137", "out of memory"}},
        Failure{"ForceNotANumber",
                "echo 'viscontact-result nan 0 0 4'; exit 0\n",
                {"viscontact-result nan 0 0 4"}},
        Failure{"ForceInfinite",
                "echo 'viscontact-result -inf 0 0 4'; exit 0\n",
                {"viscontact-result -inf 0 0 4"}},
        Failure{
            "ResultCutShort", "echo 'viscontact-result 1.5'; exit 0\n", {"viscontact-result 1.5"}},
        Failure{"ResultThenAFailure",
                "echo 'viscontact-result 1.5 0 10 4'; echo 'double free'; exit 134\n",
                {"exit status 134", "double free"}}),
    [](const auto& test) { return test.param.name; });

TEST(OtherProgram, HasNoFreeFemVersion) {
  const TemporaryFolder scratch;
  put_text(scratch.path() / "other", "#!/bin/sh\necho hello\n");
  make_executable(scratch.path() / "other");
  EXPECT_THAT(
      failure(ErrorKind::kExternalProgram,
              [&] {
                (void)freefem_version({(scratch.path() / "other").string(), scratch.path()});
              }),
      Names("other"));
}

// Each would sleep for an hour without the limits.
TEST(FreeFemThatHangs, IsStoppedAtTheLimitOfItsRow) {
  const TemporaryFolder scratch;
  const FakeFreeFem fake(scratch.path(), "exec sleep 3600\n");
  auto freefem = fake.freefem();
  freefem.row_limit = std::chrono::seconds(1);
  EXPECT_THAT(failure(ErrorKind::kExternalProgram,
                      [&] { (void)solve_row(freefem, kTabulation, 0.25, -1); }),
              Names("0.25", "-1", "VISCONTACT_FREEFEM_TIME_LIMIT"));
}

TEST(FreeFemThatHangs, IsStoppedWhenItIsAskedForItsVersion) {
  const TemporaryFolder scratch;
  put_text(scratch.path() / "sleeper", "#!/bin/sh\nexec sleep 3600\n");
  make_executable(scratch.path() / "sleeper");
  FreeFem freefem{(scratch.path() / "sleeper").string(), scratch.path()};
  freefem.version_limit = std::chrono::seconds(1);
  EXPECT_THAT(failure(ErrorKind::kExternalProgram, [&] { (void)freefem_version(freefem); }),
              Names("sleeper", "1"));
}

TEST(LineAfter, IsTheRestOfTheFirstLineThatStartsSo) {
  EXPECT_EQ(line_after("x key 0\nkey 1 2\nkey 3\n", "key"), "1 2");
  EXPECT_EQ(line_after("keys 1\n", "key"), "");
}

TEST(WorkingFolder, WithFilesNamedLikeTheScriptsIncludesIsNotLookedInto) {
  const TemporaryFolder folder;
  put_text(folder.path() / "arguments.idp", "this is no script;\n");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  const auto result = run_freefem(default_freefem(), "plane.edp", {});
  std::filesystem::current_path(before);
  // plane.edp itself speaks: it was compiled with its own includes.
  EXPECT_THAT(result.output, Names("viscontact-error", "-accuracy"));
}

}  // namespace
}  // namespace viscontact::freefem_axi
