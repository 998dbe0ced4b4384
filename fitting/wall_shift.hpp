// A rough wall as a smooth one that lies deeper: the shift at which the smooth wall's drag is the rough wall's.
#pragma once

#include <vector>

#include "viscontact/lubrication/force_table.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"

namespace viscontact {

/// One row of the rough wall's table.
struct ShiftedRow {
  double gap = 0;                      ///< q [L], from the roughness's crests
  double shift = 0;                    ///< s [L] with R_smooth(q + s) = R_rough(q)
  double relative_residual = 0;        ///< R_smooth(q + q_s) / R_rough(q) - 1, q_s the common shift
  double relative_error_estimate = 0;  ///< of the rough wall's force
};

struct WallShift {
  double shift = 0;                      ///< q_s [L], common to all rows
  double largest_relative_residual = 0;  ///< in absolute value
  double rms_relative_residual = 0;
  std::vector<ShiftedRow> rows;  ///< in the order of the table
};

/// Fits q_s in R_rough(q) = R_smooth(q + q_s) to a table, by relative least squares (Lefebvre 2008, "Rugosité";
/// Vinogradova & Yakubov 2006: a rough sphere drags like a smooth one shifted).
///
/// Throws Error(kBadInput) if viscosity or radius of table and smooth force differ, or a row's drag is beyond what the smooth
/// force has in its interval; Error(kNotConverged) if the least squares fail.
WallShift fit_wall_shift(const ForceTable& rough, const LubricationForce& smooth);

}  // namespace viscontact
