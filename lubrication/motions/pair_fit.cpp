// The names, bases and values of the resistances of a pair.
#include "viscontact/lubrication/motions/pair_fit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "viscontact/common/error.hpp"
#include "viscontact/common/named.hpp"

namespace viscontact::lubrication {
namespace {

constexpr std::string_view kCubic = "asymptotic_cubic";
constexpr std::array<std::string_view, 3> kPairBases = {"asymptotic", "asymptotic_extended",
                                                        kCubic};

}  // namespace

std::span<const NamedEntry> pair_entries() {
  static const std::vector<NamedEntry> entries = {
      {"squeeze", "F_z = -squeeze u_z: the sphere approaches", {}, kLeadingTerm, true},
      {"slide", "F_x = -slide u: it moves along x", {"1/q"}, "ln q", true},
      {"roll", "T_y = -roll w: it turns about y", {"1/q"}, "ln q", true},
      {"slide_roll", "T_y = slide_roll u and F_x = slide_roll w", {"1/q"}, "ln q", false},
      {"spin", "T_z = -spin w_z: it turns about z", {"1/q", "ln q"}, "q ln q", true}};
  return entries;
}

std::span<const std::string_view> pair_bases() { return kPairBases; }

Basis basis_of_entry(const NamedEntry& entry, std::string_view name) {
  if (std::ranges::find(kPairBases, name) == kPairBases.end())
    throw Error(ErrorKind::kBadInput, fmt::format("no basis of a pair is named '{}'; there are: {}",
                                                  name, fmt::join(kPairBases, ", ")));
  Basis basis = find_basis(name == kCubic ? "asymptotic_extended" : name);
  basis.name = name;
  if (name == kCubic) basis.terms.push_back(*find_term("q^3 ln q"));
  std::erase_if(basis.terms, [&](const Term& term) {
    return std::ranges::find(entry.absent_terms, term.name) != entry.absent_terms.end();
  });
  return basis;
}

double entry_value(const PairFit& fit, PairEntry entry, double gap) {
  const auto found = fit.entries.find(entry);
  if (found == fit.entries.end())
    throw Error(ErrorKind::kBadInput,
                fmt::format("the fit lacks the entry {}",
                            pair_entries()[static_cast<std::size_t>(entry)].name));
  double value = 0;
  for (const auto& term : found->second.fit.terms)
    value += term.coefficient * find_term(term.name)->value(gap);
  return value;
}

}  // namespace viscontact::lubrication
