#include "viscontact/common/text/number.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace viscontact {
namespace {

/// That format and parse give `value` back with all its bits (so -0 stays -0).
void expect_round_trip(double value) {
  const std::string text = format_number(value);
  const auto back = parse_number(text);
  ASSERT_TRUE(back.has_value()) << text;
  ASSERT_EQ(std::bit_cast<std::uint64_t>(*back), std::bit_cast<std::uint64_t>(value)) << text;
}

TEST(Number, RandomDoublesOfEveryMagnitudeRoundTripToTheBit) {
  std::mt19937_64 random(20080122);
  for (int i = 0; i < 200'000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    ASSERT_NO_FATAL_FAILURE(expect_round_trip(value));
  }
}

TEST(Number, SubnormalsRoundTripToTheBit) {
  std::mt19937_64 random(2007);
  constexpr std::uint64_t kFraction =
      (std::uint64_t{1} << 52) - 1;  // exponent bits zero: subnormal
  for (int i = 0; i < 50'000; ++i)
    ASSERT_NO_FATAL_FAILURE(expect_round_trip(std::bit_cast<double>(random() & kFraction)));
}

TEST(Number, ExtremesRoundTripToTheBit) {
  using Limits = std::numeric_limits<double>;
  for (const double value :
       {0.0, 1.0, 0.1, std::numbers::pi, Limits::min(), Limits::max(), Limits::denorm_min(),
        Limits::epsilon(), std::nextafter(Limits::min(), 0.0), 9007199254740993.0, 1e22, 1e23})
    for (const double sign : {1.0, -1.0}) expect_round_trip(sign * value);
}

TEST(Number, IsWrittenInItsShortestForm) {
  EXPECT_EQ(format_number(0.1), "0.1");
  EXPECT_EQ(format_number(-200), "-200");
  EXPECT_EQ(format_number(1e-3), "0.001");
  EXPECT_EQ(format_number(1e300), "1e+300");
  EXPECT_EQ(format_number(5e-324), "5e-324");
  EXPECT_EQ(format_number(1.0 / 3), "0.3333333333333333");
}

TEST(Number, ReadsAsTheNearestDouble) {
  const std::vector<std::pair<std::string, double>> accepted = {
      {"1", 1.0},           {"+1.5", 1.5},
      {"-1.5E-3", -1.5e-3}, {" \t2.5\t ", 2.5},
      {".5", 0.5},          {"5.", 5.0},
      {"0e400", 0.0},       {"0.1000000000000000055511151231257827", 0.1}};
  for (const auto& [text, value] : accepted)
    EXPECT_EQ(parse_number(text), std::optional(value)) << "'" << text << "'";
}

TEST(Number, RefusesWhatIsNoneThatADoubleCanHold) {
  for (const std::string text :
       {"",       " ",      "nan",     "NaN",  "-nan", "nan(1)", "inf", "-inf", "infinity", "1e400",
        "-1e400", "1e-400", "-1e-400", "1.5x", "x1.5", "1.5 2",  "1,5", "0x10", "1e",       "1e+",
        "--1",    "-+1",    "++1",     "+-1",  "+",    "-",      ".",   "+ 1",  "1\n",      "one"})
    EXPECT_EQ(parse_number(text), std::nullopt) << "'" << text << "'";
}

}  // namespace
}  // namespace viscontact
