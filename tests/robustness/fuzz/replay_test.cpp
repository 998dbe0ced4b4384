// A fuzz target without a fuzzer: every file of its corpus, and inputs that are made from them by
// the same random changes at each run.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "tests/robustness/fuzz/fuzz_target.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

/// The files of the corpus in the order of their names.
std::vector<fs::path> corpus() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(VISCONTACT_CORPUS)) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

/// `origin` says in a failure where the input comes from.
void run(const std::string& input, const std::string& origin) {
  EXPECT_NO_THROW(
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size()))
      << origin << ": " << ::testing::PrintToString(input);
}

/// What parts of an input are replaced by.
constexpr std::array<std::string_view, 24> kTokens = {
    "0",     "-1",   "1e308", "1e-308", "5e-324",
    "1e400", "nan",  "inf",   "-0",     "99999999999999999999",
    "\"\"",  "''",   "[",     "]",      "{",
    "}",     ",",    ":",     "\n",     "\r",
    "\t",    "\xff", "#",     "="};

std::string mutated(std::string text, const std::vector<std::string>& inputs,
                    std::mt19937_64& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  for (std::size_t changes = 1 + below(4); changes-- > 0;) {
    const std::size_t at = below(text.size() + 1),
                      length = below(std::min<std::size_t>(text.size() - at, 24) + 1);
    switch (below(6)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, text.substr(at, length));
        break;
      case 2:
        text.replace(at, length, kTokens[below(kTokens.size())]);
        break;
      case 3:
        text.resize(at);
        break;
      case 4:
        if (at < text.size()) text[at] = static_cast<char>(below(256));
        break;
      default: {
        const std::string& other = inputs[below(inputs.size())];
        text.replace(at, length, other.substr(below(other.size() + 1), below(200)));
      }
    }
  }
  return text;
}

TEST(Replay, TheCorpusIsReadOrRefused) {
  const auto files = corpus();
  ASSERT_FALSE(files.empty());
  for (const auto& file : files) run(read_file(file), file.filename().string());
}

TEST(Replay, InputsMadeOfTheCorpusAreReadOrRefused) {
  std::vector<std::string> inputs;
  for (const auto& file : corpus()) inputs.push_back(read_file(file));
  ASSERT_FALSE(inputs.empty());
  std::mt19937_64 random(20080131);
  for (int n = 0; n < 1500 && !HasFailure(); ++n)
    run(mutated(inputs[random() % inputs.size()], inputs, random), "changed input");
}

}  // namespace
}  // namespace viscontact
