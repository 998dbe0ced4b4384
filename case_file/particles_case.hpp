// The case file of many particles.
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/particles/simulation.hpp"

namespace viscontact {

/// What a user asked for (case-file.md, "Many particles").
struct ParticlesCase {
  std::filesystem::path path;
  std::string text;  ///< of the file
  std::string title;
  particles::Setting setting;
  particles::Particles particles;        ///< those of the CSV file, then those of the tables
  std::filesystem::path particles_file;  ///< empty: none
  double end_time = 0;                   ///< [T], > 0
  double frame_interval = 0;             ///< [T], > 0
};

/// Reads and checks it. Throws Error(kBadInput) with file, line, key, value and what is allowed: among others for no particle, two that overlap or one
/// on the wrong side of a plane at the start, by more than solver.tolerance mean radii; a particle smaller than a hundred times that, or further away than
/// particles::largest_resolved_distance.
ParticlesCase read_particles_case(const std::filesystem::path& path);

}  // namespace viscontact
