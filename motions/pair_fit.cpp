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
  using enum lubrication::FittedShape;
  using enum lubrication::MotionKind;
  using enum PairLoad;
  // The flows of an azimuthal mode have the same terms near contact.
  const std::vector<std::string_view> kAxial = {}, kAcross = {"1/q"}, kWeak = {"1/q", "ln q"};
  constexpr std::string_view k1 = lubrication::kLeadingTerm, kLn = "ln q", kQLn = "q ln q";
  constexpr bool kSelf = false, kOther = true;
  // clang-format off
  static const std::vector<NamedEntry> entries = {
      {"squeeze", "F_z = -squeeze u_z: the sphere approaches",
       kAxial, k1, kDrag, kApproach, kForce, kSelf, 1, {"X^A_11", 1, 3, 1}},
      {"slide", "F_x = -slide u: it moves along x",
       kAcross, kLn, kPositive, kSlide, kForce, kSelf, 1, {"Y^A_11", 1, 3, 1}},
      {"roll", "T_y = -roll w: it turns about y",
       kAcross, kLn, kPositive, kRoll, kTorque, kSelf, 3, {"Y^C_11", 1, 1, 3}},
      {"slide_roll", "T_y = slide_roll u and F_x = slide_roll w",
       kAcross, kLn, kAny, kSlide, kTorque, kSelf, 2, {"Y^B_11", -1, 1, 2}},
      {"spin", "T_z = -spin w_z: it turns about z",
       kWeak, kQLn, kPositive, kSpin, kTorque, kSelf, 3, {"X^C_11", 1, 1, 3}},
      {"squeeze_stress", "S_zz = squeeze_stress u_z and F_z = -3/2 squeeze_stress E_zz",
       kAxial, k1, kAny, kApproach, kStresslet, kSelf, 2, {"X^G_11", 3, 2, 2}},
      {"slide_stress", "S_xz = slide_stress u and F_x = -2 slide_stress E_xz",
       kAcross, kLn, kAny, kSlide, kStresslet, kSelf, 2, {"Y^G_11", 1, 1, 2}},
      {"roll_stress", "S_xz = roll_stress w and T_y = -2 roll_stress E_xz",
       kAcross, kLn, kAny, kRoll, kStresslet, kSelf, 3, {"Y^H_11", -1, 1, 3}},
      {"axial_strain", "S_zz = axial_strain E_zz, E_xx = E_yy = -E_zz/2",
       kAxial, k1, kPositive, kAxialStrain, kStresslet, kSelf, 3, {"X^M_11", 6, 5, 3}},
      {"shear_strain", "S_xz = shear_strain E_xz",
       kAcross, kLn, kPositive, kShearStrain, kStresslet, kSelf, 3, {"Y^M_11", 6, 5, 3}},
      {"twofold_strain", "S_xx = twofold_strain E_xx, S_yy = -S_xx, E_yy = -E_xx",
       kWeak, kQLn, kPositive, kTwofoldStrain, kStresslet, kSelf, 3, {"Z^M_11", 6, 5, 3}},
      {"squeeze_trace", "trace of the moment of the traction = squeeze_trace u_z",
       kAxial, k1, kAny, kApproach, kTrace, kSelf, 2, {}},
      {"axial_trace", "trace of the moment of the traction = axial_trace E_zz",
       kAxial, k1, kAny, kAxialStrain, kTrace, kSelf, 3, {}},
      {"neighbour_squeeze", "F_z on the neighbour = -neighbour_squeeze u_z",
       kAxial, k1, kAny, kApproach, kForce, kOther, 1, {"X^A_21", 1, 3, 1}},
      {"neighbour_slide", "F_x on the neighbour = -neighbour_slide u",
       kAcross, kLn, kAny, kSlide, kForce, kOther, 1, {"Y^A_21", 1, 3, 1}},
      {"neighbour_slide_torque", "T_y on the neighbour = -neighbour_slide_torque u",
       kAcross, kLn, kAny, kSlide, kTorque, kOther, 2, {"Y^B_21", 1, 1, 2}},
      {"neighbour_roll_force", "F_x on the neighbour = -neighbour_roll_force w",
       kAcross, kLn, kAny, kRoll, kForce, kOther, 2, {"Y^B_12", 1, 1, 2}},
      {"neighbour_roll", "T_y on the neighbour = -neighbour_roll w",
       kAcross, kLn, kAny, kRoll, kTorque, kOther, 3, {"Y^C_21", 1, 1, 3}},
      {"neighbour_spin", "T_z on the neighbour = -neighbour_spin w_z",
       kWeak, kQLn, kAny, kSpin, kTorque, kOther, 3, {"X^C_21", 1, 1, 3}},
      {"neighbour_squeeze_stress", "S_zz of the neighbour = neighbour_squeeze_stress u_z",
       kAxial, k1, kAny, kApproach, kStresslet, kOther, 2, {"X^G_21", 3, 2, 2}},
      {"neighbour_slide_stress", "S_xz of the neighbour = neighbour_slide_stress u",
       kAcross, kLn, kAny, kSlide, kStresslet, kOther, 2, {"Y^G_21", 1, 1, 2}},
      {"neighbour_roll_stress", "S_xz of the neighbour = neighbour_roll_stress w",
       kAcross, kLn, kAny, kRoll, kStresslet, kOther, 3, {"Y^H_21", -1, 1, 3}},
      {"neighbour_axial_force", "F_z on the neighbour = -neighbour_axial_force E_zz",
       kAxial, k1, kAny, kAxialStrain, kForce, kOther, 2, {"X^G_12", 1, 1, 2}},
      {"neighbour_shear_force", "F_x on the neighbour = -neighbour_shear_force E_xz",
       kAcross, kLn, kAny, kShearStrain, kForce, kOther, 2, {"Y^G_12", 1, 2, 2}},
      {"neighbour_shear_torque", "T_y on the neighbour = -neighbour_shear_torque E_xz",
       kAcross, kLn, kAny, kShearStrain, kTorque, kOther, 3, {"Y^H_12", -1, 2, 3}},
      {"neighbour_axial_strain", "S_zz of the neighbour = neighbour_axial_strain E_zz",
       kAxial, k1, kAny, kAxialStrain, kStresslet, kOther, 3, {"X^M_21", 6, 5, 3}},
      {"neighbour_shear_strain", "S_xz of the neighbour = neighbour_shear_strain E_xz",
       kAcross, kLn, kAny, kShearStrain, kStresslet, kOther, 3, {"Y^M_21", 6, 5, 3}},
      {"neighbour_twofold_strain", "S_xx of the neighbour = neighbour_twofold_strain E_xx",
       kWeak, kQLn, kAny, kTwofoldStrain, kStresslet, kOther, 3, {"Z^M_21", 6, 5, 3}},
      {"neighbour_squeeze_trace", "trace of the moment on the neighbour = neighbour_squeeze_trace u_z",
       kAxial, k1, kAny, kApproach, kTrace, kOther, 2, {}},
      {"neighbour_axial_trace", "trace of the moment on the neighbour = neighbour_axial_trace E_zz",
       kAxial, k1, kAny, kAxialStrain, kTrace, kOther, 3, {}},
  };
  // clang-format on
  return entries;
}

std::string function_in_words(const NamedEntry& entry) {
  const auto& [name, numerator, denominator, power] = entry.function;
  if (name.empty()) return "";
  const std::string front = numerator == 1    ? ""
                            : numerator == -1 ? "-"
                                              : fmt::format("{} ", numerator);
  return fmt::format("{} = {}{}/({}pi mu s{})", name, front, entry.name,
                     denominator == 1 ? "" : fmt::format("{} ", denominator),
                     power == 1 ? "" : fmt::format("^{}", power));
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
    const int power = pair_entries()[static_cast<std::size_t>(entry)].power;
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
