// Fits of one table in several bases, and the choice between them by Akaike's information criterion
// (FitDiagnostics::information_criterion). Lengths, masses and times are in the units of the table.
// `fit --compare-bases` and the report print and draw these fits. A change must keep that one basis
// that fails does not stop the others. Used by report/.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/motion_table.hpp"

namespace viscontact::fitting {

/// A fit in one basis, or the reason why there is none.
struct BasisResult {
  std::string basis;                      ///< its name, or its terms separated by commas
  std::optional<lubrication::Fit> fit{};  ///< nothing if the basis failed
  std::string failure;                    ///< message of the error if there is no fit
};

/// Fits the table in every named basis, and in the basis of `settings` if that is a user's list of
/// terms. All other settings are the same. The error of a basis that fails is kept in its result.
/// Throws Error(kInterrupted) if `stop` requests a stop.
std::vector<BasisResult> compare_bases(const lubrication::MotionTable& table,
                                       const FitSettings& settings, const StopToken& stop = {});

/// The result with the smallest information criterion; null if no result has a criterion.
const BasisResult* best_basis(const std::vector<BasisResult>& results);

}  // namespace viscontact::fitting
