// Each in a process of its own: an interrupt cannot be taken back.
#include "viscontact/common/system/interrupt.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>  // kill and raise are POSIX
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/system/process.hpp"

namespace viscontact {
namespace {

TEST(Interrupt, IsNoneBeforeASignal) {
  EXPECT_FALSE(interrupted());
  EXPECT_NO_THROW(throw_if_interrupted());
}

/// Exit statuses of this test's own, above those that the functions below use for what must not be.
constexpr int status_of(ErrorKind kind) { return 10 + static_cast<int>(kind); }
constexpr int kInterruptedStatus = status_of(ErrorKind::kInterrupted);

void exit_with_what_a_signal_gives(int signal) {
  catch_interrupts();
  if (interrupted()) std::exit(1);
  ::raise(signal);
  if (!interrupted()) std::exit(2);
  try {
    throw_if_interrupted();
  } catch (const Error& error) {
    std::exit(status_of(error.kind()));
  }
  std::exit(3);
}

TEST(Interrupt, TurnsASignalIntoItsKindOfError) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    EXPECT_EXIT(exit_with_what_a_signal_gives(signal),
                ::testing::ExitedWithCode(kInterruptedStatus), "");
}

void exit_after_a_hangup_under_nohup() {
  ::signal(SIGHUP, SIG_IGN);  // what nohup does
  catch_interrupts();
  ::raise(SIGHUP);
  std::exit(interrupted() ? 1 : 0);
}

TEST(Interrupt, HangupThatIsIgnoredStaysIgnored) {
  EXPECT_EXIT(exit_after_a_hangup_under_nohup(), ::testing::ExitedWithCode(0), "");
}

/// Runs a child that writes its process number and would then stay for an hour; the interrupt comes once it is there.
void interrupt_a_child(const std::string& number_file) {
  catch_interrupts();
  std::thread([=] {
    pid_t child = 0;
    while (!(std::ifstream(number_file) >> child))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ::kill(::getpid(), SIGINT);
  }).detach();
  try {
    run_process({"sh", "-c", "echo $$ > " + number_file + "; exec sleep 3600"});
  } catch (const Error& error) {
    std::_Exit(status_of(error.kind()));  // the thread may still be ending
  }
  std::_Exit(1);
}

TEST(Interrupt, EndsTheChildThatIsWaitedFor) {
  const TemporaryFolder folder;
  const std::string number_file = (folder.path() / "child").string();
  EXPECT_EXIT(interrupt_a_child(number_file), ::testing::ExitedWithCode(kInterruptedStatus), "");
  pid_t child = 0;
  ASSERT_TRUE(std::ifstream(number_file) >> child);
  EXPECT_NE(::kill(child, 0), 0) << "process " << child << " is still there";
}

}  // namespace
}  // namespace viscontact
