// Sources, from which particles are poured in while a simulation runs. Lengths, masses and times
// are in the units of the case; nothing is thrown. Setting has them, and Simulation pours after
// each step. A change must keep the times of each source, that the particles of each seed are the
// same bits, because users repeat runs by their seeds, and that a run that is continued pours the
// same ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "viscontact/particles/arrangement/species.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// A place where particles are poured in.
struct Source {
  std::vector<Species> species;   ///< not empty; with masses > 0
  Vector from{};                  ///< lowest corner of the box of the centres [L]
  Vector to{};                    ///< highest corner of that box [L], >= `from` in each component
  Vector velocity{};              ///< of each particle when it comes in [L/T]
  double rate = 0;                ///< particles in a unit of time [1/T], > 0
  double begin = 0;               ///< time of the first particle [T], >= 0
  double end = 0;                 ///< last time at which a particle is due [T], > `begin`
  std::size_t largest_count = 0;  ///< number of particles in all, at the most; >= 1
  std::uint64_t seed = 1;         ///< of radii and places

  /// The number of particles that are due at a time [T].
  std::size_t due(double time) const;
};

struct Setting;
struct State;

/// The particles that a simulation will pour in next.
class Pouring {
 public:
  /// `state` says how many particles each source has poured already, and when the source begins
  /// (State::sources). A source that is new to it is added there. It begins at state.time if
  /// Source::begin is earlier, so that a run that continues another one does not pour at once what
  /// would have come before. `sources` get the times at which they begin.
  Pouring(std::vector<Source>& sources, State& state);

  /// Adds the particles that are due at state.time. Each is put at a random place in the region of
  /// its source where it touches no other particle and no obstacle. One for which 1000 places are
  /// taken waits for the next call, and those after it wait, too. The neighbour list is made again
  /// if a particle is added. `setting` has the sources of the constructor.
  void pour(const Setting& setting, State& state);

 private:
  std::vector<DrawnSpecies> drawn_;                    // of each source
  std::vector<std::optional<DrawnParticle>> waiting_;  // the next particle of each source
};

/// Particles of a source that are due but have not come, because there is no free place.
struct WaitingParticles {
  std::size_t source;  ///< its number, from 0
  std::size_t count;   ///< >= 1
  double radius;       ///< of the first one, for which no place was free [L]
};

/// The particles that wait in this state, by their sources; `sources` are those of its case.
std::vector<WaitingParticles> waiting_particles(const std::vector<Source>& sources,
                                                const State& state);

}  // namespace viscontact::particles
