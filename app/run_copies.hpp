// The copies of its inputs that a run's folder holds.
#pragma once

#include "app/run_folder.hpp"
#include "case_file/case_file.hpp"

namespace viscontact {

/// The forces of the case's files, one text after the other.
std::string text_of_forces(const Case& c);

/// Throws Error(kBadInput) if a copy of the case or of its force files would replace another file of that name in a folder that has no trajectories yet:
/// it is the user's. (In a folder that has, it is the copy of an earlier run.)
void check_case_copies(const RunFolder& run, const Case& c);

/// The same of the fit.
void check_fit_copy(const RunFolder& run, const std::string& fit_text);

/// Makes the folder of trajectories, then the copies.
void write_copies(const RunFolder& run, const Case& c, const std::string& fit_text);

}  // namespace viscontact
