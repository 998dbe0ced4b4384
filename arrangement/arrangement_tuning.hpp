// Free choices of random arrangements.
#pragma once

#include <cstddef>

namespace viscontact::particles {

/// Free choices of random arrangements. Other values change the arrangements of seeds.
struct ArrangementTuning {
  // Least share of the region for centres in the domain; below it, random places would be found too
  // slowly.
  static constexpr double kLeastFraction = 1e-6;
  // Rounds over the planes in which a point is moved into the region.
  static constexpr int kProjections = 20;
  // Slightly beyond a plane, so that rounding errors do not leave the point behind it.
  static constexpr double kBeyond = 1 + 1e-6;
  // Slightly inside a disc: 1e-12 of the radius exceeds the rounding errors.
  static constexpr double kInside = 1 - 1e-12;
  // Aim of a push over the distance that two particles must have, because pushes approach their aim
  // without reaching it.
  static constexpr double kFurther = 1 + 1e-3;
  // Largest random move along an axis: half of the gap in the densest lattice, of which about half
  // of the moves are kept, and at least 0.01 of the least distance, so that a dense arrangement can
  // move too.
  static constexpr double kOfLatticeGap = 0.5, kOfDistance = 0.01;
  // 500 moves of each particle, on average, are taken as enough to forget the first places. To
  // bound the time, more than 40 000 particles make 20 million moves in all, but at least 20 each.
  static constexpr std::size_t kMoves = 20000000, kMostMoves = 500, kFewestMoves = 20;
  // Random beginnings, tries for a free place of each particle, and rounds of pushes. Larger
  // numbers find more of the dense arrangements.
  static constexpr int kBeginnings = 10, kTries = 1000, kRounds = 2000;
  // While particles are pushed, neighbours are listed up to twice this slack, over the least
  // distance of the smallest particles, beyond their least distance. Lists that served fewer than
  // kUses queries of each particle are given up for kPause queries of each. Lists halve the time of
  // 1000 spheres at 0.61 and change no bits.
  static constexpr double kSlack = 0.1;
  static constexpr std::size_t kUses = 5, kPause = 10;
};

}  // namespace viscontact::particles
