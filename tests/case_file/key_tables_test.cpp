// The tables of docs/case-file.md are those that the declarations of the keys make.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/particle_runs/case/particles_case.hpp"
#include "viscontact/rolling/case/rolling_case.hpp"
#include "viscontact/swimmer/case/swimmer_case.hpp"

namespace viscontact::case_file {
namespace {

std::vector<KeyTable> all_tables() {
  std::vector<KeyTable> all;
  for (const auto& tables : {tables_of_sphere_case(), particles::tables_of_particles_case(),
                             rolling::tables_of_rolling_case(), swimmer::tables_of_swimmer_case()})
    all.insert(all.end(), tables.begin(), tables.end());
  return all;
}

/// The page with these tables between their markers. A table without a marker is a failure.
std::string with_tables(std::string page, const std::vector<KeyTable>& tables) {
  const std::string end = "<!-- end of keys -->";
  for (const auto& table : tables) {
    const auto marker = "<!-- keys of " + table.section + ", made from the declarations -->\n";
    const auto begin = page.find(marker);
    const auto stop = page.find(end, begin);
    if (begin == std::string::npos || stop == std::string::npos) {
      ADD_FAILURE() << "docs/case-file.md has no place for a table between " << marker << end;
      continue;
    }
    const auto from = begin + marker.size();
    page.replace(from, stop - from, table.markdown());
  }
  return page;
}

TEST(CaseFilePage, HasTheTablesThatTheDeclarationsMake) {
  const auto page =
      read_file(std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "docs/case-file.md");
  const auto made = with_tables(page, all_tables());
  if (made == page) return;
  const auto file = std::filesystem::absolute("case-file.md");
  write_file(file, made);
  FAIL() << "docs/case-file.md is not up to date; copy " << file << " to its place";
}

TEST(CaseFilePage, HasNoTableOfKeysThatNothingDeclares) {
  const auto page =
      read_file(std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "docs/case-file.md");
  std::size_t markers = 0;
  for (auto at = page.find("<!-- keys of "); at != std::string::npos;
       at = page.find("<!-- keys of ", at + 1))
    ++markers;
  EXPECT_EQ(markers, all_tables().size());
}

struct Rod {
  double length = 0.5;
  int tries = 3;
};

void rod_keys(Keys& keys, Rod& rod) {
  keys.required("length", number(rod.length, kPositive), {.meaning = "of the rod", .example = "2"});
  keys.optional("tries", count(rod.tries, 1, 9), {"how [often](page.md)"});
  keys.require(false, "tries", "is never said where nothing is read");
}

TEST(KeyTables, SayOfEachKeyWhatItsDeclarationSays) {
  const auto table = describe_keys("[rod]", rod_keys);
  EXPECT_EQ(table.markdown(),
            "| key | value | default | meaning |\n"
            "| --- | --- | --- | --- |\n"
            "| `length` | > 0 | required | of the rod |\n"
            "| `tries` | whole number from 1 to 9 | 3 | how [often](page.md) |\n");
}

TEST(KeyTables, MakeACaseOfExamplesWithOptionalKeysCommentedOut) {
  const std::vector tables = {describe_keys("[rod]", rod_keys)};
  EXPECT_EQ(commented_case(tables),
            "\n[rod]\n# of the rod (> 0)\nlength = 2\n"
            "# how often (whole number from 1 to 9; default: 3)\n# tries = 3\n");
}

}  // namespace
}  // namespace viscontact::case_file
