// docs/dependencies.md explains each package that scripts/setup installs, in the table of the
// program or of the tests.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "tests/docs/document.hpp"

namespace viscontact {
namespace {

const std::filesystem::path kSource = VISCONTACT_SOURCE_FOLDER;

/// The words between the quotation marks of `VARIABLE="..."` in scripts/setup.
std::vector<std::string> packages_of_setup(const std::string& variable) {
  std::ifstream file(kSource / "scripts/setup");
  const std::string script(std::istreambuf_iterator<char>(file), {});
  const std::string start = "\n" + variable + "=\"";
  const auto begin = script.find(start);
  if (begin == std::string::npos) return {};
  const auto first = begin + start.size();
  std::istringstream words(script.substr(first, script.find('"', first) - first));
  return {std::istream_iterator<std::string>(words), {}};
}

/// The names in backquotes in the first cells of the table under this heading.
std::vector<std::string> packages_of_page(const std::string& heading) {
  std::vector<std::string> packages;
  bool below_heading = false;
  for (const auto& line : prose_of(kSource / "docs/dependencies.md")) {
    if (line.starts_with("## ")) below_heading = line == "## " + heading;
    if (!below_heading || !line.starts_with("| `")) continue;
    std::istringstream cell(line.substr(2, line.find(" | ") - 2));
    std::string name;
    while (std::getline(cell, name, '`') && std::getline(cell, name, '`')) packages.push_back(name);
  }
  return packages;
}

TEST(Dependencies, OfTheProgramAreThoseThatThePageExplains) {
  const auto installed = packages_of_setup("packages");
  EXPECT_THAT(installed, ::testing::Contains("freefem++"));
  EXPECT_THAT(packages_of_page("The program"), ::testing::UnorderedElementsAreArray(installed));
}

TEST(Dependencies, OfTheTestsAreThoseThatThePageExplains) {
  const auto installed = packages_of_setup("test_packages");
  EXPECT_THAT(installed, ::testing::Contains("libgtest-dev"));
  EXPECT_THAT(packages_of_page("Tests, benchmarks and packaging"),
              ::testing::UnorderedElementsAreArray(installed));
}

}  // namespace
}  // namespace viscontact
