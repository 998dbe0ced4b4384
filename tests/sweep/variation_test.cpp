// What a sweep varies: its ranges, the points of grid and random samples, and the case with the
// numbers of a point.
#include "viscontact/sweep/variation.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "tests/common/failure.hpp"

namespace viscontact::sweep {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Pair;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

std::vector<double> values_of(const Variation& variation) {
  std::vector<double> values;
  for (std::uint64_t i = 0; i < variation.count; ++i) values.push_back(variation.value(i));
  return values;
}

std::vector<double> values_of(const std::string& text) { return values_of(parse_variation(text)); }

TEST(Variation, ListHasItsValuesInTheirOrder) {
  const auto variation = parse_variation("fluid.viscosity=3,-1e-3,0,3");
  EXPECT_EQ(variation.key, "fluid.viscosity");
  EXPECT_EQ(variation.count, 4U);
  EXPECT_THAT(values_of(variation), ElementsAre(3, -1e-3, 0, 3));
  EXPECT_THAT(values_of("a=7"), ElementsAre(7));
}

TEST(Variation, RangeIsEquallySpaced) {
  // Round-off of the ends where they cancel.
  const auto near = [](double value) { return ::testing::DoubleNear(value, 2 * kEpsilon); };
  EXPECT_THAT(values_of("a=-1:2:4"), ElementsAre(-1, near(0), near(1), 2));
  EXPECT_THAT(values_of("a=2:-1:4"), ElementsAre(2, near(1), near(0), -1));
  EXPECT_THAT(values_of("a=0:8:5"), ElementsAre(0, 2, 4, 6, 8));
}

TEST(Variation, LogarithmicRangeIsAGeometricProgression) {
  for (const std::string text : {"a=0.006:1:log:25", "a=1e3:1e-3:log:33", "a=-0.3:-30:log:7"}) {
    const auto variation = parse_variation(text);
    const auto values = values_of(variation);
    const double decades = std::log(variation.last / variation.first);
    const double ratio = std::exp(decades / static_cast<double>(values.size() - 1));
    for (std::size_t i = 1; i < values.size(); ++i)
      // The power's exponent carries a round-off that the logarithm of the range multiplies.
      EXPECT_NEAR(values[i] / values[i - 1] / ratio, 1, 4 * kEpsilon * (1 + std::abs(decades)))
          << text;
  }
}

TEST(Variation, EndsAreExact) {
  // 0.1 (0.7/0.1), 0.006 (1/0.006) and 0.1 + 6 (0.6/6) are an ulp or so beside.
  for (const std::string spacing : {":log:", ":"})
    for (const auto& [first, last] : {std::pair("0.1", "0.7"), std::pair("0.006", "1"),
                                      std::pair("1e-3", "0.3"), std::pair("-7e5", "-3e-9")})
      for (const std::string count : {"2", "3", "49", "1000000000"}) {
        const auto variation =
            parse_variation("a=" + std::string(first) + ":" + last + spacing + count);
        EXPECT_EQ(variation.value(0), std::stod(first));
        EXPECT_EQ(variation.value(variation.count - 1), std::stod(last));
      }
}

TEST(Variation, RangeOfOneIsItsBeginning) {
  EXPECT_THAT(values_of("a=2:5:1"), ElementsAre(2));
  EXPECT_THAT(values_of("a=2:5:log:1"), ElementsAre(2));
}

TEST(Variation, LogarithmicRangeMaySpanAllDoubles) {
  // Neither the product nor the quotient of the ends is a double that is finite and not 0.
  const auto small = values_of("a=1e-200:1e-150:log:3");
  ASSERT_EQ(small.size(), 3U);
  EXPECT_NEAR(small[1] / 1e-175, 1, 1e-12);  // an exponent's round-off times ln of the range, 115
  const auto wide = values_of("a=1e-300:1e300:log:3");
  ASSERT_EQ(wide.size(), 3U);
  EXPECT_NEAR(wide[1], 1, 1e-12);  // the same, 1382
}

TEST(Variation, MassIsFoundUnderItsOtherName) {}

TEST(Variation, OtherTextsAreRefusedWithWhatIsWrongAndWhatIsAllowed) {
  struct Refusal {
    const char* text;
    const char* named;
  };
  for (const auto& [text, named] : std::initializer_list<Refusal>{{"", "KEY="},
                                                                  {"fluid.viscosity", "KEY="},
                                                                  {"=1,2", "KEY="},
                                                                  {"a=", "''"},
                                                                  {"a=1,", "''"},
                                                                  {"a=1,,2", "''"},
                                                                  {"a=one", "'one'"},
                                                                  {"a=1,nan", "'nan'"},
                                                                  {"a=inf:1:3", "'inf'"},
                                                                  {"a=1:1e400:3", "'1e400'"},
                                                                  {"a=1:2x:3", "'2x'"},
                                                                  {"a=1:2", "range"},
                                                                  {"a=1:2:lin:3", "range"},
                                                                  {"a=1:2:Log:3", "range"},
                                                                  {"a=1:2:log:3:4", "range"},
                                                                  {"a=1:2:log", "'log'"},
                                                                  {"a=1:2:", "''"},
                                                                  {"a=1:2:0", "COUNT"},
                                                                  {"a=1:2:-3", "COUNT"},
                                                                  {"a=1:2:2.5", "COUNT"},
                                                                  {"a=1:2:1e10", "COUNT"},
                                                                  {"a=1:2:log:0", "COUNT"},
                                                                  {"a=0:2:log:3", "0"},
                                                                  {"a=2:0:log:3", "0"},
                                                                  {"a=-1:1:log:3", "0"}}) {
    EXPECT_THAT(bad_input([&] { parse_variation(text); }),
                Names(std::string(text) + ":", named, "KEY=FROM:TO:log:COUNT"))
        << text;
  }
}

TEST(Grid, LastVariationIsTheFastest) {
  const std::vector<Variation> variations = {parse_variation("a=1,2"), parse_variation("b=0:1:3"),
                                             parse_variation("c=5")};
  ASSERT_EQ(grid_size(variations), 6U);
  std::uint64_t index = 0;
  for (const double a : {1.0, 2.0})
    for (const double b : {0.0, 0.5, 1.0})
      EXPECT_THAT(grid_point(variations, index++),
                  ElementsAre(Pair("a", a), Pair("b", b), Pair("c", 5)));
}

TEST(Grid, SizeIsLimited) {
  const auto million = parse_variation("a=0:1:1000000");
  EXPECT_EQ(grid_size({million, million}), 1'000'000'000'000U);
  // 1e27 is no 64-bit number.
  const auto billion = parse_variation("a=0:1:1e9");
  EXPECT_THAT(failure(ErrorKind::kWrongUsage,
                      [&] {
                        (void)grid_size({billion, billion, billion});
                      }),
              AllOf(Names("1e+27"), Names("1e+12")));
  const std::vector<Variation> beyond = {million, million, parse_variation("b=1,2")};
  EXPECT_THAT(failure(ErrorKind::kWrongUsage, [&] { (void)grid_size(beyond); }), Names("2e+12"));
}

class RandomPoints : public ::testing::Test {
 protected:
  static constexpr std::uint64_t kSamples = 20'000;
  static constexpr double kSigmas = 5;  // once in 2e6 for other seeds than these

  double number(std::uint64_t index, std::uint64_t seed, std::size_t i) const {
    return random_point(variations_, index, seed).at(i).second;
  }

  std::vector<Variation> variations_ = {parse_variation("a=1e-3:1e3:log:2"),
                                        parse_variation("b=-1:3:2"), parse_variation("c=1,2,4")};
};

TEST_F(RandomPoints, AreTheSameForASeedAndOthersForAnother) {
  std::set<double> seen;
  for (std::uint64_t index = 0; index < 100; ++index)
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      EXPECT_EQ(random_point(variations_, index, seed), random_point(variations_, index, seed));
      seen.insert(number(index, seed, 0));
    }
  EXPECT_EQ(seen.size(), 10'000U);
}

TEST_F(RandomPoints, HaveTheKeysInTheirOrder) {
  const auto point = random_point(variations_, 3, 1);
  ASSERT_EQ(point.size(), 3U);
  EXPECT_EQ(point[0].first, "a");
  EXPECT_EQ(point[1].first, "b");
  EXPECT_EQ(point[2].first, "c");
}

TEST_F(RandomPoints, FillTheirRangesEvenlyByTheirSpacing) {
  constexpr int kBins = 10;
  std::array<std::array<int, kBins>, 2> bins{};
  std::array<int, 3> listed{};
  for (std::uint64_t index = 0; index < kSamples; ++index) {
    const double a = number(index, 1, 0), b = number(index, 1, 1), c = number(index, 1, 2);
    ASSERT_TRUE(a >= 1e-3 && a <= 1e3) << a;
    ASSERT_TRUE(b >= -1 && b <= 3) << b;
    const auto bin = [](double share) {
      return std::min<std::size_t>(static_cast<std::size_t>(share * kBins), kBins - 1);
    };
    ++bins[0].at(bin(std::log(a / 1e-3) / std::log(1e6)));
    ++bins[1].at(bin((b + 1) / 4));
    ASSERT_TRUE(c == 1 || c == 2 || c == 4) << c;
    ++listed.at(c == 1 ? 0 : c == 2 ? 1 : 2);
  }
  const auto expect_share = [](int count, double share) {
    const double n = kSamples;
    EXPECT_NEAR(count, n * share, kSigmas * std::sqrt(n * share * (1 - share)));
  };
  for (const auto& of_key : bins)
    for (const int count : of_key) expect_share(count, 1.0 / kBins);
  for (const int count : listed) expect_share(count, 1.0 / 3);
}

TEST_F(RandomPoints, OfKeysSeedsAndNeighboursHaveNothingToDoWithEachOther) {
  const auto share = [&](std::uint64_t index, std::uint64_t seed, std::size_t i) {
    const double value = number(index, seed, i);
    return i == 0 ? std::log(value / 1e-3) / std::log(1e6) : (value + 1) / 4;
  };
  std::array<double, 3> correlations{};
  for (std::uint64_t index = 0; index < kSamples; ++index) {
    const double here = share(index, 1, 0) - 0.5;
    correlations[0] += here * (share(index, 1, 1) - 0.5);
    correlations[1] += here * (share(index, 2, 0) - 0.5);
    correlations[2] += here * (share(index + 1, 1, 0) - 0.5);
  }
  for (const double sum : correlations)
    // Variance 1/12 of each factor.
    EXPECT_NEAR(12 * sum / kSamples, 0, kSigmas / std::sqrt(kSamples));
}

}  // namespace
}  // namespace viscontact::sweep
