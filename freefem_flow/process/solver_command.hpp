// How the process of a fluid solver is started, and what messages about it contain.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace viscontact::freefem_flow {

struct SolverCommand {
  /// The program, which is looked up on PATH, and then its arguments.
  std::vector<std::string> arguments;
  std::vector<std::string> environment{};  ///< "NAME=value" each, set for the solver only
  std::string folder{};                    ///< working folder; empty: that of this process
  // The ends of messages, which say what a user can do.
  std::string remedy_if_missing{},  ///< if the program cannot be run
      remedy_if_silent{};           ///< if the program does not answer in time
  /// After a system of more unknowns than this number the solver would give other rounding errors.
  /// Before the next placement the process is then replaced by a new one, so that a run that is
  /// continued after an interrupt gives the same bits as one without interrupt.
  std::size_t most_unknowns_reproduced = std::numeric_limits<std::size_t>::max();
  /// Whether lines of other text before the answer to a placement are skipped. If it is false, such
  /// lines are an error of the solver.
  bool remarks_on_meshes = false;
};

}  // namespace viscontact::freefem_flow
