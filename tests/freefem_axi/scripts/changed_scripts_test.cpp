// What the scripts do when something is wrong with them: each test changes one line of a copy of
// the scripts and solves a row by this copy.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/common/temporary_folder.hpp"
#include "viscontact/freefem_axi/journal/freefem.hpp"

namespace viscontact::freefem_axi {
namespace {

using ::testing::HasSubstr;

struct Change {
  std::string name, file, from, to;
};

// What GoogleTest shows of the parameter.
std::ostream& operator<<(std::ostream& out, const Change& change) { return out << change.name; }

/// Solves a sphere that slides along a free surface (motion 1), or that approaches it (0), or the
/// strain across the axis (3), with the changed scripts.
ProcessResult solve_with(const std::vector<Change>& changes, const std::string& motion = "1") {
  const TemporaryFolder scratch;
  auto freefem = default_freefem();
  const auto folder = scratch.path() / "scripts";
  std::filesystem::copy(freefem.script_folder, folder, std::filesystem::copy_options::recursive);
  for (const auto& change : changes) {
    std::ifstream file(folder / change.file);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    const auto at = text.find(change.from);
    if (at == std::string::npos) throw std::logic_error(change.file + " lacks: " + change.from);
    put_text(folder / change.file, text.replace(at, change.from.size(), change.to));
  }
  freefem.script_folder = folder;
  return run_freefem(freefem, "free_surface.edp",
                     {"-radius",
                      "1",
                      "-gap",
                      "0.1",
                      "-viscosity",
                      "1",
                      "-velocity",
                      "1",
                      "-accuracy",
                      "1e-2",
                      "-cells",
                      "2",
                      "-levels",
                      "3",
                      "-attempts",
                      "3",
                      "-motion",
                      motion,
                      "-strains",
                      motion == "3" ? "1" : "0",
                      "-containerRadius",
                      "0",
                      "-containerHeight",
                      "0"});
}

class WrongScript : public ::testing::TestWithParam<Change> {};

TEST_P(WrongScript, IsFoundByTheStressOnTheSphere) {
  auto changes = std::vector{GetParam()};
  // The solver must let a wrong flow pass, so that the stress is what finds it.
  if (GetParam().name == "Flow")
    changes.push_back({"", "stokes_problem.idp", "largestResidual = 1e-9", "largestResidual = 1"});
  const auto result = solve_with(changes);
  EXPECT_EQ(result.exit_status, 4) << result.output;
  EXPECT_THAT(result.output, HasSubstr("viscontact-error the force by reactions is"))
      << result.output;
}

INSTANTIATE_TEST_SUITE_P(
    Each, WrongScript,
    ::testing::Values(
        Change{"Map", "fluid_mesh.idp", "real scale = circleRadius[c] /",
               "real scale = (i % 3 == 0 ? 1.02 : 1.) * circleRadius[c] /"},
        Change{"Label", "structured_blocks.idp", "3, ceilingLabelOfFilm[f]", "3, wallLabel"},
        Change{"Flow", "stokes_problem.idp", "flow -= correction", "flow -= 0.95 * correction"},
        Change{"Viscosity", "sideways_stokes.idp", "      2 * ((dRho(us)",
               "      2.2 * ((dRho(us)"}),
    [](const auto& test) { return test.param.name; });

// The only flows of motion 3 are those of strains.
TEST(WrongScriptOfStrains, IsFoundByTheTraction) {
  const auto wrong = [](const Change& change) { return solve_with({change}, "3"); };
  for (const auto& result :
       {wrong({"", "fluid_mesh.idp", "real scale = circleRadius[c] /",
               "real scale = (i % 3 == 0 ? 1.02 : 1.) * circleRadius[c] /"}),
        wrong({"", "twofold_stokes.idp", "      2 * ((dRho(us)", "      2.2 * ((dRho(us)"})}) {
    EXPECT_EQ(result.exit_status, 4) << result.output;
    EXPECT_THAT(line_after(result.output, "viscontact-error"), HasSubstr("traction"));
  }
  EXPECT_EQ(solve_with({}, "3").exit_status, 0);
}

TEST(FailedSolve, IsFollowedByASequenceWithOtherNumbersOfCells) {
  const auto right = solve_with({}, "0");
  const auto repeated =
      solve_with({{"", "extrapolation.idp", "bool solved = solveSequence();",
                   "bool solved = attempt > 0; if (solved) solved = solveSequence();"}},
                 "0");
  EXPECT_EQ(repeated.exit_status, 0) << repeated.output;
  const auto force = [](const ProcessResult& result) {
    return std::stod(line_after(result.output, "viscontact-result"));
  };
  EXPECT_NE(force(repeated), force(right));
  // Each is within its own estimate, which is below 1e-5 on the coarsest meshes.
  EXPECT_NEAR(force(repeated) / force(right), 1, 1e-5);
}

TEST(FailedSolve, OfAllSequencesEndsTheRow) {
  const auto result =
      solve_with({{"", "extrapolation.idp", "relativeResidual < largestResidual", "false"}}, "0");
  EXPECT_EQ(result.exit_status, 4) << result.output;
  EXPECT_THAT(line_after(result.output, "viscontact-error"), HasSubstr("the linear solve failed"));
  EXPECT_EQ(line_after(result.output, "viscontact-result"), "");
}

}  // namespace
}  // namespace viscontact::freefem_axi
