// The words that stand for the values of Misfit in fit files.
#include "viscontact/lubrication/fit_diagnostics.hpp"

#include <algorithm>
#include <array>

#include "viscontact/common/named.hpp"

namespace viscontact {
namespace {

struct NamedMisfit {
  std::string_view name;
  Misfit misfit;
};

constexpr std::array kMisfits = {NamedMisfit{"basis", Misfit::kBasis},
                                 NamedMisfit{"data", Misfit::kData},
                                 NamedMisfit{"unknown", Misfit::kUnknown}};

}  // namespace

std::string_view to_string(Misfit misfit) {
  return std::ranges::find(kMisfits, misfit, &NamedMisfit::misfit)->name;
}

Misfit parse_misfit(std::string_view word) {
  return require_named(kMisfits, word, "misfit").misfit;
}

}  // namespace viscontact
