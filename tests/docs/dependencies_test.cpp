// docs/dependencies.md says what each package is for that scripts/setup installs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "tests/docs/document.hpp"

namespace viscontact {
namespace {

const std::filesystem::path kSource = VISCONTACT_SOURCE_FOLDER;

/// The words between the quotation marks of `packages="..."` in scripts/setup.
std::vector<std::string> packages_of_setup() {
  std::ifstream file(kSource / "scripts/setup");
  const std::string script(std::istreambuf_iterator<char>(file), {});
  const std::string start = "\npackages=\"";
  const auto begin = script.find(start);
  if (begin == std::string::npos) return {};
  const auto first = begin + start.size();
  std::istringstream words(script.substr(first, script.find('"', first) - first));
  return {std::istream_iterator<std::string>(words), {}};
}

/// The names in backquotes in the first cells of the table's rows.
std::set<std::string> packages_of_page() {
  std::set<std::string> packages;
  for (const auto& line : prose_of(kSource / "docs/dependencies.md")) {
    if (!line.starts_with("| `")) continue;
    std::istringstream cell(line.substr(2, line.find(" | ") - 2));
    std::string name;
    while (std::getline(cell, name, '`') && std::getline(cell, name, '`')) packages.insert(name);
  }
  return packages;
}

TEST(Dependencies, OfSetupAreAllExplained) {
  const auto installed = packages_of_setup();
  const auto explained = packages_of_page();
  EXPECT_THAT(installed, ::testing::Contains("freefem++"));
  for (const auto& package : installed)
    EXPECT_THAT(explained, ::testing::Contains(package)) << "no row of docs/dependencies.md";
}

}  // namespace
}  // namespace viscontact
