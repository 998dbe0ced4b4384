// docs/troubleshooting.md quotes messages that the program can print, docs/command-line.md its exit
// codes.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <regex>
#include <span>
#include <string>
#include <vector>

#include "tests/docs/document.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = VISCONTACT_SOURCE_FOLDER;

/// The texts in quotes of all sources, of which neighbours are joined as the compiler does.
std::vector<std::string> all_texts() {
  static const std::regex text("\"((?:[^\"\\\\\n]|\\\\.)*)\"");
  static const std::regex space("\\s*");
  std::vector<std::string> texts;
  for (const char* folder :
       {"app", "case_file", "common", "fitting", "freefem", "freefem_axi", "freefem_flow",
        "lubrication", "pipeline", "report", "results", "terminal", "reduced_model", "particles",
        "sweep", "motions", "rolling", "swimmer"})
    for (const auto& entry : fs::recursive_directory_iterator(kSource / folder)) {
      const auto kind = entry.path().extension();
      if (kind != ".cpp" && kind != ".hpp" && kind != ".edp" && kind != ".idp") continue;
      const std::string source = read_file(entry.path());
      bool is_first = true;
      for (std::sregex_iterator match(source.begin(), source.end(), text), end; match != end;
           ++match) {
        if (is_first || !std::regex_match(match->prefix().str(), space)) texts.emplace_back();
        is_first = false;
        texts.back() += (*match)[1];
      }
    }
  return texts;
}

/// Without spaces at its ends, which another text may end or begin with.
std::string trimmed(const std::string& text) {
  static const std::regex ends("^\\s+|\\s+$");
  return std::regex_replace(text, ends, "");
}

/// What stands between the dots of a quoted message, but for single spaces, brackets and the like.
std::vector<std::string> fixed_parts(std::string message) {
  constexpr std::size_t kLeast = 4;
  std::vector<std::string> parts;
  message += "...";
  for (std::size_t at; (at = message.find("...")) != std::string::npos;) {
    if (auto part = trimmed(message.substr(0, at)); part.size() >= kLeast) parts.push_back(part);
    message.erase(0, at + 3);
  }
  return parts;
}

/// True if one of the texts contains all these parts in their order.
bool is_in_one(const std::vector<std::string>& texts, std::span<const std::string> parts) {
  return std::ranges::any_of(texts, [&](const std::string& text) {
    std::size_t at = 0;
    return std::ranges::all_of(parts, [&](const std::string& part) {
      at = text.find(part, at);
      if (at == std::string::npos) return false;
      at += part.size();
      return true;
    });
  });
}

/// True if the parts are in one text, or if the first of them are in one text and the others in
/// another one, as in a message that ends with its cause.
bool is_said(const std::vector<std::string>& texts, std::span<const std::string> parts) {
  if (is_in_one(texts, parts)) return true;
  for (std::size_t first = 1; first < parts.size(); ++first)
    if (is_in_one(texts, parts.first(first)) && is_in_one(texts, parts.subspan(first))) return true;
  return false;
}

TEST(Troubleshooting, QuotesMessagesThatAreInTheSource) {
  const auto texts = all_texts();
  const std::regex quoted("`([^`]*)`");
  int messages = 0;
  for (const auto& line : prose_of(kSource / "docs/troubleshooting.md")) {
    // A message opens its point; a second one may follow after a comma.
    if (!line.starts_with("- `")) continue;
    const std::string opening = line.substr(0, std::min(line.find("` ("), line.find("`. ")) + 1);
    for (std::sregex_iterator match(opening.begin(), opening.end(), quoted), end; match != end;
         ++match) {
      ++messages;
      const auto parts = fixed_parts((*match)[1]);
      EXPECT_FALSE(parts.empty()) << line;
      EXPECT_TRUE(is_said(texts, parts)) << "no source says what opens: " << line;
    }
  }
  EXPECT_GT(messages, 40);
}

TEST(CommandLine, ListsTheExitCodesOfTheProgram) {
  const std::string page = read_file(kSource / "docs/command-line.md");
  for (const auto& [kind, code, meaning] : results::exit_codes())
    EXPECT_THAT(page, ::testing::HasSubstr(fmt::format("\n| {} | {}", code, meaning)));
}

}  // namespace
}  // namespace viscontact
