// Case files of particles, most of them in a fluid, and functions that change one thing in them,
// for tests of the reader of cases.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "viscontact/particle_runs/case/particles_case.hpp"

namespace viscontact::particles {

// Cases that are accepted as they are.
extern const std::string_view kDiscsInDisc;    ///< two discs in a round container
extern const std::string_view kDiscsInBox;     ///< two discs in a closed box
extern const std::string_view kSpheresOnAxis;  ///< two spheres on the axis of a cylinder
extern const std::string_view kDryDiscs;       ///< two discs without a fluid and a domain

/// The text with the first occurrence of `from` replaced by `to`. The text must contain `from`.
std::string changed(std::string_view text, std::string_view from, std::string_view to);

/// Reads a case from a file with this text in a temporary folder. Throws the errors of
/// read_particles_case().
ParticlesCase read_particles_text(const std::string& text);

/// Expects that the case is refused as bad input at the line of the first occurrence of `at` in the
/// text, with this key (empty: any) and with these names and values in the message.
void expect_refused_at(const std::string& text, std::string_view at, const std::string& key,
                       const std::vector<std::string>& names = {});

}  // namespace viscontact::particles
