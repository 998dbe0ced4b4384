// Progress line and colours by ANSI escape sequences.
#include "viscontact/terminal/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <cstdlib>

namespace viscontact::terminal {
namespace {

constexpr const char* kEraseLine = "\r\033[K";

/// Free choices of progress reports.
struct ProgressTuning {
  // Time between two lines of a log, and between two changes of the line of a terminal.
  static constexpr auto kBetweenLines = std::chrono::minutes(1);
  static constexpr auto kBetweenChanges = std::chrono::milliseconds(100);
  // Time [s] from which on there is an estimate of the time left. Above the other two the time is
  // given in minutes or in hours, which are then easier to read.
  static constexpr double kTooShort = 2, kInMinutes = 90, kInHours = 5400;
};

// Number of objects of QuietThread in this thread.
thread_local int quiet_objects = 0;

bool understands_escapes(int descriptor) {
  const char* terminal = std::getenv("TERM");
  return ::isatty(descriptor) != 0 && (terminal == nullptr || std::string_view(terminal) != "dumb");
}

}  // namespace

void show_progress(const std::string& text) {
  if (quiet_objects > 0) return;
  if (understands_escapes(STDERR_FILENO)) {
    std::fputs((kEraseLine + text).c_str(), stderr);
    std::fflush(stderr);
    return;
  }
  static ProgressLines lines;
  if (!text.empty() && lines.is_due(ProgressLines::Clock::now())) say(text);
}

bool ProgressLines::is_due(Clock::time_point now) {
  const std::scoped_lock lock(mutex_);
  if (!last_) last_ = now;
  if (now - *last_ < ProgressTuning::kBetweenLines) return false;
  last_ = now;
  return true;
}

bool ProgressTimer::is_due() {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < ProgressTuning::kBetweenChanges) return false;
  last_ = now;
  return true;
}

std::string time_left(double seconds, double done) {
  assert(seconds >= 0);
  if (seconds < ProgressTuning::kTooShort || !(done > 0)) return "";
  const double left = seconds * std::max(0.0, 1 / done - 1);
  if (left > ProgressTuning::kInHours) return fmt::format(", about {:.1f} h left", left / 3600);
  if (left > ProgressTuning::kInMinutes) return fmt::format(", about {:.0f} min left", left / 60);
  return fmt::format(", about {:.0f} s left", left);
}

void clear_progress() { show_progress(""); }

void say(const std::string& text) {
  // If standard error is closed or full, only the message is lost.
  if (quiet_objects == 0) std::fputs((text + "\n").c_str(), stderr);
}

void warn(const std::string& text) {
  constexpr std::string_view kWord = "warning:";
  const auto at = text.find(kWord);
  if (at == std::string::npos) return say(text);
  say(text.substr(0, at) + coloured(kWord, Colour::kYellow, STDERR_FILENO) +
      text.substr(at + kWord.size()));
}

void complain(const std::string& text) {
  const auto end = text.find(' ');
  if (end == std::string::npos) return say(text);
  say(coloured(text.substr(0, end), Colour::kRed, STDERR_FILENO) + text.substr(end));
}

QuietThread::QuietThread() { ++quiet_objects; }
QuietThread::~QuietThread() {
  assert(quiet_objects > 0);
  --quiet_objects;
}

std::string coloured(std::string_view word, Colour colour, int descriptor) {
  const char* refused = std::getenv("NO_COLOR");
  if ((refused != nullptr && *refused != '\0') || !understands_escapes(descriptor))
    return std::string(word);
  return fmt::format("\033[{}m{}\033[0m", static_cast<int>(colour), word);
}

}  // namespace viscontact::terminal
