// Every command of the tutorials and recipes succeeds, and prints what the page says.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

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

TEST(TutorialOfAFallingSphere, DoesWhatItSays) {
  const ReadersFolder folder(VISCONTACT_EXECUTABLE);
  EXPECT_GE(folder.run_page(kTutorials / "falling.md"), 2);
}

TEST(Recipes, AllSucceedInTheirOrder) {
  const ReadersFolder folder(VISCONTACT_EXECUTABLE);
  // Fewer and coarser rows, to save time.
  folder.change_case("lecture.toml", {{"relative_accuracy = 1e-5", "relative_accuracy = 1e-2"}});
  folder.run_page(VISCONTACT_SOURCE_FOLDER "/docs/recipes.md",
                  {{"/count = 12/",
                    "/count = 5/; s/radius = 40.0, height = 80.0/radius = 5.0, height = 10.0/; "
                    "s/accuracy = 1e-5/accuracy = 1e-2/"},
                   {"kind = \"sphere\", radius = 2.0", "kind = \"free_surface\""},
                   {"mass=1:100:log:20 --vary fluid.viscosity=2:4:20",
                    "mass=1:100:log:3 --vary fluid.viscosity=2:4:3"}});
}

// The pages of results: their commands succeed, and print what the pages say. Three commands are no
// blocks of the pages and are not run here, because they take minutes: the map of regimes
// (`sweep` with 1089 points, which tests/sweep/shipped_sweeps_test.cpp samples), and the scripts
// angle_of_repose, incline_study and swimmer_study.
struct PageOfResults {
  std::string name;
  int outputs;        ///< of commands on the page. The studies promise pictures and no text:
                      ///< tests/reduced_model/studies_test.cpp checks their numbers.
  Changes changes{};  ///< of commands, to save time
};
std::ostream& operator<<(std::ostream& out, const PageOfResults& page) { return out << page.name; }

class Results : public ::testing::TestWithParam<PageOfResults> {};

TEST_P(Results, DoWhatTheyPromise) {
  const ReadersFolder folder(VISCONTACT_EXECUTABLE);
  const auto& [name, outputs, changes] = GetParam();
  // A few steps: tests/program/swimmer/direct_simulation_test.cpp checks how far a stroke leads.
  folder.change_case("swimmer/direct_simulation.toml",
                     {{"end_time = 1.0", "end_time = 0.05"},
                      {"edges_per_particle = 12", "edges_per_particle = 8"}});
  folder.change_case("swimmer/inertia.toml", {{"end_time = 6.0", "end_time = 0.05"}});
  EXPECT_EQ(folder.run_page(VISCONTACT_SOURCE_FOLDER "/docs/" + name + ".md", changes), outputs);
}

INSTANTIATE_TEST_SUITE_P(Page, Results,
                         ::testing::Values(PageOfResults{"studies", 0}, PageOfResults{"motions", 1},
                                           PageOfResults{
                                               "swimmer", 2, {{"period=0.5,1,2", "period=2"}}}),
                         [](const auto& page) { return page.param.name; });

}  // namespace
}  // namespace viscontact
