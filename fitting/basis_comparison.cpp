// Fits one force table in each basis (list of functions of the gap), and picks the fit with the
// smallest value of Akaike's criterion, a number without dimension. Gaps [L] are positive,
// velocities [L/T] not 0, forces in [M L/T^2], in the units of the table (not checked). The Error
// of a basis that cannot be fitted is stored as its text, not thrown; only Error(kInterrupted) is
// thrown. best_basis() is null if no fit has a criterion. Used by pipeline/fit_stages.cpp and
// report/. A change must fit the same rows with the same weights in each basis, because the values
// of the criterion cannot be compared otherwise.
#include "viscontact/fitting/basis_comparison.hpp"

#include "viscontact/common/error.hpp"

namespace viscontact::fitting {

/// The fit in each known basis, and then in settings.basis if this is the user's own list of terms.
/// Each result has a fit or the text of its error. The table must have a row (not checked).
std::vector<BasisResult> compare_bases(const lubrication::MotionTable& table,
                                       const FitSettings& settings, const StopToken& stop) {
  const bool has_wall =
      lubrication::second_wall(table.geometry, table.container, table.radius).has_value();
  auto bases = has_wall ? lubrication::bases_beside_walls() : lubrication::all_bases();
  if (settings.basis.name == lubrication::kOwnTerms) bases.push_back(settings.basis);
  std::vector<BasisResult> results;
  for (const auto& basis : bases) {
    BasisResult result{std::string(basis.name), {}, ""};
    FitSettings one = settings;
    one.basis = basis;
    try {
      stop.throw_if_stop_requested();
      result.fit = fit_force_table(table, one, stop);
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::kInterrupted) throw;
      result.failure = error.what();
    }
    results.push_back(std::move(result));
  }
  return results;
}

/// The result with the smallest criterion, the first among equal ones. A fit with a robust loss, or
/// with few rows, has no criterion. Each fit must have diagnostics (not checked).
const BasisResult* best_basis(const std::vector<BasisResult>& results) {
  const auto criterion = [](const BasisResult& result) {
    return result.fit ? result.fit->diagnostics->information_criterion : std::nullopt;
  };
  const BasisResult* best = nullptr;
  for (const auto& result : results)
    if (criterion(result) && (best == nullptr || *criterion(result) < *criterion(*best)))
      best = &result;
  return best;
}

}  // namespace viscontact::fitting
