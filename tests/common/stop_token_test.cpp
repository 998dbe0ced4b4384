// The token that stops long computations, and the child process that it ends.
#include "viscontact/common/stop_token.hpp"

#include <gtest/gtest.h>
#include <signal.h>  // kill is POSIX

#include <atomic>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/system/process.hpp"

namespace viscontact {
namespace {

TEST(StopToken, NeverStopsByDefault) {
  EXPECT_FALSE(StopToken().stop_requested());
  EXPECT_NO_THROW(StopToken().throw_if_stop_requested());
}

TEST(StopToken, AndItsCopiesSeeTheFlag) {
  std::atomic<bool> flag = false;
  const StopToken token(flag);
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): the copy is tested
  const StopToken copy = token;
  EXPECT_NO_THROW(copy.throw_if_stop_requested());
  flag = true;
  EXPECT_TRUE(copy.stop_requested());
  failure(ErrorKind::kInterrupted, [&] { token.throw_if_stop_requested(); });
}

TEST(StopToken, EndsTheChildThatIsWaitedFor) {
  const TemporaryFolder folder;
  const std::string number_file = (folder.path() / "child").string();
  std::atomic<bool> flag = false;
  pid_t child = 0;
  // The child writes its process number and would then stay for an hour.
  const std::jthread stopper([&] {
    while (!(std::ifstream(number_file) >> child))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    flag = true;
  });
  failure(ErrorKind::kInterrupted, [&] {
    run_process({"sh", "-c", "echo $$ > " + number_file + "; exec sleep 3600"}, {}, {}, {}, {},
                StopToken(flag));
  });
  EXPECT_NE(::kill(child, 0), 0) << "process " << child << " is still there";
}

}  // namespace
}  // namespace viscontact
