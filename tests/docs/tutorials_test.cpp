// Every command of the tutorials and recipes succeeds, and prints what the page says.
#include <gtest/gtest.h>

#include "tests/docs/document.hpp"

namespace viscontact {
namespace {

const std::filesystem::path kTutorials = VISCONTACT_SOURCE_FOLDER "/docs/tutorials";

class Tutorial : public ::testing::TestWithParam<const char*> {};

TEST_P(Tutorial, DoesWhatItSays) {
  const ReadersFolder folder(VISCONTACT_EXECUTABLE);
  EXPECT_GE(folder.run_page(kTutorials / (std::string(GetParam()) + ".md")), 5);
}

INSTANTIATE_TEST_SUITE_P(Each, Tutorial, ::testing::Values("tabulate", "fit", "trajectories"),
                         [](const auto& page) { return std::string(page.param); });

TEST(Recipes, AllSucceedInTheirOrder) {
  const ReadersFolder folder(VISCONTACT_EXECUTABLE);
  folder.run_page(VISCONTACT_SOURCE_FOLDER "/docs/recipes.md");
}

}  // namespace
}  // namespace viscontact
