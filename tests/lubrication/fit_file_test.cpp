#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <random>
#include <string>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/fitting/samples.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"

namespace viscontact::lubrication {
namespace {

using ::testing::AllOf;

Fit complete_fit() {
  Fit fit =
      fitting::fit_force_table(fitting::exact_drag_table(fitting::fifty_gaps(), {-1.0 / 3}, 3, 1),
                               "lecture", Weights::kAbsolute);
  fit.table_sha256 = sha256("table");
  fit.versions = {{"Ceres", "2.1.0"}, {"a \"quoted\" name", "\xC3\xA9"}};
  return fit;
}

void expect_equal(const Fit& read, const Fit& written) {
  EXPECT_EQ(read.basis, written.basis);
  EXPECT_EQ(read.reference_velocity, written.reference_velocity);
  EXPECT_EQ(read.viscosity, written.viscosity);
  EXPECT_EQ(read.radius, written.radius);
  EXPECT_EQ(read.gap_interval, written.gap_interval);
  EXPECT_EQ(read.weights, written.weights);
  ASSERT_EQ(read.terms.size(), written.terms.size());
  for (std::size_t i = 0; i < read.terms.size(); ++i) {
    EXPECT_EQ(read.terms[i].name, written.terms[i].name);
    EXPECT_EQ(read.terms[i].coefficient, written.terms[i].coefficient);
    EXPECT_EQ(read.terms[i].standard_error, written.terms[i].standard_error);
  }
  EXPECT_EQ(read.largest_relative_residual, written.largest_relative_residual);
  EXPECT_EQ(read.rms_relative_residual, written.rms_relative_residual);
  EXPECT_EQ(read.condition_number, written.condition_number);
  EXPECT_EQ(read.covariance, written.covariance);
  EXPECT_EQ(read.table_sha256, written.table_sha256);
  EXPECT_EQ(read.versions, written.versions);
}

TEST(FitFile, RoundTripsToTheBit) {
  const TemporaryFolder folder;
  const auto fit = complete_fit();
  const auto path = folder.file("fit.json", write_fit(fit));
  expect_equal(read_fit(path), fit);
  EXPECT_EQ(write_fit(read_fit(path)), read_file(path));
}

TEST(FitFile, RoundTripsCoefficientsOfEveryMagnitude) {
  const TemporaryFolder folder;
  std::mt19937_64 random(7);
  Fit fit = complete_fit();
  for (int trial = 0; trial < 200; ++trial) {
    for (auto& term : fit.terms) {
      do term.coefficient = std::bit_cast<double>(random());
      while (!std::isfinite(term.coefficient));
    }
    expect_equal(read_fit(folder.file("fit.json", write_fit(fit))), fit);
  }
}

TEST(FitFile, ThatIsShippedIsReadAndUsable) {
  const auto fits = std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "data" / "fits";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(fits)) {
    if (entry.path().extension() != ".json") continue;
    SCOPED_TRACE(entry.path().filename().string());
    ++count;
    const Fit fit = read_fit(entry.path());
    const LubricationForce force(fit);
    const double middle = std::sqrt(fit.gap_interval[0]) * std::sqrt(fit.gap_interval[1]);
    for (const double gap : {fit.gap_interval[0], middle, fit.gap_interval[1]}) {
      EXPECT_GT(force.resistance(gap), 0) << "at gap " << gap;
      // Gamma and its inverse are logarithms at worst: |ln q| roundings of each.
      EXPECT_NEAR(force.gap_of_impulse(force.impulse(gap)) / gap, 1,
                  1e-15 * (10 + 10 * std::abs(std::log(gap))));
    }
  }
  EXPECT_GE(count, 1);
}

class Refusal : public ::testing::Test {
 protected:
  /// The Error with which this text is refused.
  Error of(const std::string& text) const {
    const auto path = folder_.file("fit.json", text);
    return bad_input([&] { read_fit(path); });
  }

  /// The same for a good file in which `from` is replaced by `to`.
  Error with(const std::string& from, const std::string& to) const {
    std::string text = write_fit(fitting::planted_fit({{"1/q", 56.5}, {"q", 0.25}}, 0.125, 2));
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from << " is not in " << text;
    return of(at == std::string::npos ? "" : text.replace(at, from.size(), to));
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Refusal, OfWhatIsNoJsonNamesTheLine) {
  EXPECT_THAT(of(""), IsAt("fit.json:1"));
  EXPECT_THAT(of("{\n  \"basis\": \"x\",\n  oops\n}\n"), IsAt("fit.json:3"));
  EXPECT_THAT(of("gap,force\n1,2\n"), IsAt("fit.json:1"));
  EXPECT_THAT(with("\"viscosity\": 3.0", "\"viscosity\": NaN"), IsAt("fit.json"));
}

TEST_F(Refusal, OfAnotherJsonSaysWhatItMustBe) {
  EXPECT_THAT(of("[]"), IsAt("fit.json:1"));
  EXPECT_THAT(of("\n3"), IsAt("fit.json:2"));
}

TEST_F(Refusal, OfAFileCutAnywhere) {
  const std::string text = write_fit(complete_fit());
  for (std::size_t length = 0; length + 2 < text.size(); length += 7)  // all but its last brace
    EXPECT_THAT(of(text.substr(0, length)), IsAt("fit.json"));
}

TEST_F(Refusal, OfAnUnknownKeyNamesIt) {
  EXPECT_THAT(with("\"basis\"", "\"colour\": 1, \"basis\""), IsAt("fit.json:2", "colour"));
  EXPECT_THAT(with("\"name\": \"q\"", "\"unit\": 1,\n \"name\": \"q\""),
              IsAt("fit.json", "terms[1].unit"));
}

TEST_F(Refusal, OfAValueOutOfRangeNamesTheKey) {
  EXPECT_THAT(with("\"reference_velocity\": -1.0", "\"reference_velocity\": 0"),
              IsAt("fit.json:3", "reference_velocity"));
  EXPECT_THAT(with("\"viscosity\": 3.0", "\"viscosity\": 0"), IsAt("fit.json:4", "viscosity"));
  EXPECT_THAT(with("\"radius\": 1.0", "\"radius\": -1"), IsAt("fit.json:5", "radius"));
  EXPECT_THAT(with("\"condition_number\": 1.0", "\"condition_number\": 0.5"),
              IsAt("fit.json:28", "condition_number"));
  EXPECT_THAT(with("0.125", "2"), IsAt("fit.json:6", "gap_interval"));
  EXPECT_THAT(with("0.125", "0"), AllOf(IsAt("fit.json:6", "gap_interval"), Names("2.0")));
  EXPECT_THAT(with("0.125", "0.125, 1"), IsAt("fit.json:6", "gap_interval"));
  EXPECT_THAT(with("\"weights\": \"relative\"", "\"weights\": \"cubic\""),
              IsAt("fit.json:10", "weights"));
}

TEST_F(Refusal, OfANumberThatNoDoubleHolds) {
  EXPECT_THAT(with("\"viscosity\": 3.0", "\"viscosity\": 1e400"), IsAt("fit.json:4"));
}

TEST_F(Refusal, OfATermNamesItsPlace) {
  EXPECT_THAT(with("\"name\": \"q\"", "\"name\": \"q^9\""), IsAt("fit.json:20", "terms[1].name"));
  EXPECT_THAT(with("\"name\": \"q\"", "\"name\": \"1/q\""), IsAt("fit.json:20", "terms[1].name"));
  EXPECT_THAT(with("\"coefficient\": 0.25", "\"coefficient\": \"0.25\""),
              IsAt("fit.json:21", "terms[1].coefficient"));
}

TEST_F(Refusal, OfACovarianceOfAnotherSize) {
  Fit fit = fitting::planted_fit({{"1/q", 56.5}, {"q", 0.25}}, 0.125, 2);
  fit.covariance = {{1, 2}, {3}};
  EXPECT_THAT(of(write_fit(fit)), IsAt("fit.json", "covariance"));
  fit.covariance = {{1, 2}};
  EXPECT_THAT(of(write_fit(fit)), IsAt("fit.json", "covariance"));
  fit.covariance = {{1, 2}, {3, 4}, {5, 6}};
  EXPECT_THAT(of(write_fit(fit)), IsAt("fit.json", "covariance"));
}

TEST(FitFile, InPlaceOfWhichIsAFolderOrNothingIsNamed) {
  const TemporaryFolder folder;
  EXPECT_THAT(bad_input([&] { read_fit(folder.path()); }), IsAt(folder.path().string()));
  const auto missing = folder.path() / "none.json";
  EXPECT_THAT(bad_input([&] { read_fit(missing); }), IsAt(missing.string()));
}

}  // namespace
}  // namespace viscontact::lubrication
