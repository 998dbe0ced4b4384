// The units that a case says: their words, and words that are refused.
#include <gmock/gmock.h>

#include <string>

#include "tests/case_file/edited_case.hpp"
#include "viscontact/common/text/units.hpp"

namespace viscontact::case_file {
namespace {

const Units kSi = {"m", "s", "kg"};

TEST(UnitsOfACase, HaveTheWordsOfAQuantity) {
  EXPECT_EQ(kSi.unit_of(0, 1, 0), "m");
  EXPECT_EQ(kSi.unit_of(1, 1, -2), "N");
  EXPECT_EQ(kSi.unit_of(1, -1, -1), "Pa s");
  EXPECT_EQ(kSi.unit_of(1, 1, -1), "kg m/s");
  EXPECT_EQ((Units{"mm", "s", "kg"}.unit_of(1, 1, -2)), "kg mm/s²");
  EXPECT_EQ(kSi.unit_of(1, 2, -2), "N m");
  EXPECT_EQ(kSi.unit_of(0, 0, -1), "1/s");
  EXPECT_EQ(kSi.words(), "length m, time s, mass kg");
  EXPECT_EQ(Units{}.unit_of(1, 1, -2), "");
  EXPECT_EQ(Units{}.words(), "");
}

TEST(UnitsOfACase, ReplaceDimensions) {
  EXPECT_EQ(kSi.in_place_of_dimensions("M L<sup>-1</sup> T<sup>-2</sup>"),
            "kg m<sup>-1</sup> s<sup>-2</sup>");
  EXPECT_EQ(kSi.in_place_of_dimensions("1"), "1");
  EXPECT_EQ(kSi.in_place_of_dimensions(""), "");
  EXPECT_EQ(Units{}.in_place_of_dimensions("M L"), "M L");
}

TEST(UnitsOfACase, StandInBracketsInPlaceOfDimensions) {
  EXPECT_EQ(kSi.in_brackets(1, 2, -3), " [kg m²/s³]");
  EXPECT_EQ(Units::of_words(kSi.words()).words(), kSi.words());
  EXPECT_FALSE(Units::of_words("metres").are_said());
  EXPECT_EQ(Units{}.in_brackets(1, 2, -3), "");
  EXPECT_EQ(kSi.unit_or_dimension(1, 1, -2), "N");
  EXPECT_EQ(Units{}.unit_or_dimension(1, 1, -2), "mass × length/time²");
  EXPECT_EQ(kSi.in_brackets_of("<td>gap [L]</td><td>a [M/(L T)] b [M L<sup>2</sup>] [x] [1]</td>"),
            "<td>gap [m]</td><td>a [Pa s] b [kg m<sup>2</sup>] [x] [1]</td>");
  EXPECT_EQ(Units{}.in_brackets_of("gap [L]"), "gap [L]");
  EXPECT_EQ(kSi.in_brackets_of("open [L"), "open [L");
}

TEST(UnitsOfACase, AreReadAndChangeNothing) {
  const auto text = "units = { length = \"µm\", time = \"s\", mass = \"kg\" }\n" + lecture_text();
  const Case c = read_text(text), without = read_text(lecture_text());
  EXPECT_EQ(c.units.length, "µm");
  EXPECT_FALSE(without.units.are_said());
  EXPECT_EQ(c.motion->mass, without.motion->mass);
  EXPECT_EQ(c.radius, without.radius);
}

TEST(UnitsOfACase, AreWordsOfFewLetters) {
  const auto refused = [](const std::string& units, const std::string& path) {
    expect_refused({"units = " + units + "\n" + lecture_text(), 1}, path);
  };
  refused("{ length = \"\", time = \"s\", mass = \"kg\" }", "units.length");
  refused("{ length = \"m\", time = \"a second\", mass = \"kg\" }", "units.time");
  refused("{ length = \"m\", time = \"<b>\", mass = \"kg\" }", "units.time");
  refused("{ length = \"m\", time = \"s\" }", "units.mass");
  refused("{ length = \"m\", time = \"s\", mass = \"kg\", charge = \"C\" }", "units.charge");
}

}  // namespace
}  // namespace viscontact::case_file
