// What a person at a terminal sees on standard error: a progress line, and messages with coloured
// words. Elsewhere messages are plain text. A message that cannot be written is lost.
#pragma once

#include <fmt/core.h>

#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace viscontact::terminal {

/// Replaces the progress line by `text` if standard error is a terminal that understands escape
/// sequences; an empty `text` removes the line. Elsewhere writes `text`, unless it is empty, as a
/// line when a minute has passed since the first call or since the last line that it wrote, because
/// logs of long jobs must show their progress.
void show_progress(const std::string& text);

/// Decides when progress is written where there is no terminal. Threads may share it.
class ProgressLines {
 public:
  using Clock = std::chrono::steady_clock;
  /// True if a minute has passed from the first call, or from the last call that returned true, to
  /// `now`.
  bool is_due(Clock::time_point now);

 private:
  std::mutex mutex_;
  std::optional<Clock::time_point> last_;
};

/// Limits how often a progress line is shown. Only one thread may use an object.
class ProgressTimer {
 public:
  /// True if a tenth of a second has passed since it last returned true, or since the timer was
  /// made.
  bool is_due();

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// The remaining time in words, such as ", about 3 min left", if the share `done` of the work took
/// `seconds`. The result is empty if `done` is <= 0 or NaN, and in the first two seconds, which are
/// too short for an estimate. If `done` > 1, it says that 0 s are left.
std::string time_left(double seconds, double done);

void clear_progress();

void say(const std::string& text);
template <class First, class... Rest>
void say(fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest) {
  say(fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
}

/// Writes `text` and a line break to standard error; on a terminal, the first "warning:" is yellow.
void warn(const std::string& text);
template <class First, class... Rest>
void warn(fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest) {
  warn(fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
}

/// Writes an error message and a line break to standard error; on a terminal, the first word is red
/// if another word follows.
void complain(const std::string& text);

/// While an object of this class exists, the functions of this file write nothing in the thread
/// that made the object. Objects may be nested.
class QuietThread {
 public:
  QuietThread();
  ~QuietThread();
  QuietThread(const QuietThread&) = delete;
  QuietThread& operator=(const QuietThread&) = delete;
};

/// The colours of words, with the codes of ANSI escape sequences as values.
enum class Colour { kRed = 31, kGreen = 32, kYellow = 33 };

/// The word in colour if the file descriptor is a terminal that understands escape sequences and
/// the environment variable NO_COLOR (no-color.org) is unset or empty; otherwise the word
/// unchanged.
std::string coloured(std::string_view word, Colour colour, int descriptor);

}  // namespace viscontact::terminal
