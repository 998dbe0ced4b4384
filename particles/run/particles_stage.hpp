// Declares the command `particles`, which simulates many particles from a case and writes the files
// of the run, in the units of the case. app/ and sweep/ call it. If an input is wrong,
// run_particles() throws before it writes anything. If the simulation fails, run_particles() first
// writes what has been computed, and then throws. A change must keep that a run that was killed at
// any time, when it is continued, ends with the same files as an uninterrupted one. How often the
// state is saved (every 60 s, with an inertial fluid every 10 s) is a free choice.
#pragma once

#include <string>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"

namespace viscontact::particles {

/// The options of the command `particles`.
struct ParticlesRequest {
  /// Paths of the case (TOML), of the folder for the results, which is made if it is missing, and
  /// of a restart file. The last path is empty if the run starts from the particles of the case.
  std::string case_file, folder, restart;
  /// Number of threads, >= 1 (not checked); results do not depend on it.
  int threads = 1;
  StartFluidSolver start_solver;  ///< starts the fluid solver; needed only if the case has a fluid
  bool json = false;              ///< whether to print run.json to standard output
  bool hdf5 = false;              ///< whether to write particles.h5, also for a finished run
  bool xyz = false;               ///< whether to write particles.xyz, also for a finished run
  StopToken stop{};               ///< if it requests a stop, the run ends after its state is saved
};

/// Reads the case, simulates, and writes the files of docs/file-formats.md into the folder. If the
/// folder has an interrupted run of the same inputs, this run continues; a finished run of the same
/// inputs is left as it is; the files of any other run are removed at the beginning. Throws
/// Error(kBadInput) before anything is written if the case or the restart file is wrong, if a
/// result would replace an input or a file that Viscontact did not write, or if another process
/// uses the folder. Throws Error(kExternalProgram) if the fluid solver cannot be started. Throws
/// Error(kBadInput) later if a file cannot be written; the same request then continues from the
/// last restart.bin. Throws after everything is written: Error(kNotConverged) if a step missed the
/// tolerances by more than the factor kStillAResult, 10 (particles_folder.hpp), or cannot be
/// computed, Error(kExternalProgram) if the fluid solver failed in a step, Error(kInterrupted) if
/// `stop` requested a stop. If the flow of a frame cannot be computed, its error is thrown at once,
/// and the same request continues from the last restart.bin. Throws Error(kWrongUsage) at the
/// beginning if `hdf5` is true and the module hdf5 cannot be loaded.
void run_particles(const ParticlesRequest& request);

}  // namespace viscontact::particles
