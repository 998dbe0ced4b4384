// How the process of a fluid solver is started.
#pragma once

#include <string>
#include <vector>

namespace viscontact::freefem_flow {

struct SolverCommand {
  /// The program, which is looked up on PATH, and its arguments. At least one.
  std::vector<std::string> arguments;
  std::vector<std::string> environment{};  ///< "NAME=value" each, for the solver only
  std::string folder{};                    ///< working folder; empty: that of this process
  /// What a user can do if the program cannot be run, and if it does not answer in time: each ends
  /// the message of the error. May be empty.
  std::string remedy_if_missing{}, remedy_if_silent{};
};

}  // namespace viscontact::freefem_flow
