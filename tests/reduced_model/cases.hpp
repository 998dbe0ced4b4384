// The motions and forces that the tests of the models share. Lengths, masses and times are in one
// unit each.
#pragma once

#include <array>
#include <random>
#include <string_view>

#include "viscontact/lubrication/fit.hpp"
#include "viscontact/reduced_model/motion.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact::reduced_model {

/// Smallest gaps of the lecture's case with the exact drag in a half-space (docs/theory.md, section
/// 3), without inertia and with inertia, and the time of the latter.
inline constexpr double kExactMinimalGap = 2.97084661e-3;
inline constexpr double kInertialMinimalGap = 2.97845928e-3;
inline constexpr double kInertialMinimalGapTime = 2.00072819;

/// The lecture's case: m = 20, q0 = 1 at rest, pushed by -200 for 2, pulled by +200 until 4. Time
/// steps 1e-3, tolerance 1e-9.
Motion lecture_motion();

/// The lecture's limit case: m = 1, q0 = 1 at rest, f = -2 until t = 2 and +2 until t = 6. Time
/// steps 1e-3, tolerance 1e-9.
Motion limit_motion();

/// Brenner's exact drag of the lecture's sphere (mu = 3, r = 1), fitted on 40 log-spaced gaps.
lubrication::Fit brenner_fit(std::string_view basis, std::array<double, 2> gaps);

/// The lecture's basis on the gaps of its case: largest relative residual 4.6e-3.
lubrication::Fit lecture_fit();

/// The asymptotic basis on gaps in [1e-3, 1.01], those of the lecture's motion: largest relative
/// residual 7.1e-6. (On [1e-3, 2] it is 6.8e-5.)
lubrication::Fit close_fit();

/// A fit with R = k/q exactly and radius 1, for gaps q in [1e-200, 1e20].
lubrication::Fit leading_term_fit(double k);

/// A fit with R = k (1/q + 1) and radius 1, for gaps q in [1e-200, 1e200].
lubrication::Fit shifted_fit(double k);

/// A motion and the k of its drag.
struct RandomCase {
  Motion motion;
  double k;
};

/// A random motion until t = 10 with steps from 0.01 to 0.1. Masses and viscosities are spread over
/// ten decades. The force has up to six jumps over four decades, and in every third case a sinusoid
/// is added. Half of the surfaces are rough.
RandomCase random_case(std::mt19937_64& generator);

/// The first of the rows with the smallest gap.
const TrajectoryRow& lowest_row(const Trajectory& trajectory);

/// The row whose time is exactly `time`; fails the test if there is none.
const TrajectoryRow& row_at(const Trajectory& trajectory, double time);

}  // namespace viscontact::reduced_model
