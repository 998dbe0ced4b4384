#include "viscontact/common/named.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "tests/common/failure.hpp"

namespace viscontact {
namespace {

struct Row {
  std::string_view name;
  int value;
};

constexpr std::array kRows = {Row{"one", 1}, Row{"two", 2}};

TEST(Named, RowsAreFoundByTheirName) {
  ASSERT_NE(find_named(kRows, "two"), nullptr);
  EXPECT_EQ(find_named(kRows, "two")->value, 2);
  EXPECT_EQ(require_named(kRows, "one", "row").value, 1);
}

TEST(Named, AnUnknownNameIsNothingOrAnErrorThatListsTheNames) {
  EXPECT_EQ(find_named(kRows, "three"), nullptr);
  EXPECT_EQ(bad_input([] { (void)require_named(kRows, "three", "row"); }),
            "no row is named 'three'; there are: one, two");
}

}  // namespace
}  // namespace viscontact
