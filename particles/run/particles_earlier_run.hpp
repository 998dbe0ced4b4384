// The run that an earlier call of `particles` left in its folder: whether it can be continued, and
// from which state. Lengths, masses and times are in the units of the case. The stages of runs and
// sweeps call it. A continued run must give the same files as a run that was never interrupted.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "viscontact/particles/case/particles_case.hpp"
#include "viscontact/particles/run/particles_folder.hpp"
#include "viscontact/particles/run/run_log.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// An interrupted or finished run: its last state, from which it can continue, and its record.
struct EarlierRun {
  State state;       ///< after its last saved step
  RunRecord record;  ///< of what it did up to this state
};

/// The state at the start: that of the case, or that of the restart file `restart` (empty: none).
/// Throws Error(kBadInput) if the restart file has other particles than the case or contacts with
/// planes that the case does not have, or if it is not earlier than the end of the case.
State first_state(const ParticlesCase& c, const std::string& restart);

/// The run in the folder, if it was made from the same inputs by the same version and the files of
/// `log` are as it has left them; otherwise nothing. If the folder has a restart.bin that cannot be
/// used, a message says why.
std::optional<EarlierRun> find_earlier_run(const ParticlesCase& c,
                                           const std::filesystem::path& folder,
                                           const results::Provenance& provenance,
                                           const RunLog& log);

/// True if the run has reached the end time of the case, to `tiny` [T], and all its files exist.
bool is_finished(const EarlierRun& run, const ParticlesCase& c, double tiny,
                 const std::filesystem::path& folder);

}  // namespace viscontact::particles
