// Every link of a page leads somewhere: to a file of this tree, and to a heading where it names
// one.
#include <gmock/gmock.h>

#include <cctype>
#include <set>

#include "tests/common/regular_expressions.hpp"
#include "tests/docs/document.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = VISCONTACT_SOURCE_FOLDER;

/// Every page of this tree, without what builds and runs leave there.
std::vector<fs::path> all_pages() {
  std::vector<fs::path> pages;
  for (auto entry = fs::recursive_directory_iterator(kSource);
       entry != fs::recursive_directory_iterator(); ++entry) {
    const auto name = entry->path().filename();
    if (entry.depth() == 0 && (name == "build" || name == "out" || name == ".git"))
      entry.disable_recursion_pending();
    else if (entry->path().extension() == ".md")
      pages.push_back(entry->path());
  }
  return pages;
}

/// The name by which a link finds a heading, as GitHub makes it.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ')
      anchor += '-';
    else if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 0x80)
      anchor += static_cast<char>(std::tolower(byte));
  }
  return anchor;
}

std::set<std::string> anchors_of(const fs::path& page) {
  std::set<std::string> anchors;
  for (const auto& line : prose_of(page))
    for (const auto& heading : matches_in(line, "^#+ (.*)", 1)) anchors.insert(anchor_of(heading));
  return anchors;
}

/// Targets of links and pictures, code left aside.
std::vector<std::string> links_of(const fs::path& page) {
  std::string text;
  for (const auto& line : prose_of(page)) text += line + "\n";
  // The text of a link may be code: `](` keeps its place.
  return matches_in(replaced_matches(text, "`[^`\n]*`", ""), "\\]\\(([^)\\s]+)\\)", 1);
}

TEST(Links, LeadToFilesAndHeadings) {
  int links = 0;
  for (const auto& page : all_pages())
    for (const auto& link : links_of(page)) {
      if (link.starts_with("http://") || link.starts_with("https://")) continue;
      ++links;
      const auto hash = link.find('#');
      const auto file = link.substr(0, hash);
      const auto target = file.empty() ? page : page.parent_path() / file;
      const std::string where = fs::relative(page, kSource).string() + ": " + link;
      EXPECT_TRUE(fs::exists(target)) << where;
      if (hash != std::string::npos && fs::exists(target)) {
        EXPECT_THAT(anchors_of(target), ::testing::Contains(link.substr(hash + 1))) << where;
      }
    }
  EXPECT_GT(links, 100);
}

TEST(Links, ReachEveryPageOfDocs) {
  std::set<fs::path> reached = {kSource / "README.md"};
  for (std::vector<fs::path> next(reached.begin(), reached.end()); !next.empty();) {
    const auto page = next.back();
    next.pop_back();
    for (const auto& link : links_of(page)) {
      const auto target = (page.parent_path() / link.substr(0, link.find('#'))).lexically_normal();
      if (target.extension() == ".md" && fs::exists(target) && reached.insert(target).second)
        next.push_back(target);
    }
  }
  for (const auto& page : all_pages()) {
    if (!page.string().starts_with((kSource / "docs").string())) continue;
    EXPECT_TRUE(reached.contains(page)) << "no link leads from README.md to " << page;
  }
}

}  // namespace
}  // namespace viscontact
