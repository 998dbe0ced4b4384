// The impulses of the pairs of a state, kept outside it.
#pragma once

#include <array>
#include <cstdint>
#include <map>

#include "viscontact/particles/state/pair_memory.hpp"
#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

/// Impulses [M L/T] and memories of pairs.
class PairImpulses {
 public:
  bool empty() const { return of_.empty(); }
  void clear() { of_.clear(); }

  /// Of all pairs of `state`. The object must be empty.
  void copy(const State& state);
  /// Gives the pairs of `state` the impulses and memories that copy() has taken.
  void restore(State& state) const;

  /// Adds the impulses of all pairs of `state`, and those in their memories.
  void add(const State& state);
  /// Gives the pairs of `state` the sums of add(), and 0 to pairs without a sum. The sum of a contact
  /// that has got another number, or has become one with another, goes to a present contact of the
  /// same shapes.
  void give_to(State& state);

 private:
  struct Impulses {
    double of_contact = 0;
    PairMemory memory{};
    void add(double impulse, const PairMemory& other);
  };
  using Key = std::array<std::int32_t, 4>;  // Pair::first, second, image and place
  static Key key_of(const Pair& pair) { return {pair.first, pair.second, pair.image, pair.place}; }
  Impulses of(const Pair& pair) const;
  void move_to_present(const State& state);

  std::map<Key, Impulses> of_;
};

/// Multiplies the impulses of all pairs, and those in their memories, by `factor`.
void scale_impulses(double factor, State& state);

}  // namespace viscontact::particles
