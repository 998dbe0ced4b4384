#include <gtest/gtest.h>

#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/pipeline/simulate/run_inputs.hpp"
#include "viscontact/reduced_model/trajectory.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::pipeline {
namespace {

case_file::Case case_of(const std::string& text) {
  case_file::Case c;
  c.text = text;
  return c;
}

TEST(IdentityOfATrajectory, NamesCaseFitForcesLimitsAndVersion) {
  const auto identity = identity_of_trajectory(case_of("a case"), "a fit", {});
  EXPECT_EQ(identity.at("case"), sha256("a case"));
  EXPECT_EQ(identity.at("fit"), sha256("a fit"));
  EXPECT_EQ(identity.at("version of Viscontact"), VISCONTACT_VERSION);
  EXPECT_FALSE(identity.contains("force"));
  EXPECT_FALSE(identity.contains("drag below the fit"));

  const TemporaryFolder folder;
  auto forced = case_of("a case");
  forced.force_files = {folder.file("one.csv", "1\n"), folder.file("two.csv", "2\n")};
  const auto more = identity_of_trajectory(
      forced, "a fit",
      {lubrication::BelowInterval::kTheoryLimit, lubrication::AboveInterval::kStokesLimit});
  EXPECT_EQ(more.at("force"), sha256("1\n2\n"));
  EXPECT_EQ(more.at("drag below the fit"), "theory's limit");
  EXPECT_EQ(more.at("drag above the fit"), "Stokes' limit");
}

TEST(IdentityOfATrajectory, DoesNotDependOnWhenTheFitWasMade) {
  const std::string fit = "{\n  \"basis\": \"lecture\"\n}\n";
  results::Provenance provenance;
  provenance.made = "2001-09-09T01:46:40Z";
  EXPECT_EQ(identity_of_trajectory(case_of(""),
                                   results::with_provenance(TextKind::kJson, fit, provenance), {}),
            identity_of_trajectory(case_of(""), fit, {}));
}

TEST(IdentityOfATrajectory, DecidesWhetherATrajectoryIsUpToDate) {
  const TemporaryFolder folder;
  const results::RunFolder run{folder.path()};
  std::filesystem::create_directory(run.trajectories());
  const auto identity = identity_of_trajectory(case_of("a case"), "a fit", {});
  EXPECT_FALSE(is_simulated(run, "inertial", identity));

  reduced_model::Trajectory trajectory;
  trajectory.model = "inertial";
  trajectory.provenance = identity;
  trajectory.rows = {{0, 1, -1}, {1, 0.5, -0.5}};
  put_text(run.trajectory("inertial"), reduced_model::write_trajectory(trajectory));
  EXPECT_TRUE(is_simulated(run, "inertial", identity));
  EXPECT_FALSE(
      is_simulated(run, "inertial", identity_of_trajectory(case_of("another"), "a fit", {})));
  EXPECT_FALSE(
      is_simulated(run, "inertial",
                   identity_of_trajectory(case_of("a case"), "a fit",
                                          {.below = lubrication::BelowInterval::kTheoryLimit})));

  put_text(run.trajectory("inertial"), "not a trajectory\n");
  EXPECT_FALSE(is_simulated(run, "inertial", identity));
}

}  // namespace
}  // namespace viscontact::pipeline
