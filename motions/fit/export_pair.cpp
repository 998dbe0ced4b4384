// Each resistance of a pair as a function of the gap in C, Fortran, Python, MATLAB, JSON or CSV.
#include "viscontact/motions/fit/export_pair.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "viscontact/common/named.hpp"
#include "viscontact/fitting/export/code_text.hpp"

namespace viscontact::motions {
namespace {

const NamedEntry& named(PairEntry entry) { return pair_entries()[static_cast<std::size_t>(entry)]; }

/// The terms of the fit of one resistance with their coefficients. The sum of coefficient times
/// term is the resistance, because the fit is at the velocity -1.
std::vector<fitting::WeightedTerm> weighted_terms(const EntryFit& entry) {
  std::vector<fitting::WeightedTerm> terms;
  for (const auto& term : entry.fit.terms)
    terms.emplace_back(term.coefficient, *lubrication::find_term(term.name));
  return terms;
}

std::vector<std::string> facts_of_pair(const PairFit& fit, std::string_view source) {
  const auto version = fit.versions.find("Viscontact");
  std::vector<std::string> lines = {
      fmt::format("Resistances of a sphere beside its neighbour at rest, written by 'viscontact "
                  "export' (Viscontact {}).",
                  version == fit.versions.end() ? "of unknown version" : version->second),
      "z goes from the neighbour to the sphere. Its velocity is u along x and u_z along z, its",
      "angular velocity w about y and w_z about z. Force and torque on the sphere:",
      "F_z = -squeeze u_z, F_x = -slide u + slide_roll w,",
      "T_y = slide_roll u - roll w, T_z = -spin w_z.",
      fmt::format(
          "Valid for gaps in [{}, {}]; sphere of radius {}, viscosity {}, consistent units.",
          fitting::plain(fit.gap_interval[0]), fitting::plain(fit.gap_interval[1]),
          fitting::plain(fit.radius), fitting::plain(fit.viscosity)),
      fmt::format("The neighbour: {}.", fit.geometry.empty() ? "not said" : fit.geometry)};
  for (const auto& [entry, one] : fit.entries)
    lines.push_back(
        fmt::format("{}: basis {}, relative residuals at most {:.3g}, error estimates of "
                    "the table at most {:.3g}.",
                    named(entry).name, one.fit.basis, one.fit.largest_relative_residual,
                    one.fit.diagnostics ? one.fit.diagnostics->largest_error_estimate : 0));
  lines.emplace_back(
      "Functions of Jeffrey & Onishi 1984 and Jeffrey 1992: the sphere is sphere 1, its");
  lines.emplace_back("neighbour sphere 2, and the unit vector of all goes from 1 to 2. With the");
  lines.emplace_back("radii r and r_2, s is 2 r for the indices 11, and r + r_2 for 12 and 21.");
  for (const auto& [entry, one] : fit.entries)
    if (const auto words = function_in_words(named(entry)); !words.empty())
      lines.push_back(words + ".");
  if (!source.empty()) lines.push_back(fmt::format("Exported from the fit in {}.", source));
  return fitting::on_lines_of_comments(std::move(lines));
}

/// A header file. Each of the functions pair_in_...() returns the whole text of its format.
std::string pair_in_c(const PairFit& fit, std::string_view source) {
  std::string text =
      fitting::commented(facts_of_pair(fit, source), "//") +
      fmt::format(
          "// C99 or C++11. Outside the interval the answer is NaN.\n"
          "#ifndef VISCONTACT_PAIR_H\n#define VISCONTACT_PAIR_H\n\n#include <math.h>\n\n"
          "#define VISCONTACT_PAIR_SMALLEST_GAP {}\n#define VISCONTACT_PAIR_LARGEST_GAP {}\n\n",
          fitting::c_literal(fit.gap_interval[0]), fitting::c_literal(fit.gap_interval[1]));
  for (const auto& [entry, one] : fit.entries)
    text += fmt::format(
        "// {}.\nstatic inline double viscontact_{}(double gap) {{\n"
        "  const double q = gap, l = log(gap);\n  (void)q;\n  (void)l;\n"
        "  if (!(gap >= VISCONTACT_PAIR_SMALLEST_GAP && gap <= VISCONTACT_PAIR_LARGEST_GAP)) "
        "return NAN;\n"
        "  return {};\n}}\n\n",
        named(entry).description, named(entry).name,
        fitting::terms_text(weighted_terms(one), &lubrication::Term::value, fitting::c_literal,
                            "\n      + "));
  return text + "#endif\n";
}

std::string pair_in_fortran(const PairFit& fit, std::string_view source) {
  std::string text = fitting::commented(facts_of_pair(fit, source), "!") +
                     fmt::format(
                         "! Outside the interval the answer is NaN.\n"
                         "module viscontact_pair\n"
                         "  use, intrinsic :: iso_fortran_env, only: real64\n"
                         "  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan\n"
                         "  implicit none\n"
                         "  real(real64), parameter :: smallest_gap = {}, largest_gap = {}\n"
                         "contains\n\n",
                         fitting::fortran_literal(fit.gap_interval[0]),
                         fitting::fortran_literal(fit.gap_interval[1]));
  for (const auto& [entry, one] : fit.entries)
    text += fmt::format(
        "  ! {}.\n  elemental function viscontact_{}(gap) result(answer)\n"
        "    real(real64), intent(in) :: gap\n"
        "    real(real64) :: answer, q, l\n"
        "    if (.not. (gap >= smallest_gap .and. gap <= largest_gap)) then\n"
        "      answer = ieee_value(answer, ieee_quiet_nan)\n"
        "      return\n    end if\n"
        "    q = gap\n    l = log(gap)\n"
        "    answer = {}\n  end function\n\n",
        named(entry).description, named(entry).name,
        fitting::terms_text(weighted_terms(one), &lubrication::Term::value,
                            fitting::fortran_literal, " &\n      + "));
  return text + "end module\n";
}

std::string pair_in_python(const PairFit& fit, std::string_view source) {
  std::string text =
      fitting::commented(facts_of_pair(fit, source), "#") +
      "# A gap is a number or an array of NumPy, and so is the answer.\n" +
      fmt::format("import math\n\nSMALLEST_GAP, LARGEST_GAP = {}, {}\n\n\n",
                  fitting::plain(fit.gap_interval[0]), fitting::plain(fit.gap_interval[1])) +
      std::string(fitting::kPythonEvaluate);
  for (const auto& [entry, one] : fit.entries)
    text += fmt::format(
        "\n\ndef _{0}(q, log):\n    l = log(q)\n    return ({2})\n\n\n"
        "def {0}(gap):\n"
        "    \"\"\"{1}. Raises ValueError outside the interval.\"\"\"\n"
        "    return _evaluate(gap, ((SMALLEST_GAP, LARGEST_GAP, _{0}),))\n",
        named(entry).name, named(entry).description,
        fitting::terms_text(weighted_terms(one), &lubrication::Term::value, fitting::plain,
                            "\n            + "));
  return text;
}

std::string pair_in_matlab(const PairFit& fit, std::string_view source) {
  const auto smallest = fitting::plain(fit.gap_interval[0]);
  const auto largest = fitting::plain(fit.gap_interval[1]);
  std::string text =
      fitting::commented(facts_of_pair(fit, source), "%") +
      fmt::format(
          "% MATLAB or Octave, in a file viscontact_pair.m: f = viscontact_pair(); f.slide(gap). "
          "A\n"
          "% gap is a number or an array. Outside the interval the answer is NaN.\n"
          "function f = viscontact_pair()\n  f.smallest_gap = {};\n  f.largest_gap = {};\n",
          smallest, largest);
  std::string functions;
  for (const auto& [entry, one] : fit.entries) {
    text += fmt::format("  f.{0} = @{0};  % {1}\n", named(entry).name, named(entry).description);
    functions += fmt::format(
        "\nfunction answer = {}(gap)\n  gap = double(gap);\n  answer = NaN(size(gap));\n"
        "  here = gap >= {} & gap <= {};\n  q = gap(here);\n  l = log(q);\n"
        "  answer(here) = {};\nend\n",
        named(entry).name, smallest, largest,
        fitting::elementwise(fitting::terms_text(weighted_terms(one), &lubrication::Term::value,
                                                 fitting::plain, " ...\n      + ")));
  }
  return text + "end\n" + functions;
}

std::string pair_in_json(const PairFit& fit, std::string_view source) {
  nlohmann::ordered_json json;
  json["about"] = facts_of_pair(fit, source);
  json["formulas"] = "q: gap, l: ln q; each entry = sum of weight * value";
  json["interval"] = fit.gap_interval;
  json["radius"] = fit.radius;
  json["viscosity"] = fit.viscosity;
  for (const auto& [entry, one] : fit.entries) {
    auto& object = json["functions"][std::string(named(entry).name)];
    for (const auto& [weight, term] : weighted_terms(one))
      object["terms"].push_back(
          {{"name", term.name}, {"weight", weight}, {"value", term.value.text}});
    object["largest_relative_residual"] = one.fit.largest_relative_residual;
  }
  for (const double gap : lubrication::spread_gaps(fit.gap_interval)) {
    json["samples"]["gap"].push_back(gap);
    for (const auto& [entry, one] : fit.entries)
      json["samples"][std::string(named(entry).name)].push_back(entry_value(fit, entry, gap));
  }
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string pair_in_csv(const PairFit& fit, std::string_view source) {
  std::string text = fitting::commented(facts_of_pair(fit, source), "#") + "gap";
  for (const auto& [entry, one] : fit.entries) text += "," + std::string(named(entry).name);
  text += "\n";
  for (const double gap : lubrication::spread_gaps(fit.gap_interval)) {
    text += fitting::plain(gap);
    for (const auto& [entry, one] : fit.entries)
      text += "," + fitting::plain(entry_value(fit, entry, gap));
    text += "\n";
  }
  return text;
}

struct PairTarget {
  std::string_view name;  // as users type it; export_fit.cpp has the same names
  std::string (*write)(const PairFit& fit, std::string_view source);
};
constexpr std::array kPairTargets = {
    PairTarget{"c-header", pair_in_c},    PairTarget{"fortran", pair_in_fortran},
    PairTarget{"python", pair_in_python}, PairTarget{"matlab", pair_in_matlab},
    PairTarget{"json", pair_in_json},     PairTarget{"csv", pair_in_csv}};

}  // namespace

std::string export_pair(const PairFit& fit, std::string_view target, std::string_view source) {
  return require_named(kPairTargets, target, "export target").write(fit, source);
}

}  // namespace viscontact::motions
