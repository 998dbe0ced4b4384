#include "viscontact/contact_dynamics/pair_impulses.hpp"

#include <cassert>
#include <set>

namespace viscontact::particles {
namespace {

/// Calls visit(pair) for all pairs of a state.
template <class AnyState, class Visit>
void for_pairs(AnyState& state, const Visit& visit) {
  for (auto* pairs : {&state.pairs, &state.walls})
    for (auto& pair : *pairs) visit(pair);
}

/// Calls `change` for each number of `memory` that is an impulse, with the number of `other` at the
/// same place.
template <class Change>
void for_impulses(PairMemory& memory, const PairMemory& other, const Change& change) {
  for (std::size_t f = 0; f < kMemoryFields.size(); ++f)
    if (kMemoryFields[f].is_impulse) change(memory.values()[f], other.values()[f]);
}

bool has_impulses(const Pair& pair) {
  return pair.impulse != 0 || pair.memory != PairMemories::kNone;
}

}  // namespace

void PairImpulses::Impulses::add(double impulse, const PairMemory& other) {
  of_contact += impulse;
  for_impulses(memory, other, [](double& sum, double value) { sum += value; });
}

PairImpulses::Impulses PairImpulses::of(const Pair& pair) const {
  const auto found = of_.find(key_of(pair));
  return found == of_.end() ? Impulses{} : found->second;
}

void PairImpulses::copy(const State& state) {
  assert(empty());
  for_pairs(state, [&](const Pair& pair) {
    if (has_impulses(pair)) of_[key_of(pair)] = {pair.impulse, state.memories.of(pair.memory)};
  });
}

void PairImpulses::restore(State& state) const {
  for_pairs(state, [&](Pair& pair) {
    const auto impulses = of(pair);
    pair.impulse = impulses.of_contact;
    state.memories.set(pair.memory, impulses.memory);
  });
}

void PairImpulses::add(const State& state) {
  for_pairs(state, [&](const Pair& pair) {
    if (has_impulses(pair)) of_[key_of(pair)].add(pair.impulse, state.memories.of(pair.memory));
  });
}

void PairImpulses::give_to(State& state) {
  if (state.particles.has_other_shapes()) move_to_present(state);
  for_pairs(state, [&](Pair& pair) {
    const auto impulses = of(pair);
    pair.impulse = impulses.of_contact;
    auto memory = state.memories.of(pair.memory);
    for_impulses(memory, impulses.memory, [](double& value, double sum) { value = sum; });
    state.memories.set(pair.memory, memory);
  });
}

void PairImpulses::move_to_present(const State& state) {
  std::set<Key> present;
  for_pairs(state, [&](const Pair& pair) { present.insert(key_of(pair)); });
  for (auto sums = of_.begin(); sums != of_.end();) {
    const auto [first, second, image, place] = sums->first;
    const auto same = present.lower_bound({first, second, image, 0});
    if (present.contains(sums->first) || same == present.end() ||
        Key{(*same)[0], (*same)[1], (*same)[2], place} != sums->first) {
      ++sums;
      continue;
    }
    of_[*same].add(sums->second.of_contact, sums->second.memory);
    sums = of_.erase(sums);
  }
}

void scale_impulses(double factor, State& state) {
  for_pairs(state, [&](Pair& pair) {
    pair.impulse *= factor;
    if (pair.memory == PairMemories::kNone) return;
    auto& memory = state.memories.make(pair.memory);
    for_impulses(memory, memory, [&](double& value, double) { value *= factor; });
  });
}

}  // namespace viscontact::particles
