// The fits of all resistances of a pair (physics.md (2.12)) to the tables of its motions. Lengths,
// masses and times are in the units of the tables. `fit` and `rolling` use it; a change must keep
// that the matrix of resistances is checked to be symmetric.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/motions/pair_fit.hpp"

namespace viscontact::motions {

/// The tables of one pair by their motions, at least one of them.
using PairTables = std::map<lubrication::MotionKind, lubrication::MotionTable>;

/// The choices of the fits of a pair, the same for all entries.
struct PairFitSettings {
  std::string basis{kDefaultPairBasis};                  ///< one of pair_bases()
  lubrication::Loss loss = lubrication::Loss::kSquared;  ///< how strongly large residuals count
};

/// Fits the entries that the tables determine. Residuals of slide_roll are relative to the
/// geometric mean of slide and roll, or, if one of these tables is missing, to slide times r or
/// roll over r, with the radius r of the sphere; those of the other entries are relative to the
/// entry. Throws Error(kBadInput) if the tables are of different pairs, if the neighbour has a
/// velocity of its own, or if the torque of sliding and the force of rolling (both are slide_roll)
/// differ by more than their error estimates; and the errors of fit_force_table().
PairFit fit_pair(const PairTables& tables, const PairFitSettings& settings,
                 const StopToken& stop = {});

}  // namespace viscontact::motions
