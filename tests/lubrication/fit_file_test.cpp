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
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

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
  /// The message, behind the file's name, with which this text is refused.
  std::string of(const std::string& text) const {
    const auto path = folder_.file("fit.json", text);
    const auto message = bad_input([&] { read_fit(path); });
    EXPECT_THAT(message, StartsWith(path.string() + ":"));
    return message.substr(std::min(message.size(), path.string().size()));
  }

  /// The same for a good file in which `from` is replaced by `to`.
  std::string with(const std::string& from, const std::string& to) const {
    std::string text = write_fit(fitting::planted_fit({{"1/q", 56.5}, {"q", 0.25}}, 0.125, 2));
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from << " is not in " << text;
    return at == std::string::npos ? "" : of(text.replace(at, from.size(), to));
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
  EXPECT_EQ(of("[]"), ":1: the file is an array; it must be an object");
  EXPECT_EQ(of("\n3"), ":2: the file is 3; it must be an object");
}

TEST_F(Refusal, OfAFileCutAnywhere) {
  const std::string text = write_fit(complete_fit());
  for (std::size_t length = 0; length + 2 < text.size(); length += 7)  // all but its last brace
    EXPECT_THAT(of(text.substr(0, length)), IsAt("fit.json"));
}

TEST_F(Refusal, OfAnUnknownKeyNamesIt) {
  EXPECT_EQ(with("\"basis\"", "\"colour\": 1, \"basis\""), ":2: colour is not a key of this file");
  EXPECT_THAT(with("\"name\": \"q\"", "\"unit\": 1,\n \"name\": \"q\""),
              MatchesRegex(":[0-9]+: terms\\[1\\]\\.unit is not a key of this file"));
}

TEST_F(Refusal, OfAValueOutOfRangeNamesTheKey) {
  EXPECT_EQ(with("\"reference_velocity\": -1.0", "\"reference_velocity\": 0"),
            ":3: reference_velocity is 0; it must be different from 0");
  EXPECT_EQ(with("\"viscosity\": 3.0", "\"viscosity\": 0"), ":4: viscosity is 0; it must be > 0");
  EXPECT_EQ(with("\"radius\": 1.0", "\"radius\": -1"), ":5: radius is -1; it must be > 0");
  EXPECT_THAT(with("\"condition_number\": 1.0", "\"condition_number\": 0.5"),
              IsAt("fit.json:28", "condition_number"));
  EXPECT_THAT(with("0.125", "2"), IsAt("fit.json:6", "gap_interval"));
  EXPECT_THAT(with("0.125", "0"), AllOf(IsAt("fit.json:6", "gap_interval"), Names("2.0")));
  EXPECT_EQ(with("0.125", "0.125, 1"), ":6: gap_interval has 3 elements; it must be two numbers");
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
  const std::string size = ": covariance must be a matrix of 2 rows with 2 numbers each";
  fit.covariance = {{1, 2}, {3}};
  EXPECT_THAT(of(write_fit(fit)), HasSubstr(size));
  fit.covariance = {{1, 2}};
  EXPECT_THAT(of(write_fit(fit)), HasSubstr(size));
  fit.covariance = {{1, 2}, {3, 4}, {5, 6}};
  EXPECT_THAT(of(write_fit(fit)), HasSubstr(size));
}

TEST(FitFile, InPlaceOfWhichIsAFolderOrNothingIsNamed) {
  const TemporaryFolder folder;
  EXPECT_THAT(bad_input([&] { read_fit(folder.path()); }),
              StartsWith(folder.path().string() + ": cannot be read"));
  const auto missing = folder.path() / "none.json";
  EXPECT_THAT(bad_input([&] { read_fit(missing); }),
              StartsWith(missing.string() + ": cannot be read"));
}

}  // namespace
}  // namespace viscontact::lubrication
