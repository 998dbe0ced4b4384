// What a person at a terminal sees on standard error: a progress line, and messages with coloured
// words. If standard error is not a terminal, messages are plain text, and progress is a line of
// its own once a minute; a change must keep that, because scripts read the messages and logs of
// long jobs tell how far they are. app/, pipeline/, particles/, rolling/, swimmer/, motions/ and
// report/ call it. Nothing is thrown.
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
/// since the last line that it wrote. An empty text removes the progress line, and writes none.
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

/// The remaining time of a work whose share `done`, from 0 to 1, took `seconds` [s] >= 0, such as
/// ", about 3 min left". Empty if `done` is 0 or NaN, and in the first two seconds, which are too
/// short for an estimate; 0 s are left if `done` > 1.
std::string time_left(double seconds, double done);

/// Removes the progress line.
void clear_progress();

/// Writes a line to standard error; if that fails, the line is lost, as in all functions here.
void say(const std::string& text);
/// As above; the line is fmt::format(text, first, rest...).
template <class First, class... Rest>
void say(fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest) {
  say(fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
}

/// Writes a line to standard error, in which the first "warning:" is yellow.
void warn(const std::string& text);
/// As above; the line is fmt::format(text, first, rest...).
template <class First, class... Rest>
void warn(fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest) {
  warn(fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
}

/// Writes an error message to standard error, with its first word in red if another one follows.
void complain(const std::string& text);

/// While an object of this class exists, nothing that its thread says or shows reaches the
/// terminal; objects may be nested. A sweep runs many simulations at once, whose messages would be
/// mixed.
class QuietThread {
 public:
  QuietThread();
  ~QuietThread();
  QuietThread(const QuietThread&) = delete;
  QuietThread& operator=(const QuietThread&) = delete;
};

/// The values are the codes of ANSI escape sequences (SGR) for the colour of text.
enum class Colour { kRed = 31, kGreen = 32, kYellow = 33 };

/// Returns the word in colour if the file descriptor is a terminal that understands escape
/// sequences and the environment variable NO_COLOR (no-color.org) is either unset or empty.
/// Otherwise returns the word unchanged.
std::string coloured(std::string_view word, Colour colour, int descriptor);

}  // namespace viscontact::terminal
