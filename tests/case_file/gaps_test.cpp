// The gaps of a tabulation: a list, or a grid with logarithmic or linear spacing.
#include <gmock/gmock.h>

#include <string>

#include "tests/case_file/edited_case.hpp"

namespace viscontact::case_file {
namespace {

using ::testing::ElementsAre;

constexpr LectureKey kGaps = {"tabulation.gaps",
                              "{ from = 1e-3, to = 2.0, count = 40, spacing = \"log\" }"};

std::vector<double> gaps(const char* value) {
  return required_tabulation(read_text(with_value(kGaps, value).text)).gaps;
}

TEST(Gaps, AreAListAsItStands) {
  EXPECT_THAT(gaps("[0.5, 0.75, 1, 1.5]"), ElementsAre(0.5, 0.75, 1, 1.5));
}

TEST(Gaps, AreSorted) { EXPECT_THAT(gaps("[1, 0.25, 0.5]"), ElementsAre(0.25, 0.5, 1)); }

TEST(Gaps, MayBeOne) { EXPECT_THAT(gaps("[0.25]"), ElementsAre(0.25)); }

TEST(Gaps, AreEquallyFarApartWithLinearSpacing) {
  EXPECT_THAT(gaps("{ from = 0.5, to = 1.5, count = 5, spacing = \"linear\" }"),
              ElementsAre(0.5, 0.75, 1, 1.25, 1.5));
}

TEST(Gaps, GrowByTheSameFactorWithLogarithmicSpacing) {
  const auto values = gaps("{ from = 0.125, to = 2, count = 5, spacing = \"log\" }");
  ASSERT_EQ(values.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_DOUBLE_EQ(values[i], 0.125 * static_cast<double>(1 << i));
}

TEST(Gaps, BeginAndEndExactlyWhereTheyShould) {
  for (const auto* spacing : {"log", "linear"}) {
    const auto values =
        gaps(("{ from = 0.0013, to = 1.7, count = 2, spacing = \"" + std::string(spacing) + "\" }")
                 .c_str());
    EXPECT_THAT(values, ElementsAre(0.0013, 1.7)) << spacing;
  }
}

TEST(Gaps, AreRefusedInAListThatIsNoListOfDifferentPositiveNumbers) {
  for (const auto* value : {"[]", "[0.5, 0]", "[-0.5]", "[0.5, nan]", "[inf]", "[0.5, \"1\"]",
                            "[0.5, 0.25, 0.5]", "[[0.5]]"}) {
    SCOPED_TRACE(value);
    expect_refused(with_value(kGaps, value), kGaps.path, "");
  }
}

TEST(Gaps, MustLeaveTheSphereRoomInTheContainer) {
  // 78 and a diameter of 2 fill the 80 of the container, which stands two lines further down.
  auto edited = with_value({"tabulation.gaps.to", "2.0"}, "78.0");
  edited.line += 2;
  expect_refused(edited, "tabulation.container.height");
}

}  // namespace
}  // namespace viscontact::case_file
