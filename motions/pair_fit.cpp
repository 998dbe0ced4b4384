// The names, bases and values of the resistances of a pair, and the keys of their file
// (docs/file-formats.md).
#include "viscontact/motions/pair_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "viscontact/common/equal_up_to_rounding.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/common/text/json_fields.hpp"
#include "viscontact/lubrication/scaling.hpp"

namespace viscontact::motions {
namespace {

/// The terms of the basis `base` of lubrication/terms.hpp, and further ones.
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
    throw Error(ErrorKind::kBadInput, "the fit lacks the entry {}",
                pair_entries()[static_cast<std::size_t>(entry)].name);
  double value = 0;
  for (const auto& term : found->second.fit.terms)
    value += term.coefficient * lubrication::find_term(term.name)->value(gap);
  return value;
}

PairFit scaled_to(PairFit fit, double viscosity, double radius) {
  assert(viscosity > 0 && radius > 0);
  // If the radius is the same up to rounding, lengths keep their bits.
  const double ratio = radius / fit.radius;
  const bool has_radius = equal_up_to_rounding(radius, fit.radius);
  for (auto& [entry, one] : fit.entries) {
    // The power of the radius in a force per velocity (1), a torque per velocity (2), and a torque
    // per angular velocity (3).
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

namespace {

const std::string kPairFit = "pair fit";

/// Throws Error(kBadInput) if an entry was fitted for another sphere, fluid or neighbour than those
/// of `fit`, or at another velocity than -1.
void check_same_pair(const JsonFields& json, const std::string& name, const lubrication::Fit& entry,
                     const PairFit& fit) {
  const auto differs = [&](const char* key) {
    json.fail("entries." + name + "." + key, "differs from that of the file");
  };
  if (!equal_up_to_rounding(entry.viscosity, fit.viscosity)) differs("viscosity");
  if (!equal_up_to_rounding(entry.radius, fit.radius)) differs("radius");
  if (entry.geometry != fit.geometry) differs("geometry");
  if (entry.reference_velocity != -1)
    json.fail("entries." + name + ".reference_velocity", "is {}; it must be -1",
              entry.reference_velocity);
}

}  // namespace

void fields_of(JsonFields& json, EntryFit& entry) {
  fields_of(json, entry.fit);
  json("theory", entry.theory, Absence::kLeftOutIfEmpty);
}

void fields_of(JsonFields& json, std::map<PairEntry, EntryFit>& entries) {
  // A resistance that the fit lacks has no key.
  for (std::size_t i = 0; i < pair_entries().size(); ++i) {
    const auto which = static_cast<PairEntry>(i);
    std::optional<EntryFit> entry;
    if (entries.contains(which)) entry = entries[which];
    json(std::string(pair_entries()[i].name), entry, Absence::kLeftOutIfEmpty);
    if (entry) entries[which] = *entry;
  }
}

void fields_of(JsonFields& json, PairFit& fit) {
  json.constant("kind", kPairFit);
  json("viscosity", fit.viscosity, kPositive);
  json("radius", fit.radius, kPositive);
  json("geometry", fit.geometry);
  json.gap_interval("gap_interval", fit.gap_interval);
  json("entries", fit.entries);
  if (json.reads() && fit.entries.empty())
    json.fail("entries", "is empty; a fit must have at least one entry");
  if (json.reads())
    for (const auto& [which, entry] : fit.entries)
      check_same_pair(json, std::string(pair_entries()[static_cast<std::size_t>(which)].name),
                      entry.fit, fit);
  json("versions", fit.versions);
  json.foreign_object("provenance");
}

bool is_pair_fit(const std::filesystem::path& path) {
  return std::filesystem::is_regular_file(path) &&
         read_file(path).find(fmt::format("\"kind\": \"{}\"", kPairFit)) != std::string::npos;
}

PairFit read_pair_fit(const std::filesystem::path& path) {
  return JsonFields::read<PairFit>(read_file(path), path.string());
}

std::string write_pair_fit(const PairFit& fit) { return JsonFields::text_of(fit); }

}  // namespace viscontact::motions
