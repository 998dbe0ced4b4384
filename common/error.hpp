// The error type of Viscontact, which all parts throw. Every error that a user can cause or meet is
// thrown as viscontact::Error. Unless a caller handles it, app/main.cpp prints its message and ends
// with the exit code of its kind. Words of messages may be changed. A new kind needs an exit code
// in results/exit_code.cpp and a row in docs/command-line.md.
#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace viscontact {

/// Kind of an error. results/exit_code.hpp gives the exit code of each kind.
enum class ErrorKind {
  /// An option, or a combination of options, is wrong.
  kWrongUsage,
  /// A file, or a value in a file, is wrong.
  kBadInput,
  /// A computation did not reach the accuracy or tolerance that was asked for, left the range of a
  /// double, or lacks rows that it needs.
  kNotConverged,
  /// An external program (FreeFEM, gnuplot, Slurm) failed or is missing.
  kExternalProgram,
  /// The user interrupted the program; everything finished so far is kept.
  kInterrupted,
};

/// An error with a message for users. `what()` has the form "FILE:LINE: what is wrong (the value);
/// what is allowed or what to do".
class Error : public std::runtime_error {
 public:
  /// `message` becomes what() of the error. It is not a format, so that braces in it stay. Whether
  /// it has the form of the comment of this class is not checked.
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  /// Makes an error of this kind whose message is fmt::format(text, first, rest...).
  template <class First, class... Rest>
  Error(ErrorKind kind, fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest)
      : Error(kind, fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...)) {}

  ErrorKind kind() const { return kind_; }  ///< the kind, which decides the exit code

 private:
  ErrorKind kind_;
};

/// Calls `call` and returns its value. An Error that it throws is thrown again with "PLACE: "
/// before its message, except an Error(kInterrupted), which passes unchanged because a stop has no
/// place. Other exceptions pass unchanged.
template <class Call>
auto with_place(const std::string& place, const Call& call) {
  try {
    return call();
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInterrupted) throw;
    throw Error(error.kind(), place + ": " + error.what());
  }
}

/// A position in an input file.
struct FilePosition {
  std::string file;  ///< its path, as the user gave it
  int line = 0;      ///< counted from 1; 0 or less: the file as a whole
};

/// Throws Error(kBadInput) with the message "FILE:LINE: message", or "FILE: message" if `at` means
/// the whole file.
[[noreturn]] inline void throw_bad_input(const FilePosition& at, const std::string& message) {
  const std::string line = at.line > 0 ? ":" + std::to_string(at.line) : "";
  throw Error(ErrorKind::kBadInput, at.file + line + ": " + message);
}
/// Throws the same error with the message fmt::format(text, first, rest...).
template <class First, class... Rest>
[[noreturn]] void throw_bad_input(const FilePosition& at, fmt::format_string<First, Rest...> text,
                                  First&& first, Rest&&... rest) {
  throw_bad_input(at, fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
}

}  // namespace viscontact
