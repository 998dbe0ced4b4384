// Whether the run that an earlier call left in its folder can be continued, and from which state.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "viscontact/particle_runs/case/particles_case.hpp"
#include "viscontact/particle_runs/run/particles_folder.hpp"
#include "viscontact/particle_runs/run/run_log.hpp"
#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

/// An interrupted or finished run.
struct EarlierRun {
  State state;       ///< after its last saved step
  RunRecord record;  ///< what the run has done until this state
};

/// The state at the start: that of the restart file at the path `restart`, or that of the case if
/// `restart` is empty. Throws Error(kBadInput) if the restart file cannot be read; if it has other
/// particles, sources, rigid bodies or links than the case, or contacts with obstacles that the
/// case does not have; if a hinge is turned beyond its stops by more than 1e-3 rad and by more than
/// ten times the tolerance of the solver; or if its time is not before the end of the case.
State first_state(const ParticlesCase& c, const std::string& restart);

/// The run in the folder, if it was made from the same inputs by the same version of Viscontact as
/// `provenance` records, and if the files of `log` are as the run has left them. Otherwise, also if
/// a file is damaged, std::nullopt; no Error is thrown. If there is a restart.bin that cannot be
/// used, a message on the terminal says why.
std::optional<EarlierRun> find_earlier_run(const ParticlesCase& c,
                                           const std::filesystem::path& folder,
                                           const results::Provenance& provenance,
                                           const RunLog& log);

/// True if the run has reached the end time of the case, up to `tiny` >= 0 [T], and all files that
/// it writes at the end, and all its frames, exist in the folder. A file that cannot be read gives
/// false.
bool is_finished(const EarlierRun& run, const ParticlesCase& c, double tiny,
                 const std::filesystem::path& folder);

}  // namespace viscontact::particles
