// A sweep of particles on Slurm itself: a cluster of two nodes on this machine.
#include <gmock/gmock.h>

#include "tests/particle_runs/sweep/particles_case.hpp"
#include "tests/program/program.hpp"
#include "tests/program/slurm_cluster.hpp"
#include "tests/program/sweep/sweep_command.hpp"
#include "tests/program/undisturbed.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

class SlurmSweep : public SweepCommand {
 protected:
  void TearDown() override { cluster().cancel_jobs(); }
  ProgramResult run(const std::string& output, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"sweep",   path("case.toml"),
                                          "-o",      path(output),
                                          "--vary",  "arrangement.area_fraction=0.2,0.4",
                                          "--draws", "6"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_viscontact(arguments, {cluster().variable()});
  }
};

TEST_F(SlurmSweep, ArrayJobAndGatherGiveTheTablesOfALocalRun) {
  put_text(path("case.toml"), small_particles_case());
  const auto submitted = run("rows.csv", {"--launcher", "slurm", "--tasks", "5"});
  expect_done(submitted);
  EXPECT_THAT(submitted.errors, Names("5 tasks"));
  wait_until([] { return cluster().jobs().empty(); });
  expect_done(run("rows.csv", {"--gather"}));
  expect_done(run("local.csv", {}));
  EXPECT_EQ(rest_of(path("rows.csv")), rest_of(path("local.csv")));
  EXPECT_EQ(rest_of(path("rows_means.csv")), rest_of(path("local_means.csv")));
  // Nothing is left to compute.
  const auto again = run("rows.csv", {"--launcher", "slurm"});
  expect_done(again);
  EXPECT_EQ(again.output, "");
  EXPECT_THAT(again.errors, Names(path("rows.csv"), "--gather"));
}

}  // namespace
}  // namespace viscontact
