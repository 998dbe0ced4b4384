// Rows by name in tables, such as those of geometries, bases, terms and models.
#pragma once

#include <algorithm>
#include <ranges>
#include <string>
#include <string_view>

#include "viscontact/common/error.hpp"

namespace viscontact {

// Each row has a member `name`. find_named() and require_named() return a row of the table itself.
// Therefore their argument is a table that outlives the call, or a view of such a table
// (std::span); a call with a temporary container does not compile.

/// The names in the order of the table.
template <class Table>
std::string names_of(const Table& table, const char* separator = ", ") {
  std::string names;
  for (const auto& row : table) names += (names.empty() ? "" : separator) + std::string(row.name);
  return names;
}

/// The first row with this name, in which upper and lower case differ; nullptr if there is none.
template <std::ranges::borrowed_range Table>
auto find_named(Table&& table, std::string_view name) -> decltype(&*table.begin()) {
  const auto found = std::ranges::find_if(table, [&](const auto& row) { return row.name == name; });
  return found == table.end() ? nullptr : &*found;
}

/// The first row with this name. Throws Error(kBadInput), which lists all names, if there is none;
/// `kind` is the word for a row in the message, such as "model".
template <std::ranges::borrowed_range Table>
const auto& require_named(Table&& table, std::string_view name, std::string_view kind) {
  if (const auto* row = find_named(table, name)) return *row;
  throw Error(ErrorKind::kBadInput, "no " + std::string(kind) + " is named '" + std::string(name) +
                                        "'; there are: " + names_of(table));
}

}  // namespace viscontact
