// Exported code, compiled and run, against the fitted force.
#include "viscontact/fitting/export/export_fit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
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

lubrication::OutsideInterval both_limits() { return lubrication::OutsideInterval{}.with_limits(); }

/// Gamma vanishes at q = r, where only its parts have digits.
void expect_values(const std::string& output, const lubrication::LubricationForce& force,
                   const std::vector<double>& gaps, double rounding) {
  const auto values = values_of(output);
  ASSERT_EQ(values.size(), gaps.size());
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const double resistance = force.resistance(gaps[i]);
    EXPECT_NEAR(values[i].resistance / resistance, 1, rounding) << gaps[i];
    EXPECT_NEAR(values[i].force / (-resistance * kVelocity), 1, rounding) << gaps[i];
    EXPECT_NEAR(values[i].impulse, force.impulse(gaps[i]),
                rounding * std::max(std::abs(force.impulse(gaps[i])), resistance * gaps[i]))
        << gaps[i];
  }
}

/// What is asked of an export: 1e-15.
void expect_values(const std::string& output, const lubrication::Fit& fit) {
  expect_values(output, lubrication::LubricationForce(fit),
                lubrication::spread_gaps(fit.gap_interval), 1e-15);
}

/// Compares with the force that has both limits, from far below the interval to far above it.
/// Libraries for arrays have logarithms of their own.
void expect_values_outside(const std::string& output, const lubrication::Fit& fit) {
  expect_values(output, lubrication::LubricationForce(fit, both_limits()),
                lubrication::spread_gaps(wide(fit)), 1e-14);
}

/// The gaps as a list in the language's source.
std::string list_of(const std::vector<double>& gaps) {
  return fmt::format("{:.17e}", fmt::join(gaps, ", "));
}

class Export : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  static std::string output_of(const std::vector<std::string>& command) {
    const auto result = run_process(command);
    EXPECT_EQ(result.exit_status, 0) << result.output;
    return result.output;
  }

  /// What Octave prints that runs a script in its folder.
  std::string octave(const std::string& script) const {
    put_text(path("main.m"), script);
    return output_of({"octave-cli", "--norc", "--no-history", "--path", folder_.path().string(),
                      path("main.m")});
  }

  /// The values at these gaps by functions of Octave, which are called f in the assertions.
  std::string octave_values(const std::string& functions, const std::vector<double>& gaps,
                            const std::string& assertions) const {
    put_text(path("viscontact_lubrication.m"), functions);
    return octave(fmt::format(R"(
f = viscontact_lubrication();
gaps = [{}];
printf("%.17g %.17g %.17g\n", [f.resistance(gaps); f.force(gaps, {}); f.impulse(gaps)]);
{}
)",
                              list_of(gaps), kVelocity, assertions));
  }

  /// The values at these gaps by a header for C, which compiles without a warning, and whose
  /// functions obey the condition.
  std::string c_values(const std::string& header, const std::vector<double>& gaps,
                       const std::string& condition,
                       std::vector<std::string> compiler = {"gcc", "-std=c99", "-x", "c"}) const {
    put_text(path("force.h"), header);
    put_text(path("main.c"), fmt::format(R"(
#include <stdio.h>
#include "force.h"
#include "force.h"
int main(void) {{
  const double gaps[] = {{{}}};
  for (unsigned i = 0; i < sizeof gaps / sizeof *gaps; ++i)
    printf("%.17g %.17g %.17g\n", viscontact_resistance(gaps[i]),
           viscontact_force(gaps[i], {}), viscontact_impulse(gaps[i]));
  return !({});
}}
)",
                                         list_of(gaps), kVelocity, condition));
    compiler.insert(compiler.end(), {"-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O2",
                                     path("main.c"), "-o", path("program"), "-lm"});
    output_of(compiler);
    return output_of({path("program")});
  }

  /// The same by a module for Fortran, with statements that stop if its functions are wrong.
  std::string fortran_values(const std::string& module, const std::vector<double>& gaps,
                             const std::string& conditions) const {
    std::string calls;
    for (const double gap : gaps) {
      std::string text = fmt::format("{:.17e}", gap);
      std::ranges::replace(text, 'e', 'd');
      calls += fmt::format(
          "  print '(3es25.16e3)', viscontact_resistance({0}), viscontact_force({0}, {1}d0), &\n"
          "    viscontact_impulse({0})\n",
          text, kVelocity);
    }
    put_text(path("force.f90"), module);
    put_text(path("main.f90"),
             "program main\n  use viscontact_lubrication\n  use, intrinsic :: ieee_arithmetic\n"
             "  implicit none\n" +
                 calls + conditions + "end program\n");
    output_of({"gfortran", "-std=f2008", "-Wall", "-Wextra", "-pedantic", "-Werror", "-O2", "-J",
               folder_.path().string(), path("force.f90"), path("main.f90"), "-o",
               path("program")});
    return output_of({path("program")});
  }

  std::vector<double> gaps() const { return lubrication::spread_gaps(fit_.gap_interval); }
  std::vector<double> gaps_outside() const { return lubrication::spread_gaps(wide(fit_)); }

  lubrication::Fit fit_ = fit_of_all_terms();
  TemporaryFolder folder_;
};

TEST_F(Export, CHeaderCompilesWithoutAWarningAsCAndAsCxxAndHasTheValues) {
  for (const auto& compiler : {std::vector<std::string>{"gcc", "-std=c99", "-x", "c"},
                               std::vector<std::string>{"g++", "-std=c++11", "-x", "c++"}})
    expect_values(
        c_values(export_fit(fit_, "c-header"), gaps(),
                 "isnan(viscontact_resistance(9e-4)) && isnan(viscontact_impulse(2.1)) && "
                 "isnan(viscontact_force(-1, 1))",
                 compiler),
        fit_);
}

TEST_F(Export, FortranModuleCompilesWithoutAWarningAndHasTheValues) {
  expect_values(fortran_values(export_fit(fit_, "fortran"), gaps(),
                               "  if (.not. ieee_is_nan(viscontact_resistance(9d-4))) stop 1\n"
                               "  if (.not. ieee_is_nan(viscontact_impulse(2.1d0))) stop 1\n"),
                fit_);
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
                                        list_of(gaps()), kVelocity));
  expect_values(output_of({"python3", path("main.py")}), fit_);
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
                                        list_of(gaps_outside()), kVelocity));
  expect_values_outside(output_of({"/usr/bin/python3", path("main.py")}), fit_);
}

TEST_F(Export, OctaveFunctionsHaveTheValuesAndAreNanOutside) {
  expect_values(
      octave_values(export_fit(fit_, "matlab"), gaps(),
                    "assert(all(isnan(f.resistance([9e-4, 2.1; NaN, -1])(:))));\n"
                    "assert(size(f.impulse(gaps')), size(gaps'));\n"
                    "assert(f.resistance(f.smallest_gap) > f.resistance(f.largest_gap));"),
      fit_);
  expect_values_outside(octave_values(export_fit(fit_, "matlab", "", both_limits()), gaps_outside(),
                                      "assert(all(isnan(f.resistance([0, -1, NaN, Inf]))));"),
                        fit_);
}

TEST_F(Export, CHeaderHasTheLimitsOutsideTheInterval) {
  expect_values_outside(
      c_values(export_fit(fit_, "c-header", "", both_limits()), gaps_outside(),
               "isnan(viscontact_resistance(0)) && isnan(viscontact_impulse(HUGE_VAL)) && "
               "isnan(viscontact_force(-1, 1)) && isnan(viscontact_resistance(NAN))"),
      fit_);
}

TEST_F(Export, FortranModuleHasTheLimitsOutsideTheInterval) {
  expect_values_outside(
      fortran_values(export_fit(fit_, "fortran", "", both_limits()), gaps_outside(),
                     "  if (.not. ieee_is_nan(viscontact_resistance(0d0))) stop 1\n"),
      fit_);
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
  const auto all = lubrication::spread_gaps({1e-7, 3.9999}, 40);
  const auto expect = [&](const std::string& output) {
    expect_values(output, force, all, 1e-11);  // rounding of 1e-4, the distance to the lid
  };
  const auto at_lid = fmt::format("{:.17g}", lid);
  const auto code_in = [&](const char* target) {
    return export_fit(fit, target, "", both_limits());
  };
  expect(c_values(
      code_in("c-header"), all,
      "isinf(viscontact_resistance(" + at_lid + ")) && isnan(viscontact_resistance(4.1))"));
  expect(
      fortran_values(code_in("fortran"), all,
                     fmt::format("  if (ieee_is_finite(viscontact_resistance({0}d0))) stop 1\n"
                                 "  if (ieee_is_nan(viscontact_resistance({0}d0))) stop 1\n"
                                 "  if (.not. ieee_is_nan(viscontact_resistance(4.1d0))) stop 1\n",
                                 at_lid)));
  put_text(path("lubrication.py"), code_in("python"));
  put_text(path("main.py"), fmt::format(R"(
import lubrication, math
for gap in [{}]:
    print(repr(lubrication.resistance(gap)), repr(lubrication.force(gap, {})),
          repr(lubrication.impulse(gap)))
assert math.isinf(lubrication.resistance({}))
try:
    lubrication.resistance(4.1)
except ValueError:
    raise SystemExit(0)
raise SystemExit("no error")
)",
                                        list_of(all), kVelocity, at_lid));
  expect(output_of({"python3", path("main.py")}));
  expect(octave_values(code_in("matlab"), all,
                       "assert(isinf(f.resistance(" + at_lid + ")) && isnan(f.resistance(4.1)));"));
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
    expect(octave("f = viscontact_lubrication();\nprintf(\"%.17g %.17g\\n\", f.resistance(" + type +
                  "(1)), f.force(" + type + "(1), " + type + "(3)));\n"));
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
              Names("--below", "--above"));
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
