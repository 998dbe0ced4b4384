// The run that an earlier call of the command `particles` left in its folder: whether it can be
// continued, and from which state. Lengths, masses and times are in the units of the case. run/,
// sweep/ and python/ use it. A restart file that does not fit the case throws Error(kBadInput). A
// run that cannot be continued is no error. A change must keep that a continued run gives the same
// files as a run that was never interrupted.
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
  RunRecord record;  ///< what the run has done until this state
};

/// The state at the start: that of the case, or that of the restart file at the path `restart`, if
/// it is not empty. Throws Error(kBadInput) if the restart file cannot be read; if it has other
/// particles, sources, rigid bodies or links than the case, contacts with obstacles that the case
/// does not have, or a hinge beyond its stops; or if it is not earlier than the end of the case.
State first_state(const ParticlesCase& c, const std::string& restart);

/// The run in the folder, if it was made from the same inputs by the same version of Viscontact, as
/// `provenance` records both for this call, and the files of `log` are as the run has left them;
/// otherwise, also if a file is damaged, nothing. Errors are not thrown: if the folder has a
/// restart.bin that cannot be used, a message on the terminal says why.
std::optional<EarlierRun> find_earlier_run(const ParticlesCase& c,
                                           const std::filesystem::path& folder,
                                           const results::Provenance& provenance,
                                           const RunLog& log);

/// True if the run has reached the end time of the case, up to `tiny` >= 0 [T], and all its files
/// exist.
bool is_finished(const EarlierRun& run, const ParticlesCase& c, double tiny,
                 const std::filesystem::path& folder);

}  // namespace viscontact::particles
