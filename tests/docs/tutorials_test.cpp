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

// The pages of results: their commands succeed, and print what the pages say. Three commands are no
// blocks of the pages and are not run here, because they take minutes: the map of regimes
// (`sweep` with 1089 points, which tests/sweep/shipped_sweeps_test.cpp samples), and the scripts
// angle_of_repose, incline_study and swimmer_study.
class Results : public ::testing::TestWithParam<std::pair<const char*, int>> {};

TEST_P(Results, DoWhatTheyPromise) {
  const auto [page, promises] = GetParam();
  const ReadersFolder folder(VISCONTACT_EXECUTABLE);
  EXPECT_EQ(folder.run_page(VISCONTACT_SOURCE_FOLDER "/docs/" + std::string(page) + ".md"),
            promises);
}

INSTANTIATE_TEST_SUITE_P(Page, Results,
                         ::testing::Values(std::pair("studies", 0), std::pair("motions", 1),
                                           std::pair("swimmer", 1)),
                         [](const auto& page) { return std::string(page.param.first); });

}  // namespace
}  // namespace viscontact
