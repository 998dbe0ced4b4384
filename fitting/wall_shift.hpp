// The shift of a rough wall: how far below its crests a smooth wall would be that resists the
// sphere as much (Lefebvre 2008, "Rugosité"; Vinogradova & Yakubov 2006).
#pragma once

#include <vector>

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/lubrication/motion_table.hpp"

namespace viscontact::fitting {

/// The result for one row of the rough wall's table, with the resistance R.
struct ShiftedRow {
  /// Gap q [L] between sphere and crests of the roughness.
  double gap = 0;
  /// The shift s [L] of this row alone, of any sign: the solution of R_smooth(q + s) = R_rough(q).
  double shift = 0;
  /// R_smooth(q + q_s)/R_rough(q) - 1 [1], with the common shift q_s.
  double relative_residual = 0;
  /// Relative error estimate of the rough wall's force [1]; 0: not known.
  double relative_error_estimate = 0;
};

/// The common shift of all rows, > 0 if the rough wall resists less than a smooth wall at its
/// crests.
struct WallShift {
  double shift = 0;  ///< q_s [L], >= 0
  /// The largest |relative residual| of the rows [1], and their root mean square.
  double largest_relative_residual = 0;
  double rms_relative_residual = 0;
  std::vector<ShiftedRow> rows;  ///< in the order of the table
};

/// Fits the common shift q_s >= 0 [L] in R_rough(q) = R_smooth(q + q_s). It minimises the sum over
/// the rows of `rough` of (R_smooth(q + q_s)/R_rough(q) - 1)^2. All q + q_s are in the fitted
/// interval of `smooth`. Throws Error(kBadInput) if `smooth` has a formula for gaps outside this
/// interval (OutsideInterval), if viscosity or radius of table and smooth force differ, if the
/// smooth force does not have the resistance of some row at any gap of its interval, or if no shift
/// brings all gaps into the interval; Error(kNotConverged) if 100 steps of the iteration do not
/// suffice.
WallShift fit_wall_shift(const lubrication::MotionTable& rough,
                         const lubrication::LubricationForce& smooth);

}  // namespace viscontact::fitting
