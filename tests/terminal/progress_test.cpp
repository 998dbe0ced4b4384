#include "viscontact/terminal/progress.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>
#include <thread>

namespace viscontact::terminal {
namespace {

/// What `call` writes to standard error, which is a file meanwhile.
std::string said_by(const std::function<void()>& call) {
  ::testing::internal::CaptureStderr();
  call();
  return ::testing::internal::GetCapturedStderr();
}

/// A terminal of its own.
class Terminal {
 public:
  Terminal() : controller_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    if (controller_ >= 0 && ::grantpt(controller_) == 0 && ::unlockpt(controller_) == 0)
      descriptor_ = ::open(::ptsname(controller_), O_RDWR | O_NOCTTY);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal() {
    ::close(descriptor_);
    ::close(controller_);
  }
  int descriptor() const { return descriptor_; }

 private:
  int controller_;
  int descriptor_ = -1;
};

TEST(Progress, IsNotShownWithoutATerminal) {
  EXPECT_EQ(said_by([] {
              show_progress("row 1 of 2");
              clear_progress();
            }),
            "");
}

TEST(Progress, IsALineOnceAMinuteWithoutATerminal) {
  ProgressLines lines;
  const auto start = ProgressLines::Clock::now();
  const auto at = [&](int seconds) { return lines.is_due(start + std::chrono::seconds(seconds)); };
  EXPECT_FALSE(at(0));
  EXPECT_FALSE(at(59));
  EXPECT_TRUE(at(60));
  EXPECT_FALSE(at(61));
  EXPECT_FALSE(at(119));
  EXPECT_TRUE(at(150));
  EXPECT_FALSE(at(209));
  EXPECT_TRUE(at(210));
}

TEST(Progress, IsDueOnceInATenthOfASecond) {
  ProgressTimer timer;
  EXPECT_FALSE(timer.is_due());
  std::this_thread::sleep_for(std::chrono::milliseconds(110));
  EXPECT_TRUE(timer.is_due());
}

TEST(Messages, ArePlainTextWithoutATerminal) {
  EXPECT_EQ(said_by([] {
              say("tabulate: 2 rows");
              warn("case.toml: warning: an odd key");
              complain("viscontact: no such case");
            }),
            "tabulate: 2 rows\ncase.toml: warning: an odd key\nviscontact: no such case\n");
}

TEST(Words, AreColouredOnATerminalUnlessThatIsRefused) {
  const Terminal terminal;
  ASSERT_TRUE(::isatty(terminal.descriptor()));
  const auto word = [&](const char* term, const char* no_color) {
    ::setenv("TERM", term, 1);
    ::setenv("NO_COLOR", no_color, 1);
    return coloured("failed", Colour::kRed, terminal.descriptor());
  };
  EXPECT_EQ(word("xterm", ""), "\033[31mfailed\033[0m");  // an empty NO_COLOR refuses nothing
  EXPECT_EQ(word("xterm", "1"), "failed");
  EXPECT_EQ(word("dumb", ""), "failed");
}

TEST(TimeLeft, IsInUnitsThatAreEasyToRead) {
  EXPECT_EQ(time_left(10, 0.5), ", about 10 s left");
  EXPECT_EQ(time_left(60, 0.25), ", about 3 min left");
  EXPECT_EQ(time_left(3600, 0.2), ", about 4.0 h left");
  EXPECT_EQ(time_left(10, 1), ", about 0 s left");
  // Nothing can be told from the first second, nor before anything is done.
  EXPECT_EQ(time_left(1, 0.5), "");
  EXPECT_EQ(time_left(10, 0), "");
}

}  // namespace
}  // namespace viscontact::terminal
