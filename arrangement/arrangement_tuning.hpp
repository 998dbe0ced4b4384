// Free choices of random arrangements.
#pragma once

#include <cstddef>

namespace viscontact::particles {

/// Free choices of random arrangements. Other values change the arrangements of seeds.
struct ArrangementTuning {
  // Gap over the smallest radius, if none is asked.
  static constexpr double kGapOfRadius = 0.05;
  // What random packings of equal discs or spheres cover, just below the densest that are found.
  static constexpr double kPackedArea = 0.83, kPackedVolume = 0.635;
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

  // If pushes fail. Pushes of all particles, in all beginnings; 1000 particles have ten beginnings.
  // 10 000 spheres at 0.61 need 15 million, 100 000 spheres at 0.55 18 million; more would take
  // longer than 10 s.
  static constexpr std::size_t kMostPushes = 20000000;
  // Tries for a free place of a particle before the repulsion; it decides little.
  static constexpr int kTriesBeforeRepulsion = 20;
  // Random beginnings, and steps in one of them and in all of them times the particles. 1000 equal
  // spheres at 0.635 take 10 000 steps, 10 000 at 0.62 less than 1000; 4e8 steps take about 20 s.
  static constexpr int kPackings = 30, kMostSteps = 20000;
  static constexpr std::size_t kMostStepsOfAll = 400000000;
  // Distance at which particles stop to repel each other, over their least distance: close to 1,
  // because packings are less dense by the cube of it, but beyond rounding errors.
  static constexpr double kAim = 1 + 1e-4;
  // Way of a particle until pairs are listed anew, and longest move in a step, over the mean least
  // distance.
  static constexpr double kRelaxationSlack = 0.1, kLongestMove = 0.1;
  // FIRE as Bitzek et al. (2006) have it. A step of 0.8 is unstable, and 0.3 takes twice as many.
  static constexpr double kFirstStep = 0.1, kLongestStep = 0.5, kMixing = 0.1, kLessMixing = 0.99,
                          kFaster = 1.1, kSlower = 0.5;
  static constexpr int kDownhill = 5;
  // Particles are jammed if so many steps leave more than this part of the energy.
  static constexpr int kStepsOfCheck = 250;
  static constexpr double kJammed = 0.99;
  // How often jammed particles are made smaller, to say which fraction can be reached, and by how
  // much beyond their mean overlap.
  static constexpr int kShrinkings = 12;
  static constexpr double kShrinkFurther = 2e-4;
};

}  // namespace viscontact::particles
