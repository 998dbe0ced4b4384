// What a script answers when no mesh is good enough, or the solver fails.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "tests/common/temporary_folder.hpp"
#include "tests/oracles/bispherical/bispherical.hpp"
#include "viscontact/freefem_axi/journal/freefem.hpp"

namespace viscontact::freefem_axi {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kGap = 0.5;

/// A sphere above a plane in unbounded fluid, or in a cavity, which needs fewer elements.
ProcessResult solve(const FreeFem& freefem, const std::string& accuracy, const std::string& cells,
                    const std::string& attempts, bool in_cavity = false) {
  std::vector<std::string> arguments = {
      "-radius",   "1",      "-gap",    "0.5", "-viscosity", "1",   "-velocity", "-1",
      "-accuracy", accuracy, "-levels", "3",   "-cells",     cells, "-attempts", attempts};
  const std::vector<std::string> walls =
      in_cavity ? std::vector<std::string>{"-cavityRadius", "3"}
                : std::vector<std::string>{"-containerRadius", "0", "-containerHeight", "0"};
  arguments.insert(arguments.end(), walls.begin(), walls.end());
  return run_freefem(freefem, in_cavity ? "cavity.edp" : "plane.edp", arguments);
}

struct Answer {
  double force = 0, estimate = 0, unknowns = 0;
};

Answer answer_of(const ProcessResult& result) {
  EXPECT_EQ(result.exit_status, 0) << result.output;
  std::istringstream words(line_after(result.output, "viscontact-result"));
  Answer answer;
  words >> answer.force >> answer.estimate >> answer.unknowns;
  EXPECT_TRUE(words) << result.output;
  return answer;
}

TEST(Attempts, GoOnUntilTheAccuracyIsMetAndAnswerWithTheirOwnEstimateWhereItIsNot) {
  const auto one = answer_of(solve(default_freefem(), "1e-15", "2", "1", true));
  const auto three = answer_of(solve(default_freefem(), "5e-7", "2", "3", true));
  const double exact = 6 * std::numbers::pi * cavity_drag_factor(kGap, 3);
  for (const auto& answer : {one, three}) {
    EXPECT_LE(std::abs(answer.force / exact - 1), answer.estimate);
  }
  // The estimate of the first attempt is 2e-6.
  EXPECT_LE(three.estimate, 5e-7);
  EXPECT_GT(three.unknowns, 2 * one.unknowns);
}

/// FreeFEM with at most 0.6 GB of addresses, of which it takes 0.4 GB before it begins. That is
/// enough for 40 000 unknowns, but not for 100 000. UMFPACK then leaves zeros: FreeFEM 4.11 goes
/// on, 4.15 throws an error.
FreeFem limited_freefem(const TemporaryFolder& scratch) {
  const auto limited = scratch.path() / "limited_freefem";
  const auto freefem = default_freefem();
  put_text(limited, "#!/bin/sh\nulimit -v 600000\nexec '" + freefem.executable + "' \"$@\"\n");
  make_executable(limited);
  return {limited.string(), freefem.script_folder};
}

TEST(Attempts, OutOfMemoryIsAFailureNotAForce) {
  const TemporaryFolder scratch;
  const auto result = solve(limited_freefem(scratch), "1e-15", "4", "1");
  EXPECT_THAT(result.output, HasSubstr("viscontact-level 0"));
  EXPECT_NE(result.exit_status, 0);
  EXPECT_THAT(result.output, HasSubstr("viscontact-error the linear solve failed"));
  EXPECT_THAT(result.output, Not(HasSubstr("viscontact-result")));
}

TEST(Attempts, OutOfMemoryInALaterAttemptLeavesTheAnswerOfTheOneBefore) {
  const TemporaryFolder scratch;
  const auto result = solve(limited_freefem(scratch), "1e-15", "3", "3");
  // The memory was too small for the second attempt: a level without a force.
  EXPECT_THAT(result.output, HasSubstr("\nviscontact-level 1 -0 "));
  const auto answer = answer_of(result);
  const double exact = 6 * std::numbers::pi * bispherical_plane_factor(kGap);
  EXPECT_LE(std::abs(answer.force / exact - 1), answer.estimate);
  EXPECT_GT(answer.estimate, 1e-15);
}

}  // namespace
}  // namespace viscontact::freefem_axi
