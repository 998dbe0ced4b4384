// The exit code of the program for each kind of error. Scripts of users rely on these numbers,
// which docs/command-line.md lists.
#pragma once

#include "viscontact/common/error.hpp"

namespace viscontact {

/// The exit code for an error: 2 wrong usage, 3 bad input, 4 not converged, 5 external program,
/// 130 interrupted. The exit code of success is 0.
int exit_code_of(ErrorKind kind);

/// The kind of error that has this exit code. Throws std::out_of_range if no kind has it.
ErrorKind kind_of_exit_code(int exit_code);

}  // namespace viscontact
