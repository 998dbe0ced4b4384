// What a step linearises: the films and contacts of its pairs, and the constants of its iteration.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "viscontact/suspensions/suspension_step.hpp"

namespace viscontact::suspensions {

struct StepTuning {
  // Residual of the last linear problem: its power error over the dissipation is the square.
  static constexpr double kTolerance = 1e-5;
  // Without films, where rounding errors would else grow by 1e8 in ten steps.
  static constexpr double kToleranceWithoutFilm = 1e-7;
  // The last linear problems are solved to this part of it, so that what changes after them, such as
  // directions at the end of the step, does not need another one.
  static constexpr double kSolved = 0.1;
  // The least dissipation that counts, over that of the loads on spheres alone, because spheres that
  // are pressed together and do not move have none.
  static constexpr double kLeastPower = 1e-6;
  // Each linear problem reduces its residual by this factor at least.
  static constexpr double kReduction = 1e-3;
  // Error of the gap of a contact and of friction_error(), in mean radii. A friction of loads of order
  // one has then errors of 1e-3 at most.
  static constexpr double kGapTolerance = 3e-8;
  static constexpr int kMostSolutions = 260;
  // After so many the loads that bound friction follow those of the contacts by this part of the
  // difference, because the iteration may else go on for ever: with it 1 of 100 steps of 0.01 of 200
  // spheres (volume fraction 0.45, roughness 1e-3, coefficient 0.5) is not solved, without it 72.
  // Of 0.1, 0.2, 0.3 and 0.5 this one solves most.
  static constexpr int kMostWithLoads = 40;
  static constexpr double kFollowed = 0.2;
  // After so many the bounds stay as they are.
  static constexpr int kMostFollowing = 200;
  // Error of a bound in use, over the bound, and over the largest one.
  static constexpr double kBoundTolerance = 3e-4, kLeastBound = 1e-6;
  static constexpr int kMostIterations = 5000;
  // The least factor on the tolerance of linear problems, beyond which rounding errors are met.
  static constexpr double kTightest = 1e-6;
  // After so many the motions are good enough for the place of pairs at half of the step.
  static constexpr int kRough = 2;
  // After so many linear problems a change is shortened if the slope at its end is above this part
  // of that at its begin. Without this, contacts may come and go for ever.
  static constexpr int kUnchecked = 3, kBisections = 6;
  static constexpr double kLargestSlope = 0.3;
  // Stiffness of the augmented Lagrangian over that of the film at contact.
  static constexpr double kStiffness = 10, kStiffnessAcross = 0.3;
  // Gaps in mean radii at which that film is taken, if solids touch at smaller ones.
  static constexpr double kLeastWidth = 1e-3, kWidthWithoutFilm = 1e-2;
  // A film is linearised at no less than this part of its width before.
  static constexpr double kLeastPart = 0.2;
  // Smaller gaps at the start of a step count as this one, such as those of spheres that touch.
  static constexpr double kLeastGap = 1e-7;
  // Gaps in mean radii below which a pair may touch in the step; others are added where they do.
  static constexpr double kNearGap = 0.1;
};

/// Force f = [alpha ln((q' + delta)/(q + delta))/h + constant] n on the fluid by the second sphere,
/// > 0 where gaps open, linearised at the gap `at`.
struct SuspensionStep::Film {
  double alpha = 0;         // [M L/T]
  double start = 0;         // q + delta [L]
  double delta = 0;         // [L]
  double constant = 0;      // [M L/T^2]
  double arm = 0;           // the strain's share in the motion of the surfaces [L]
  double stress_axial = 0;  // beside the force [M L^2/T]
  Vector carried{};         // from the first to the second sphere, if they move with the flow [L]
  double affine_gap = 0;    // along the normal, if the spheres only move with the flow [L]
  double curvature = 0;     // the gap at the end less the linear one [L]
  double at = 0;            // q' + delta [L]
  double load = 0;          // linearised force without motion, with that of the contact
  std::int32_t contact = -1;

  double force(double h) const { return alpha * std::log(at / start) / h + constant; }
  // The same at a gap, which may be far below the last one.
  double force_at(double gap, double h) const {
    const double least = StepTuning::kLeastPart * at, width = std::max(gap + delta, least);
    return alpha * (std::log(width / start) + (gap + delta - width) / width) / h + constant;
  }
};

struct SuspensionStep::Contact {
  std::size_t pair = 0;
  ContactMemory memory;
  double gap = 0;            // at contact [L]
  double stiffness = 0;      // [M/T]
  double borne_by_film = 0;  // part of the load that has no friction, (gamma - gamma_min)/h
  bool pushes = false;       // its load is above the least one
  // Of friction [L]: l of the pair, by which forces across the normal turn it, and its parts.
  double arm = 0, arm_first = 0, arm_second = 0;
  double stiffness_across = 0;
  Lanes friction{};
  // Where friction was linearised: slip, friction, stiffness, and the direction without stiffness.
  bool slides = false;
  double given_bound = 0;  // of friction, unless it is that of the load
  Lanes at_slip{}, at_friction{}, direction{};
  double at_stiffness = 0;
  double turn_first = 0, turn_mixed = 0, turn_second = 0;  // of the film
};

}  // namespace viscontact::suspensions
