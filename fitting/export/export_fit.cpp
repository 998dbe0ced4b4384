// Writes R(q) and its primitive Gamma(q) (docs/physics.md (3.2), (3.3), (4.2)) in each language.
#include "viscontact/fitting/export/export_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/fitting/export/code_text.hpp"
#include "viscontact/lubrication/stokes_drag.hpp"

namespace viscontact::fitting {
namespace {

using Limits = lubrication::OutsideInterval;

/// R(q) = sum of weight * value(q) [M/T] and Gamma(q) = sum of weight * antiderivative(q) - offset
/// [M L/T]; the offset makes Gamma(r) = 0 at the sphere's radius r.
struct Sum {
  std::vector<WeightedTerm> terms;
  double offset = 0;
  double largest_gap = lubrication::kNoWall;  // L [L] of a second wall
  bool needs_wall = false;                    // true if a term is a function of L - q
};

/// The weights of a fit, -coefficient/(reference velocity), in the order of all_terms().
/// LubricationForce adds the terms in the same order, so that the rounding errors agree.
Sum sum_of(const lubrication::Fit& fit) {
  Sum sum;
  for (const auto& term : lubrication::terms_beside_walls())
    if (const auto* fitted = find_named(fit.terms, term.name); fitted != nullptr)
      sum.terms.emplace_back(-fitted->coefficient / fit.reference_velocity, term);
  if (const auto wall = lubrication::second_wall_of(fit)) sum.largest_gap = wall->largest_gap;
  const double zero = lubrication::zero_of_impulse(fit);
  for (const auto& [weight, term] : sum.terms) {
    sum.needs_wall = sum.needs_wall || lubrication::needs_second_wall(term.name);
    sum.offset += weight * term.antiderivative(zero, sum.largest_gap);
  }
  return sum;
}

/// The resistance outside the fitted interval [q1, q2], where the user chose a formula for it: R =
/// k/q + constant below the interval, R = stokes + reflected/(q + r) above it. With a second wall
/// at the gap L, k_wall (1/(L - q) - 1/(L - q2)) is added above, and R is infinite at L.
struct Outside {
  bool has_below = false, has_above = false;     // true if the user chose the formula
  double smallest = 0, largest = 0, radius = 0;  // q1, q2 and r [L]
  double wall = lubrication::kNoWall;            // L of a second wall [L]
  double k_wall = 0;                             // [M L/T]
  double k = 0, constant = 0;                    // [M L/T], [M/T]
  bool has_wall() const { return wall < lubrication::kNoWall; }
  double stokes = 0, reflected = 0;             // [M/T], [M L/T]
  double impulse_below = 0, impulse_above = 0;  // Gamma(q1) and Gamma(q2) [M L/T]
};

/// The numbers of the formulas that the user chose in `limits`, such that R is continuous at q1 and
/// q2.
Outside outside_of(const lubrication::Fit& fit, const lubrication::OutsideInterval& limits) {
  const lubrication::LubricationForce force(fit, limits);
  const auto [smallest, largest] = fit.gap_interval;
  Outside outside{.smallest = smallest, .largest = largest, .radius = fit.radius};
  outside.has_below = limits.below != lubrication::BelowInterval::kError;
  outside.has_above = limits.above != lubrication::AboveInterval::kError;
  if (const auto wall = lubrication::second_wall_of(fit)) {
    outside.wall = wall->largest_gap;
    outside.k_wall = wall->leading_factor *
                     lubrication::stokes_resistance(fit.viscosity, fit.radius) * fit.radius;
  }
  if (outside.has_below) {
    const bool is_theory = limits.below == lubrication::BelowInterval::kTheoryLimit;
    outside.k = is_theory ? fit.leading_coefficient.value() : force.leading_coefficient();
    outside.constant = force.resistance(smallest) - outside.k / smallest;
    outside.impulse_below = force.impulse(smallest);
  }
  if (outside.has_above) {
    outside.stokes = lubrication::stokes_resistance(fit.viscosity, fit.radius);
    outside.reflected = (force.resistance(largest) - outside.stokes) * (largest + fit.radius);
    outside.impulse_above = force.impulse(largest);
  }
  return outside;
}

/// R or Gamma as expressions of a language: `inside` the fitted interval in the variables q and l =
/// ln q; `below` and `above` it in q alone, empty if the user chose no formula there.
struct Expressions {
  std::string inside, below, above;
};

/// The expressions for R. `number` writes a number as a literal of the language; `between`, which
/// contains a "+", stands between two summands.
Expressions resistance_of(const Sum& sum, const Outside& o, Literal number,
                          std::string_view between) {
  Expressions e{terms_text(sum.terms, &lubrication::Term::value, number, between), "", ""};
  if (o.has_below) e.below = fmt::format("({})/q{}({})", number(o.k), between, number(o.constant));
  if (o.has_above)
    e.above = fmt::format("({}){}({})/(q + ({}))", number(o.stokes), between, number(o.reflected),
                          number(o.radius));
  if (o.has_above && o.has_wall())
    e.above += fmt::format("{0}({1}) * (1.0/(({2}) - q) - 1.0/(({2}) - ({3})))", between,
                           number(o.k_wall), number(o.wall), number(o.largest));
  return e;
}

Expressions impulse_of(const Sum& sum, const Outside& o, Literal number, std::string_view between) {
  assert(between.find('+') != std::string_view::npos);
  std::string minus(between);
  minus.replace(minus.rfind('+'), 1, "-");
  Expressions e{terms_text(sum.terms, &lubrication::Term::antiderivative, number, between) +
                    fmt::format("{}({})", minus, number(sum.offset)),
                "", ""};
  if (o.has_below)
    e.below = fmt::format("({0}){5}({1}) * log(q/({3})){5}({2}) * (q - ({4}))",
                          number(o.impulse_below), number(o.k), number(o.constant),
                          number(o.smallest), number(o.smallest), between);
  if (o.has_above)
    e.above = fmt::format("({0}){5}({1}) * (q - ({3})){5}({2}) * log((q + ({4}))/(({3}) + ({4})))",
                          number(o.impulse_above), number(o.stokes), number(o.reflected),
                          number(o.largest), number(o.radius), between);
  if (o.has_above && o.has_wall())
    e.above +=
        fmt::format("{0}({1}) * (log((({2}) - ({3}))/(({2}) - q)) - (q - ({3}))/(({2}) - ({3})))",
                    between, number(o.k_wall), number(o.wall), number(o.largest));
  return e;
}

/// What a user of the exported numbers must know (sign, interval, error, source), one line each.
std::vector<std::string> facts(const lubrication::Fit& fit, std::string_view source,
                               const Outside& outside = {}) {
  const auto version = fit.versions.find("Viscontact");
  std::vector<std::string> lines = {
      fmt::format("Lubrication force of a sphere, written by 'viscontact export' (Viscontact {}).",
                  version == fit.versions.end() ? "of unknown version" : version->second),
      "F = -R(q) u: q the gap, u the normal velocity (positive away), F along the outward normal.",
      ("Gamma(q) = integral of R from the sphere's radius to q: minus the impulse that the film "
       "absorbs while the gap falls from the radius to q."),
      fmt::format(
          "Valid for gaps in [{}, {}]; sphere of radius {}, viscosity {}, consistent units.",
          plain(fit.gap_interval[0]), plain(fit.gap_interval[1]), plain(fit.radius),
          plain(fit.viscosity)),
      fmt::format("The sphere approaches: {}.", fit.geometry.empty() ? "not said" : fit.geometry),
      fmt::format("Basis {}; relative residuals: largest {:.3g}, root mean square {:.3g}.",
                  fit.basis, fit.largest_relative_residual, fit.rms_relative_residual)};
  if (outside.has_below)
    lines.emplace_back("Below this interval R = k/q + constant, the lubrication limit.");
  if (outside.has_above)
    lines.emplace_back(
        outside.has_wall()
            ? fmt::format(
                  "Above this interval R = R_S + c/(q + r) + k (1/(L - q) - 1/(L - q2)), up "
                  "to the wall opposite at L = {}, where R is infinite.",
                  plain(outside.wall))
            : "Above this interval R = R_S + c/(q + r), which tends to Stokes' drag R_S.");
  if (fit.diagnostics && fit.diagnostics->largest_error_estimate > 0)
    lines.push_back(fmt::format("Largest error estimate of the table: {:.3g}.",
                                fit.diagnostics->largest_error_estimate));
  if (!source.empty()) lines.push_back(fmt::format("Exported from the fit in {}.", source));
  if (!fit.table_sha256.empty())
    lines.push_back(fmt::format("SHA-256 of the table: {}.", fit.table_sha256));
  return on_lines_of_comments(std::move(lines));
}

/// The target c-header. This function and those below have the arguments of export_fit().
std::string write_c_header(const lubrication::Fit& fit, std::string_view source,
                           const Limits& limits) {
  const Sum sum = sum_of(fit);
  const Outside outside = outside_of(fit, limits);
  const auto function = [&](std::string_view name, const Expressions& e) {
    std::string text = fmt::format(
        "static inline double viscontact_{}(double gap) {{\n"
        "  const double q = gap, l = log(gap);\n{}"
        "  (void)q;\n  (void)l;\n",
        name,
        sum.needs_wall
            ? fmt::format("  const double p = {} - gap, m = log(p);\n  (void)p;\n  (void)m;\n",
                          c_literal(sum.largest_gap))
            : "");
    if (!e.below.empty())
      text +=
          fmt::format("  if (gap > 0 && gap < VISCONTACT_SMALLEST_GAP)\n    return {};\n", e.below);
    if (!e.above.empty())
      text += fmt::format(
          "  if (gap > VISCONTACT_LARGEST_GAP && gap {})\n    return {};\n{}",
          outside.has_wall() ? "< " + c_literal(outside.wall) : "< HUGE_VAL", e.above,
          outside.has_wall()
              ? fmt::format("  if (gap == {}) return HUGE_VAL;\n", c_literal(outside.wall))
              : "");
    return text + fmt::format(
                      "  if (!(gap >= VISCONTACT_SMALLEST_GAP && gap <= VISCONTACT_LARGEST_GAP)) "
                      "return NAN;\n  return {};\n}}\n\n",
                      e.inside);
  };
  constexpr std::string_view kBetween = "\n      + ";
  return commented(facts(fit, source, outside), "//") +
         "// C99 or C++11. At other gaps the answer is NaN.\n" +
         fmt::format(
             "#ifndef VISCONTACT_LUBRICATION_H\n#define VISCONTACT_LUBRICATION_H\n\n"
             "#include <math.h>\n\n#define VISCONTACT_SMALLEST_GAP {}\n"
             "#define VISCONTACT_LARGEST_GAP {}\n\n",
             c_literal(fit.gap_interval[0]), c_literal(fit.gap_interval[1])) +
         "// R(q), > 0.\n" +
         function("resistance", resistance_of(sum, outside, c_literal, kBetween)) +
         "// Gamma(q).\n" + function("impulse", impulse_of(sum, outside, c_literal, kBetween)) +
         "// F(q, u).\nstatic inline double viscontact_force(double gap, double velocity) {\n"
         "  return -viscontact_resistance(gap) * velocity;\n}\n\n#endif\n";
}

/// The statements with lines of at most 100 characters, of the 132 that Fortran allows.
std::string continued(const std::string& statements) {
  constexpr std::size_t kLongest = 100;
  std::string text;
  std::istringstream lines(statements);
  for (std::string line; std::getline(lines, line);) {
    for (auto at = line.rfind(' ', kLongest);
         line.size() > kLongest && at != std::string::npos && line.find_first_not_of(' ') < at;
         at = line.rfind(' ', kLongest)) {
      text += line.substr(0, at) + " &\n";
      line = "      " + line.substr(at + 1);
    }
    text += line + "\n";
  }
  return text;
}

/// The target fortran: a module, whose functions take a number or an array.
std::string write_fortran(const lubrication::Fit& fit, std::string_view source,
                          const Limits& limits) {
  const Sum sum = sum_of(fit);
  const Outside outside = outside_of(fit, limits);
  const auto function = [&](std::string_view name, const Expressions& e) {
    const auto branch = [](std::string_view condition, const std::string& answer) {
      return answer.empty() ? ""
                            : fmt::format(
                                  "    if ({}) then\n      answer = {}\n"
                                  "      return\n    end if\n",
                                  condition, answer);
    };
    return continued(
        fmt::format("  elemental function viscontact_{}(gap) result(answer)\n"
                    "    real(real64), intent(in) :: gap\n"
                    "    real(real64) :: answer, q, l{}\n"
                    "    q = gap\n",
                    name, sum.needs_wall ? ", p, m" : "") +
        branch("gap > 0 .and. gap < smallest_gap", e.below) +
        branch(outside.has_wall()
                   ? fmt::format("gap > largest_gap .and. gap < {}", fortran_literal(outside.wall))
                   : "gap > largest_gap .and. gap <= huge(gap)",
               e.above) +
        (outside.has_above && outside.has_wall()
             ? branch(fmt::format("gap >= {0} .and. gap <= {0}", fortran_literal(outside.wall)),
                      "ieee_value(answer, ieee_positive_inf)")
             : "") +
        branch(".not. (gap >= smallest_gap .and. gap <= largest_gap)",
               "ieee_value(answer, ieee_quiet_nan)") +
        fmt::format("    l = log(gap)\n{}    answer = {}\n  end function\n\n",
                    sum.needs_wall ? fmt::format("    p = {} - gap\n    m = log(p)\n",
                                                 fortran_literal(sum.largest_gap))
                                   : "",
                    e.inside));
  };
  constexpr std::string_view kBetween = " &\n      + ";
  return commented(facts(fit, source, outside), "!") + "! At other gaps the answer is NaN.\n" +
         fmt::format(
             "module viscontact_lubrication\n"
             "  use, intrinsic :: iso_fortran_env, only: real64\n"
             "  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan{}\n"
             "  implicit none\n"
             "  real(real64), parameter :: smallest_gap = {}, largest_gap = {}\n"
             "contains\n\n",
             outside.has_above && outside.has_wall() ? ", &\n    ieee_positive_inf" : "",
             fortran_literal(fit.gap_interval[0]), fortran_literal(fit.gap_interval[1])) +
         "  ! R(q), > 0.\n" +
         function("resistance", resistance_of(sum, outside, fortran_literal, kBetween)) +
         "  ! Gamma(q).\n" +
         function("impulse", impulse_of(sum, outside, fortran_literal, kBetween)) +
         "  ! F(q, u).\n"
         "  elemental function viscontact_force(gap, velocity) result(answer)\n"
         "    real(real64), intent(in) :: gap, velocity\n"
         "    real(real64) :: answer\n"
         "    answer = -viscontact_resistance(gap) * velocity\n"
         "  end function\n\n"
         "end module\n";
}

/// The target python: functions that raise ValueError at a gap without a formula.
std::string write_python(const lubrication::Fit& fit, std::string_view source,
                         const Limits& limits) {
  const Sum sum = sum_of(fit);
  const Outside outside = outside_of(fit, limits);
  const auto function = [&](std::string_view name, std::string_view what, const Expressions& e) {
    std::string text, tuples;
    const std::string wall_variables =
        sum.needs_wall ? fmt::format("    p = {} - q\n    m = log(p)\n", plain(sum.largest_gap))
                       : "";
    const auto formula = [&](std::string_view place, std::string_view low, std::string_view high,
                             const std::string& expression) {
      if (expression.empty()) return;
      text += fmt::format("def _{0}_{1}(q, log):\n{2}    return ({3})\n\n\n", name, place,
                          place == "inside" ? "    l = log(q)\n" + wall_variables : "", expression);
      tuples += fmt::format("({}, {}, _{}_{}), ", low, high, name, place);
    };
    formula("inside", "SMALLEST_GAP", "LARGEST_GAP", e.inside);
    formula("below", "sys.float_info.min", "SMALLEST_GAP", e.below);
    if (outside.has_wall()) {
      formula("above", "LARGEST_GAP", plain(std::nextafter(outside.wall, 0.0)), e.above);
      // At the wall itself, in the type of the gap.
      formula("at_wall", plain(outside.wall), plain(outside.wall),
              e.above.empty() ? "" : "q + math.inf");
    } else {
      formula("above", "LARGEST_GAP", "sys.float_info.max", e.above);
    }
    return text + fmt::format(
                      "def {0}(gap):\n"
                      "    \"\"\"{1} Raises ValueError at other gaps.\"\"\"\n"
                      "    return _evaluate(gap, ({2}))\n\n\n",
                      name, what, tuples.substr(0, tuples.size() - 1));
  };
  constexpr std::string_view kBetween = "\n            + ";
  return commented(facts(fit, source, outside), "#") +
         "# A gap is a number or an array of NumPy, and so is the answer.\n" +
         fmt::format("import math\nimport sys\n\nSMALLEST_GAP, LARGEST_GAP = {}, {}\n\n\n",
                     plain(fit.gap_interval[0]), plain(fit.gap_interval[1])) +
         std::string(kPythonEvaluate) + "\n\n" +
         function("resistance", "R(q), > 0.", resistance_of(sum, outside, plain, kBetween)) +
         function("impulse", "Gamma(q).", impulse_of(sum, outside, plain, kBetween)) +
         "def force(gap, velocity):\n"
         "    \"\"\"F(q, u). Raises ValueError as resistance(gap).\"\"\"\n"
         "    return -resistance(gap) * velocity\n";
}

/// The target matlab: a function that returns a struct of functions.
std::string write_matlab(const lubrication::Fit& fit, std::string_view source,
                         const Limits& limits) {
  const Sum sum = sum_of(fit);
  const Outside outside = outside_of(fit, limits);
  const auto function = [&](std::string_view name, const Expressions& e) {
    const auto branch = [](std::string_view condition, const std::string& answer) {
      return answer.empty() ? ""
                            : fmt::format("  here = {};\n  q = gap(here);\n  answer(here) = {};\n",
                                          condition, elementwise(answer));
    };
    return fmt::format(
        "function answer = {}(gap)\n  gap = double(gap);\n  answer = NaN(size(gap));\n{}{}"
        "  here = gap >= {} & gap <= {};\n  q = gap(here);\n  l = log(q);\n{}"
        "  answer(here) = {};\nend\n",
        name, branch(fmt::format("gap > 0 & gap < {}", plain(outside.smallest)), e.below),
        branch(fmt::format("gap > {} & gap < {}", plain(outside.largest),
                           outside.has_wall() ? plain(outside.wall) : "Inf"),
               e.above) +
            (outside.has_above && outside.has_wall()
                 ? fmt::format("  answer(gap == {}) = Inf;\n", plain(outside.wall))
                 : ""),
        plain(outside.smallest), plain(outside.largest),
        sum.needs_wall ? fmt::format("  p = {} - q;\n  m = log(p);\n", plain(sum.largest_gap)) : "",
        elementwise(e.inside));
  };
  constexpr std::string_view kBetween = " ...\n      + ";
  return commented(facts(fit, source, outside), "%") +
         fmt::format(
             "% MATLAB or Octave, in a file viscontact_lubrication.m: f = "
             "viscontact_lubrication();\n"
             "% f.force(gap, velocity). A gap is a number or an array. At other gaps the answer "
             "is\n"
             "% NaN.\n"
             "function f = viscontact_lubrication()\n"
             "  f.smallest_gap = {};\n  f.largest_gap = {};\n"
             "  f.resistance = @resistance;  % R(q), > 0\n"
             "  f.impulse = @impulse;  % Gamma(q)\n"
             "  f.force = @(gap, velocity) -resistance(gap) .* double(velocity);  % F(q, "
             "u)\nend\n\n",
             plain(outside.smallest), plain(outside.largest)) +
         function("resistance", resistance_of(sum, outside, plain, kBetween)) + "\n" +
         function("impulse", impulse_of(sum, outside, plain, kBetween));
}

/// The target json: terms, numbers of the formulas outside the interval, and samples.
std::string write_json(const lubrication::Fit& fit, std::string_view source, const Limits& limits) {
  const Sum sum = sum_of(fit);
  const Outside outside = outside_of(fit, limits);
  const lubrication::LubricationForce force(fit);
  nlohmann::ordered_json json;
  json["about"] = facts(fit, source, outside);
  json["formulas"] =
      sum.needs_wall
          ? "q: gap, l: ln q, p: largest_gap - q, m: ln p; R = sum of weight * value, Gamma = sum "
            "of "
            "weight * antiderivative - impulse_offset"
          : "q: gap, l: ln q; R = sum of weight * value, Gamma = sum of weight * antiderivative - "
            "impulse_offset";
  // Fit files have no key "interval", so that the reader of fit files refuses an export.
  json["interval"] = fit.gap_interval;
  if (outside.has_wall()) json["largest_gap"] = outside.wall;
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
  if (outside.has_below)
    json["below"] = {
        {"formula", "R = k/q + constant"}, {"k", outside.k}, {"constant", outside.constant}};
  if (outside.has_above) {
    json["above"] = {{"formula", "R = stokes + reflected/(q + radius)"},
                     {"stokes", outside.stokes},
                     {"reflected", outside.reflected}};
    if (outside.has_wall()) {
      json["above"]["formula"] =
          "R = stokes + reflected/(q + radius) + wall (1/(L - q) - 1/(L - q2)), q2: end of the "
          "interval, L: largest_gap; R is infinite at L";
      json["above"]["wall"] = outside.k_wall;
    }
  }
  json["reference_velocity"] = fit.reference_velocity;
  for (const double gap : lubrication::spread_gaps(fit.gap_interval)) {
    json["samples"]["gap"].push_back(gap);
    json["samples"]["resistance"].push_back(force.resistance(gap));
    json["samples"]["impulse"].push_back(force.impulse(gap));
    json["samples"]["force"].push_back(-force.resistance(gap) * fit.reference_velocity);
  }
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

/// The target csv: samples within the interval.
std::string write_csv(const lubrication::Fit& fit, std::string_view source, const Limits& limits) {
  if (limits.below != lubrication::BelowInterval::kError ||
      limits.above != lubrication::AboveInterval::kError)
    throw Error(ErrorKind::kWrongUsage,
                "csv has samples within the interval of the fit only; leave out --below and "
                "--above, or choose another target");
  const lubrication::LubricationForce force(fit);
  std::string text = commented(facts(fit, source), "#");
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
    ExportTarget{"python", "a module of Python 3, also for arrays of NumPy", TextKind::kHashComment,
                 write_python},
    ExportTarget{"matlab", "functions of MATLAB and Octave", TextKind::kMatlab, write_matlab},
    ExportTarget{"json", "terms, formulas and 201 samples", TextKind::kJson, write_json},
    ExportTarget{"csv", "201 samples", TextKind::kHashComment, write_csv},
};

}  // namespace

std::span<const ExportTarget> export_targets() { return kTargets; }

std::string export_fit(const lubrication::Fit& fit, std::string_view target,
                       std::string_view source, const Limits& outside) {
  (void)lubrication::LubricationForce(fit);  // throws if the resistance is not positive
  return require_named(kTargets, target, "export target").write(fit, source, outside);
}

}  // namespace viscontact::fitting
