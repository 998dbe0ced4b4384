// Pours the particles of sources into a simulation while it runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "viscontact/arrangement/species.hpp"
#include "viscontact/particles/setting/source.hpp"

namespace viscontact::particles {

struct Setting;
struct State;

/// The particles that a simulation will pour in next. A run that is continued from a restart file
/// pours the same particles as one that is not interrupted.
class Pouring {
 public:
  /// `state` is the state from which the simulation goes on. The constructor adds an entry to
  /// State::sources for each source that has none, and sets Source::begin of all `sources` to the
  /// times there. A new source whose Source::begin is before state.time begins at state.time;
  /// otherwise all particles that were due before would be poured at once.
  Pouring(std::vector<Source>& sources, State& state);

  /// Adds the particles that are due at state.time, each at a random place in the box of its source
  /// where it touches no other particle and no obstacle. If 1000 random places are not free, the
  /// particle waits for the next call, and the later particles of its source wait too. If a
  /// particle is added, State::positions_at_listing is cleared, so that the next step makes a new
  /// neighbour list. `setting` contains the sources that the constructor got.
  void pour(const Setting& setting, State& state);

 private:
  std::vector<DrawnSpecies> drawn_;  // the sequence of the particles of each source
  // The next particle of each source, if it has been drawn but has found no free place.
  std::vector<std::optional<DrawnParticle>> waiting_;
};

/// The particles of one source that are due but not poured in, because no place is free.
struct WaitingParticles {
  std::size_t source;  ///< from 0
  std::size_t count;   ///< >= 1
  double radius;       ///< of the first waiting particle [L]
};

/// An entry for each source of which particles wait. `sources` are those of the case file, in the
/// order of State::sources.
std::vector<WaitingParticles> waiting_particles(const std::vector<Source>& sources,
                                                const State& state);

}  // namespace viscontact::particles
