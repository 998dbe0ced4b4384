// The lengths of arms in a case, and whether they can be. Units are those of the case.
#pragma once

#include <cstdint>
#include <span>

#include "viscontact/case_file/particles/particles_case.hpp"
#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/particles/links/arm_length.hpp"

namespace viscontact::case_file {

/// Reads `length` of an arm: a number, { pieces, period }, or { mean, amplitude, angular_frequency,
/// phase }.
particles::ArmLength read_arm_length(const TomlSection& section);

/// Distance of the centres of two particles at the start, across periods if that is shorter [L].
double distance_at_start(const ParticlesCase& c, std::int32_t first, std::int32_t second);

/// Checks the arms of a case; `sections` are their tables. Throws Error(kBadInput) as read_links()
/// says.
void check_arms(std::span<const TomlSection> sections, const ParticlesCase& c);

}  // namespace viscontact::case_file
