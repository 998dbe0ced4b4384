// Particles as CSV files, in the units of the case, and the rows of motion.csv.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viscontact/particles/state/particles.hpp"
#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

struct ParticleFile {
  Particles particles;     ///< in the order of the file
  std::vector<int> lines;  ///< of each particle in the file, from 1
  /// Of each particle: whether its row has a component of the velocity, or of the angular velocity.
  std::vector<bool> has_velocity{}, has_angular_velocity{};
};

/// Reads a file. `dimension` is 1 (spheres on an axis), 2 (discs) or 3 (spheres). The columns are
/// x,y[,z],radius,mass and, if they exist, vx,vy[,vz] and id. In a fluid (`in_fluid`), and for
/// spheres with lubrication without inertia, masses may be 0 or missing. Without columns of
/// velocities the particles are at rest; without the column id, or with ids 0, 1, ...,
/// Particles::ids is empty. The file final_particles.csv of a run can be read, too, unless the run
/// has other shapes than discs and spheres.
///
/// On an axis (dimension 1) the columns are z,radius,mass and, if they exist, vz and id. In a fluid
/// (`in_fluid`) discs have an angle and an angular velocity, which are 0 if their columns are
/// missing, and the columns with forces of the fluid are accepted and not used. Without a fluid,
/// particles turn (Particles::turn) if a row has a value in the columns angle and angular_velocity
/// of discs, or angular_velocity_x, _y and _z of spheres. Particles::inertias are not set.
///
/// Throws Error(kBadInput), which names the file and the line (if the fault is in one), if the file
/// cannot be read or is no CSV file with the required columns (common/text/csv.hpp); for a value in
/// a column of another dimension, such as z of a disc; for any column that is not named above, such
/// as the semi-axes of ellipses that write_particles() writes; if some but not all components of
/// the velocity have columns; for a radius or mass below 1e-100 (in a fluid a mass may be 0); for a
/// number above 1e100 in magnitude; for more than 2^31 - 1 particles; and for an id that occurs
/// twice, is not a whole number from 0 to 2^31 - 1, or is missing although another row has one.
ParticleFile read_particles(const std::filesystem::path& path, int dimension,
                            bool in_fluid = false);

/// Forces and torques of the fluid on particles and estimates >= 0 of their errors, with three
/// numbers for each disc: force_x, force_y and torque per length [M/T^2, M L/T^2]; or one for each
/// sphere on an axis: force_z [M L/T^2]. An empty list means that the numbers are not known, and
/// leaves their fields empty.
struct FluidForces {
  std::span<const double> values;
  std::span<const double> errors;
};

/// final_particles.csv: a line "# rows: N" with the number of particles, the names of the columns
/// (particle_columns()), and a row for each particle. Numbers are read back to the same bits.
/// Particles in a fluid have `forces`. `loads` are those of the particles whose motion is given
/// without a fluid, in the order of the particles.
std::string write_particles(const Particles& particles,
                            const std::optional<FluidForces>& forces = {},
                            std::span<const GivenParticleLoad> loads = {});

/// The line with the names of the columns of motion.csv (particle_columns()).
std::string motion_header(int dimension, bool turn, bool has_loads = false);
/// The rows of motion.csv of all particles at `time` [T]. `loads` is null unless the table has
/// their columns.
std::string motion_rows(double time, const Particles& particles,
                        const std::vector<GivenParticleLoad>* loads = nullptr);

}  // namespace viscontact::particles
