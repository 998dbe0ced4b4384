// Adds particles to a simulation while it runs: each source of a case adds ("pours") particles into
// a box at a constant rate. Lengths, masses and times are in the units of the case file. Nothing is
// checked or thrown here; particles/case checks the values. setting.hpp contains the sources,
// Simulation (simulation.hpp) pours after each step, and particles/run prints which particles wait
// because no place is free. A change must keep the due times and the particles of each seed bit for
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
  std::vector<Species> species;   ///< kinds of particles, at least one, with masses > 0
  Vector from{};                  ///< lowest corner of the box in which centres are put [L]
  Vector to{};                    ///< highest corner of that box [L], >= `from` in each component
  Vector velocity{};              ///< of each particle when it is added [L/T]
  double rate = 0;                ///< particles per time [1/T], > 0
  double begin = 0;               ///< time of the first particle [T], >= 0
  double end = 0;                 ///< last time at which a particle is due [T], > `begin`
  std::size_t largest_count = 0;  ///< largest number of particles that the source adds, >= 1
  std::uint64_t seed = 1;         ///< seed of radii and places; any number

  /// The number of particles, 0 to `largest_count`, that are due up to the time `time` [T], any
  /// number. It is 0 before `begin`, 1 at `begin`, grows by `rate` per time, and is constant after
  /// `end`.
  std::size_t due(double time) const;
};

struct Setting;
struct State;

/// The particles that a simulation will pour in next, and how it pours them in.
class Pouring {
 public:
  /// `state` is the state from which the simulation goes on. Its array State::sources has an entry
  /// for each source of the run that made the state: how many particles it has poured already, and
  /// when it began. The constructor adds an entry for each further source, and sets Source::begin
  /// of all `sources` to the times in State::sources. A further source whose Source::begin is
  /// before state.time begins at state.time. Otherwise a run that continues another one with a new
  /// source would pour at once all particles that were due before.
  Pouring(std::vector<Source>& sources, State& state);

  /// Adds the particles that are due at state.time. The centre of each is put at a random place in
  /// the box of its source where it touches no other particle and no obstacle (wall of the domain
  /// or plane). If 1000 random places are not free, the particle waits for the next call, and the
  /// later particles of its source wait too. (The number 1000 bounds the time; another one changes
  /// runs.) If a particle is added, State::positions_at_listing is cleared, so that the next step
  /// makes a new neighbour list. `setting` contains the sources that the constructor got.
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
  double radius;       ///< of the first waiting particle, for which no place was free [L], > 0
};

/// An entry for each source of which particles wait in this state; empty if no particle waits.
/// `sources` are those of the case file, in the order of State::sources.
std::vector<WaitingParticles> waiting_particles(const std::vector<Source>& sources,
                                                const State& state);

}  // namespace viscontact::particles
