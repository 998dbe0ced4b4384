// The table of exit codes, which docs/command-line.md repeats.
#include "viscontact/results/exit_code.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <stdexcept>
#include <string>

namespace viscontact::results {
namespace {

constexpr auto kExitCodes = std::to_array<ExitCode>({
    {{}, 0, "done"},
    {ErrorKind::kWrongUsage, 2, "wrong usage"},
    {ErrorKind::kBadInput, 3, "bad input: a file, or a value in it"},
    {ErrorKind::kNotConverged, 4,
     "a computation did not converge, every point of a sweep failed, or memory ran out"},
    {ErrorKind::kExternalProgram, 5,
     "an external program (FreeFEM, gnuplot, Slurm) failed or is missing"},
    // For a process that SIGINT (signal 2) ended, shells report the exit code 128 + 2.
    {ErrorKind::kInterrupted, 130,
     "interrupted; what was finished is kept, and the same command continues from there"},
});

}  // namespace

std::span<const ExitCode> exit_codes() { return kExitCodes; }

int exit_code_of(ErrorKind kind) {
  const auto* row = std::ranges::find(kExitCodes, kind, &ExitCode::kind);
  assert(row != std::end(kExitCodes));  // the table has a row for every kind
  return row->code;
}

ErrorKind kind_of_exit_code(int exit_code) {
  const auto* row = std::ranges::find(kExitCodes, exit_code, &ExitCode::code);
  if (row == std::end(kExitCodes) || !row->kind)
    throw std::out_of_range("no error has the exit code " + std::to_string(exit_code));
  return *row->kind;
}

}  // namespace viscontact::results
