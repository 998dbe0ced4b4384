// CITATION.cff has the keys of its format (citation-file-format.github.io, version 1.2.0) that it
// needs, and names the version of the program.
#include <gmock/gmock.h>

#include <set>
#include <string>
#include <vector>

#include "tests/common/regular_expressions.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

using ::testing::IsSupersetOf;

const std::string kFolder = VISCONTACT_SOURCE_FOLDER;

/// What is written behind a key at the beginning of a line; nothing if the key does not occur once.
std::string value_of(const std::string& key, const std::string& text) {
  const auto values = matches_in("\n" + text, "\n" + key + ": ([^\n]+)", 1);
  return values.size() == 1 ? values.front() : "";
}

TEST(Citation, HasTheKeysOfAFileThatIsComplete) {
  const auto text = read_file(kFolder + "/CITATION.cff");
  EXPECT_THAT(matches_in("\n" + text, "\n([a-z-]+):", 1),
              IsSupersetOf({"cff-version", "message", "title", "type", "abstract", "keywords",
                            "version", "date-released", "license", "authors", "references"}));
  EXPECT_EQ(value_of("cff-version", text), "1.2.0");
  EXPECT_TRUE(has_match(value_of("date-released", text), "^[0-9]{4}-[0-9]{2}-[0-9]{2}$"));
  const auto version = matches_in(read_file(kFolder + "/CMakeLists.txt"),
                                  "project\\(viscontact VERSION ([0-9.]+)", 1);
  ASSERT_EQ(version.size(), 1U);
  EXPECT_EQ(value_of("version", text), version.front());
}

TEST(Citation, HasReferencesThatCanBeFound) {
  auto text = read_file(kFolder + "/CITATION.cff");
  text.erase(0, text.find("\nreferences:\n"));
  std::set<std::string> found;  // authors and years
  for (auto at = text.find("\n  - type: "); at != std::string::npos;) {
    const auto end = text.find("\n  - type: ", at + 1);
    const auto reference = text.substr(at, end == std::string::npos ? end : end - at);
    SCOPED_TRACE(reference);
    auto keys = matches_in(reference, "\n    ([a-z-]+):", 1);
    EXPECT_THAT(keys, IsSupersetOf({"title", "authors", "year", "notes"}));
    if (reference.starts_with("\n  - type: article")) {
      EXPECT_THAT(keys, IsSupersetOf({"journal", "volume", "start", "end", "doi"}));
    }
    const auto authors = matches_in(reference, "family-names: ([^\n]+)", 1);
    const auto years = matches_in(reference, "\n    year: ([0-9]{4})", 1);
    ASSERT_TRUE(!authors.empty() && years.size() == 1);
    found.insert(authors.front() + " " + years.front());
    at = end;
  }
  EXPECT_THAT(found, IsSupersetOf({"Lefebvre 2008", "Maury 2006", "Maury 2007", "Lefebvre 2009"}));
}

}  // namespace
}  // namespace viscontact
