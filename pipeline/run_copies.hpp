// The copies of its inputs that a run's folder holds.
#pragma once

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/results/run_folder.hpp"

namespace viscontact {

/// The forces of the case's files, one text after the other.
std::string text_of_forces(const Case& c);

/// True if the folder is one into which Viscontact has simulated before: it has a folder of
/// trajectories, and this is empty, as an interrupted run leaves it, or holds a file that Viscontact
/// wrote.
bool holds_a_run(const RunFolder& run);

/// Throws Error(kBadInput) if a copy of the case or of its force files would replace another file of
/// that name in a folder that does not hold a run: then it is the user's own. (In a folder that
/// holds one it is the copy that the earlier run made.)
void check_case_copies(const RunFolder& run, const Case& c);

/// The same of the fit.
void check_fit_copy(const RunFolder& run, const std::string& fit_text);

/// Makes the folder of trajectories, then the copies.
void write_copies(const RunFolder& run, const Case& c, const std::string& fit_text);

}  // namespace viscontact
