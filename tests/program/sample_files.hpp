// Valid cases and tables, which tests use as they are or change. They are made without FreeFEM.
#pragma once

#include <string>

namespace viscontact {

/// The lecture's case file, as shipped.
std::string lecture_case_text();

/// A table for the lecture's case with the exact drag (Brenner) at 30 gaps from 1e-3 to 2 with
/// equal ratios.
std::string exact_table_text();

/// `text` with `old_part`, which must occur once, replaced. Throws if it does not occur.
std::string replaced(std::string text, const std::string& old_part, const std::string& new_part);

/// A case with six gaps from 0.05 to 1.5 in a cylinder of radius 5 and height 10. Its force is so
/// small that the motion with drag does not leave the interval of these gaps.
std::string gentle_case_text();

}  // namespace viscontact
