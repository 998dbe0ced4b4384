// Overlaps of particles are removed by the descent of their energy.
#pragma once

#include "viscontact/arrangement/placed_particles.hpp"

namespace viscontact::particles {

/// What relax() reached.
struct Relaxation {
  bool is_free;    ///< all gaps are large enough
  int steps;       ///< of FIRE
  double overlap;  ///< root mean square over all that repel each other, over the mean distance
};

/// Moves all particles until their gaps are large enough, they are jammed, or `most_steps` steps
/// are done.
///
/// Two particles that are closer than kAim times their least distance D repel each other with the
/// energy (kAim D - distance)^2 / 2, of which FIRE finds a minimum (Bitzek et al. 2006). The centres
/// stay in their regions. Below the density at which the particles jam, the minimum is 0, without
/// any repulsion (O'Hern et al. 2003).
Relaxation relax(PlacedParticles& placed, int most_steps);

}  // namespace viscontact::particles
