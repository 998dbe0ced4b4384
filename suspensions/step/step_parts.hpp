// The constants of the iteration of a step, and the unknown rate of the flow.
#pragma once

#include <vector>

#include "viscontact/suspensions/step/suspension_step.hpp"

namespace viscontact::suspensions {

struct StepTuning {
  // Residual of the last linear problem: the error of the dissipation is its square, and stresses
  // beside it, such as N_1, have an error of the first power. With 1e-5 a step takes a quarter less
  // time, and the work of the walls by N_1 differs from the dissipation by 2e-5.
  static constexpr double kTolerance = 3e-9;
  // Without films, where rounding errors would else grow by 1e8 in ten steps.
  static constexpr double kToleranceWithoutFilm = 1e-7;
  // The last linear problems are solved to this part of it, so that what changes after them, such
  // as directions at the end of the step, does not need another one.
  static constexpr double kSolved = 0.1;
  // The least dissipation that counts, over that of the loads on spheres alone, because spheres
  // that are pressed together and do not move have none.
  static constexpr double kLeastPower = 1e-6;
  // Rounding errors of a gap, in mean radii, some tens of those of one operation. What films and
  // contacts make of it is the least residual, because nothing smaller can be reached where nothing
  // moves.
  static constexpr double kGapRounding = 1e-14;
  // The dissipation that counts is that after so many linear problems, or the present one if it has
  // fallen below this part of that of the start, as it does where a flow stops.
  static constexpr int kMeasured = 3;
  static constexpr double kFallen = 0.1;
  // Rates are at rest below this strain in a step, and below so many of their errors by
  // kGapRounding.
  static constexpr double kRestStrain = 1e-12, kRestErrors = 100;
  // Each linear problem reduces its residual by this factor at least, and more before the pairs are
  // placed again, so that rounding errors of motions hardly change their places.
  static constexpr double kReduction = 1e-3, kReductionBefore = 1e-4;
  // Nor is it solved better than to this part of what the loads of contacts still change. 10 000
  // spheres at 0.55 take 169 iterations, 178 and 173 with half and twice of it, 203 without it.
  static constexpr double kPartOfChanges = 5e-3;
  // The factors of a linear problem are those of an earlier one while fewer than this part of the
  // pairs have changed their stiffnesses by this part of them. This takes no more iterations; ten
  // times as many pairs, a twentieth more.
  static constexpr double kFewChanged = 1e-4, kChanged = 0.1;
  // Error of the gap of a contact and of friction_error(), in mean radii. A friction of loads of
  // order one has then errors of 1e-3 at most.
  static constexpr double kGapTolerance = 3e-8;
  // The residual of linear problems of steps with friction is less by this factor, because the
  // loads of contacts are found to a part of a gap of this size.
  static constexpr double kTightWithFriction = 1e-2;
  // Few contacts are solved before the first accelerated solution, and do not depend on rounding
  // errors, which the acceleration may enlarge to a part of the tolerance.
  static constexpr int kFirstAccelerated = 16;
  // The loads of contacts are accelerated after each fourth solution: in the first ones always, and
  // then only after so many in which each contact stays open, sticks or slides. Always accelerated,
  // the loads of four hard steps (200 spheres, 0.52 and 0.55 of the volume, coefficients 1 and 0.5)
  // go on changing for ever; never accelerated, they need 130 to 390 solutions.
  static constexpr int kAcceleratedEach = 4, kMostAccelerated = 100, kUnchanged = 4;
  // The reduction with friction. With 1e-3 a third more iterations are needed.
  static constexpr double kReductionWithFriction = 1e-2;
  // With friction factors serve so many linear problems while each contact stays open, sticks or
  // slides, which takes a twentieth of the time less than new ones each time.
  static constexpr int kFactorsWithFriction = 4;
  // After so many the splitting follows.
  static constexpr int kFirstSplit = 50;
  // After so many beside those of the splitting, or if that fails, the bounds of friction stay as
  // they are.
  static constexpr int kMostWithLoads = 150;
  static constexpr int kMostSolutions = 270;
  // The same with a given stress and no contacts. Each fifth step of smooth spheres with gaps of
  // some 1e-7 goes to and fro for ever, because a larger rate turns pairs farther, which opens their
  // gaps; half of the step does not. Others take at most 30.
  static constexpr int kMostWithRate = 40;
  // Error of a bound in use, over the bound, and over the largest one.
  static constexpr double kBoundTolerance = 3e-4, kLeastBound = 1e-6;
  static constexpr int kMostIterations = 5000;
  // So many linear problems may have loads of contacts that are taken early.
  static constexpr int kMostEarly = 40;
  // The least factor on the tolerance of linear problems, beyond which rounding errors are met.
  static constexpr double kTightest = 1e-6;
  // After so many the motions are good enough for the place of pairs at half of the step.
  static constexpr int kRough = 2, kRoughWithFriction = 4;
  // After so many linear problems a change is shortened if the slope at its end is above this part
  // of that at its begin. Without this, contacts may come and go for ever.
  static constexpr int kUnchecked = 3, kBisections = 6;
  static constexpr double kLargestSlope = 0.3;
  // Error of a given stress, relative, and rounding errors of the terms that it consists of.
  static constexpr double kStressTolerance = 1e-8, kStressRounding = 1e-12;
  // The last linear problem of a step changes the stress by some 1e-8. What is corrected after it
  // at most, so that no gap changes by more than its tolerance.
  static constexpr double kMostCorrected = 1e-6;
  static constexpr int kMostCorrections = 3;
  // The motions over the rate are the response to it if they are this near the best multiple.
  static constexpr double kProportional = 0.5;
  // Stiffness of the augmented Lagrangian over that of the film at contact. The loads change by the
  // gap times both stiffnesses, with which the load of a contact that no other one moves is right
  // at once. 10 000 spheres at 0.55 take 271, 220, 196, 182, 169 and 168 iterations with 10, 5, 3,
  // 2, 1.5 and 1.
  static constexpr double kStiffness = 1.5;
  // The same without a film, and after so many linear problems: in a settled bed, where contacts
  // share the loads of others, their loads change by a percent only with the smaller one.
  static constexpr double kLargeStiffness = 10;
  static constexpr int kMostSoft = 24;
  // The same with friction. With 1 in place of 5, or 0.3 in place of 1, fewer steps are solved.
  static constexpr double kStiffnessWithFriction = 5, kStiffnessAcross = 1;
  // Gaps in mean radii at which that film is taken, if solids touch at smaller ones.
  static constexpr double kLeastWidth = 1e-4, kLeastWidthWithFriction = 1e-3,
                          kWidthWithoutFilm = 1e-2;
  // A film is linearised at no less than this part of its width before.
  static constexpr double kLeastPart = 0.2;
  // Smaller gaps at the start of a step count as this one, such as those of spheres that touch.
  static constexpr double kLeastGap = 1e-7;
  // Spheres that only a film keeps apart touch at this gap in mean radii. An impact closes the gap
  // to exp(-St) of that at its start, where St, the momentum over 6 pi mu a^2, may be 1000.
  static constexpr double kSolidGap = 1e-9;
  // A sphere with inertia that would close a gap to this part of it in the step loses its velocity
  // there: theta = 1.
  static constexpr double kImpact = 0.25;
  // Gaps in mean radii below which a pair may touch in the step; others are added where they do.
  static constexpr double kNearGap = 0.02;
};

/// The rate of the flow, if it is an unknown, and its row in the linear problem.
struct SuspensionStep::Rate {
  double value = 0;        // [1]
  SymmetricTensor strain;  // at rate 1 [1/T]
  // Loads of the spheres and power at rate 1, without those of films along normals and of contacts.
  std::vector<Motion> loads_by_strain;
  double of_strain = 0;
  std::vector<double> opening;  // rate at which the flow of rate 1 opens each pair [L/T]
  std::vector<Motion> loads;    // of the spheres at rate 1
  double resistance = 0;        // power at rate 1 without motions [M L^2/T^3]
  double resisted = 0;          // the same with the motions that respond to the rate
  double power = 0;             // at rate 1 of the present forces [M L^2/T^3]
  double magnitude = 0;         // sum of the magnitudes of the terms of `power`
  bool is_right = false;        // whether `power` was that of the stress
};

}  // namespace viscontact::suspensions
