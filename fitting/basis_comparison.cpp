// Tries one basis after the other.
#include "viscontact/fitting/basis_comparison.hpp"

#include <cassert>

#include "viscontact/common/error.hpp"

namespace viscontact::fitting {

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

const BasisResult* best_basis(const std::vector<BasisResult>& results) {
  const auto criterion = [](const BasisResult& result) {
    assert(!result.fit || result.fit->diagnostics);
    return result.fit ? result.fit->diagnostics->information_criterion : std::nullopt;
  };
  const BasisResult* best = nullptr;
  for (const auto& result : results)
    if (criterion(result) && (best == nullptr || *criterion(result) < *criterion(*best)))
      best = &result;
  return best;
}

}  // namespace viscontact::fitting
