// The exit codes of the program (docs/command-line.md).
#pragma once

#include "viscontact/common/error.hpp"

namespace viscontact {

/// 2 wrong usage, 3 bad input, 4 not converged, 5 external program, 130 interrupted. The exit code of
/// success is 0.
int exit_code_of(ErrorKind kind);

/// The kind that becomes this exit code. Throws std::out_of_range for any other number.
ErrorKind kind_of_exit_code(int exit_code);

}  // namespace viscontact
