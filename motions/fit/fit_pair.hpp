// Fits all resistances of a pair, a sphere beside a body at rest (pair_fit.hpp), to the tables of
// force and torque in its motions: approach, slide, roll, spin. Lengths, masses and times are in
// the units of the tables. Tables that are not those of one pair throw Error(kBadInput); other
// errors are those of fit_force_table(). Used by motions/job/ (commands `fit` and `rolling`) and
// the Python module. A change must keep the check that the matrix of resistances is symmetric.
#pragma once

#include <map>
#include <string>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/motions/pair_fit.hpp"

namespace viscontact::motions {

/// The tables of one pair by their motions, at least one table.
using PairTables = std::map<lubrication::MotionKind, lubrication::MotionTable>;

/// The choices of the fits of a pair, the same for all resistances.
struct PairFitSettings {
  std::string basis{kDefaultPairBasis};  ///< one of pair_bases()
  /// kSquared: least squares; kHuber, kCauchy: large residuals count less.
  lubrication::Loss loss = lubrication::Loss::kSquared;
};

/// Fits the resistances (entries) that the tables determine. Residuals are relative to the entry,
/// but those of slide_roll, which can be 0, are relative to sqrt(slide roll), or, if one of these
/// tables is missing, to slide r or roll/r, with the radius r of the sphere. Throws
/// Error(kBadInput) if there is no table, if the tables are of different pairs or have no gaps in
/// common, if the neighbour moves, if the table of rolling lacks a gap of that of sliding, or if
/// their slide_roll differ by more than their error estimates, or if `settings.basis` is not known;
/// and errors of fit_force_table(): Error(kNotConverged), and Error(kInterrupted) if `stop`
/// requests a stop during a robust fit. The versions in the result are empty.
PairFit fit_pair(const PairTables& tables, const PairFitSettings& settings,
                 const StopToken& stop = {});

}  // namespace viscontact::motions
