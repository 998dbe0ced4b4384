// Writes the progress line and coloured messages to standard error, with ANSI escape sequences, for
// all commands: app/, motions/, particles/, pipeline/, report/, rolling/ and swimmer/ call these
// functions. Times are in seconds, >= 0. A share of the work is from 0 to 1; if the share is 0 or
// NaN, there is no estimate of the time left. No failure is reported: a message that cannot be
// written is lost. A change must keep that a file, or a terminal with TERM=dumb, gets no escape
// sequences.
#include "viscontact/terminal/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace viscontact::terminal {
namespace {

constexpr const char* kEraseLine = "\r\033[K";

// The number of objects of QuietThread in this thread. If it is > 0, nothing is written.
thread_local int quiet_objects = 0;

/// True if the file descriptor is a terminal that understands escape sequences.
bool understands_escapes(int descriptor) {
  const char* terminal = std::getenv("TERM");
  return ::isatty(descriptor) != 0 && (terminal == nullptr || std::string_view(terminal) != "dumb");
}

}  // namespace

/// Shows `text` as the progress line of a terminal, in place of the line before; an empty text
/// removes the line. Elsewhere `text` is written at most once a minute.
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

/// True if at least a minute has passed since the first call or since the last call that returned
/// true. Several threads may call this function.
bool ProgressLines::is_due(Clock::time_point now) {
  // A free choice, which progress.hpp states.
  constexpr auto kBetween = std::chrono::minutes(1);
  const std::scoped_lock lock(mutex_);
  if (!last_) last_ = now;
  if (now - *last_ < kBetween) return false;
  last_ = now;
  return true;
}

/// True if at least a tenth of a second has passed since the last call that returned true.
bool ProgressTimer::is_due() {
  // A free choice, which progress.hpp states.
  constexpr auto kBetween = std::chrono::milliseconds(100);
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < kBetween) return false;
  last_ = now;
  return true;
}

/// The time left in words, such as ", about 3 min left", if the share `done` of the work took
/// `seconds` [s]. The text is empty in the first two seconds, and if `done` is not > 0.
std::string time_left(double seconds, double done) {
  // Limits [s], which are free choices. Before the first one there is no estimate. Above the others
  // the time is given in minutes or in hours, which are then easier to read.
  constexpr double kTooShort = 2, kInMinutes = 90, kInHours = 5400;
  if (seconds < kTooShort || !(done > 0)) return "";
  const double left = seconds * std::max(0.0, 1 / done - 1);
  if (left > kInHours) return fmt::format(", about {:.1f} h left", left / 3600);
  if (left > kInMinutes) return fmt::format(", about {:.0f} min left", left / 60);
  return fmt::format(", about {:.0f} s left", left);
}

void clear_progress() { show_progress(""); }

// Errors of fputs are ignored: if standard error is closed or full, only the message is lost.
void say(const std::string& text) {
  if (quiet_objects == 0) std::fputs((text + "\n").c_str(), stderr);
}

/// Writes the text as a line, with the first "warning:" in yellow.
void warn(const std::string& text) {
  constexpr std::string_view kWord = "warning:";
  const auto at = text.find(kWord);
  if (at == std::string::npos) return say(text);
  say(text.substr(0, at) + coloured(kWord, Colour::kYellow, STDERR_FILENO) +
      text.substr(at + kWord.size()));
}

/// Writes the text as a line, with its first word in red if another word follows.
void complain(const std::string& text) {
  const auto end = text.find(' ');
  if (end == std::string::npos) return say(text);
  say(coloured(text.substr(0, end), Colour::kRed, STDERR_FILENO) + text.substr(end));
}

// While an object of QuietThread exists, the functions of this file write nothing in its thread.
QuietThread::QuietThread() { ++quiet_objects; }
QuietThread::~QuietThread() { --quiet_objects; }

/// The word with the escape sequences of the colour. It is unchanged if the environment variable
/// NO_COLOR is set and not empty, or if understands_escapes(descriptor) is false.
std::string coloured(std::string_view word, Colour colour, int descriptor) {
  const char* refused = std::getenv("NO_COLOR");
  if ((refused != nullptr && *refused != '\0') || !understands_escapes(descriptor))
    return std::string(word);
  return fmt::format("\033[{}m{}\033[0m", static_cast<int>(colour), word);
}

}  // namespace viscontact::terminal
