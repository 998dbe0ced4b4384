// A source adds ("pours") particles to a simulation while it runs. Lengths, masses and times are in
// the units of the case file; nothing is checked or thrown here, particles/case checks the values.
// setting.hpp contains the sources, Simulation pours after each step, and particles/run prints
// which particles wait. A change must keep the due times and the particles of each seed bit for
// bit, because users repeat runs by their seeds. A run that is continued from a restart file must
// pour the same particles as one that is not interrupted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "viscontact/particles/arrangement/species.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// A box in which particles appear one after the other, at a constant rate.
struct Source {
  std::vector<Species> species;   ///< kinds of particles; not empty; with masses > 0
  Vector from{};                  ///< lowest corner of the box in which centres are put [L]
  Vector to{};                    ///< highest corner of that box [L], >= `from` in each component
  Vector velocity{};              ///< of each particle when it comes in [L/T]
  double rate = 0;                ///< particles per time [1/T], > 0
  double begin = 0;               ///< time of the first particle [T], >= 0
  double end = 0;                 ///< last time at which a particle is due [T], > `begin`
  std::size_t largest_count = 0;  ///< largest number of particles in all, >= 1
  std::uint64_t seed = 1;         ///< seed of radii and places; any number

  /// The number of particles, 0 to `largest_count`, that are due up to the time `time` [T]: 0
  /// before `begin`, 1 at `begin`, and constant after `end`.
  std::size_t due(double time) const;
};

struct Setting;
struct State;

/// The particles that a simulation will pour in next, and how it pours them in.
class Pouring {
 public:
  /// State::sources says how many particles each source has poured already, and when it began. The
  /// constructor adds an entry for each source that has none, and sets Source::begin of all
  /// `sources` to the times in State::sources. A new source with Source::begin before state.time
  /// begins at state.time. Otherwise a run that continues another one with a new source would pour
  /// at once all particles that were due before.
  Pouring(std::vector<Source>& sources, State& state);

  /// Adds the particles that are due at state.time. The centre of each is put at a random place in
  /// the box of its source where it touches no other particle and no obstacle. If 1000 random
  /// places are not free, the particle waits for the next call, and the later particles of its
  /// source wait too. If a particle is added, State::positions_at_listing is cleared, so that the
  /// next step makes a new neighbour list. `setting` contains the sources that the constructor got.
  void pour(const Setting& setting, State& state);

 private:
  std::vector<DrawnSpecies> drawn_;  // the sequence of the particles of each source
  // The next particle of each source, if it has been drawn but has found no free place.
  std::vector<std::optional<DrawnParticle>> waiting_;
};

/// The particles of one source that are due but not poured in, because no place is free.
struct WaitingParticles {
  std::size_t source;  ///< number of the source, from 0
  std::size_t count;   ///< number of particles that wait, >= 1
  double radius;       ///< of the first of them, for which no place was free [L], > 0
};

/// The waiting particles in this state, of the sources that have any; empty if none waits.
/// `sources` are those of the case file, in the order of State::sources.
std::vector<WaitingParticles> waiting_particles(const std::vector<Source>& sources,
                                                const State& state);

}  // namespace viscontact::particles
