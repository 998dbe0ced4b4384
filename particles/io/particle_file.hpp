// Particles and contacts as CSV files. Lengths, masses and times are in the units of the case. A
// change must keep the names of the columns, which users' files contain.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "viscontact/particles/current_contacts.hpp"

namespace viscontact::particles {

/// Particles, and the number of the line in the file of each particle.
struct ParticleFile {
  Particles particles;
  std::vector<int> lines;
};

/// Reads the columns x,y[,z],radius,mass and, if they exist, vx,vy[,vz] and id. Without velocities
/// the particles are at rest; without `id`, or with ids 0, 1, ..., particles.ids is empty. The file
/// of final particles of a run can be read, too.
///
/// Throws Error(kBadInput) with file and line for what read_csv refuses; for a value in a column of
/// the third dimension if dimension is 2; for any other column; if some but not all velocities are
/// given; for a radius or mass below 1e-100 and any number above 1e100 in magnitude; for more than
/// 2^31 - 1 particles; and for an id that is missing, occurs twice or is not a whole number from 0
/// to 2^31 - 1.
ParticleFile read_particles(const std::filesystem::path& path, int dimension);

/// CSV text with the columns id,x,y[,z],vx,vy[,vz],radius,mass. The numbers read back to the same
/// bits.
std::string write_particles(const Particles& particles);

/// CSV text with the columns i,j,gap,gamma,gamma_error. i and j are the ids of two particles; j is
/// -1, -2, ... for the first, second plane.
std::string write_contacts(const Particles& particles, std::span<const CurrentContact> contacts);

}  // namespace viscontact::particles
