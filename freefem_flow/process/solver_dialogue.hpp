// Requests to the process of a fluid solver, and its answers word by word, each of which is
// checked, in the words of the protocol (docs/fluid-solver.md, which a change must follow).
// Everything that goes wrong becomes an error that names the solver, the request and the last lines
// of the solver. flow_process.cpp and membrane_process.cpp use it; a change must keep that no
// answer is waited for without end, and that numbers read back to the same double.
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
#include "viscontact/freefem_flow/mesh_boundary.hpp"
#include "viscontact/freefem_flow/process/solver_command.hpp"

namespace viscontact::freefem_flow {

/// All functions but the destructor throw Error(kExternalProgram) if the solver fails, and
/// Error(kInterrupted) if a stop is requested. After an error the process of the solver is gone,
/// and every further request is an error.
class SolverDialogue {
 public:
  /// Starts the solver. `time_limit` is that of each answer, `first_limit` that of the first one.
  SolverDialogue(const SolverCommand& command, std::chrono::milliseconds time_limit,
                 std::chrono::milliseconds first_limit, const StopToken& stop);
  SolverDialogue(const SolverDialogue&) = delete;
  SolverDialogue& operator=(const SolverDialogue&) = delete;
  /// Asks the solver to end, and kills it if it does not within two seconds.
  ~SolverDialogue();

  /// Sends a request, whose first word is `name`. The answer to the last one must have been read.
  void ask(std::string_view name, std::string_view text);

  /// Reads the first word of the answer, which must be `word`. With `skip_lines`, up to a thousand
  /// lines that begin with another word than `word` and `error` are left out.
  void expect(std::string_view word, bool skip_lines = false);

  /// The next word of the answer.
  std::string word();
  double number();            ///< a finite number
  double number_from_zero();  ///< a finite number >= 0
  /// The next `count` words of the answer, as finite numbers.
  std::vector<double> numbers(std::size_t count);
  /// A whole number from 0 to `largest`.
  std::int64_t whole_number(std::int64_t largest);

  /// The largest resident memory of the solver so far [kB]; 0 after an error.
  long peak_memory_kb() const { return process_ ? process_->peak_memory_kb() : 0; }

  /// Ends the solver and throws: what it answered, the last word that was read, is wrong.
  [[noreturn]] void refuse(std::string_view needed);

 private:
  std::string_view next_word();
  /// The limit of the answer to the last request.
  std::chrono::milliseconds limit() const { return requests_ > 1 ? time_limit_ : first_limit_; }
  [[noreturn]] void fail(const std::string& reason, std::chrono::milliseconds grace);
  [[noreturn]] void fail_without_answer(ChildProcess::State state);
  [[noreturn]] void fail_as_solver_says();
  std::string asked_in_words() const;

  std::string name_;  ///< the command, for messages
  std::string remedy_if_silent_;
  std::chrono::milliseconds time_limit_, first_limit_;
  std::optional<ChildProcess> process_;  ///< nothing after an error
  std::string request_;                  ///< first word of the last request
  std::string awaited_;                  ///< first word of the answer that is expected
  std::int64_t requests_ = 0;
  std::size_t numbers_asked_ = 0, numbers_read_ = 0;  ///< of the numbers that are being read
  ChildProcess::Clock::time_point asked_at_{};
};

/// Appends numbers with a space before each. Throws Error(kNotConverged) if one of them is not
/// finite, with the words `what` it is.
void append(std::string& text, std::span<const double> values, const char* what);

/// The boundary of a mesh. Errors as append().
std::string words_of(const MeshBoundary& boundary);

}  // namespace viscontact::freefem_flow
