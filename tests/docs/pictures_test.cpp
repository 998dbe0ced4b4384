// The pictures of docs/ say how they were made without naming a folder of the machine.
#include <gtest/gtest.h>

#include <filesystem>

#include "viscontact/common/files/file.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

TEST(Pictures, NameNoFolderOfTheMachineOnWhichTheyWereMade) {
  std::size_t pictures = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(VISCONTACT_SOURCE_FOLDER) / "docs/images")) {
    // Pictures of scripts that gnuplot drew have none.
    const auto provenance = results::read_provenance(entry.path());
    if (!provenance) continue;
    SCOPED_TRACE(entry.path());
    ++pictures;
    EXPECT_EQ(provenance->folder, "/viscontact");
    EXPECT_TRUE(fs::path(provenance->output).is_relative()) << provenance->output;
    for (const auto& word : provenance->command) EXPECT_FALSE(word.starts_with("/")) << word;
    for (const auto& input : provenance->inputs)
      EXPECT_TRUE(fs::path(input.file).is_relative()) << input.file;
  }
  EXPECT_GE(pictures, 35U);
}

}  // namespace
}  // namespace viscontact
