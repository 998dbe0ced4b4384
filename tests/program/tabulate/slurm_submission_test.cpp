// What Slurm is asked for, and what becomes of its refusals: with scripts in the place of sbatch
// and squeue. Slurm itself: slurm_test.cpp.
#include <gmock/gmock.h>

#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/system/process.hpp"

namespace viscontact {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class SlurmSubmission : public ::testing::Test {
 protected:
  SlurmSubmission() {
    put_text(path("case.toml"), gentle_case_text());
    std::filesystem::create_directory(path("bin"));
    sbatch("echo '12;far'");
    squeue("true");
  }
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

  /// What sbatch does after it has written its arguments, one a line.
  void sbatch(const std::string& script) const {
    program("sbatch",
            "for word; do printf '%s\\n' \"$word\"; done > '" + path("asked") + "'\n" + script);
  }
  void squeue(const std::string& script) const { program("squeue", script); }

  ProgramResult submit(const std::vector<std::string>& options = {},
                       const std::string& output = "table.csv") const {
    std::vector<std::string> arguments = {"tabulate",   path("case.toml"), "-o",
                                          path(output), "--launcher",      "slurm"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_viscontact(arguments, {"PATH=" + path("bin") + ":/usr/bin:/bin",
                                      "VISCONTACT_FREEFEM=" + fake_.executable()});
  }
  std::string asked() const { return "\n" + read_file(path("asked")); }

  TemporaryFolder scratch_;
  freefem_axi::FakeFreeFem fake_{scratch_.path()};

 private:
  void program(const std::string& name, const std::string& script) const {
    const auto file = scratch_.path() / "bin" / name;
    put_text(file, "#!/bin/sh\n" + script + "\n");
    make_executable(file);
  }
};

TEST_F(SlurmSubmission, PrintsTheJobAndHowToGather) {
  const auto result = submit();
  expect_done(result);
  EXPECT_EQ(result.output, "12\n");
  EXPECT_THAT(result.errors,
              Names("job 12", "6 tasks", path("case.toml"), path("table.csv"), "--gather"));
  EXPECT_TRUE(fake_.answered().empty());
}

TEST_F(SlurmSubmission, OfSeveralMotionsNamesTheCaseOnceAndTheMotions) {
  const auto result = submit({"--motion", "slide,roll,spin"}, "tables");
  expect_done(result);
  EXPECT_THAT(result.errors, Names(path("case.toml"), path("tables"), "--motion", "--gather"));
  const auto script = read_file(path("tables.slurm/task.sh"));
  EXPECT_THAT(script, HasSubstr(" tabulate " + path("tables.slurm/case.toml") + " -o " +
                                path("tables") + " --motion slide,roll,spin --jobs 1"));
}

TEST_F(SlurmSubmission, AsksForATaskARowOfThisProgramWithTheCaseAsItIsNow) {
  expect_done(submit());
  EXPECT_THAT(asked(), AllOf(HasSubstr("\n--array=0-5\n"), HasSubstr("\n--requeue\n"),
                             HasSubstr("\n--output=" + path("table.csv.slurm") + "/%A_%a.log\n"),
                             EndsWith("\n" + path("table.csv.slurm/task.sh") + "\n")));
  EXPECT_EQ(read_file(path("table.csv.slurm/case.toml")), gentle_case_text());
  // The script does what it should: task 2 is row 2, whatever becomes of the case file.
  put_text(path("case.toml"), "no case");
  const auto task =
      run_process({"sh", path("table.csv.slurm/task.sh")},
                  {"SLURM_ARRAY_TASK_ID=2", "VISCONTACT_FREEFEM=" + fake_.executable()});
  EXPECT_EQ(task.exit_status, 0) << task.output;
  ASSERT_EQ(fake_.answered().size(), 1U);
  EXPECT_THAT(fake_.answered().front(), StartsWith("0.19"));
}

TEST_F(SlurmSubmission, AsksOnlyForTasksThatHaveRowsToCompute) {
  expect_done(submit());
  for (const auto* task : {"0", "3", "4"})
    EXPECT_EQ(run_process({"sh", path("table.csv.slurm/task.sh")},
                          {std::string("SLURM_ARRAY_TASK_ID=") + task,
                           "VISCONTACT_FREEFEM=" + fake_.executable()})
                  .exit_status,
              0);
  expect_done(submit());
  EXPECT_THAT(asked(), HasSubstr("\n--array=1-2,5\n"));
  expect_done(submit({"--tasks", "4"}));  // rows 1 and 5 are of task 1 of 4
  EXPECT_THAT(asked(), HasSubstr("\n--array=1-2\n"));
}

TEST_F(SlurmSubmission, WithNoRowMissingAsksForNothing) {
  expect_done(run_viscontact({"tabulate", path("case.toml"), "-o", path("table.csv")},
                             {"VISCONTACT_FREEFEM=" + fake_.executable()}));
  const auto result = submit();
  expect_done(result);
  EXPECT_EQ(result.output, "");
  EXPECT_THAT(result.errors, Names(path("table.csv"), "--gather"));
  EXPECT_FALSE(std::filesystem::exists(path("asked")));
}

TEST_F(SlurmSubmission, PassesTheUsersOptionsBeforeItsOwn) {
  expect_done(submit(
      {"--slurm-options", "--no-requeue  -A 'my account' --comment=\"it's\" ''", "--jobs", "3"}));
  EXPECT_THAT(asked(),
              AllOf(StartsWith("\n--requeue\n--no-requeue\n-A\nmy account\n--comment=it's\n\n"
                               "--parsable\n"),
                    HasSubstr("\n--cpus-per-task=3\n")));
  EXPECT_THAT(read_file(path("table.csv.slurm/task.sh")), HasSubstr("--jobs 3"));
  expect_refusal(submit({"--slurm-options", "-A 'my account"}), ErrorKind::kWrongUsage,
                 Names("-A 'my account"));
}

TEST_F(SlurmSubmission, TakesNamesThatAShellOrSlurmWouldChange) {
  const std::string odd = "it's 100 %a";
  expect_done(submit({}, odd));
  EXPECT_THAT(asked(), HasSubstr("\n--output=" + path("it's 100 %%a.slurm") + "/%A_%a.log\n"));
  const auto task =
      run_process({"sh", path(odd + ".slurm/task.sh")},
                  {"SLURM_ARRAY_TASK_ID=0", "VISCONTACT_FREEFEM=" + fake_.executable()});
  EXPECT_EQ(task.exit_status, 0) << task.output;
}

TEST_F(SlurmSubmission, SecondJobForTheSameTableIsRefusedWhileTheFirstIsNotOver) {
  // As squeue does: a line for each task, if it is asked for this job's name.
  expect_done(submit());
  const auto at = asked().find("--job-name=") + 11;
  const std::string name = asked().substr(at, asked().find('\n', at) - at);
  squeue("case \"$*\" in *--name=" + name + "*) echo 12; echo 12 ;; esac");
  std::filesystem::remove(path("asked"));
  expect_refusal(submit(), ErrorKind::kBadInput, Names("job 12", "scancel", "12"));
  EXPECT_FALSE(std::filesystem::exists(path("asked")));
  expect_done(submit({}, "another.csv"));
}

TEST_F(SlurmSubmission, RefusalBySlurmIsSaidInItsWords) {
  sbatch(
      "echo 'sbatch: error: invalid partition specified: x' >&2; echo 'sbatch: error: no' >&2; "
      "exit 1");
  expect_refusal(submit(), ErrorKind::kExternalProgram, Names("sbatch", "exit status 1"));
}

TEST_F(SlurmSubmission, MissingSlurmIsSaidWithWhatToDo) {
  std::filesystem::remove_all(path("bin"));
  const TemporaryFolder empty;
  const auto result = run_viscontact(
      {"tabulate", path("case.toml"), "-o", path("table.csv"), "--launcher", "slurm"},
      {"PATH=" + empty.path().string()});
  expect_refusal(result, ErrorKind::kExternalProgram, Names("apt-get install slurm-client"));
}

}  // namespace
}  // namespace viscontact
