// The columns of particles: final_particles.csv, motion.csv, the points of the frames, the group
// `particles` of particles.h5, and particles() of Python.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "viscontact/particle_runs/io/columns.hpp"
#include "viscontact/particle_runs/io/particle_file.hpp"

namespace viscontact::particles {

struct ParticleRow {
  const Particles& particles;
  std::size_t k;                            ///< number of the particle
  double time = 0;                          ///< [T], in tables over time only
  const FluidForces* forces = nullptr;      ///< null without a fluid
  const GivenParticleLoad* load = nullptr;  ///< null unless the motion of the particle is given
};

const std::vector<Column<ParticleRow>>& particle_columns();

/// Columns that stand before the others in motion.csv and in frames.
inline constexpr std::array<std::string_view, 4> kFirstOfMotion = {"time", "id", "position",
                                                                   "angle"};
inline constexpr std::array<std::string_view, 2> kFirstOfParticleFrames = {"radius", "velocity"};

/// The facts that particles themselves tell.
RunFacts facts_of(const Particles& particles);

/// The rows of all particles. `loads` are in the order of the particles, some of which have none.
std::vector<ParticleRow> rows_of(const Particles& particles, double time, const FluidForces* forces,
                                 std::span<const GivenParticleLoad> loads);

/// The columns of particles in docs/file-formats.md.
ColumnTable particle_column_table();

}  // namespace viscontact::particles
