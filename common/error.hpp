// The error type of Viscontact: every error that a user can cause or meet.
#pragma once

#include <fmt/core.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscontact {

/// A new kind needs an exit code in results/exit_code.cpp and a row in docs/command-line.md.
enum class ErrorKind {
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

struct FilePosition {
  std::string file = {};  ///< as the user gave it; empty: none
  int line = 0;           ///< from 1; 0 or less: the file as a whole
  std::string key = {};   ///< of a value, such as "particle[0].radius", or its column; empty: none
};

/// `what()` has the form "FILE:LINE: what is wrong (the value); what is allowed or what to do".
class Error : public std::runtime_error {
 public:
  /// `message` is not a format, so that braces in it stay.
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  /// `message` must name file, line and key itself.
  Error(ErrorKind kind, const std::string& message, FilePosition at) : Error(kind, message) {
    at_ = std::make_shared<const FilePosition>(std::move(at));
  }
  template <class First, class... Rest>
  Error(ErrorKind kind, fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest)
      : Error(kind, fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...)) {}

  ErrorKind kind() const { return kind_; }  ///< decides the exit code
  /// Where the cause stands; empty if it does not stand in a file.
  FilePosition at() const { return at_ ? *at_ : FilePosition(); }

 private:
  ErrorKind kind_;
  /// Shared, because copies of an exception must not throw.
  std::shared_ptr<const FilePosition> at_;
};

/// Returns call(). An Error that it throws is thrown again with "PLACE: " before its message,
/// except an Error(kInterrupted), which passes unchanged because a stop has no place.
template <class Call>
auto with_place(const std::string& place, const Call& call) {
  try {
    return call();
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInterrupted) throw;
    throw Error(error.kind(), place + ": " + error.what(), error.at());
  }
}

/// The same with the place `file`, which also becomes the file of an Error that has none.
template <class Call>
auto in_file(const std::string& file, const Call& call) {
  return with_place(file, [&] {
    try {
      return call();
    } catch (const Error& error) {
      if (!error.at().file.empty()) throw;
      throw Error(error.kind(), error.what(), {file, 0, error.at().key});
    }
  });
}

/// "FILE:LINE: message", or without the line.
inline std::string located(const FilePosition& at, const std::string& message) {
  return at.file + (at.line > 0 ? ":" + std::to_string(at.line) : "") + ": " + message;
}
/// Throws Error(kBadInput) with the message of located(), which must name the key itself.
[[noreturn]] inline void throw_bad_input(const FilePosition& at, const std::string& message) {
  throw Error(ErrorKind::kBadInput, located(at, message), at);
}
template <class First, class... Rest>
[[noreturn]] void throw_bad_input(const FilePosition& at, fmt::format_string<First, Rest...> text,
                                  First&& first, Rest&&... rest) {
  throw_bad_input(at, fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
}

}  // namespace viscontact
