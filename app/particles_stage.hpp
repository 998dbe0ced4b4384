// A simulation of many particles from its case to its files.
#pragma once

#include <string>

namespace viscontact {

struct ParticlesRequest {
  std::string case_file, folder, restart;  ///< restart: empty for a start from the case's particles
  int threads = 1;
  bool json = false;  ///< print the record
};

/// Reads the case, simulates, and writes into the folder what docs/interfaces.md says. Throws Error(kBadInput) for a bad case or restart file before
/// anything is written; Error(kNotConverged) once all is written if a step did not reach the tolerance; Error(kInterrupted), too.
void run_particles(const ParticlesRequest& request);

}  // namespace viscontact
