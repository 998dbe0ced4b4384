// The text of each target: the resistance R and its primitive Gamma, sums of terms by physics.md
// (3.2) and (4.2), as code or numbers. Numbers are in the units of the fit. An impossible fit is an
// Error(kBadInput). Names, keys and the order of sums must stay.
#include "viscontact/fitting/export/export_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "viscontact/common/files/file.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/fitting/export/code_text.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/lubrication/spread_gaps.hpp"

namespace viscontact::fitting {
namespace {

/// R(q) = sum of weight * value, Gamma(q) = sum of weight * antiderivative - offset [M L/T]. Value
/// and antiderivative of a term are functions of the gap q.
struct Sum {
  std::vector<WeightedTerm> terms;
  double offset = 0;
};

/// The sum for a fit, in the order of all_terms(), as in LubricationForce.
Sum sum_of(const lubrication::Fit& fit) {
  Sum sum;
  for (const auto& term : lubrication::all_terms())
    if (const auto* fitted = find_named(fit.terms, term.name); fitted != nullptr)
      sum.terms.emplace_back(-fitted->coefficient / fit.reference_velocity, term);
  for (const auto& [weight, term] : sum.terms)
    sum.offset += weight * term.antiderivative(fit.radius);
  return sum;
}

/// What a reader must know to use the numbers, one line for each fact.
std::vector<std::string> facts(const lubrication::Fit& fit, std::string_view source) {
  const auto version = fit.versions.find("Viscontact");
  std::vector<std::string> lines = {
      fmt::format("Lubrication force of a sphere, written by 'viscontact export' (Viscontact {}).",
                  version == fit.versions.end() ? "of unknown version" : version->second),
      "F = -R(q) u: q the gap, u the normal velocity (positive away), F along the outward normal.",
      ("Gamma(q) = integral of R from the sphere's radius to q: the impulse that the film has "
       "absorbed."),
      fmt::format(
          "Valid for gaps in [{}, {}]; sphere of radius {}, viscosity {}, consistent units.",
          plain(fit.gap_interval[0]), plain(fit.gap_interval[1]), plain(fit.radius),
          plain(fit.viscosity)),
      fmt::format("The sphere approaches: {}.", fit.geometry.empty() ? "not said" : fit.geometry),
      fmt::format("Basis {}; relative residuals: largest {:.3g}, root mean square {:.3g}.",
                  fit.basis, fit.largest_relative_residual, fit.rms_relative_residual)};
  if (fit.diagnostics && fit.diagnostics->largest_error_estimate > 0)
    lines.push_back(fmt::format("Largest error estimate of the table: {:.3g}.",
                                fit.diagnostics->largest_error_estimate));
  if (!source.empty()) lines.push_back(fmt::format("Exported from the fit in {}.", source));
  if (!fit.table_sha256.empty())
    lines.push_back(fmt::format("SHA-256 of the table: {}.", fit.table_sha256));
  return on_lines_of_comments(std::move(lines));
}

std::string commented(const lubrication::Fit& fit, std::string_view source, std::string_view mark) {
  std::string text;
  for (const auto& line : facts(fit, source)) text += fmt::format("{} {}\n", mark, line);
  return text;
}

std::string write_c_header(const lubrication::Fit& fit, std::string_view source) {
  const Sum sum = sum_of(fit);
  const auto function = [&](std::string_view name, lubrication::Formula lubrication::Term::*formula,
                            const std::string& tail) {
    return fmt::format(
        "static inline double viscontact_{}(double gap) {{\n"
        "  const double q = gap, l = log(gap);\n"
        "  (void)q;\n  (void)l;\n"
        "  if (!(gap >= VISCONTACT_SMALLEST_GAP && gap <= VISCONTACT_LARGEST_GAP)) return NAN;\n"
        "  return {}{};\n}}\n\n",
        name, terms_text(sum.terms, formula, c_literal, "\n      + "), tail);
  };
  return commented(fit, source, "//") +
         "// C99 or C++11. Outside the interval the answer is NaN.\n" +
         fmt::format(
             "#ifndef VISCONTACT_LUBRICATION_H\n#define VISCONTACT_LUBRICATION_H\n\n"
             "#include <math.h>\n\n#define VISCONTACT_SMALLEST_GAP {}\n"
             "#define VISCONTACT_LARGEST_GAP {}\n\n",
             c_literal(fit.gap_interval[0]), c_literal(fit.gap_interval[1])) +
         "// R(q), > 0.\n" + function("resistance", &lubrication::Term::value, "") +
         "// Gamma(q).\n" +
         function("impulse", &lubrication::Term::antiderivative,
                  fmt::format("\n      - ({})", c_literal(sum.offset))) +
         "// F(q, u).\nstatic inline double viscontact_force(double gap, double velocity) {\n"
         "  return -viscontact_resistance(gap) * velocity;\n}\n\n#endif\n";
}

std::string write_fortran(const lubrication::Fit& fit, std::string_view source) {
  const Sum sum = sum_of(fit);
  const auto function = [&](std::string_view name, lubrication::Formula lubrication::Term::*formula,
                            const std::string& tail) {
    return fmt::format(
        "  elemental function viscontact_{0}(gap) result(answer)\n"
        "    real(real64), intent(in) :: gap\n"
        "    real(real64) :: answer, q, l\n"
        "    if (.not. (gap >= smallest_gap .and. gap <= largest_gap)) then\n"
        "      answer = ieee_value(answer, ieee_quiet_nan)\n"
        "      return\n"
        "    end if\n"
        "    q = gap\n"
        "    l = log(gap)\n"
        "    answer = {1}{2}\n"
        "  end function\n\n",
        name, terms_text(sum.terms, formula, fortran_literal, " &\n      + "), tail);
  };
  return commented(fit, source, "!") + "! Outside the interval the answer is NaN.\n" +
         fmt::format(
             "module viscontact_lubrication\n"
             "  use, intrinsic :: iso_fortran_env, only: real64\n"
             "  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan\n"
             "  implicit none\n"
             "  real(real64), parameter :: smallest_gap = {}, largest_gap = {}\n"
             "contains\n\n",
             fortran_literal(fit.gap_interval[0]), fortran_literal(fit.gap_interval[1])) +
         "  ! R(q), > 0.\n" + function("resistance", &lubrication::Term::value, "") +
         "  ! Gamma(q).\n" +
         function("impulse", &lubrication::Term::antiderivative,
                  fmt::format(" &\n      - ({})", fortran_literal(sum.offset))) +
         "  ! F(q, u).\n"
         "  elemental function viscontact_force(gap, velocity) result(answer)\n"
         "    real(real64), intent(in) :: gap, velocity\n"
         "    real(real64) :: answer\n"
         "    answer = -viscontact_resistance(gap) * velocity\n"
         "  end function\n\n"
         "end module\n";
}

std::string write_python(const lubrication::Fit& fit, std::string_view source) {
  const Sum sum = sum_of(fit);
  const auto function = [&](std::string_view name, std::string_view what,
                            lubrication::Formula lubrication::Term::*formula,
                            const std::string& tail) {
    return fmt::format(
        "def {0}(gap):\n"
        "    \"\"\"{1} Raises ValueError outside the interval.\"\"\"\n"
        "    _check(gap)\n"
        "    q, l = gap, math.log(gap)\n"
        "    return ({2}{3})\n\n\n",
        name, what, terms_text(sum.terms, formula, plain, "\n            + "), tail);
  };
  return commented(fit, source, "#") +
         fmt::format("import math\n\nSMALLEST_GAP, LARGEST_GAP = {}, {}\n\n\n",
                     plain(fit.gap_interval[0]), plain(fit.gap_interval[1])) +
         "def _check(gap):\n"
         "    if not SMALLEST_GAP <= gap <= LARGEST_GAP:\n"
         "        raise ValueError(f\"gap {gap} is outside [{SMALLEST_GAP}, "
         "{LARGEST_GAP}]\")\n\n\n" +
         function("resistance", "R(q), > 0.", &lubrication::Term::value, "") +
         function("impulse", "Gamma(q).", &lubrication::Term::antiderivative,
                  fmt::format("\n            - ({})", plain(sum.offset))) +
         "def force(gap, velocity):\n"
         "    \"\"\"F(q, u). Raises ValueError outside the interval.\"\"\"\n"
         "    return -resistance(gap) * velocity\n";
}

std::string write_json(const lubrication::Fit& fit, std::string_view source) {
  const Sum sum = sum_of(fit);
  const lubrication::LubricationForce force(fit);
  nlohmann::ordered_json json;
  json["about"] = facts(fit, source);
  json["formulas"] =
      "q: gap, l: ln q; R = sum of weight * value, Gamma = sum of weight * antiderivative - "
      "impulse_offset";
  // Fit files do not have this key, so that an export is not read as a fit file.
  json["interval"] = fit.gap_interval;
  json["radius"] = fit.radius;
  json["viscosity"] = fit.viscosity;
  json["largest_relative_residual"] = fit.largest_relative_residual;
  json["terms"] = nlohmann::ordered_json::array();
  for (const auto& [weight, term] : sum.terms)
    json["terms"].push_back({{"name", term.name},
                             {"weight", weight},
                             {"value", term.value.text},
                             {"antiderivative", term.antiderivative.text}});
  json["impulse_offset"] = sum.offset;
  json["reference_velocity"] = fit.reference_velocity;
  for (const double gap : lubrication::spread_gaps(fit.gap_interval)) {
    json["samples"]["gap"].push_back(gap);
    json["samples"]["resistance"].push_back(force.resistance(gap));
    json["samples"]["impulse"].push_back(force.impulse(gap));
    json["samples"]["force"].push_back(-force.resistance(gap) * fit.reference_velocity);
  }
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string write_csv(const lubrication::Fit& fit, std::string_view source) {
  const lubrication::LubricationForce force(fit);
  std::string text = commented(fit, source, "#");
  text += fmt::format("# force: at velocity {}\ngap,resistance,impulse,force\n",
                      plain(fit.reference_velocity));
  for (const double gap : lubrication::spread_gaps(fit.gap_interval))
    text += fmt::format("{},{},{},{}\n", plain(gap), plain(force.resistance(gap)),
                        plain(force.impulse(gap)),
                        plain(-force.resistance(gap) * fit.reference_velocity));
  return text;
}

constexpr std::array kTargets = {
    ExportTarget{"c-header", "functions of C99 and C++", TextKind::kC, write_c_header},
    ExportTarget{"fortran", "a module of Fortran 2008", TextKind::kFortran, write_fortran},
    ExportTarget{"python", "a module of Python 3", TextKind::kHashComment, write_python},
    ExportTarget{"json", "terms, formulas and 201 samples", TextKind::kJson, write_json},
    ExportTarget{"csv", "201 samples", TextKind::kHashComment, write_csv},
};

}  // namespace

std::span<const ExportTarget> export_targets() { return kTargets; }

std::string export_fit(const lubrication::Fit& fit, std::string_view target,
                       std::string_view source) {
  (void)lubrication::LubricationForce(fit);  // refuses a fit whose drag is not positive
  return require_named(kTargets, target, "export target").write(fit, source);
}

}  // namespace viscontact::fitting
