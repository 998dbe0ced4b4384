#include "tests/docs/document.hpp"

#include <gtest/gtest.h>

namespace viscontact {
namespace {

TEST(DifferenceFrom, TakesNumbersWithinTheToleranceForEqual) {
  EXPECT_EQ(difference_from("q 1.00e-3 s\n", "q   1.01e-3 s\n", 0.02), "");
  EXPECT_NE(difference_from("q 1.00e-3 s\n", "q 1.03e-3 s\n", 0.02), "");
}

TEST(DifferenceFrom, SeesOtherWordsAndMissingOrFurtherLines) {
  EXPECT_NE(difference_from("a 1\n", "b 1\n", 0.02), "");
  EXPECT_NE(difference_from("a 1\nb 2\n", "a 1\n", 0.02), "");
  EXPECT_NE(difference_from("a 1\n", "a 1\nb 2\n", 0.02), "");
  EXPECT_NE(difference_from("a 1 2\n", "a 1\n", 0.02), "");
}

TEST(DifferenceFrom, TakesThreeDotsForAnyLines) {
  EXPECT_EQ(difference_from("...\nc 3\n...\n", "a 1\nb 2\nc 3\nd 4\n", 0.02), "");
  EXPECT_EQ(difference_from("...\na 1\n", "a 1\n", 0.02), "");
  EXPECT_NE(difference_from("...\nc 4\n", "a 1\nb 2\nc 3\n", 0.02), "");
  EXPECT_NE(difference_from("...\nb 2\n", "a 1\nb 2\nc 3\n", 0.02), "");
}

TEST(DifferenceFrom, TakesThreeDotsWithinALineForOneNumber) {
  EXPECT_EQ(difference_from("a 1 b ... c 3\n", "a 1 b 2.5e-7 c 3\n", 0.02), "");
  EXPECT_NE(difference_from("a 1 b ... c 3\n", "a 1 b 2 c 4\n", 0.02), "");
  EXPECT_NE(difference_from("a 1 b ... c 3\n", "a 1 b c 3\n", 0.02), "");
  EXPECT_NE(difference_from("a 1 b ... c 3\n", "a 1 b two c 3\n", 0.02), "");
}

}  // namespace
}  // namespace viscontact
