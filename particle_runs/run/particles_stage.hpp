// The command `particles`: simulates many particles from a case and writes the files of the run.
#pragma once

#include <string>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/immersed/fluid/fluid_solver.hpp"

namespace viscontact::particles {

struct ParticlesRequest {
  /// The case (TOML), the folder for the results, which is made if it is missing, and a restart
  /// file; the last is empty if the run starts from the particles of the case.
  std::string case_file, folder, restart;
  /// At least 1. Results do not depend on it.
  int threads = 1;
  StartFluidSolver start_solver;  ///< needed only if the case has a fluid
  bool json = false;              ///< print run.json to standard output
  bool hdf5 = false;              ///< write particles.h5, also for a finished run
  bool xyz = false;               ///< write particles.xyz, also for a finished run
  StopToken stop{};               ///< a stop ends the run after its state is saved
};

/// Reads the case, simulates, and writes the files of docs/file-formats.md into the folder. If the
/// folder has an interrupted run of the same inputs, this run continues, and ends with the same
/// files as an uninterrupted one; a finished run of the same inputs is left as it is; the files of
/// any other run are removed at the beginning. The state is saved every 60 s, with an inertial
/// fluid every 10 s. Throws at the beginning, before anything is written: Error(kBadInput) if the
/// case or the restart file is wrong, if a result would replace an input or a file that Viscontact
/// did not write, or if another process uses the folder; Error(kWrongUsage) if `hdf5` is true and
/// the module hdf5 cannot be loaded; Error(kExternalProgram) if the fluid solver cannot be
/// started. Throws after everything is written: Error(kNotConverged) if a step missed the
/// tolerances by more than the factor kStillAResult or cannot be computed, Error(kExternalProgram)
/// if the fluid solver failed in a step, Error(kInterrupted) if `stop` requested a stop. If a file
/// cannot be written, or the flow of a frame cannot be computed, the error is thrown at once, and
/// the same request continues from the last restart.bin.
void run_particles(const ParticlesRequest& request);

}  // namespace viscontact::particles
