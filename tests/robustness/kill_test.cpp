// SIGKILL at any moment: outputs are absent or whole, and the same command then finishes. The suite
// kills a few times; scripts/kill_test kills VISCONTACT_KILLS times (VISCONTACT_KILL_FREEFEM).
#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/robustness/whole_outputs.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

int kills() {
  const char* asked = std::getenv("VISCONTACT_KILLS");
  return asked != nullptr ? std::atoi(asked) : 2;
}

class Kill : public ::testing::Test {
 protected:
  // Rows that take a while, so that there is a moment to be killed in.
  Kill() : fake_(scratch_.path(), "sleep 0.05") {
    const fs::path data = VISCONTACT_SOURCE_FOLDER "/data";
    put_text(path("case.toml"), quick_case_text());
    put_text(path("sweep.toml"), replaced(read_file(data / "cases" / "vanishing_viscosity.toml"),
                                          "../fits", data / "fits"));
    if (std::getenv("VISCONTACT_KILL_FREEFEM") == nullptr)
      ::setenv("VISCONTACT_FREEFEM", fake_.executable().c_str(), 1);
  }
  ~Kill() override {
    if (std::getenv("VISCONTACT_KILL_FREEFEM") == nullptr) ::unsetenv("VISCONTACT_FREEFEM");
  }

  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

  /// Starts the command and kills it after that time, if it is not done before. Children are not
  /// killed: they have to end with it.
  void run_and_kill(const std::vector<std::string>& arguments, Clock::duration after) const {
    std::vector<const char*> argv = {VISCONTACT_EXECUTABLE};
    for (const auto& argument : arguments) argv.push_back(argument.c_str());
    argv.push_back(nullptr);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
      for (const int descriptor : {0, 1, 2}) ::dup2(nowhere, descriptor);
      ::execv(VISCONTACT_EXECUTABLE, const_cast<char* const*>(argv.data()));
      ::_exit(127);
    }
    std::this_thread::sleep_for(after);
    ::kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0);
    killed_ += WIFSIGNALED(status) ? 1 : 0;
  }

  /// Kills the command again and again, each time from an empty folder `out`, where all of its
  /// outputs go. A run that was done before its moment came counts for nothing: another moment is
  /// drawn, before the end of the fastest run seen.
  void kill_again_and_again(const std::vector<std::string>& arguments) {
    auto whole_run = time_of_whole_run(arguments);
    const std::string undisturbed = numbers_below(path("out"));
    constexpr unsigned kSeed = 20080131;
    constexpr int kAttemptsPerKill =
        20;  // a moment misses only when this run is much faster than any before
    std::mt19937 random(kSeed);
    int attempts = 0;
    for (; killed_ < kills() && attempts < kAttemptsPerKill * kills() && !HasFailure();
         ++attempts) {
      SCOPED_TRACE("attempt " + std::to_string(attempts));
      fs::remove_all(path("out"));
      const double share = static_cast<double>(random()) / std::mt19937::max();
      run_and_kill(arguments, std::chrono::duration_cast<Clock::duration>(share * whole_run));
      expect_whole_files(path("out"));
      const int left = unfinished_below(path("out"));
      EXPECT_LE(left, 1);
      left_behind_ += left;
      whole_run = std::min(whole_run, time_of_whole_run(arguments));
      EXPECT_EQ(unfinished_below(path("out")), 0) << "what a killed run left is not taken away";
      EXPECT_EQ(numbers_below(path("out")), undisturbed);
    }
    std::printf(
        "%d of %d runs of %.1f s killed, seed %u; %d left an unfinished file beside its place\n",
        killed_, attempts, std::chrono::duration<double>(whole_run).count(), kSeed, left_behind_);
    EXPECT_EQ(killed_, kills()) << "most runs were done before they were to be killed";
  }

  /// Runs the command to its end, which has to be a good one, with whole files.
  Clock::duration time_of_whole_run(const std::vector<std::string>& arguments) const {
    const auto start = Clock::now();
    expect_done(run_viscontact(arguments));
    const auto time = Clock::now() - start;
    expect_whole_files(path("out"));
    return time;
  }

  TemporaryFolder scratch_;
  freefem_axi::FakeFreeFem fake_;
  mutable int killed_ = 0;
  int left_behind_ = 0;
};

TEST_F(Kill, Run) {
  kill_again_and_again({"run", path("case.toml"), "-o", path("out"), "--jobs", "2"});
}

TEST_F(Kill, Tabulate) {
  kill_again_and_again({"tabulate", path("case.toml"), "-o", path("out/table.csv"), "--jobs", "2"});
}

TEST_F(Kill, Sweep) {
  kill_again_and_again({"sweep", path("sweep.toml"), "-o", path("out/sweep.csv"), "--plot",
                        path("out/sweep.svg"), "--jobs", "2"});
}

TEST_F(Kill, Particles) {
  const fs::path cases = VISCONTACT_SOURCE_FOLDER "/data/cases/particles";
  put_text(path("settling.csv"), read_file(cases / "settling.csv"));
  put_text(path("settling.toml"),
           replaced(read_file(cases / "settling.toml"), "end_time = 20.0", "end_time = 4.0"));
  kill_again_and_again({"particles", path("settling.toml"), "-o", path("out")});
}

}  // namespace
}  // namespace viscontact
