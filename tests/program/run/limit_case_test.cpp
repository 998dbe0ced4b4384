// data/cases/limit.toml: the lecture's limit of vanishing viscosity, without tabulation. That the
// trajectories are those of the limit, tests/reduced_model/models checks.
#include <gmock/gmock.h>

#include "tests/common/temporary_folder.hpp"
#include "tests/program/program.hpp"
#include "viscontact/reduced_model/comparison.hpp"

namespace viscontact {
namespace {

TEST(LimitCase, NeedsNoFreeFemAndIsNotSimulatedTwice) {
  const TemporaryFolder scratch;
  const auto run = [&] {
    const auto result = run_viscontact(
        {"run", VISCONTACT_SOURCE_FOLDER "/data/cases/limit.toml", "-o", scratch.path().string()},
        {"VISCONTACT_FREEFEM=no-such-freefem"});
    expect_done(result);
    return result.errors;
  };
  run();
  const auto comparison = reduced_model::read_comparison(scratch.path() / "comparison.json");
  ASSERT_EQ(comparison.models.size(), 4U);
  EXPECT_EQ(comparison.models[1].model, "viscous_contact");
  EXPECT_TRUE(comparison.models[1].contact_interval);
  EXPECT_THAT(run(), ::testing::HasSubstr("up to date"));
}

}  // namespace
}  // namespace viscontact
