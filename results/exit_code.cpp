// The table of exit codes, with a row for each kind of error.
#include "viscontact/results/exit_code.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscontact {
namespace {

constexpr std::array<std::pair<ErrorKind, int>, 5> kExitCodes = {{
    {ErrorKind::kWrongUsage, 2},
    {ErrorKind::kBadInput, 3},
    {ErrorKind::kNotConverged, 4},
    {ErrorKind::kExternalProgram, 5},
    // Shells report a process that SIGINT (signal 2) ended by 128 + 2.
    {ErrorKind::kInterrupted, 130},
}};

}  // namespace

int exit_code_of(ErrorKind kind) {
  const auto* row = std::ranges::find(kExitCodes, kind, &std::pair<ErrorKind, int>::first);
  assert(row != kExitCodes.end());  // the table has a row for every kind
  return row->second;
}

ErrorKind kind_of_exit_code(int exit_code) {
  const auto* row = std::ranges::find(kExitCodes, exit_code, &std::pair<ErrorKind, int>::second);
  if (row == kExitCodes.end())
    throw std::out_of_range("no error has the exit code " + std::to_string(exit_code));
  return row->first;
}

}  // namespace viscontact
