// The names, bases and values of the resistances of a pair (pair_fit.hpp). Values have the units of
// the fit. An unknown name or a missing entry is an Error(kBadInput). A change must keep the names.
#include "viscontact/motions/pair_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "viscontact/common/equal_up_to_rounding.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/lubrication/scaling.hpp"

namespace viscontact::motions {
namespace {

/// A basis of a pair: a named basis, and further terms.
struct PairBasis {
  std::string_view name;
  std::string_view base;
  std::vector<std::string_view> further;
};

const std::vector<PairBasis>& bases_of_pairs() {
  static const std::vector<PairBasis> bases = {
      {"asymptotic", "asymptotic", {}},
      {"asymptotic_extended", "asymptotic_extended", {}},
      {kDefaultPairBasis, "asymptotic_extended", {"q^3 ln q"}},
      {"asymptotic_quartic", "asymptotic_extended", {"q^3 ln q", "q^4 ln q", "q^4"}}};
  return bases;
}

}  // namespace

std::span<const NamedEntry> pair_entries() {
  static const std::vector<NamedEntry> entries = {{"squeeze",
                                                   "F_z = -squeeze u_z: the sphere approaches",
                                                   {},
                                                   lubrication::kLeadingTerm,
                                                   lubrication::FittedShape::kDrag},
                                                  {"slide",
                                                   "F_x = -slide u: it moves along x",
                                                   {"1/q"},
                                                   "ln q",
                                                   lubrication::FittedShape::kPositive},
                                                  {"roll",
                                                   "T_y = -roll w: it turns about y",
                                                   {"1/q"},
                                                   "ln q",
                                                   lubrication::FittedShape::kPositive},
                                                  {"slide_roll",
                                                   "T_y = slide_roll u and F_x = slide_roll w",
                                                   {"1/q"},
                                                   "ln q",
                                                   lubrication::FittedShape::kAny},
                                                  {"spin",
                                                   "T_z = -spin w_z: it turns about z",
                                                   {"1/q", "ln q"},
                                                   "q ln q",
                                                   lubrication::FittedShape::kPositive}};
  return entries;
}

std::vector<std::string_view> pair_bases() {
  std::vector<std::string_view> names;
  for (const auto& basis : bases_of_pairs()) names.push_back(basis.name);
  return names;
}

lubrication::Basis basis_of_entry(const NamedEntry& entry, std::string_view name,
                                  std::optional<double> theory) {
  const auto& pair_basis = require_named(bases_of_pairs(), name, "basis of a pair");
  lubrication::Basis basis = lubrication::find_basis(pair_basis.base);
  basis.name = name;
  for (const auto term : pair_basis.further) basis.terms.push_back(*lubrication::find_term(term));
  std::erase_if(basis.terms, [&](const lubrication::Term& term) {
    return std::ranges::find(entry.absent_terms, term.name) != entry.absent_terms.end() ||
           (theory && *theory == 0 && term.name == entry.leading_term);
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
    value += term.coefficient * lubrication::find_term(term.name)->value(gap);
  return value;
}

PairFit scaled_to(PairFit fit, double viscosity, double radius) {
  const double ratio = radius / fit.radius;
  const bool has_radius = equal_up_to_rounding(radius, fit.radius);
  for (auto& [entry, one] : fit.entries) {
    // Powers of the length in a force per velocity, a torque per velocity, and a torque per angular
    // velocity.
    const int power = entry == PairEntry::kSqueeze || entry == PairEntry::kSlide ? 1
                      : entry == PairEntry::kSlideRoll                           ? 2
                                                                                 : 3;
    if (one.theory && !has_radius) {
      const auto term = pair_entries()[static_cast<std::size_t>(entry)].leading_term;
      *one.theory *= std::pow(ratio, power) * lubrication::scale_of_term(term, ratio);
    }
    if (one.theory) *one.theory *= viscosity / fit.viscosity;
    one.fit = lubrication::scaled_to(std::move(one.fit), viscosity, radius, power);
  }
  if (!has_radius) {
    for (auto& gap : fit.gap_interval) gap *= ratio;
    fit.geometry = lubrication::with_lengths_scaled(fit.geometry, ratio);
    fit.radius = radius;
  }
  fit.viscosity = viscosity;
  return fit;
}

}  // namespace viscontact::motions
