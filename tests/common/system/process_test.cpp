#include "viscontact/common/system/process.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>

#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

using ::testing::HasSubstr;

ProcessResult shell(const std::string& script, const std::vector<std::string>& environment = {},
                    const std::string& input = {}) {
  return run_process({"sh", "-c", script}, environment, input);
}

/// Lines of text, `size` bytes in all: more than the 64 KiB that a pipe holds.
std::string large_input(std::size_t size) {
  std::string text;
  for (std::size_t i = 0; text.size() < size; ++i) text += "line " + std::to_string(i) + "\n";
  return text;
}

TEST(Process, GivesOutputAndErrorsAsTheyCame) {
  const auto result = shell("echo one; echo two >&2; echo three");
  EXPECT_TRUE(result.started);
  EXPECT_EQ(result.exit_status, 0);
  EXPECT_EQ(result.output, "one\ntwo\nthree\n");
}

TEST(Process, GivesTheExitStatus) {
  EXPECT_EQ(shell("exit 0").exit_status, 0);
  EXPECT_EQ(shell("exit 7").exit_status, 7);
}

TEST(Process, GivesTheSignalThatEndedIt) {
  EXPECT_EQ(shell("kill -KILL $$").exit_status, 128 + SIGKILL);
  EXPECT_EQ(shell("echo before; kill -SEGV $$").output,
            "before\nended by signal 11 (Segmentation fault)\n");
}

TEST(Process, SaysThatAProgramIsMissing) {
  const auto result = run_process({"viscontact-no-such-program"});
  EXPECT_FALSE(result.started);
  EXPECT_NE(result.exit_status, 0);
  EXPECT_THAT(result.output, HasSubstr("No such file"));
}

TEST(Process, SaysThatAFileMayNotBeRun) {
  const TemporaryFolder folder;
  const auto result = run_process(
      {folder.file("text", "no program\n").string()});  // not executable, for root neither
  EXPECT_FALSE(result.started);
  EXPECT_THAT(result.output, HasSubstr("Permission denied"));
}

TEST(Process, PassesArgumentsAsTheyAre) {
  const auto result = run_process({"printf", "%s|", "two words", "", "$HOME;*", "'\""});
  EXPECT_EQ(result.output, "two words||$HOME;*|'\"|");
}

TEST(Process, AddsToTheEnvironmentAndKeepsTheRest) {
  const auto result = shell("echo \"$ADDED\"; test -n \"$PATH\" && echo kept", {"ADDED=a b=c"});
  EXPECT_EQ(result.output, "a b=c\nkept\n");
}

TEST(Process, ReplacesAVariableThatIsSetAlready) {
  const auto result = run_process({"env"}, {"HOME=elsewhere"});
  EXPECT_THAT(result.output, HasSubstr("HOME=elsewhere\n"));
  std::size_t count = 0;
  const std::string lines = "\n" + result.output;
  for (auto at = lines.find("\nHOME="); at != std::string::npos; at = lines.find("\nHOME=", at + 1))
    ++count;
  EXPECT_EQ(count, 1U);
}

TEST(Process, RunsInTheFolderThatItIsGiven) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_process({"pwd", "-P"}, {}, {}, folder.path().string()).output,
            std::filesystem::canonical(folder.path()).string() + "\n");
  const auto nowhere = run_process({"pwd"}, {}, {}, (folder.path() / "none").string());
  EXPECT_FALSE(nowhere.started);
  EXPECT_THAT(nowhere.output, HasSubstr("No such file"));
}

TEST(Process, HasNoInputUnlessGiven) { EXPECT_EQ(shell("cat; echo end").output, "end\n"); }

TEST(Process, TalksBothWaysWithoutDeadlock) {
  // Either pipe holds 64 KiB: to write all before reading, or the reverse, would wait for ever.
  const std::string input = large_input(4'000'000);
  const auto result = run_process({"cat"}, {}, input);
  EXPECT_EQ(result.exit_status, 0);
  EXPECT_TRUE(result.output == input)
      << result.output.size() << " bytes came back of " << input.size();
}

TEST(Process, MayAnswerOnlyWhenAllIsReadOrTalkBeforeItReads) {
  const std::string input = large_input(1'000'000);
  EXPECT_TRUE(shell("content=$(cat; echo .); printf %s \"${content%.}\"", {}, input).output ==
              input);
  const auto result = shell("head -c 1000000 /dev/zero | tr '\\0' x; wc -c", {}, input);
  EXPECT_EQ(result.output.substr(0, 1'000'000), std::string(1'000'000, 'x'));
  EXPECT_THAT(result.output.substr(1'000'000), HasSubstr(std::to_string(input.size())));
}

TEST(Process, ThatDoesNotReadItsInputDoesNotEndUs) {
  // Writing to it raises SIGPIPE, which by default would end this process without a word.
  const std::string input = large_input(1'000'000);
  EXPECT_EXIT(
      {
        const auto result = shell("exec <&-; echo not reading; exit 3", {}, input);
        std::exit(result.exit_status == 3 && result.output == "not reading\n" ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST(Process, ReportsTheMemoryOfTheChild) {
  // A shell variable of 32 MB takes that much at least, in kB.
  const auto result = shell("x=$(head -c 32000000 /dev/zero | tr '\\0' x); echo ${#x}");
  EXPECT_EQ(result.output, "32000000\n");
  EXPECT_GE(result.peak_memory_kb, 32'000'000 / 1024);
}

// What each of these does would take an hour without the limit. None asserts how long it takes.
TEST(ProcessWithATimeLimit, IsKilledWithTheProcessesThatItHasStarted) {
  const TemporaryFolder folder;
  const auto pid_file = (folder.path() / "pid").string();
  const auto result =
      run_process({"sh", "-c", "echo before; sleep 3600 & echo $! > '" + pid_file + "'; wait"}, {},
                  {}, {}, std::chrono::milliseconds(500));
  EXPECT_TRUE(result.timed_out);
  EXPECT_EQ(result.exit_status, 128 + SIGKILL);
  EXPECT_THAT(result.output, HasSubstr("before\n"));
  pid_t grandchild = 0;
  ASSERT_TRUE(std::ifstream(pid_file) >> grandchild);
  // It is gone, or a zombie that init has not waited for, within moments.
  const auto is_running = [&] {
    std::ifstream file("/proc/" + std::to_string(grandchild) + "/stat");
    std::string number, name, state;
    return file >> number >> name >> state && state != "Z";
  };
  for (int i = 0; i < 100 && is_running(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(is_running());
}

TEST(ProcessWithATimeLimit, IsKilledIfItHasClosedItsOutputAndStays) {
  const auto result = run_process({"sh", "-c", "exec >&- 2>&-; exec sleep 3600"}, {}, {}, {},
                                  std::chrono::milliseconds(500));
  EXPECT_TRUE(result.timed_out);
}

TEST(ProcessWithATimeLimit, EndsThoughAnotherProcessHoldsItsOutput) {
  // sh ends at once; sleep keeps the output open.
  const auto result = run_process({"sh", "-c", "echo done; sleep 3600 &"}, {}, {}, {},
                                  std::chrono::milliseconds(500));
  EXPECT_TRUE(result.timed_out);
  EXPECT_THAT(result.output, HasSubstr("done\n"));
}

TEST(ProcessWithATimeLimit, IsAsWithoutIfItEndsInTime) {
  const auto result =
      run_process({"sh", "-c", "cat; exit 7"}, {}, "input", {}, std::chrono::minutes(10));
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.exit_status, 7);
  EXPECT_EQ(result.output, "input");
}

TEST(Process, HasAllItsStreamsIfThisProcessHasNone) {
  const TemporaryFolder folder;
  const auto said = folder.path() / "said";
  const pid_t without_streams = ::fork();
  ASSERT_GE(without_streams, 0);
  if (without_streams == 0) {
    for (const int stream : {0, 1, 2}) ::close(stream);
    const auto result = shell("cat; echo errors >&2", {}, "input\n");
    std::ofstream(said) << result.output;
    ::_exit(result.exit_status);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(without_streams, &status, 0), without_streams);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(read_file(said), "input\nerrors\n");
}

TEST(Process, LeavesNoDescriptorOpen) {
  const auto count = [] {
    std::size_t open = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
      ++open;
    return open;
  };
  const auto before = count();
  shell("true");
  run_process({"viscontact-no-such-program"});
  EXPECT_EQ(count(), before);
}

}  // namespace
}  // namespace viscontact
