// The exit code of the program for each kind of error. A change must keep the numbers, on which
// users' scripts rely, and give each new kind a code of its own. --help and the manual print the
// table, and docs/command-line.md repeats it. The table is in this folder and not in app/, because
// the file failed_models.json stores the codes. Used by app/ and failed_models.cpp. Only
// kind_of_exit_code() throws.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "viscontact/common/error.hpp"

namespace viscontact::results {

/// An exit code of the program.
struct ExitCode {
  std::optional<ErrorKind> kind;  ///< kind of the error; nothing: success
  int code;                       ///< 0 to 255
  std::string_view meaning;       ///< words for a line of --help and of the manual
};

/// All exit codes, in increasing order.
std::span<const ExitCode> exit_codes();

/// The exit code for an error of this kind, from 1 to 255. It is asserted that the kind has a code.
int exit_code_of(ErrorKind kind);

/// The kind of error that has this exit code. Throws std::out_of_range if no kind has it, as for 0.
ErrorKind kind_of_exit_code(int exit_code);

}  // namespace viscontact::results
