// Fits of one force table in several bases, and the choice between them by Akaike's information
// criterion.
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
  /// Name of the basis, such as lecture; kOwnTerms ("terms") for a user's list of terms.
  std::string basis;
  std::optional<lubrication::Fit> fit{};  ///< nothing if the fit threw an Error
  std::string failure;                    ///< what() of that Error; empty if there is a fit
};

/// Fits the table in each of all_bases(), or bases_beside_walls() if it has a second wall, in this
/// order, and then in settings.basis if this is a user's list of terms. Rows and weights are the
/// same for each fit, because the criteria could not be compared otherwise. An Error of a fit is
/// stored in its result and not thrown, except Error(kInterrupted) if `stop` requests a stop, which
/// is checked before each fit and during a fit with a robust loss.
std::vector<BasisResult> compare_bases(const lubrication::MotionTable& table,
                                       const FitSettings& settings, const StopToken& stop = {});

/// The element of `results` whose fit has the smallest FitDiagnostics::information_criterion, the
/// first among equal ones; null if no fit has a criterion, as with robust losses or too few rows.
const BasisResult* best_basis(const std::vector<BasisResult>& results);

}  // namespace viscontact::fitting
