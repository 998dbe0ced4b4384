// Writes to standard error what a person at a terminal sees: a progress line, and messages with
// coloured words. If standard error is not a terminal, messages are plain text, and a line about
// the progress is written once a minute. A change must keep this, because scripts read the
// messages, and logs of long jobs show their progress. The times of a minute and of a tenth of a
// second, and the colours, are free choices. app/, pipeline/, particles/, rolling/, swimmer/,
// motions/ and report/ call this file. Nothing is thrown: a message that cannot be written is lost.
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
/// sequences. Otherwise writes `text` as a line when a minute has passed since the first call or
/// since the last line that it wrote. An empty `text` removes the progress line of a terminal;
/// elsewhere nothing is written.
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

/// Limits how often a progress line is shown. Only one thread may use it.
class ProgressTimer {
 public:
  /// True if a tenth of a second has passed since it last returned true, or since the timer was
  /// made.
  bool is_due();

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// The remaining time in words, such as ", about 3 min left". `done` is the share of the work, from
/// 0 to 1, that took the time `seconds` [s] >= 0. The result is empty if `done` is <= 0 or NaN, and
/// in the first two seconds, which are too short for an estimate. If `done` > 1, it says that 0 s
/// are left.
std::string time_left(double seconds, double done);

/// Removes the progress line of a terminal.
void clear_progress();

/// Writes `text` and a line break to standard error.
void say(const std::string& text);
/// As above; the line is fmt::format(text, first, rest...).
template <class First, class... Rest>
void say(fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest) {
  say(fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
}

/// Writes `text` and a line break to standard error; on a terminal, the first "warning:" is yellow.
void warn(const std::string& text);
/// As above; the line is fmt::format(text, first, rest...).
template <class First, class... Rest>
void warn(fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest) {
  warn(fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
}

/// Writes an error message and a line break to standard error; on a terminal, the first word is red
/// if another word follows.
void complain(const std::string& text);

/// While an object of this class exists, the functions of this file write nothing in the thread
/// that made the object. Objects may be nested. A sweep uses this class, because it runs many
/// simulations at once, whose messages would be mixed.
class QuietThread {
 public:
  QuietThread();
  ~QuietThread();
  QuietThread(const QuietThread&) = delete;
  QuietThread& operator=(const QuietThread&) = delete;
};

/// The colours of words. Their values are the codes of ANSI escape sequences for the colour of
/// text.
enum class Colour { kRed = 31, kGreen = 32, kYellow = 33 };

/// Returns the word in colour if the file descriptor is a terminal that understands escape
/// sequences and the environment variable NO_COLOR (no-color.org) is either unset or empty.
/// Otherwise returns the word unchanged.
std::string coloured(std::string_view word, Colour colour, int descriptor);

}  // namespace viscontact::terminal
