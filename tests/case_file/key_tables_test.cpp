// The tables of docs/case-file.md are those that the declarations of the keys make.
#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/common/made_tables.hpp"
#include "viscontact/case_file/case_file.hpp"
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

TEST(CaseFilePage, HasTheTablesThatTheDeclarationsMake) {
  std::vector<std::pair<std::string, std::string>> tables;
  for (const auto& table : all_tables()) tables.emplace_back(table.section, table.markdown());
  expect_made_tables("case-file.md", "keys", tables);
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
