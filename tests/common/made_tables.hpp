// Tables of pages of documentation that declarations make.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/common/files/file.hpp"

namespace viscontact {

/// The number of places in which `text` has `part`.
inline std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// Fails the test if docs/`name` does not have each of the tables, which are pairs of a title and a
/// text, between the lines "<!-- `what` of TITLE, made from the declarations -->" and "<!-- end of
/// `what` -->", or has other such tables. Then the failure names a file with the right page.
inline void expect_made_tables(const std::string& name, const std::string& what,
                               const std::vector<std::pair<std::string, std::string>>& tables) {
  const auto page = read_file(std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "docs" / name);
  auto made = page;
  const std::string end = "<!-- end of " + what + " -->";
  for (const auto& [title, text] : tables) {
    const auto marker = "<!-- " + what + " of " + title + ", made from the declarations -->\n";
    const auto begin = made.find(marker), stop = made.find(end, begin);
    if (begin == std::string::npos || stop == std::string::npos) {
      ADD_FAILURE() << "docs/" << name << " has no place for a table between " << marker << end;
      continue;
    }
    const auto from = begin + marker.size();
    made.replace(from, stop - from, text);
  }
  EXPECT_EQ(count_of(page, "<!-- " + what + " of "), tables.size());
  if (made == page) return;
  const auto file = std::filesystem::absolute(name);
  write_file(file, made);
  FAIL() << "docs/" << name << " is not up to date; copy " << file << " to its place";
}

}  // namespace viscontact
