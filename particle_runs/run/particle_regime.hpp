// Reynolds and Stokes numbers of a run of many particles.
#pragma once

#include <string>
#include <vector>

#include "viscontact/particle_runs/case/particles_case.hpp"

namespace viscontact::particles {

/// The largest numbers of all particles and steps [1]; < 0: not known. The speed |V| of a particle
/// is that relative to the linear flow of the case, if it has one.
struct ParticleRegime {
  double reynolds = -1;  ///< 2 r rho_f |V|/mu
  /// m |V|/(6 pi mu r^2); of discs with masses per length that of a sphere of their density.
  double stokes = -1;
  /// Without a fluid around the particles: m |V|/|gamma_min|, with gamma_min of a film at a plane.
  double film = -1;
  bool has_contact = false;
  bool have_solids_touched = false;  ///< whether a film has absorbed all that it can

  /// The radius of each particle, and gamma_min of a film at a plane, which is integrated once.
  struct AtPlane {
    double radius = -1, lowest_gamma = 0;
  };
  std::vector<AtPlane> at_plane;

  /// Takes the state at the end of a step into account, and whether it has contacts.
  void add(const ParticlesCase& c, const State& state, bool contact);
};

/// The largest Stokes and Reynolds numbers in words; empty if the case has no viscosity.
std::string in_words(const ParticleRegime& regime);

/// Warnings of a Reynolds number at which Stokes flow does not hold, although the case computes the
/// fluid without inertia, and of films in which inertia plays no part.
std::vector<std::string> warnings_of(const ParticlesCase& c, const ParticleRegime& regime);

}  // namespace viscontact::particles
