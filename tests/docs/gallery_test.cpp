// Each command of the gallery in docs/README.md succeeds. The cases whose computation takes minutes
// are made shorter or coarser first; each such change must find what it changes.
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
      {"end_time = [^ \n]+", "end_time = 0.2"}}},
    {"fluid/viscosity_random_cell.toml",
     {{"draws = 8", "draws = 1"}, {"=0.05,0.1,0.2,0.3,0.4,0.5", "=0.05,0.1"}}},
    {"swimmer/direct_simulation.toml", {{"end_time = 1.0", "end_time = 0.1"}}},
    {"membrane/tank_treading.toml",
     {{"end_time = [^ \n]+", "end_time = 0.2"}, {"angle = 1.0", "beads = 16\nangle = 1.0"}}},
    {"membrane/track.toml", {{"end_time = [^ \n]+", "end_time = 0.1"}}},
    {"flow/two_discs.toml",
     {{"constraint = \"rigid\"", "constraint = \"rigid\"\nedges_per_particle = 8"},
      {"end_time = [^ \n]+", "end_time = 0.01"}}},
    {"valve/valve.toml", {{"end_time = [^ \n]+", "end_time = 0.02"}}},
};

TEST(Gallery, RunsEachSystemOfTheLectureByOneCommand) {
  const ReadersFolder folder(VISCONTACT_EXECUTABLE);
  for (const auto& [name, changes] : kShortened) folder.change_case(name, changes);
  // With the shipped table, which takes minutes, the swimmer needs no FreeFEM.
  fs::create_directories(folder.path() / "out/gallery/swimmer");
  fs::copy_file(kSource / "data/tables/three_spheres.csv",
                folder.path() / "out/gallery/swimmer/table.csv");
  const auto page = kSource / "docs/README.md";
  std::size_t commands = 0;
  for (const auto& block : blocks_of(page)) {
    ASSERT_EQ(block.language, "sh") << block.line;
    const auto result = folder.run(block.text);
    EXPECT_EQ(result.exit_status, 0) << block.line << ": " << block.text << result.output;
    ++commands;
  }
  // One picture stands below each command.
  EXPECT_EQ(matches_in(read_file(page), "\n!\\[").size(), commands);
  EXPECT_GE(commands, 10U);
}

}  // namespace
}  // namespace viscontact
