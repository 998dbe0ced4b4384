// The copies of its inputs that a run's folder holds.
#pragma once

#include "app/run_folder.hpp"
#include "case_file/case_file.hpp"

namespace viscontact {

/// The forces of the case's files, one text after the other.
std::string text_of_forces(const Case& c);

/// Throws Error(kBadInput) if a copy of the case or of its force files would replace another file of that name: one that no trajectory in the folder was
/// made from.
void check_case_copies(const RunFolder& run, const Case& c);

/// The same of the fit.
void check_fit_copy(const RunFolder& run, const std::string& fit_text);

/// Writes the copies.
void write_copies(const RunFolder& run, const Case& c, const std::string& fit_text);

}  // namespace viscontact
