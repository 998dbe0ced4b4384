// The exit code of the program for each kind of error, also those in failed_models.json.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "viscontact/common/error.hpp"

namespace viscontact::results {

struct ExitCode {
  std::optional<ErrorKind> kind;  ///< nothing: success
  int code;                       ///< 0 to 255; users' scripts rely on it
  std::string_view meaning;       ///< for a line of --help and of the manual
};

/// The codes in increasing order.
std::span<const ExitCode> exit_codes();

/// The code is from 1 to 255.
int exit_code_of(ErrorKind kind);

/// The kind of error that has this exit code. Throws std::out_of_range if no kind has it, as for 0.
ErrorKind kind_of_exit_code(int exit_code);

}  // namespace viscontact::results
