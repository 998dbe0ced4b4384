// Each command of the gallery in docs/README.md succeeds. The cases whose computation takes minutes
// are made shorter or coarser first; commands that tutorials_test.cpp runs are left out.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "tests/common/regular_expressions.hpp"
#include "tests/docs/document.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = VISCONTACT_SOURCE_FOLDER;

/// What is changed in the cases that take minutes, by their path in data/cases.
const std::map<std::string, Changes> kShortened = {
    {"lecture.toml", {{"\nbasis = [^\n]*", ""}, {"weights = [^\n]*", "exact = \"plane\""}}},
    {"fluid/lecture.toml",
     {{"edges_per_particle = [0-9]+", "edges_per_particle = 8"},
      {"every = [^ \n]+", "every = 0.04"},
      {"end_time = [^ \n]+", "end_time = 0.04"}}},
    {"fluid/viscosity_random_cell.toml",
     {{"draws = 8", "draws = 1"},
      {"edges_per_particle = 12", "edges_per_particle = 8"},
      {"=0.05,0.1,0.2,0.3,0.4,0.5", "=0.05"}}},
    {"suspensions/reversal.toml",
     {{"until = 4.0", "until = 0.1"},
      {"until = 8.0", "until = 0.2"},
      {"end_strain = [^ \n]+", "end_strain = 0.2"},
      {"average_from = [^ \n]+", "average_from = 0.05"}}},
    {"membrane/tank_treading.toml",
     {{"end_time = [^ \n]+", "end_time = 0.2"}, {"angle = 1.0", "beads = 16\nangle = 1.0"}}},
    {"membrane/track.toml", {{"end_time = [^ \n]+", "end_time = 0.1"}}},
    {"flow/two_discs.toml",
     {{"constraint = \"rigid\"", "constraint = \"rigid\"\nedges_per_particle = 8"},
      {"end_time = [^ \n]+", "end_time = 0.01"}}},
    {"valve/valve.toml", {{"end_time = [^ \n]+", "end_time = 0.01"}}},
};

TEST(Gallery, RunsEachSystemOfTheLectureByOneCommand) {
  const ReadersFolder folder(VISCONTACT_EXECUTABLE);
  for (const auto& [name, changes] : kShortened) folder.change_case(name, changes);
  std::string elsewhere;
  for (const auto* page : {"studies.md", "swimmer.md"})
    elsewhere += read_file(kSource / "docs" / page);
  const auto page = kSource / "docs/README.md";
  std::size_t commands = 0;
  for (const auto& block : blocks_of(page)) {
    ASSERT_EQ(block.language, "sh") << block.line;
    ++commands;
    if (elsewhere.find(block.text.substr(0, block.text.find(" -o "))) != std::string::npos)
      continue;
    const auto result = folder.run(block.text);
    EXPECT_EQ(result.exit_status, 0) << block.line << ": " << block.text << result.output;
  }
  // One picture stands below each command.
  EXPECT_EQ(matches_in(read_file(page), "\n!\\[").size(), commands);
  EXPECT_GE(commands, 10U);
}

}  // namespace
}  // namespace viscontact
