// Reads and writes particles as CSV files, and the rows of motion.csv. Lengths, masses and times
// are in the units of the case; angles are in radians. Writing throws nothing. case/ reads such
// files, io/ and run/ write them. A change must keep the names of columns, which users' files have.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// Particles from a file, and where each stands in it.
struct ParticleFile {
  Particles particles;     ///< in the order of the file
  std::vector<int> lines;  ///< line of each particle in the file, from 1
};

/// `dimension` is 1 (spheres on an axis), 2 (discs) or 3 (spheres). Reads the columns
/// x,y[,z],radius,mass and, if they exist, vx,vy[,vz] and id. Without velocities the particles are
/// at rest; without `id`, or with ids 0, 1, ..., particles.ids is empty. final_particles.csv of a
/// run without ellipses and plates can be read, too.
///
/// On an axis (dimension 1) the columns are z,radius,mass and, if they exist, vz and id. In a fluid
/// (`in_fluid`) discs have an angle and an angular velocity, which are 0 if their columns are
/// missing, and the columns with forces of the fluid are accepted and not used. Without a fluid,
/// particles turn (Particles::turn) if a row has a value in the columns angle and angular_velocity
/// of discs, or angular_velocity_x, _y and _z of spheres. Moments of inertia are not set.
///
/// Throws Error(kBadInput) with file and line if the file is no CSV file with the required columns
/// (read_csv()); for a value in a column of another dimension; for any other column, such as the
/// semi-axes of ellipses that write_particles() writes; if some but not all components of the
/// velocity have columns; for a radius or mass below 1e-100 (in a fluid a mass may be 0) and any
/// number above 1e100 in magnitude; for more than 2^31 - 1 particles; and for an id that is
/// missing, occurs twice or is not a whole number from 0 to 2^31 - 1.
ParticleFile read_particles(const std::filesystem::path& path, int dimension,
                            bool in_fluid = false);

/// Forces and torques of the fluid on particles and estimates of their errors: for each particle
/// force_x, force_y and torque, per length [M/T^2, M L/T^2], or on an axis force_z [M L/T^2]. An
/// empty list means that the numbers are not known.
struct FluidForces {
  std::span<const double> values;  ///< forces and torques
  std::span<const double> errors;  ///< estimates of their errors, >= 0
  /// Semi-axes of all particles [L], Fluid::semi_axes; empty if all particles are discs or spheres.
  std::span<const std::array<double, 2>> semi_axes{};
};

/// CSV text with the columns id,x,y[,z],vx,vy[,vz],radius,mass, or id,z,vz,radius,mass on an axis.
/// Numbers have so many digits that they are read back to the same bits.
///
/// With `forces`, which particles in a fluid have, discs also have the columns
/// angle,angular_velocity,fluid_force_x,fluid_force_y,fluid_torque,fluid_force_error_estimate,
/// fluid_torque_error_estimate and, with FluidForces::semi_axes, semi_axis_1,semi_axis_2; spheres
/// on an axis have fluid_force_z,fluid_force_error_estimate. Without `forces`, particles that turn
/// have the columns angle,angular_velocity (discs) or
/// angular_velocity_x,angular_velocity_y,angular_velocity_z.
std::string write_particles(const Particles& particles,
                            const std::optional<FluidForces>& forces = {});

/// The line with the names of the columns of motion.csv: time,id,x,y,angle,vx,vy,angular_velocity
/// for discs that `turn`; time,id,x,y,vx,vy for others; in space time,id,x,y,z,vx,vy,vz and, if
/// particles turn, angular_velocity_x,angular_velocity_y,angular_velocity_z; time,id,z,vz on an
/// axis.
std::string motion_header(int dimension, bool turn);
/// The rows of motion.csv of all particles at `time` [T].
std::string motion_rows(double time, const Particles& particles);

}  // namespace viscontact::particles
