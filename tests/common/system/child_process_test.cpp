#include "viscontact/common/system/child_process.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"

namespace viscontact {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using State = ChildProcess::State;

/// A shell that is asked, and reads of its words that must come within ten minutes.
class Shell : public ChildProcess {
 public:
  explicit Shell(const std::string& script, const StopToken& stop = {})
      : ChildProcess({{"sh", "-c", script}}, stop) {}

  std::string word() {
    const auto reading = read_word(Clock::now() + 10min);
    EXPECT_EQ(reading.state, State::kRead);
    return std::string(reading.text);
  }
  std::string line() {
    const auto reading = read_line(Clock::now() + 10min);
    EXPECT_EQ(reading.state, State::kRead);
    return std::string(reading.text);
  }
  State state_of_next_word(std::chrono::milliseconds limit = 10min) {
    return read_word(Clock::now() + limit).state;
  }
};

/// Whether a process runs, and is not a zombie that nobody has waited for.
bool is_running(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string number, name, state;
  return file >> number >> name >> state && state != "Z";
}

bool ends_within_seconds(pid_t process) {
  for (int i = 0; i < 100 && is_running(process); ++i) std::this_thread::sleep_for(50ms);
  return !is_running(process);
}

TEST(ChildProcess, AnswersManyTimes) {
  Shell shell("while read a b; do echo \"$b\t $a\"; done");
  for (int i = 0; i < 100; ++i) {
    shell.send(std::to_string(i) + " word\n");
    EXPECT_EQ(shell.word(), "word");
    EXPECT_EQ(shell.word(), std::to_string(i));
  }
  EXPECT_FALSE(shell.has_unread_output());
  EXPECT_EQ(shell.finish(10min), "ended with status 0");
}

TEST(ChildProcess, TellsThePeakOfItsMemory) {
  Shell shell("x=$(head -c 32000000 /dev/zero | tr '\\0' x); x=; echo done; read wait");
  EXPECT_EQ(shell.word(), "done");
  EXPECT_GE(shell.peak_memory_kb(), 32'000'000 / 1024);
  EXPECT_LT(shell.peak_memory_kb(), 1'000'000);
  shell.finish(10min);
  EXPECT_EQ(shell.peak_memory_kb(), 0);
}

TEST(ChildProcess, GivesLinesAndPutsAWordBack) {
  Shell shell("printf 'first line\\n second  3\\n'; read end");
  EXPECT_EQ(shell.word(), "first");
  shell.put_word_back();
  EXPECT_EQ(shell.line(), "first line");
  EXPECT_EQ(shell.word(), "second");
  EXPECT_EQ(shell.line(), "  3");
}

TEST(ChildProcess, TalksBothWaysWithoutDeadlock) {
  // Either pipe holds about 200 kB: to send all before reading would wait for ever.
  Shell shell("exec cat");
  std::string text;
  constexpr int kWords = 500'000;
  for (int i = 0; i < kWords; ++i) text += std::to_string(i) + "\n";
  shell.send(text);
  for (int i = 0; i < kWords; ++i) ASSERT_EQ(shell.word(), std::to_string(i));
}

TEST(ChildProcess, MayWriteMuchBeforeItReadsAndToItsErrors) {
  Shell shell("seq 200000 >&2; seq 200000; read word; echo $word");
  shell.send("asked\n");
  for (int i = 1; i <= 200'000; ++i) ASSERT_EQ(shell.word(), std::to_string(i));
  EXPECT_EQ(shell.word(), "asked");
  EXPECT_EQ(shell.finish(10min), "ended with status 0");
  const auto lines = shell.last_lines();
  ASSERT_EQ(lines.size(), LastLines::kLines);
  EXPECT_EQ(lines.front(), "199981");
  EXPECT_EQ(lines.back(), "200000");
}

TEST(ChildProcess, ThatDoesNotReadDoesNotEndUs) {
  // Writing to it raises SIGPIPE, which by default would end this process without a word.
  EXPECT_EXIT(
      {
        ChildProcess child({{"sh", "-c", "exec <&-; sleep 0.1; exit 3"}}, {});
        child.send(std::string(1'000'000, 'x'));
        const bool closed =
            child.read_word(ChildProcess::Clock::now() + 10min).state == State::kClosed;
        std::exit(closed && child.finish(10min) == "ended with status 3" ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST(ChildProcess, SaysHowItEnded) {
  Shell status("exit 7");
  EXPECT_EQ(status.state_of_next_word(), State::kClosed);
  EXPECT_EQ(status.finish(10min), "ended with status 7");
  Shell crash("echo before; kill -SEGV $$");
  EXPECT_EQ(crash.word(), "before");
  EXPECT_EQ(crash.state_of_next_word(), State::kClosed);
  EXPECT_EQ(crash.finish(10min), "ended by signal 11 (Segmentation fault)");
  Shell sleeper("exec sleep 3600");
  EXPECT_EQ(sleeper.finish(50ms), "had to be stopped");
}

TEST(ChildProcess, KeepsWhatWasNotRead) {
  Shell shell("echo error one >&2; echo read; echo; echo not read; printf end");
  EXPECT_EQ(shell.word(), "read");
  shell.finish(10min);
  EXPECT_THAT(shell.last_lines(), ElementsAre("error one", "not read", "end"));
}

TEST(ChildProcess, AWordThatTheEndCutsOffDoesNotCount) {
  Shell shell("printf 'whole 1.23'");
  EXPECT_EQ(shell.word(), "whole");
  EXPECT_EQ(shell.state_of_next_word(), State::kClosed);
  Shell line("printf 'error half a line'");
  EXPECT_EQ(line.word(), "error");
  const auto rest = line.read_line(ChildProcess::Clock::now() + 10min);
  EXPECT_EQ(rest.state, State::kClosed);
  EXPECT_EQ(rest.text, " half a line");
}

TEST(ChildProcess, AWordWithoutEndIsGivenUp) {
  Shell shell("exec cat /dev/zero");
  EXPECT_EQ(shell.state_of_next_word(), State::kTooLong);
  EXPECT_EQ(shell.finish(0ms), "had to be stopped");
  Shell exact(
      "head -c 4096 /dev/zero | tr '\\0' x; echo; head -c 4097 /dev/zero | tr '\\0' x; echo");
  EXPECT_EQ(exact.word(), std::string(ChildProcess::kLongestText, 'x'));
  EXPECT_EQ(exact.state_of_next_word(), State::kTooLong);
}

TEST(ChildProcess, ASilentOneMeetsTheDeadline) {
  Shell shell("exec sleep 3600");
  EXPECT_EQ(shell.state_of_next_word(50ms), State::kTimedOut);
  Shell closed("exec >&- 2>&-; exec sleep 3600");
  EXPECT_EQ(closed.state_of_next_word(), State::kClosed);
  EXPECT_EQ(closed.finish(50ms), "had to be stopped");
}

TEST(ChildProcess, AStopRequestEndsTheWaiting) {
  std::atomic<bool> stop = false;
  Shell shell("exec sleep 3600", StopToken(stop));
  stop = true;
  failure(ErrorKind::kInterrupted, [&] { shell.state_of_next_word(); });
  EXPECT_EQ(shell.finish(10min), "had to be stopped");
}

TEST(ChildProcess, SaysThatAProgramIsMissing) {
  EXPECT_THAT(failure(ErrorKind::kExternalProgram,
                      [] { const ChildProcess child({{"viscontact-no-such-program"}}, {}); }),
              Names("viscontact-no-such-program"));
}

TEST(ChildProcess, GetsItsEnvironmentAndFolder) {
  const TemporaryFolder folder;
  ChildProcess child({{"sh", "-c", "echo $ADDED; pwd -P"}, {"ADDED=value"}, folder.path().string()},
                     {});
  EXPECT_EQ(child.read_word(ChildProcess::Clock::now() + 10min).text, "value");
  EXPECT_EQ(child.read_word(ChildProcess::Clock::now() + 10min).text,
            std::filesystem::canonical(folder.path()).string());
}

TEST(ChildProcess, EndsWithItsObjectAndTheProcessesThatItHasStarted) {
  pid_t child = 0, grandchild = 0;
  {
    Shell shell("sleep 3600 & echo $$ $!; wait");
    child = std::stoi(shell.word());
    grandchild = std::stoi(shell.word());
    EXPECT_TRUE(is_running(child));
    EXPECT_TRUE(is_running(grandchild));
  }
  EXPECT_FALSE(is_running(child));
  EXPECT_TRUE(ends_within_seconds(grandchild));
}

TEST(ChildProcess, ThatEndsLeavesNoProcessBehind) {
  // sh ends at once; sleep keeps its output open.
  Shell shell("sleep 3600 & echo $!");
  const pid_t grandchild = std::stoi(shell.word());
  EXPECT_EQ(shell.finish(10min), "ended with status 0");
  EXPECT_TRUE(ends_within_seconds(grandchild));
}

TEST(ChildProcess, DiesWithUsEvenIfWeAreKilled) {
  // A process of ours starts a child that would take an hour, and is killed by it.
  const TemporaryFolder folder;
  const auto pid_file = folder.path() / "pid";
  const pid_t middle = ::fork();
  if (middle == 0) {
    Shell shell("echo $$ > '" + pid_file.string() + "'; kill -KILL $PPID; exec sleep 3600");
    shell.state_of_next_word();
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(middle, &status, 0), middle);
  EXPECT_TRUE(WIFSIGNALED(status));
  pid_t child = 0;
  std::ifstream(pid_file) >> child;
  ASSERT_GT(child, 0);
  EXPECT_TRUE(ends_within_seconds(child));
}

TEST(ChildProcess, LeavesNoDescriptorOpen) {
  const auto count = [] {
    std::size_t open = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
      ++open;
    return open;
  };
  const auto before = count();
  {
    Shell destroyed("exec sleep 3600");
    Shell finished("exit 0");
    finished.finish(10min);
    EXPECT_EQ(count(), before + 3);
  }
  EXPECT_EQ(count(), before);
}

TEST(LastLines, KeepsTheLastOfBothStreams) {
  LastLines lines;
  lines.add(LastLines::kErrors, "one\n\n  \ntw");
  lines.add(LastLines::kOutput, "three");
  lines.add(LastLines::kErrors, "o\n");
  EXPECT_THAT(lines.lines(), ElementsAre("one", "two", "three"));
  lines.add(LastLines::kOutput, std::string(10 * LastLines::kLongest, '.') + "\nshort\n");
  EXPECT_EQ(lines.lines()[2], "three" + std::string(LastLines::kLongest - 5, '.'));
  EXPECT_EQ(lines.lines()[3], "short");
}

}  // namespace
}  // namespace viscontact
