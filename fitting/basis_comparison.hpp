// One table fitted in every basis.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/force_table.hpp"

namespace viscontact {

struct BasisResult {
  std::string basis;
  std::optional<Fit> fit{};
  std::string failure;  ///< why there is no fit
};

/// Fits every named basis, and that of `settings` if it is a user's own, each with the other settings. Errors of a single basis are
/// kept in its result.
std::vector<BasisResult> compare_bases(const ForceTable& table, const FitSettings& settings);

/// The result with the least information criterion; nothing if none has one.
const BasisResult* best_basis(const std::vector<BasisResult>& results);

}  // namespace viscontact
