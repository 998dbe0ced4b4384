// The tables of columns in docs/file-formats.md are those that the declarations make.
#include <gtest/gtest.h>

#include "tests/common/made_tables.hpp"
#include "viscontact/particle_runs/io/contact_file.hpp"
#include "viscontact/particle_runs/io/particle_columns.hpp"
#include "viscontact/particle_runs/io/rheology_file.hpp"
#include "viscontact/particle_runs/io/step_columns.hpp"

namespace viscontact::particles {
namespace {

TEST(FileFormatsPage, HasTheColumnsThatTheDeclarationsMake) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto& tables : {std::vector{particle_column_table()}, contact_file_tables(),
                             step_column_tables(), link_column_tables(), rheology_column_tables()})
    for (const auto& table : tables) all.emplace_back(table.title, table.markdown);
  expect_made_tables("file-formats.md", "columns", all);
}

}  // namespace
}  // namespace viscontact::particles
