// The shift of a rough wall: how far below its crests it acts like a smooth one (Lefebvre 2008,
// "Rugosité"; Vinogradova & Yakubov 2006). R is the resistance (drag over velocity), q the gap.
// Lengths, masses and times are in the units of the table. The command `shift` uses it. A change
// must keep the sign: the shift is > 0 if the rough wall resists less.
#pragma once

#include <vector>

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/lubrication/motion_table.hpp"

namespace viscontact::fitting {

/// The result for one row of the rough wall's table.
struct ShiftedRow {
  /// Gap from the crests of the roughness, q [L].
  double gap = 0;
  /// The shift s [L] of this row alone, from R_smooth(q + s) = R_rough(q).
  double shift = 0;
  /// R_smooth(q + q_s)/R_rough(q) - 1 [1], with the common shift q_s.
  double relative_residual = 0;
  /// Relative error estimate of the rough wall's force [1], >= 0.
  double relative_error_estimate = 0;
};

/// The common shift of all rows, with its residuals.
struct WallShift {
  double shift = 0;  ///< q_s [L]
  /// The largest |relative residual| of the rows.
  double largest_relative_residual = 0;
  /// Root mean square of the relative residuals.
  double rms_relative_residual = 0;
  std::vector<ShiftedRow> rows;  ///< in the order of the table
};

/// Fits q_s in R_rough(q) = R_smooth(q + q_s) to a table by relative least squares: the drag near a
/// rough wall is that near a smooth wall at a larger distance. Throws Error(kBadInput) if viscosity
/// or radius of table and smooth force differ, or if the drag of a row is outside the range of the
/// smooth force in its interval; Error(kNotConverged) if the least squares fail.
WallShift fit_wall_shift(const lubrication::MotionTable& rough,
                         const lubrication::LubricationForce& smooth);

}  // namespace viscontact::fitting
