// A child process with which this process exchanges many messages, such as a fluid solver (Linux):
// text goes to its standard input, and words come from its standard output. Used by freefem_flow/.
// Failures are Error(kExternalProgram) if the program cannot be run, Error(kInterrupted) at a stop,
// std::system_error without free sockets; a child that fails later is a state, no error. A change
// must keep that no function waits longer than its deadline, also if a pipe is full, or if the
// child has ended or is silent.
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

/// The last lines of two streams, in the order in which the lines were completed. Blank lines, the
/// white space at both ends of a line, and its bytes beyond kLongest are left out.
class LastLines {
 public:
  // Error messages show these lines. Other small numbers would do as well.
  static constexpr std::size_t kLines = 20,  ///< number of lines that are kept
      kLongest = 1000;                       ///< number of bytes of a line that are kept

  /// The streams: standard output and standard error.
  enum Stream { kOutput, kErrors };

  /// Adds what was read from a stream. `text` may end within a line, and the next text of the
  /// stream then continues it.
  void add(Stream stream, std::string_view text);

  /// At most kLines lines without their ends, the oldest first, those that are not complete last;
  /// none if nothing was added.
  std::deque<std::string> lines() const;

 private:
  void complete(std::string& line);

  std::deque<std::string> lines_;
  std::array<std::string, 2> incomplete_;
};

/// The child leads a process group of its own. The group is killed when the object is destroyed,
/// and the child is ended by the kernel when the thread that made the object ends, even by SIGKILL.
///
/// read_word() and read_line() throw Error(kInterrupted) if they would wait while `stop` of the
/// constructor requests a stop, at most 0.1 s after the request. The other functions throw nothing.
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

  /// Adds `text` to what is sent to the child. It is sent while one of the functions below waits,
  /// so that a child that writes before it reads cannot block both sides. If the child no longer
  /// reads, the text is lost without an error.
  void send(std::string_view text);

  /// How the attempt to read a word or a line ended.
  enum class State {
    kRead,      ///< the word or line was read
    kClosed,    ///< the child has closed its standard output before the end of a word or line
    kTimedOut,  ///< the deadline has passed
    kTooLong,   ///< longer than kLongestText; `text` is the beginning, and nothing was taken
  };
  /// What was read. `text` is valid until the next call of a function of the object.
  struct Reading {
    State state = State::kRead;  ///< how reading ended
    std::string_view text{};     ///< the word or line, or what there is of it; empty if kTimedOut
  };
  /// Bytes of the longest word or line that is accepted, which bounds the memory. Answers are
  /// numbers and messages, which are shorter.
  static constexpr std::size_t kLongestText = 4096;

  /// The next word of the output, which white space must follow: after a last word without it the
  /// state is kClosed and `text` is empty.
  Reading read_word(Clock::time_point deadline);

  /// The rest of the current line of the output, without its end. At the end of the output the line
  /// need not be complete: state is kClosed, and `text` is what there is.
  Reading read_line(Clock::time_point deadline);

  /// Makes the next call read the last word again; only directly after read_word() gave kRead.
  void put_word_back() { at_ = word_start_; }

  /// The largest resident memory of the child so far [1024 bytes], without that of its own
  /// children; 0 if the child has ended.
  long peak_memory_kb() const;

  /// True if the child has written something that was not read yet, other than white space.
  bool has_unread_output();

  /// Adds a line of the output that was read to last_lines().
  void keep(std::string_view line);

  /// Closes the standard input of the child, waits for the end of the child until `grace` has
  /// passed, and then kills its process group. All output that was not read is added to
  /// last_lines(). Returns how the child ended: "ended with status 3", "ended by signal 11
  /// (Segmentation fault)", or "had to be stopped". A stop request only ends the waiting.
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
