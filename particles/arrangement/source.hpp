// Particles that are poured in while a simulation runs. Lengths, masses and times are in the units of
// the case. Simulation calls it after each step. A change must keep that the particles of each seed
// are the same bits, and that a run that is continued pours the same particles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "viscontact/particles/arrangement/species.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

struct Particles;
struct Setting;
struct State;

/// A place where particles are poured in.
struct Source {
  std::vector<Species> species;  ///< not empty; with masses > 0
  Vector from{};                 ///< lowest corner of the box of the centres [L]
  Vector to{};                   ///< highest corner of that box [L], >= `from` in each component
  Vector velocity{};             ///< of each particle when it comes in [L/T]
  double rate = 0;               ///< particles in a unit of time [1/T], > 0
  double begin = 0;              ///< time of the first particle [T], >= 0
  double end = 0;                ///< last time at which a particle is due [T], > `begin`
  std::size_t most = 0;          ///< number of particles in all, >= 1
  std::uint64_t seed = 1;        ///< of radii and places

  /// The number of particles that are due at a time [T].
  std::size_t due(double time) const;
};

/// The state of the sources of a simulation.
class Pouring {
 public:
  /// `state` says how many particles each source has poured already (State::poured).
  Pouring(const std::vector<Source>& sources, const State& state);

  /// Adds the particles that are due at state.time. Each is put at a random place in the region of
  /// its source where it touches no other particle and no obstacle. One for which 1000 places are
  /// taken waits for the next call, and those after it wait, too. The neighbour list is made again if
  /// a particle is added.
  void pour(const Setting& setting, State& state);

 private:
  std::vector<DrawnSpecies> drawn_;                    // of each source
  std::vector<std::optional<DrawnParticle>> waiting_;  // the next particle of each source
};

/// Gives ids to particles that have none, if the others have ids: the largest id so far plus 1, 2,
/// ...
void add_missing_ids(Particles& particles);

}  // namespace viscontact::particles
