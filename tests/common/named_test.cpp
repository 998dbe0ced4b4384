#include "viscontact/common/named.hpp"

#include <gmock/gmock.h>

#include <array>
#include <span>
#include <utility>

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

// The row belongs to the table, so it would not exist any more after a call with a temporary array.
template <class Table>
concept CanBeSearched = requires(Table&& table) {
  find_named(std::forward<Table>(table), "one");
  require_named(std::forward<Table>(table), "one", "row");
};
static_assert(CanBeSearched<const std::array<Row, 2>&>);
static_assert(CanBeSearched<std::span<const Row>>);
static_assert(!CanBeSearched<std::array<Row, 2>>);

TEST(Named, AnUnknownNameIsNothingOrAnErrorThatListsTheNames) {
  EXPECT_EQ(find_named(kRows, "three"), nullptr);
  EXPECT_THAT(bad_input([] { (void)require_named(kRows, "three", "row"); }),
              Names("row", "three", "one", "two"));
}

}  // namespace
}  // namespace viscontact
