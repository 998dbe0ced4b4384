// docs/troubleshooting.md quotes messages that the program can print, docs/command-line.md its exit
// codes.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <regex>
#include <string>

#include "tests/docs/document.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = VISCONTACT_SOURCE_FOLDER;

/// The texts in quotes of all sources, neighbours joined as the compiler does, a line each; of
/// FreeFEM's scripts too, whose texts are joined by +.
std::string all_texts() {
  static const std::regex text("\"((?:[^\"\\\\\n]|\\\\.)*)\"");
  static const std::regex space("\\s*");
  std::string texts;
  for (const char* folder :
       {"app", "case_file", "common", "fitting", "freefem_axi", "lubrication", "pipeline", "report",
        "results", "terminal", "reduced_model", "particles", "sweep"})
    for (const auto& entry : fs::recursive_directory_iterator(kSource / folder)) {
      if (!entry.is_regular_file()) continue;
      const std::string source = read_file(entry.path());
      for (std::sregex_iterator match(source.begin(), source.end(), text), end; match != end;
           ++match) {
        if (!std::regex_match(match->prefix().str(), space)) texts += '\n';
        texts += (*match)[1];
      }
      texts += '\n';
    }
  return texts;
}

/// Without spaces at its ends, which another text may end or begin with.
std::string trimmed(const std::string& text) {
  static const std::regex ends("^\\s+|\\s+$");
  return std::regex_replace(text, ends, "");
}

/// What stands between the dots of a quoted message.
std::vector<std::string> fixed_parts(std::string message) {
  std::vector<std::string> parts;
  for (std::size_t at; (at = message.find("...")) != std::string::npos;) {
    parts.push_back(trimmed(message.substr(0, at)));
    message.erase(0, at + 3);
  }
  parts.push_back(trimmed(message));
  return parts;
}

TEST(Troubleshooting, QuotesMessagesThatAreInTheSource) {
  const std::string texts = all_texts();
  const std::regex quoted("`([^`]*)`");
  int messages = 0;
  for (const auto& line : prose_of(kSource / "docs/troubleshooting.md")) {
    // A message opens its point; a second one may follow after a comma.
    if (!line.starts_with("- `")) continue;
    const std::string opening = line.substr(0, std::min(line.find("` ("), line.find("`. ")) + 1);
    for (std::sregex_iterator match(opening.begin(), opening.end(), quoted), end; match != end;
         ++match) {
      ++messages;
      int found = 0;
      for (const auto& part : fixed_parts((*match)[1])) {
        if (part.size() < 4) continue;  // a space, a bracket
        ++found;
        EXPECT_NE(texts.find(part), std::string::npos)
            << "no source says '" << part << "' of: " << line;
      }
      EXPECT_GT(found, 0) << line;
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
