// The one way to fail: every error that a user can cause or meet is a viscontact::Error, caught
// once in app/.
#pragma once

#include <stdexcept>
#include <string>

namespace viscontact {

/// What the process reports to its caller when an Error ends it (interfaces of the command line,
/// docs/command-line.md).
enum class ExitCode {
  kDone = 0,
  kWrongUsage = 2,       ///< the command line itself
  kBadInput = 3,         ///< a file or a value in it
  kNotConverged = 4,     ///< a computation did not reach what was asked
  kExternalProgram = 5,  ///< FreeFEM or gnuplot failed or is missing
  kInterrupted = 130,    ///< Ctrl-C; everything finished so far is kept
};

/// An error fit for a user: `what()` reads "FILE:LINE: what is wrong (the value); what is allowed
/// or what to do".
class Error : public std::runtime_error {
 public:
  Error(ExitCode exit_code, const std::string& message)
      : std::runtime_error(message), exit_code_(exit_code) {}
  ExitCode exit_code() const { return exit_code_; }

 private:
  ExitCode exit_code_;
};

/// A place in an input file; `line` 0 means the file as a whole.
struct FilePosition {
  std::string file;
  int line = 0;
};

/// Bad input at a place: throws Error(kBadInput, "FILE:LINE: message").
[[noreturn]] inline void throw_bad_input(const FilePosition& at, const std::string& message) {
  const std::string line = at.line > 0 ? ":" + std::to_string(at.line) : "";
  throw Error(ExitCode::kBadInput, at.file + line + ": " + message);
}

}  // namespace viscontact
