// Particles and contacts as CSV files.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "viscontact/particles/current_contacts.hpp"

namespace viscontact::particles {

/// Particles and the lines of the file that they are on.
struct ParticleFile {
  Particles particles;
  std::vector<int> lines;
};

/// Reads columns x,y[,z],radius,mass and, if they are there (else at rest), vx,vy[,vz]; a file of final particles is one too. Throws Error(kBadInput)
/// with file and line for what read_csv refuses, a column of the third dimension for discs, another column but `id`, some but not all velocities, a radius or mass below 1e-100, a number beyond 1e100,
/// more than 2^31 - 1 particles, an id that is missing, no whole number from 0 to 2^31 - 1 or there
/// twice. Without a column `id`, `particles.ids` is empty.
ParticleFile read_particles(const std::filesystem::path& path, int dimension);

/// id,x,y[,z],vx,vy[,vz],radius,mass; numbers read back to the same bits.
std::string write_particles(const Particles& particles);

/// i,j,gap,gamma,gamma_error: the ids of two particles; j is -1, -2, ... for the first, second plane.
std::string write_contacts(const Particles& particles, std::span<const CurrentContact> contacts);

}  // namespace viscontact::particles
