// A simulation of many particles from its case to its files.
#pragma once

#include <string>

namespace viscontact {

struct ParticlesRequest {
  std::string case_file, folder, restart;  ///< restart: empty for a start from the case's particles
  int threads = 1;
  bool json = false;  ///< print the record
};

/// Reads the case, simulates, and writes into the folder what docs/file-formats.md says. Throws Error(kBadInput) for a bad case or restart file before
/// anything is written; once all is written, Error(kNotConverged) if a step did not reach the tolerance or cannot be computed, Error(kInterrupted).
/// An interrupted run of the same inputs in the folder goes on, and a finished one is left as it is; of
/// any other run, the files in the folder are removed at the beginning.
void run_particles(const ParticlesRequest& request);

}  // namespace viscontact
