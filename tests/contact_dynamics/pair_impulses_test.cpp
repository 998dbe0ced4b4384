#include "viscontact/contact_dynamics/pair_impulses.hpp"

#include <gtest/gtest.h>

#include "tests/particles/systems.hpp"

namespace viscontact::particles {
namespace {

/// Two plates without a pair.
State two_plates() {
  State state = no_particles(2);
  for (const double x : {0.0, 3.0}) {
    add_particle(state, {x, 0, 0}, 1, 1);
    state.particles.shapes.push_back(Shape::plate(1, 0.1));
  }
  return state;
}

/// Pair 0, 1 with a contact for each of `places`. The impulse is that of all of them.
void list_contacts(State& state, std::initializer_list<int> places, double impulse) {
  state.pairs.clear();
  for (const int place : places) {
    Pair pair{0, 1};
    pair.place = place;
    pair.impulse = impulse;
    PairMemory memory;
    memory.set_friction({2 * impulse, 0, 0});
    state.memories.set(pair.memory, memory);
    state.pairs.push_back(pair);
  }
}

TEST(PairImpulses, SumsOfAContactThatHasAnotherNumberNowAreNotLost) {
  auto state = two_plates();
  PairImpulses sums;
  list_contacts(state, {0, 1}, 1);
  sums.add(state);
  list_contacts(state, {2}, 10);  // both have become one
  sums.add(state);
  sums.give_to(state);
  EXPECT_EQ(state.pairs[0].impulse, 12);
  EXPECT_EQ(state.memories.of(state.pairs[0].memory).friction()[0], 24);
}

TEST(PairImpulses, OfAContactThatKeepsItsNumberGoToIt) {
  auto state = two_plates();
  PairImpulses sums;
  list_contacts(state, {0, 2}, 1);
  sums.add(state);
  list_contacts(state, {0, 2}, 3);
  sums.add(state);
  sums.give_to(state);
  EXPECT_EQ(state.pairs[0].impulse, 4);
  EXPECT_EQ(state.pairs[1].impulse, 4);
}

TEST(PairImpulses, CopiesAreGivenBackAndOtherPairsGetNone) {
  auto state = two_plates();
  PairImpulses copy;
  list_contacts(state, {0}, 5);
  copy.copy(state);
  list_contacts(state, {0, 2}, 7);
  copy.restore(state);
  EXPECT_EQ(state.pairs[0].impulse, 5);
  EXPECT_EQ(state.memories.of(state.pairs[0].memory).friction()[0], 10);
  EXPECT_EQ(state.pairs[1].impulse, 0);
  EXPECT_EQ(state.memories.of(state.pairs[1].memory).friction()[0], 0);
}

TEST(PairImpulses, AreScaledWithThoseInMemories) {
  auto state = two_plates();
  list_contacts(state, {0}, 5);
  scale_impulses(0.5, state);
  EXPECT_EQ(state.pairs[0].impulse, 2.5);
  EXPECT_EQ(state.memories.of(state.pairs[0].memory).friction()[0], 5);
}

}  // namespace
}  // namespace viscontact::particles
