// A child process with which this process exchanges many messages, such as a fluid solver (Linux).
#pragma once

#include <array>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <deque>
#include <string>
#include <string_view>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/common/system/start_process.hpp"

namespace viscontact {

/// The last lines of two streams, in the order in which the lines were completed, without blank
/// lines, white space at the ends of a line, and bytes of a line beyond kLongest.
class LastLines {
 public:
  // Error messages show the lines.
  static constexpr std::size_t kLines = 20,  ///< lines that are kept
      kLongest = 1000;                       ///< bytes of a line that are kept

  enum Stream { kOutput, kErrors };

  /// Adds what was read from a stream. `text` may end within a line.
  void add(Stream stream, std::string_view text);

  /// The lines without line ends, the oldest first. Lines that are not complete yet come last.
  std::deque<std::string> lines() const;

 private:
  // Adds `line` without white space at its ends, unless it is blank, and empties it.
  void complete(std::string& line);

  std::deque<std::string> lines_;
  std::array<std::string, 2> incomplete_;
};

/// A child process, which leads a process group of its own. The group is killed when the object is
/// destroyed. The kernel ends the child when the thread that made the object ends, even by SIGKILL.
///
/// No function waits longer than its deadline, also if the child no longer reads or writes, or has
/// ended. read_word() and read_line() throw Error(kInterrupted) if they have to wait and `stop` of
/// the constructor requests a stop; they notice the request within 0.1 s. A child that fails after
/// its start is no error: Reading::state says what happened.
class ChildProcess {
 public:
  using Clock = std::chrono::steady_clock;

  /// Starts the child. Throws Error(kExternalProgram) "PROGRAM cannot be run (REASON)" if there is
  /// no such program or it cannot be run, and std::system_error if the system has no more sockets.
  ChildProcess(const ProcessCommand& command, const StopToken& stop);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  /// The text is sent while one of the functions below waits, so that a child that writes before it
  /// reads cannot block both processes. Text that the child no longer reads is lost.
  void send(std::string_view text);

  enum class State {
    kRead,
    kClosed,  ///< the child has closed its standard output before the end of a word or line
    kTimedOut,
    kTooLong,  ///< longer than kLongestText; `text` is its beginning, and it stays unread
  };
  /// `text` is valid until the next call of a function of the object.
  struct Reading {
    State state = State::kRead;
    std::string_view text{};  ///< the word or line, or its beginning; empty if kTimedOut
  };
  /// Bytes of a word or line. The limit bounds the memory; answers of solvers are shorter.
  static constexpr std::size_t kLongestText = 4096;

  /// The next word of the output. White space must follow the word: if the output ends directly
  /// after it, the state is kClosed and `text` is empty.
  Reading read_word(Clock::time_point deadline);

  /// The rest of the current line of the output, without its line end. If the output ends before
  /// the line is complete, the state is kClosed, and `text` is the incomplete line.
  Reading read_line(Clock::time_point deadline);

  /// Makes the next call read the last word again; only directly after read_word() with kRead.
  void put_word_back() {
    assert(word_start_ <= at_);
    at_ = word_start_;
  }

  /// The largest resident memory so far [1024 bytes], without the memory of processes that the
  /// child has started; 0 if the child has ended.
  long peak_memory_kb() const;

  /// True if the child has written more than white space that was not read yet. Does not wait.
  bool has_unread_output();

  /// Adds `line`, which was read from the output, to last_lines().
  void keep(std::string_view line);

  /// Closes the standard input of the child, waits for the end of the child at most for `grace`,
  /// and then kills its process group. All output that was not read is added to last_lines().
  /// Returns how the child ended: "ended with status 3", "ended by signal 11 (Segmentation fault)",
  /// or "had to be stopped". A stop request ends the waiting. Afterwards only last_lines() may be
  /// called.
  std::string finish(std::chrono::milliseconds grace);

  /// The last lines of the standard error, and of the output that keep() or finish() added.
  std::deque<std::string> last_lines() const { return last_lines_.lines(); }

 private:
  // Sends and receives once, after at most `milliseconds` of waiting.
  void exchange(int milliseconds);
  // These three functions do not wait. At most one buffer is received, so that a child that writes
  // without end takes no memory.
  void send_some();
  void receive();
  void receive_errors();
  // Waits for more output. `length` is the number of bytes of the word or line that have come. The
  // state is kRead if reading can continue. Throws Error(kInterrupted) if a stop is requested.
  Reading more_or(Clock::time_point deadline, std::size_t length);
  bool has_ended() const;

  StopToken stop_;
  StartedProcess child_;
  std::string to_send_;
  std::size_t sent_ = 0;        ///< bytes of to_send_ that the child has got
  std::string output_;          ///< received and not yet removed
  std::size_t at_ = 0;          ///< position in output_ of the first byte that was not read
  std::size_t word_start_ = 0;  ///< position in output_ of the last word that was read
  LastLines last_lines_;
};

}  // namespace viscontact
