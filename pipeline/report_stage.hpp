// The command `report`: makes the pages of a folder again from its files. It computes nothing else;
// a change must keep it able to do so without FreeFEM.
#pragma once

#include <filesystem>

#include "viscontact/common/stop_token.hpp"

namespace viscontact::pipeline {

/// Writes the page and the pictures of the folder again, which `run`, `rolling`, `swimmer` or
/// `particles` wrote. Throws Error(kBadInput) if a file that the page is made from is missing,
/// damaged or of the user, Error(kExternalProgram) if gnuplot fails, and Error(kInterrupted) if
/// `stop` requests a stop.
void report_stage(const std::filesystem::path& folder, const StopToken& stop);

}  // namespace viscontact::pipeline
