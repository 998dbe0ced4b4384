// How the process of a fluid solver is started, with what messages need. freefem_solver.cpp makes
// it, flow_process.hpp uses it. A change must keep a user's command as it was written.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace viscontact::freefem_flow {

/// How a fluid solver is started, and what is known of it.
struct SolverCommand {
  /// The program, which is looked up on PATH, and its arguments. At least one.
  std::vector<std::string> arguments;
  std::vector<std::string> environment{};  ///< "NAME=value" each, for the solver only
  std::string folder{};                    ///< working folder; empty: that of this process
  /// What a user can do if the program cannot be run, and if it does not answer in time: each ends
  /// the message of the error. May be empty.
  std::string remedy_if_missing{},  ///< if the program cannot be run
      remedy_if_silent{};           ///< if the program does not answer in time
  /// A solver that has solved a system of more unknowns gives other rounding errors afterwards, and
  /// is replaced by a new process before the next placement. A run that is continued after an
  /// interrupt then gives the same bits.
  std::size_t most_unknowns_reproduced = std::numeric_limits<std::size_t>::max();
  /// The solver may write lines of its own before it answers a placement. They are skipped.
  bool remarks_on_meshes = false;
};

}  // namespace viscontact::freefem_flow
