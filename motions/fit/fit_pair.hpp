// Fits all resistances of a pair (pair_fit.hpp) to tables of force and torque on the sphere.
#pragma once

#include <map>
#include <string>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/motions/pair_fit.hpp"

namespace viscontact::motions {

/// The tables of one pair by their motions: at least one table, each with at least one row.
using PairTables = std::map<lubrication::MotionKind, lubrication::MotionTable>;

/// The choices of the fits of a pair.
struct PairFitSettings {
  std::string basis{kDefaultPairBasis};  ///< a name of pair_bases()
  /// kSquared is plain least squares; with kHuber and kCauchy large residuals count less.
  lubrication::Loss loss = lubrication::Loss::kSquared;
};

/// Fits the resistances, called entries, that the tables determine: squeeze by the approach, slide,
/// roll and spin by the tables of these names, slide_roll by those of sliding or rolling, and all
/// other entries by tables with stresslets, as NamedEntry says; those of the neighbour, if it is a
/// sphere, and traces, if the fluid is unbounded. Residuals are relative to the entry; those of the
/// other entries are relative to the diagonal entry of their motion times a power of the radius.
/// Those of slide_roll, which can be 0, are relative to sqrt(slide roll). If there is no table of
/// rolling, they are relative to slide r, and if there is none of sliding, to roll/r, with the
/// radius r of the sphere. The interval of gaps of the result is the one that all tables have in
/// common, its units are those of the tables, and `versions` is empty.
///
/// Throws Error(kBadInput) if there is no table; if viscosity, radius, geometry or container of two
/// tables differ, or their intervals of gaps do not overlap; if the neighbour moves; if the table
/// of rolling lacks a gap of that of sliding; if the slide_roll of both differ by more than their
/// error estimates, or without estimates by more than 1e-3 sqrt(slide roll); if a table has fewer
/// gaps than the basis has terms; or if `settings.basis` is not known. Throws Error(kNotConverged)
/// if the terms cannot be told apart on these gaps or a robust fit does not converge, and
/// Error(kInterrupted) if `stop` requests a stop during a robust fit.
PairFit fit_pair(const PairTables& tables, const PairFitSettings& settings,
                 const StopToken& stop = {});

}  // namespace viscontact::motions
