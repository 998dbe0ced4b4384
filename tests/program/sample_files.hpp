// Good files to start from, made without FreeFEM.
#pragma once

#include <string>

namespace viscontact {

/// The lecture's case file, as shipped.
std::string lecture_case_text();

/// A table for the lecture's case from the exact drag (Brenner): 30 gaps in [1e-3, 2], logarithmic.
std::string exact_table_text();

/// `text` with the one place where `old_part` stands replaced. Throws if there is none.
std::string replaced(std::string text, const std::string& old_part, const std::string& new_part);

/// A case of six gaps in [0.05, 1.5] in a cylinder of 5 x 10 radii, pushed so gently that the
/// motion with drag stays between them.
std::string gentle_case_text();

}  // namespace viscontact
