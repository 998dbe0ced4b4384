#include "tests/docs/document.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <regex>
#include <sstream>
#include <string_view>

#include "tests/common/regular_expressions.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

// What another processor's arithmetic may change: meshes and so tables within their accuracy, 1e-5,
// and figures made of the small differences between them.
constexpr double kTolerance = 0.02;

const std::regex kNumber("[-+]?[0-9]*\\.?[0-9]+(e[-+]?[0-9]+)?");

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// A line without its numbers and spaces.
std::string words_of(const std::string& line) {
  static const std::regex spaces("\\s+");
  return std::regex_replace(std::regex_replace(line, kNumber, "#"), spaces, "");
}

/// Three dots in a promised line stand for any number. Not a number takes their place, so that the
/// numbers of both lines correspond.
constexpr std::string_view kAnyNumber = "...";

std::string words_of_promise(const std::string& promised) {
  std::string words = promised;
  for (auto at = words.find(kAnyNumber); at != std::string::npos; at = words.find(kAnyNumber))
    words.replace(at, kAnyNumber.size(), "0");
  return words_of(words);
}

std::vector<double> numbers_of_promise(const std::string& promised) {
  std::vector<double> numbers;
  std::size_t begin = 0;
  for (auto at = promised.find(kAnyNumber); at != std::string::npos;
       at = promised.find(kAnyNumber, begin)) {
    std::ranges::copy(numbers_in(promised.substr(begin, at - begin)), std::back_inserter(numbers));
    numbers.push_back(std::numeric_limits<double>::quiet_NaN());
    begin = at + kAnyNumber.size();
  }
  std::ranges::copy(numbers_in(promised.substr(begin)), std::back_inserter(numbers));
  return numbers;
}

bool is_as_promised(const std::string& promised, const std::string& line, double tolerance) {
  if (words_of_promise(promised) != words_of(line)) return false;
  const auto expected = numbers_of_promise(promised);
  const auto actual = numbers_in(line);
  for (std::size_t i = 0; i < expected.size(); ++i)
    if (!std::isnan(expected[i]) &&
        !(std::abs(actual[i] - expected[i]) <= tolerance * std::abs(expected[i])))
      return false;
  return true;
}

}  // namespace

std::vector<Block> blocks_of(const fs::path& page) {
  std::vector<Block> blocks;
  bool inside = false;
  int number = 0;
  for (const auto& line : lines_of(read_file(page))) {
    ++number;
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) blocks.push_back({line.substr(3), {}, number});
    } else if (inside) {
      blocks.back().text += line + "\n";
    }
  }
  return blocks;
}

std::vector<std::string> prose_of(const fs::path& page) {
  auto lines = lines_of(read_file(page));
  bool inside = false;
  for (auto& line : lines) {
    const bool fence = line.starts_with("```");
    if (fence) inside = !inside;
    if (fence || inside) line.clear();
  }
  return lines;
}

std::vector<double> numbers_in(const std::string& line) {
  std::vector<double> values;
  for (std::sregex_iterator match(line.begin(), line.end(), kNumber), end; match != end; ++match)
    values.push_back(std::strtod(match->str().c_str(), nullptr));
  return values;
}

std::string changed(std::string text, const Changes& changes) {
  for (const auto& [expression, replacement] : changes) {
    auto other = replaced_matches(text, expression, replacement);
    EXPECT_NE(other, text) << expression;
    text = std::move(other);
  }
  return text;
}

std::string difference_from(const std::string& promised, const std::string& output,
                            double tolerance) {
  const auto printed = lines_of(output);
  std::size_t next = 0;
  bool any = false;
  for (const auto& line : lines_of(promised)) {
    if (line == "...") {
      any = true;
      continue;
    }
    const auto begin = next;
    while (next < printed.size() && !is_as_promised(line, printed[next], tolerance) && any) ++next;
    if (next == printed.size() || !is_as_promised(line, printed[next], tolerance))
      return "promised: " + line +
             "\nprinted:  " + (begin < printed.size() ? printed[begin] : "nothing more");
    ++next;
    any = false;
  }
  if (next < printed.size() && !any) return "not promised: " + printed[next];
  return {};
}

ReadersFolder::ReadersFolder(const fs::path& executable) {
  fs::copy(fs::path(VISCONTACT_SOURCE_FOLDER) / "data", path() / "data",
           fs::copy_options::recursive);
  fs::create_directories(path() / "build/release");
  fs::create_symlink(executable, path() / "build/release/viscontact");
}

ProcessResult ReadersFolder::run(const std::string& commands) const {
  return run_process({"sh", "-ec", "PATH=\"$PWD/build/release:$PATH\"\n" + commands}, {}, {},
                     path().string());
}

void ReadersFolder::change_case(const std::string& name, const Changes& changes) const {
  const auto file = path() / "data/cases" / name;
  write_file(file, changed(read_file(file), changes));
}

int ReadersFolder::run_page(const fs::path& page, const Changes& changes) const {
  int promises = 0;
  auto blocks = blocks_of(page);
  for (const auto& change : changes) {
    const auto block = std::ranges::find_if(blocks, [&](const Block& b) {
      return b.language == "sh" && !matches_in(b.text, change.first).empty();
    });
    EXPECT_NE(block, blocks.end()) << change.first;
    if (block != blocks.end()) block->text = changed(block->text, {change});
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks[i].language != "sh") continue;
    const auto result = run(blocks[i].text);
    const std::string where =
        page.filename().string() + ":" + std::to_string(blocks[i].line) + ": ";
    EXPECT_EQ(result.exit_status, 0) << where << blocks[i].text << result.output;
    if (i + 1 == blocks.size() || blocks[i + 1].language != "text") continue;
    EXPECT_EQ(difference_from(blocks[i + 1].text, result.output, kTolerance), "")
        << where << blocks[i].text << result.output;
    ++promises;
  }
  return promises;
}

}  // namespace viscontact
