// A child process with which this process exchanges many messages, such as a fluid solver (Linux):
// text goes to its standard input, and words come from its standard output. Used by freefem_flow/.
// Throws Error(kExternalProgram) if the program cannot be run, Error(kInterrupted) if a stop is
// requested while it waits, and std::system_error if the system has no free sockets. If the child
// fails later, nothing is thrown: the state of a Reading says so. A change must keep that no
// function waits longer than its deadline, also if the child no longer reads or writes, or has
// ended.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <deque>
#include <string>
#include <string_view>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/common/system/start_process.hpp"

namespace viscontact {

/// The last lines of two streams, in the order in which the lines were completed. The list has no
/// blank lines, no white space at the ends of a line, and no bytes of a line beyond kLongest.
class LastLines {
 public:
  // Error messages show the lines. Both numbers are free choices; other small ones would do as
  // well.
  static constexpr std::size_t kLines = 20,  ///< number of lines that are kept
      kLongest = 1000;                       ///< number of bytes of a line that are kept

  /// The two streams of a child: its standard output and its standard error.
  enum Stream { kOutput, kErrors };

  /// Adds what was read from a stream. `text` may end within a line, and the next text of the
  /// stream then continues it.
  void add(Stream stream, std::string_view text);

  /// The lines without their line ends, at most kLines, the oldest first. Lines that are not
  /// complete yet come last. There are no lines if nothing was added.
  std::deque<std::string> lines() const;

 private:
  void complete(std::string& line);

  std::deque<std::string> lines_;
  std::array<std::string, 2> incomplete_;
};

/// A child process, which leads a process group of its own. The group is killed when the object is
/// destroyed. The kernel ends the child when the thread that made the object ends, even by SIGKILL.
///
/// read_word() and read_line() throw Error(kInterrupted) if they have to wait and `stop` of the
/// constructor requests a stop; they notice the request within 0.1 s. The other functions, except
/// the constructor, throw nothing.
class ChildProcess {
 public:
  /// The clock of the deadlines.
  using Clock = std::chrono::steady_clock;

  /// Starts the child; command.arguments must not be empty (not checked). Throws
  /// Error(kExternalProgram) "PROGRAM cannot be run (REASON)" if there is no such program or it
  /// cannot be run, and std::system_error if the system has no more sockets.
  ChildProcess(const ProcessCommand& command, const StopToken& stop);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  /// Adds `text` to what is sent to the child. The text is sent while one of the functions below
  /// waits, so that a child that writes before it reads cannot block both processes. If the child
  /// no longer reads, the text is lost without an error.
  void send(std::string_view text);

  /// How the attempt to read a word or a line ended.
  enum class State {
    kRead,      ///< the word or line was read
    kClosed,    ///< the child has closed its standard output before the end of a word or line
    kTimedOut,  ///< the deadline has passed
    kTooLong,   ///< longer than kLongestText; `text` is its beginning, and it stays unread
  };
  /// What was read. `text` is valid until the next call of a function of the object.
  struct Reading {
    State state = State::kRead;  ///< how reading ended
    std::string_view text{};     ///< the word or line, or its beginning; empty if kTimedOut
  };
  /// Number of bytes of the longest word or line that is accepted. The limit bounds the memory and
  /// is a free choice; the solvers answer with numbers and messages, which are shorter.
  static constexpr std::size_t kLongestText = 4096;

  /// Reads the next word of the output. White space must follow the word: if the output ends
  /// directly after it, the state is kClosed and `text` is empty. Waits at most until `deadline`.
  Reading read_word(Clock::time_point deadline);

  /// Reads the rest of the current line of the output, without its line end. If the output ends
  /// before the line is complete, the state is kClosed, and `text` is the incomplete line. Waits at
  /// most until `deadline`.
  Reading read_line(Clock::time_point deadline);

  /// Makes the next call read the last word again. It must be called directly after read_word() has
  /// returned kRead (not checked).
  void put_word_back() { at_ = word_start_; }

  /// The largest resident memory of the child so far [1024 bytes], without the memory of processes
  /// that the child has started; 0 if the child has ended.
  long peak_memory_kb() const;

  /// True if the child has written something other than white space that was not read yet. Does not
  /// wait.
  bool has_unread_output();

  /// Adds `line`, a line that was read from the output, to last_lines().
  void keep(std::string_view line);

  /// Closes the standard input of the child, waits for the end of the child at most for `grace`
  /// [ms], and then kills its process group. All output that was not read is added to last_lines().
  /// Returns how the child ended: "ended with status 3", "ended by signal 11 (Segmentation fault)",
  /// or "had to be stopped". A stop request only ends the waiting. Afterwards only last_lines() may
  /// be called (not checked).
  std::string finish(std::chrono::milliseconds grace);

  /// The last lines of the standard error, and of the output that keep() or finish() added.
  std::deque<std::string> last_lines() const { return last_lines_.lines(); }

 private:
  void exchange(int milliseconds);
  void send_some();
  void receive();
  void receive_errors();
  Reading more_or(Clock::time_point deadline, std::size_t length);
  bool has_ended() const;

  StopToken stop_;
  StartedProcess child_;
  std::string to_send_;
  std::size_t sent_ = 0;        ///< bytes of to_send_ that the child has got
  std::string output_;          ///< output that was received and may still be read
  std::size_t at_ = 0;          ///< position in output_ of the first byte that was not read
  std::size_t word_start_ = 0;  ///< position in output_ of the last word that was read
  LastLines last_lines_;
};

}  // namespace viscontact
