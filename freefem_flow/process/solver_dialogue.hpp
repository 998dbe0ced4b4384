// Requests to the process of a fluid solver and answers, word by word, docs/fluid-solver.md.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/common/system/child_process.hpp"
#include "viscontact/freefem_flow/boundary/mesh_boundary.hpp"
#include "viscontact/freefem_flow/process/solver_command.hpp"

namespace viscontact::freefem_flow {

/// The dialogue with one process. All functions that read or write throw Error(kExternalProgram),
/// which names the solver, the request and the last lines that the solver wrote, if the solver
/// ends, answers wrongly or too late, and Error(kInterrupted) if a stop is requested. The process
/// is ended then. After that ask() throws Error(kExternalProgram), and no other function may be
/// called.
class SolverDialogue {
 public:
  /// Starts the solver. `first_limit` is the time limit of the answer to the first request,
  /// `time_limit` that of each other answer, both from the request on. Throws
  /// Error(kExternalProgram) if the program cannot be run, and std::system_error if the system has
  /// no free sockets.
  SolverDialogue(const SolverCommand& command, std::chrono::milliseconds time_limit,
                 std::chrono::milliseconds first_limit, const StopToken& stop);
  SolverDialogue(const SolverDialogue&) = delete;
  SolverDialogue& operator=(const SolverDialogue&) = delete;
  /// Asks the solver to end, and kills it if it does not within two seconds.
  ~SolverDialogue();

  /// Sends the request `text`, which messages call `name`. Throws Error(kExternalProgram) if the
  /// solver wrote more than the answer to the request before.
  void ask(std::string_view name, std::string_view text);

  /// Reads the first word of the answer, which must be `word`. With `skip_lines`, up to a thousand
  /// lines before it are skipped, except one that begins with the word `error`.
  void expect(std::string_view word, bool skip_lines = false);

  /// Reads the next word of the answer. If it is `error`, the rest of the line is the text of the
  /// Error(kExternalProgram) that is thrown.
  std::string word();
  double number();            ///< reads a finite number
  double number_from_zero();  ///< the same, but >= 0
  /// Reads the next `count` words of the answer as finite numbers.
  std::vector<double> numbers(std::size_t count);
  /// Reads a whole number from 0 to `largest`.
  std::int64_t whole_number(std::int64_t largest);

  /// The largest resident memory of the solver so far [kB]; 0 after an error.
  long peak_memory_kb() const { return process_ ? process_->peak_memory_kb() : 0; }

  /// Ends the solver and throws Error(kExternalProgram), which says that the solver answered the
  /// last word in place of `needed`.
  [[noreturn]] void refuse(std::string_view needed);

 private:
  using Reading = ChildProcess::Reading;
  /// Reads by `what`, ChildProcess::read_word or read_line, within the time limit.
  Reading read(Reading (ChildProcess::*what)(ChildProcess::Clock::time_point));
  /// Valid until the next call that reads.
  std::string_view next_word();
  /// The time limit of the answer to the last request.
  std::chrono::milliseconds limit() const { return requests_ > 1 ? time_limit_ : first_limit_; }
  /// Ends the solver, which gets the time `grace` to end by itself, and throws
  /// Error(kExternalProgram) with `reason` and the last lines that the solver wrote.
  [[noreturn]] void fail(const std::string& reason, std::chrono::milliseconds grace);
  [[noreturn]] void fail_without_answer(ChildProcess::State state);
  [[noreturn]] void fail_as_solver_says();
  std::string asked_in_words() const;

  std::string name_;  ///< the command line, for messages
  std::string remedy_if_silent_;
  std::chrono::milliseconds time_limit_, first_limit_;
  std::optional<ChildProcess> process_;  ///< nothing after an error
  std::string request_;                  ///< first word of the last request
  std::string awaited_;                  ///< first word of the answer that is expected
  std::int64_t requests_ = 0;
  std::size_t numbers_asked_ = 0, numbers_read_ = 0;  ///< by numbers(); 0 outside of it
  ChildProcess::Clock::time_point asked_at_{};
};

/// Appends numbers to a request, with a space before each, in digits that read back to the same
/// double. Throws Error(kNotConverged) if one of them is not finite; the message calls it `what`,
/// for example "a force".
void append(std::string& text, std::span<const double> values, const char* what);

/// The boundary of a mesh as a part of a request: the numbers of points and curves, the points [L],
/// and the curves with first point, number of edges and label. Throws Error(kNotConverged) if a
/// coordinate is not finite.
std::string words_of(const MeshBoundary& boundary);

}  // namespace viscontact::freefem_flow
