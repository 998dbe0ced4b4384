// The one way to fail: every error that a user can cause or meet is a viscontact::Error, caught
// once in app/.
#pragma once

#include <stdexcept>
#include <string>

namespace viscontact {

/// What kind of fault ends a computation; results/exit_code.hpp says which exit code each becomes.
enum class ErrorKind {
  kWrongUsage,       ///< what was asked for: an option, or a combination of them
  kBadInput,         ///< a file or a value in it
  kNotConverged,     ///< a computation did not reach what was asked
  kExternalProgram,  ///< FreeFEM or gnuplot failed or is missing
  kInterrupted,      ///< by the user; everything finished so far is kept
};

/// An error fit for a user: `what()` reads "FILE:LINE: what is wrong (the value); what is allowed
/// or what to do".
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

/// A place in an input file; `line` 0 means the file as a whole.
struct FilePosition {
  std::string file;
  int line = 0;
};

/// Bad input at a place: throws Error(kBadInput, "FILE:LINE: message").
[[noreturn]] inline void throw_bad_input(const FilePosition& at, const std::string& message) {
  const std::string line = at.line > 0 ? ":" + std::to_string(at.line) : "";
  throw Error(ErrorKind::kBadInput, at.file + line + ": " + message);
}

}  // namespace viscontact
