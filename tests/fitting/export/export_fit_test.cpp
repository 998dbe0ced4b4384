// Exported code, compiled and run, against the fitted force.
#include "viscontact/fitting/export/export_fit.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/lubrication/spread_gaps.hpp"

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

class Export : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  /// The gaps as a list in the language's source.
  static std::string gap_list(const lubrication::Fit& fit, const std::string& suffix = "") {
    std::string list;
    for (const double gap : lubrication::spread_gaps(fit.gap_interval)) {
      std::string text = fmt::format("{:.17e}", gap);
      if (!suffix.empty()) std::ranges::replace(text, 'e', suffix[0]);
      list += (list.empty() ? "" : ", ") + text;
    }
    return list;
  }

  static std::string output_of(const std::vector<std::string>& command) {
    const auto result = run_process(command);
    EXPECT_EQ(result.exit_status, 0) << result.output;
    return result.output;
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
                                       gap_list(fit_), kVelocity));
  for (const auto& compiler : {std::vector<std::string>{"gcc", "-std=c99", "-x", "c"},
                               std::vector<std::string>{"g++", "-std=c++11", "-x", "c++"}}) {
    auto command = compiler;
    command.insert(command.end(), {"-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O2",
                                   path("main.c"), "-o", path("program"), "-lm"});
    output_of(command);
    expect_values(values_of(output_of({path("program")})), fit_);
  }
}

TEST_F(Export, FortranModuleCompilesWithoutAWarningAndHasTheValues) {
  put_text(path("force.f90"), export_fit(fit_, "fortran"));
  std::string calls;
  for (const double gap : lubrication::spread_gaps(fit_.gap_interval)) {
    std::string text = fmt::format("{:.17e}", gap);
    std::ranges::replace(text, 'e', 'd');
    calls += fmt::format(
        "  print '(3es25.16e3)', viscontact_resistance({0}), viscontact_force({0}, {1}d0), &\n"
        "    viscontact_impulse({0})\n",
        text, kVelocity);
  }
  put_text(path("main.f90"),
           "program main\n  use viscontact_lubrication\n  use, intrinsic :: ieee_arithmetic\n"
           "  implicit none\n" +
               calls +
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
                                        gap_list(fit_), kVelocity));
  expect_values(values_of(output_of({"python3", path("main.py")})), fit_);
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
  EXPECT_THAT(bad_input([&] { export_fit(fit_, "cobol"); }),
              HasSubstr("c-header, fortran, python, json, csv"));
}

TEST_F(Export, OfADragThatIsNotPositiveIsRefused) {
  EXPECT_THAT(bad_input([] {
                export_fit(planted_fit({{"1/q", 1}, {"1", -10}}, 1e-3, 1), "csv");
              }),
              HasSubstr("positive"));
}

}  // namespace
}  // namespace viscontact::fitting
