// Exported code, compiled and run, against the fitted force.
#include "viscontact/fitting/export/export_fit.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/fitting/samples.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/system/process.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"

namespace viscontact::fitting {
namespace {

using ::testing::HasSubstr;

constexpr double kVelocity = -0.7;

/// Every term there is, with coefficients of no short form, at a radius and a velocity that are
/// not 1.
lubrication::Fit fit_of_all_terms() {
  lubrication::Fit fit = planted_fit({}, 1e-3, 2);
  fit.basis = lubrication::kOwnTerms;
  fit.geometry = "plane";
  fit.radius = 1.3;
  fit.reference_velocity = -1.0 / 3;
  double coefficient = 100.0 / 3;
  for (const auto& term : lubrication::all_terms()) {
    fit.terms.push_back({std::string(term.name), coefficient, 0});
    coefficient *= -0.11;
  }
  fit.terms[1].coefficient = -10.0 / 3;
  fit.terms[2].coefficient = 200.0 / 7;
  fit.covariance.assign(fit.terms.size(), std::vector<double>(fit.terms.size(), 0.0));
  return fit;
}

struct Values {
  double resistance, force, impulse;
};

std::vector<Values> values_of(const std::string& output) {
  std::istringstream stream(output);
  std::vector<Values> values;
  for (Values v{}; stream >> v.resistance >> v.force >> v.impulse;) values.push_back(v);
  return values;
}

/// Gaps from far below the interval to far above it.
std::array<double, 2> wide(const lubrication::Fit& fit) {
  return {1e-4 * fit.gap_interval[0], 50 * fit.gap_interval[1]};
}

void expect_values(const std::vector<Values>& values, const lubrication::Fit& fit) {
  const lubrication::LubricationForce force(fit);
  const auto gaps = lubrication::spread_gaps(fit.gap_interval);
  ASSERT_EQ(values.size(), gaps.size());
  // What is asked of an export: 1e-15. Gamma vanishes at q = r, where only its parts have digits.
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const double resistance = force.resistance(gaps[i]);
    EXPECT_NEAR(values[i].resistance / resistance, 1, 1e-15) << gaps[i];
    EXPECT_NEAR(values[i].force / (-resistance * kVelocity), 1, 1e-15) << gaps[i];
    EXPECT_NEAR(values[i].impulse, force.impulse(gaps[i]),
                1e-15 * std::max(std::abs(force.impulse(gaps[i])), resistance * gaps[i]))
        << gaps[i];
  }
}

lubrication::OutsideInterval both_limits() { return lubrication::OutsideInterval{}.with_limits(); }

/// Compares with the force that has both limits, from far below the interval to far above it.
void expect_values_outside(const std::vector<Values>& values, const lubrication::Fit& fit) {
  const lubrication::LubricationForce force(fit, both_limits());
  const auto gaps = lubrication::spread_gaps(wide(fit));
  ASSERT_EQ(values.size(), gaps.size());
  // What is asked of an export. Libraries for arrays have logarithms of their own.
  constexpr double kRounding = 1e-14;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const double resistance = force.resistance(gaps[i]);
    EXPECT_NEAR(values[i].resistance / resistance, 1, kRounding) << gaps[i];
    EXPECT_NEAR(values[i].force / (-resistance * kVelocity), 1, kRounding) << gaps[i];
    EXPECT_NEAR(values[i].impulse, force.impulse(gaps[i]),
                kRounding * std::max(std::abs(force.impulse(gaps[i])), resistance * gaps[i]))
        << gaps[i];
  }
}

class Export : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  /// The gaps as a list in the language's source.
  static std::string gap_list(const std::array<double, 2>& interval, char exponent = 'e') {
    std::string list;
    for (const double gap : lubrication::spread_gaps(interval)) {
      std::string text = fmt::format("{:.17e}", gap);
      std::ranges::replace(text, 'e', exponent);
      list += (list.empty() ? "" : ", ") + text;
    }
    return list;
  }

  static std::string output_of(const std::vector<std::string>& command) {
    const auto result = run_process(command);
    EXPECT_EQ(result.exit_status, 0) << result.output;
    return result.output;
  }

  /// What Octave prints that runs a script in its folder.
  std::string octave(const std::string& script) const {
    return output_of(
        {"octave-cli", "--norc", "--no-history", "--path", folder_.path().string(), script});
  }

  lubrication::Fit fit_ = fit_of_all_terms();
  TemporaryFolder folder_;
};

TEST_F(Export, CHeaderCompilesWithoutAWarningAsCAndAsCxxAndHasTheValues) {
  put_text(path("force.h"), export_fit(fit_, "c-header"));
  put_text(path("main.c"), fmt::format(R"(
#include <stdio.h>
#include "force.h"
#include "force.h"
int main(void) {{
  const double gaps[] = {{{}}};
  for (unsigned i = 0; i < sizeof gaps / sizeof *gaps; ++i)
    printf("%.17g %.17g %.17g\n", viscontact_resistance(gaps[i]),
           viscontact_force(gaps[i], {}), viscontact_impulse(gaps[i]));
  return !(isnan(viscontact_resistance(9e-4)) && isnan(viscontact_impulse(2.1)) &&
           isnan(viscontact_force(-1, 1)));
}}
)",
                                       gap_list(fit_.gap_interval), kVelocity));
  for (const auto& compiler : {std::vector<std::string>{"gcc", "-std=c99", "-x", "c"},
                               std::vector<std::string>{"g++", "-std=c++11", "-x", "c++"}}) {
    auto command = compiler;
    command.insert(command.end(), {"-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O2",
                                   path("main.c"), "-o", path("program"), "-lm"});
    output_of(command);
    expect_values(values_of(output_of({path("program")})), fit_);
  }
}

/// Fortran statements that print the values of the module at gaps in an interval.
template <class Interval>
std::string fortran_calls(const Interval& interval) {
  std::string calls;
  for (const double gap : lubrication::spread_gaps(interval)) {
    std::string text = fmt::format("{:.17e}", gap);
    std::ranges::replace(text, 'e', 'd');
    calls += fmt::format(
        "  print '(3es25.16e3)', viscontact_resistance({0}), viscontact_force({0}, {1}d0), &\n"
        "    viscontact_impulse({0})\n",
        text, kVelocity);
  }
  return calls;
}

TEST_F(Export, FortranModuleCompilesWithoutAWarningAndHasTheValues) {
  put_text(path("force.f90"), export_fit(fit_, "fortran"));
  put_text(path("main.f90"),
           "program main\n  use viscontact_lubrication\n  use, intrinsic :: ieee_arithmetic\n"
           "  implicit none\n" +
               fortran_calls(fit_.gap_interval) +
               "  if (.not. ieee_is_nan(viscontact_resistance(9d-4))) stop 1\n"
               "  if (.not. ieee_is_nan(viscontact_impulse(2.1d0))) stop 1\nend program\n");
  output_of({"gfortran", "-std=f2008", "-Wall", "-Wextra", "-pedantic", "-Werror", "-O2", "-J",
             folder_.path().string(), path("force.f90"), path("main.f90"), "-o", path("program")});
  expect_values(values_of(output_of({path("program")})), fit_);
}

TEST_F(Export, PythonModuleHasTheValuesAndRaisesOutside) {
  put_text(path("lubrication.py"), export_fit(fit_, "python"));
  put_text(path("main.py"), fmt::format(R"(
import lubrication
for gap in [{}]:
    print(repr(lubrication.resistance(gap)), repr(lubrication.force(gap, {})),
          repr(lubrication.impulse(gap)))
for gap in (9e-4, 2.1, float("nan")):
    for function in (lubrication.resistance, lubrication.impulse):
        try:
            function(gap)
        except ValueError:
            continue
        raise SystemExit("no error at " + str(gap))
)",
                                        gap_list(fit_.gap_interval), kVelocity));
  expect_values(values_of(output_of({"python3", path("main.py")})), fit_);
}

TEST_F(Export, PythonModuleTakesArraysOfNumPy) {
  // Debian's python3, for which python3-numpy is.
  put_text(path("lubrication.py"), export_fit(fit_, "python", "", both_limits()));
  put_text(path("main.py"), fmt::format(R"(
import lubrication, numpy
gaps = numpy.array([{}])
columns = lubrication.resistance(gaps), lubrication.force(gaps, {}), lubrication.impulse(gaps)
for row in zip(*columns):
    print(*(repr(float(value)) for value in row))
grid = gaps[:200].reshape(4, 50)
assert (lubrication.resistance(grid) == columns[0][:200].reshape(4, 50)).all()
assert lubrication.impulse(numpy.array(0.5)).shape == ()
assert isinstance(lubrication.resistance(numpy.float64(0.5)), float)
assert lubrication.resistance(list(gaps)).shape == gaps.shape
for bad in ([0.5, -1.0], [0.0, 0.5], [0.5, float("nan")], [float("inf")]):
    try:
        lubrication.resistance(numpy.array(bad))
    except ValueError as error:
        assert "is outside [0.001, 2]" in str(error), error
        continue
    raise SystemExit("no error at " + str(bad))
)",
                                        gap_list(wide(fit_)), kVelocity));
  expect_values_outside(values_of(output_of({"/usr/bin/python3", path("main.py")})), fit_);
}

TEST_F(Export, OctaveFunctionsHaveTheValuesAndAreNanOutside) {
  put_text(path("viscontact_lubrication.m"), export_fit(fit_, "matlab"));
  put_text(path("main.m"), fmt::format(R"(
f = viscontact_lubrication();
gaps = [{}];
printf("%.17g %.17g %.17g\n", [f.resistance(gaps); f.force(gaps, {}); f.impulse(gaps)]);
assert(all(isnan(f.resistance([9e-4, 2.1; NaN, -1])(:))));
assert(size(f.impulse(gaps')), size(gaps'));
assert(f.resistance(f.smallest_gap) > f.resistance(f.largest_gap));
)",
                                       gap_list(fit_.gap_interval), kVelocity));
  expect_values(values_of(octave(path("main.m"))), fit_);
  put_text(path("viscontact_lubrication.m"), export_fit(fit_, "matlab", "", both_limits()));
  put_text(path("main.m"), fmt::format(R"(
f = viscontact_lubrication();
gaps = [{}];
printf("%.17g %.17g %.17g\n", [f.resistance(gaps); f.force(gaps, {}); f.impulse(gaps)]);
assert(all(isnan(f.resistance([0, -1, NaN, Inf]))));
)",
                                       gap_list(wide(fit_)), kVelocity));
  expect_values_outside(values_of(octave(path("main.m"))), fit_);
}

TEST_F(Export, CHeaderHasTheLimitsOutsideTheInterval) {
  put_text(path("force.h"), export_fit(fit_, "c-header", "", both_limits()));
  put_text(path("main.c"), fmt::format(R"(
#include <stdio.h>
#include "force.h"
int main(void) {{
  const double gaps[] = {{{}}};
  for (unsigned i = 0; i < sizeof gaps / sizeof *gaps; ++i)
    printf("%.17g %.17g %.17g\n", viscontact_resistance(gaps[i]),
           viscontact_force(gaps[i], {}), viscontact_impulse(gaps[i]));
  return !(isnan(viscontact_resistance(0)) && isnan(viscontact_impulse(HUGE_VAL)) &&
           isnan(viscontact_force(-1, 1)) && isnan(viscontact_resistance(NAN)));
}}
)",
                                       gap_list(wide(fit_)), kVelocity));
  output_of({"gcc", "-std=c99", "-x", "c", "-Wall", "-Wextra", "-Wpedantic", "-Werror",
             path("main.c"), "-o", path("program"), "-lm"});
  expect_values_outside(values_of(output_of({path("program")})), fit_);
}

TEST_F(Export, FortranModuleHasTheLimitsOutsideTheInterval) {
  put_text(path("force.f90"), export_fit(fit_, "fortran", "", both_limits()));
  put_text(path("main.f90"),
           "program main\n  use viscontact_lubrication\n  use, intrinsic :: ieee_arithmetic\n"
           "  implicit none\n" +
               fortran_calls(wide(fit_)) +
               "  if (.not. ieee_is_nan(viscontact_resistance(0d0))) stop 1\nend program\n");
  output_of({"gfortran", "-std=f2008", "-Wall", "-Wextra", "-pedantic", "-Werror", "-J",
             folder_.path().string(), path("force.f90"), path("main.f90"), "-o", path("program")});
  expect_values_outside(values_of(output_of({path("program")})), fit_);
}

/// A fit between a floor and a lid at the gap 4, with both kinds of terms that the lid needs.
lubrication::Fit fit_below_a_lid() {
  auto fit = planted_fit({{"1/q", 20}, {"1", 30}, {"1/(L-q)", 19}, {"ln(L-q)", -3}}, 1e-3, 2);
  fit.geometry = "plane";
  fit.container = "closed cylinder, radius 5, height 6.6";
  fit.radius = 1.3;
  fit.basis = lubrication::kOwnTerms;
  fit.covariance.assign(4, std::vector<double>(4, 0.0));
  return fit;
}

TEST_F(Export, OfAFitBelowALidIsInfiniteThereInEachLanguage) {
  const auto fit = fit_below_a_lid();
  const lubrication::LubricationForce force(fit, both_limits());
  const double lid = force.largest_gap();
  ASSERT_NEAR(lid, 4, 1e-15);
  std::string gaps, fortran;
  std::vector<double> all;
  for (const double gap : lubrication::spread_gaps({1e-7, 3.9999}, 40)) all.push_back(gap);
  for (const double gap : all) {
    gaps += fmt::format("{}{:.17e}", gaps.empty() ? "" : ", ", gap);
    auto text = fmt::format("{:.17e}", gap);
    std::ranges::replace(text, 'e', 'd');
    fortran += fmt::format(
        "  print '(3es25.16e3)', viscontact_resistance({0}), viscontact_force({0}, {1}d0), &\n"
        "    viscontact_impulse({0})\n",
        text, kVelocity);
  }
  const auto expect = [&](const std::string& output) {
    const auto values = values_of(output);
    ASSERT_EQ(values.size(), all.size());
    // Rounding of the distance to the lid, 1e-4, relative to the gap.
    constexpr double kRounding = 1e-11;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double resistance = force.resistance(all[i]);
      EXPECT_NEAR(values[i].resistance / resistance, 1, kRounding) << all[i];
      EXPECT_NEAR(values[i].impulse, force.impulse(all[i]),
                  kRounding * std::max(std::abs(force.impulse(all[i])), resistance * all[i]));
    }
  };
  const auto at_lid = fmt::format("{:.17g}", lid);
  put_text(path("force.h"), export_fit(fit, "c-header", "", both_limits()));
  put_text(path("main.c"), fmt::format(R"(
#include <stdio.h>
#include "force.h"
int main(void) {{
  const double gaps[] = {{{}}};
  for (unsigned i = 0; i < sizeof gaps / sizeof *gaps; ++i)
    printf("%.17g %.17g %.17g\n", viscontact_resistance(gaps[i]),
           viscontact_force(gaps[i], -0.7), viscontact_impulse(gaps[i]));
  return !(isinf(viscontact_resistance({})) && isnan(viscontact_resistance(4.1)));
}}
)",
                                       gaps, at_lid));
  output_of({"gcc", "-std=c99", "-x", "c", "-Wall", "-Wextra", "-Wpedantic", "-Werror",
             path("main.c"), "-o", path("program"), "-lm"});
  expect(output_of({path("program")}));

  put_text(path("force.f90"), export_fit(fit, "fortran", "", both_limits()));
  put_text(path("main.f90"),
           "program main\n  use viscontact_lubrication\n  use, intrinsic :: ieee_arithmetic\n"
           "  implicit none\n" +
               fortran +
               fmt::format("  if (ieee_is_finite(viscontact_resistance({}d0))) stop 1\n"
                           "  if (ieee_is_nan(viscontact_resistance({}d0))) stop 1\n"
                           "  if (.not. ieee_is_nan(viscontact_resistance(4.1d0))) stop 1\n"
                           "end program\n",
                           at_lid, at_lid));
  output_of({"gfortran", "-std=f2008", "-Wall", "-Wextra", "-pedantic", "-Werror", "-J",
             folder_.path().string(), path("force.f90"), path("main.f90"), "-o", path("program")});
  expect(output_of({path("program")}));

  put_text(path("lubrication.py"), export_fit(fit, "python", "", both_limits()));
  put_text(path("main.py"), fmt::format(R"(
import lubrication, math
for gap in [{}]:
    print(repr(lubrication.resistance(gap)), repr(lubrication.force(gap, -0.7)),
          repr(lubrication.impulse(gap)))
assert math.isinf(lubrication.resistance({}))
try:
    lubrication.resistance(4.1)
except ValueError:
    raise SystemExit(0)
raise SystemExit("no error")
)",
                                        gaps, at_lid));
  expect(output_of({"python3", path("main.py")}));

  put_text(path("viscontact_lubrication.m"), export_fit(fit, "matlab", "", both_limits()));
  put_text(path("main.m"), fmt::format(R"(
f = viscontact_lubrication();
gaps = [{}];
printf("%.17g %.17g %.17g\n", [f.resistance(gaps); f.force(gaps, -0.7); f.impulse(gaps)]);
assert(isinf(f.resistance({})) && isnan(f.resistance(4.1)));
)",
                                       gaps, at_lid));
  expect(octave(path("main.m")));
}

TEST_F(Export, TakesWholeNumbersAsDoublesInEachLanguage) {
  fit_.gap_interval = {1e-3, 5};
  const lubrication::LubricationForce force(fit_);
  const auto expect = [&](const std::string& output) {
    std::istringstream stream(output);
    double resistance = 0, drag = 0;
    ASSERT_TRUE(stream >> resistance >> drag) << output;
    EXPECT_NEAR(resistance / force.resistance(1), 1, 1e-15);
    EXPECT_NEAR(drag / (-3 * force.resistance(1)), 1, 1e-15);
  };
  put_text(path("viscontact_lubrication.m"), export_fit(fit_, "matlab"));
  for (const std::string type : {"int32", "uint8", "int64", "single", "double"}) {
    put_text(path("main.m"),
             "f = viscontact_lubrication();\nprintf(\"%.17g %.17g\\n\", f.resistance(" + type +
                 "(1)), f.force(" + type + "(1), " + type + "(3)));\n");
    expect(octave(path("main.m")));
  }
  put_text(path("lubrication.py"), export_fit(fit_, "python"));
  put_text(path("main.py"),
           "import lubrication, numpy\nfor one, three in ((1, 3), (numpy.int32(1), numpy.int8(3)), "
           "(True, 3)):\n    print(repr(float(lubrication.resistance(one))), "
           "repr(float(lubrication.force(one, three))))\n");
  std::istringstream lines(output_of({"/usr/bin/python3", path("main.py")}));
  for (std::string line; std::getline(lines, line);) expect(line);
  put_text(path("force.h"), export_fit(fit_, "c-header"));
  put_text(
      path("main.c"),
      "#include <stdio.h>\n#include \"force.h\"\nint main(void) {\n  printf(\"%.17g %.17g\\n\", "
      "viscontact_resistance(1), viscontact_force(1, 3));\n  return 0;\n}\n");
  output_of({"gcc", "-std=c99", "-x", "c", "-Wall", "-Werror", path("main.c"), "-o",
             path("program"), "-lm"});
  expect(output_of({path("program")}));
}

TEST_F(Export, JsonHasTheLimitsAndCsvRefusesThem) {
  fit_.leading_coefficient = 90;
  auto limits = both_limits();
  limits.below = lubrication::BelowInterval::kTheoryLimit;
  const auto json = nlohmann::json::parse(export_fit(fit_, "json", "", limits));
  const lubrication::LubricationForce force(fit_, limits);
  const auto& below = json.at("below");
  EXPECT_EQ(below.at("k"), 90);
  EXPECT_NEAR(below.at("k").get<double>() / 1e-5 + below.at("constant").get<double>(),
              force.resistance(1e-5), 1e-14 * force.resistance(1e-5));
  const auto& above = json.at("above");
  EXPECT_NEAR(
      above.at("stokes").get<double>() + above.at("reflected").get<double>() / (7 + fit_.radius),
      force.resistance(7), 1e-14 * force.resistance(7));
  EXPECT_FALSE(nlohmann::json::parse(export_fit(fit_, "json")).contains("below"));
  EXPECT_THAT(failure(ErrorKind::kWrongUsage, [&] { export_fit(fit_, "csv", "", limits); }),
              Says("within the interval of the fit only"));
}

TEST_F(Export, CsvHasTheValuesAtTheReferenceVelocity) {
  const std::array<std::string, 4> columns = {"gap", "resistance", "force", "impulse"};
  put_text(path("force.csv"), export_fit(fit_, "csv"));
  const auto csv = read_csv(path("force.csv"), columns, columns.size());
  const lubrication::LubricationForce force(fit_);
  ASSERT_EQ(csv.rows.size(), 201U);
  for (const auto& row : csv.rows) {
    const double gap = *row.fields[0];
    EXPECT_EQ(*row.fields[1], force.resistance(gap));
    EXPECT_EQ(*row.fields[2], -force.resistance(gap) * fit_.reference_velocity);
    EXPECT_EQ(*row.fields[3], force.impulse(gap));
  }
}

TEST_F(Export, JsonHasTermsAndSamplesThatAgree) {
  const auto json = nlohmann::json::parse(export_fit(fit_, "json"));
  const lubrication::LubricationForce force(fit_);
  EXPECT_EQ(json.at("interval"), fit_.gap_interval);
  const auto& samples = json.at("samples");
  const auto gaps = samples.at("gap").get<std::vector<double>>();
  ASSERT_EQ(gaps.size(), 201U);
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    EXPECT_EQ(samples.at("resistance").at(i), force.resistance(gaps[i]));
    EXPECT_EQ(samples.at("impulse").at(i), force.impulse(gaps[i]));
    double sum = 0, gamma = 0;
    for (const auto& term : json.at("terms")) {
      const auto known = lubrication::find_term(term.at("name").get<std::string>()).value();
      EXPECT_EQ(term.at("value"), known.value.text);
      sum += term.at("weight").get<double>() * known.value(gaps[i]);
      gamma += term.at("weight").get<double>() * known.antiderivative(gaps[i]);
    }
    EXPECT_EQ(sum, force.resistance(gaps[i]));
    EXPECT_EQ(gamma - json.at("impulse_offset").get<double>(), force.impulse(gaps[i]));
  }
}

TEST_F(Export, SaysIntervalErrorAndSource) {
  const lubrication::Fit fit = [] {
    auto table = exact_drag_table(fifty_gaps(), {-1}, 3, 1);
    table.geometry = "plane";
    for (auto& row : table.rows) row.relative_error_estimate = 1.25e-6;
    lubrication::Fit made = fit_force_table(table, "lecture", lubrication::Weights::kRelative);
    made.table_sha256 = "abc123";
    made.versions["Viscontact"] = "9.9";
    return made;
  }();
  for (const auto& target : export_targets()) {
    const auto text = export_fit(fit, target.name);
    for (const auto* fact : {"[0.001, 1]", "plane", "largest 0.0025,", "1.25e-06", "abc123",
                             "Viscontact 9.9", "radius 1, viscosity 3"})
      EXPECT_THAT(text, HasSubstr(fact)) << target.name;
  }
}

TEST_F(Export, ToAnUnknownLanguageIsRefusedWithTheNamesThereAre) {
  EXPECT_THAT(bad_input([&] { export_fit(fit_, "cobol"); }), Names("cobol", "c-header", "csv"));
}

TEST_F(Export, OfADragThatIsNotPositiveIsRefused) {
  EXPECT_THAT(bad_input([] {
                export_fit(planted_fit({{"1/q", 1}, {"1", -10}}, 1e-3, 1), "csv");
              }),
              Names("positive"));
}

}  // namespace
}  // namespace viscontact::fitting
