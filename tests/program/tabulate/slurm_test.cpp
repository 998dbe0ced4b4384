// A sweep on Slurm itself: a cluster of two nodes on this machine
// (tests/program/tabulate/slurm_cluster).
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/program/slurm_cluster.hpp"
#include "tests/program/undisturbed.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;

[[maybe_unused]] const auto* const environment =
    ::testing::AddGlobalTestEnvironment(new ClusterEnvironment);  // GoogleTest deletes it

/// Two cases of six gaps at two velocities: 24 rows.
class Slurm : public ::testing::Test {
 protected:
  Slurm() {
    const auto text = replaced(gentle_case_text(), "reference_velocities = [-1.0]",
                               "reference_velocities = [-1.0, 2.0]");
    put_text(path("thin.toml"), text);
    put_text(path("thick.toml"), replaced(text, "viscosity = 3.0", "viscosity = 6.0"));
  }
  void TearDown() override { cluster().cancel_jobs(); }
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

  ProgramResult tabulate(const std::string& output, const std::vector<std::string>& options,
                         const std::string& freefem) const {
    std::vector<std::string> arguments = {"tabulate"};
    arguments.insert(arguments.end(), cases_.begin(), cases_.end());
    arguments.insert(arguments.end(), {"-o", path(output)});
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_viscontact(arguments, {cluster().variable(), "VISCONTACT_FREEFEM=" + freefem});
  }
  static void wait_for_the_jobs() {
    wait_until([] { return cluster().jobs().empty(); });
  }
  /// Expects the tables of these folders to be those of a run here.
  void expect_tables_of_a_local_run(const std::string& freefem,
                                    const std::vector<std::string>& folders = {"out"}) const {
    expect_done(tabulate("local", {}, freefem));
    for (const auto& folder : folders)
      for (const std::string name : {"/thin.csv", "/thick.csv"})
        EXPECT_EQ(without_seconds(path(folder + name)), without_seconds(path("local" + name)));
  }
  std::size_t files_in(const std::string& folder) const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path(folder)),
                                                  std::filesystem::directory_iterator()));
  }

  TemporaryFolder scratch_;
  std::vector<std::string> cases_ = {path("thin.toml"), path("thick.toml")};
};

TEST_F(Slurm, ArrayJobIsSubmittedByOneCommandAndGatheredByAnother) {
  const freefem_axi::FakeFreeFem fake(scratch_.path(),
                                      "while [ -e \"$folder/hold\" ]; do sleep 0.1; done\n");
  put_text(path("hold"), "");
  const auto submitted = tabulate("out", {"--launcher", "slurm"}, fake.executable());
  expect_done(submitted);
  EXPECT_THAT(submitted.errors, Names("24 tasks"));
  // Nothing of it is over: no second job, and no table.
  expect_refusal(tabulate("out", {"--launcher", "slurm"}, fake.executable()), ErrorKind::kBadInput,
                 Names("Slurm"));
  const auto early = tabulate("out", {"--gather"}, fake.executable());
  expect_refusal(early, ErrorKind::kNotConverged, Names("2 of 2"));
  EXPECT_THAT(early.errors, Names("thin.csv", "12 of 12", "0.05"));
  // Nor does an edit of a case reach the tasks that start later.
  const std::string thin = read_file(path("thin.toml"));
  put_text(path("thin.toml"), replaced(thin, "viscosity = 3.0", "viscosity = 9.0"));
  std::filesystem::remove(path("hold"));
  wait_for_the_jobs();
  const auto edited = tabulate("out", {"--gather"}, fake.executable());
  expect_refusal(edited, ErrorKind::kNotConverged, Names("1 of 2"));
  EXPECT_THAT(edited.errors, Names("thin.toml", "edited"));
  put_text(path("thin.toml"), thin);

  EXPECT_THAT(fake.answered(), SizeIs(24));
  expect_done(tabulate("out", {"--gather"}, "no-such-freefem"));
  EXPECT_THAT(fake.answered(), SizeIs(24));
  EXPECT_EQ(files_in("out"), 2U);  // the tables, and no journal
  expect_tables_of_a_local_run(fake.executable());
}

TEST_F(Slurm, WithFreeFemTheTablesAreThoseOfALocalRunToo) {
  for (const auto& file : cases_) {
    auto text = replaced(read_file(file), "to = 1.5, count = 6", "to = 0.3, count = 2");
    text = replaced(text, "[-1.0, 2.0]", "[-1.0]");
    put_text(file, replaced(text, "relative_accuracy = 1e-3", "relative_accuracy = 1e-2"));
  }
  expect_done(tabulate("out", {"--launcher", "slurm", "--tasks", "3"}, "FreeFem++-nw"));
  wait_for_the_jobs();
  expect_done(tabulate("out", {"--gather"}, "no-such-freefem"));
  expect_tables_of_a_local_run("FreeFem++-nw");
}

TEST_F(Slurm, RowThatFailsIsNamedWhenGatheredAndASecondJobComputesItAlone) {
  const freefem_axi::FakeFreeFem fake(scratch_.path(), R"sh(
[ $gap = 1.5 ] && [ $velocity = 2 ] && [ ! -e "$folder/mended" ] && { echo out of luck; exit 4; }
)sh");
  expect_done(tabulate("out", {"--launcher", "slurm", "--tasks", "5"}, fake.executable()));
  wait_for_the_jobs();
  const auto failed = tabulate("out", {"--gather"}, fake.executable());
  expect_refusal(failed, ErrorKind::kExternalProgram, Names("2 of 2"));
  EXPECT_THAT(failed.errors, Names("thin.csv", "1 of 12", "--gather", "FreeFEM",
                                   "gap 1.5, velocity 2", "out of luck"));
  // The tables are there without that row, and a second job has its two tasks alone.
  EXPECT_EQ(files_in("out"), 2U);
  EXPECT_THAT(read_file(path("out/thin.csv")),
              AllOf(HasSubstr("# rows: 11\n"), HasSubstr("# failed row, gap 1.5, velocity 2: ")));
  put_text(path("mended"), "");
  EXPECT_THAT(tabulate("out", {"--launcher", "slurm"}, fake.executable()).errors, Names("2 tasks"));
  wait_for_the_jobs();
  expect_done(tabulate("out", {"--gather"}, "no-such-freefem"));
  EXPECT_THAT(fake.answered(), SizeIs(24));
  expect_tables_of_a_local_run(fake.executable());
}

TEST_F(Slurm, JobThatItDoesNotTakeIsSaidInItsWords) {
  expect_refusal(
      tabulate("out", {"--launcher", "slurm", "--slurm-options", "--partition=nowhere"}, "none"),
      ErrorKind::kExternalProgram, Names("sbatch", "nowhere"));
}

// Four tasks of six rows, two on each node. The first row of each is answered, and all rows on node
// 2; the second rows on node 1 take for ever, until that node dies.
constexpr const char* kEndlessOnNode1 = R"sh(
if [ "$SLURMD_NODENAME" = n1 ] && [ -e "$folder/answered_by.$SLURM_ARRAY_TASK_ID" ]; then
  : > "$folder/endless.$SLURM_ARRAY_TASK_ID"
  exec sleep 3600
fi
: > "$folder/answered_by.$SLURM_ARRAY_TASK_ID"
)sh";

class NodeThatDies : public Slurm {};

// Two jobs at once, because Slurm begins the tasks of a dead node again after many seconds only.
TEST_F(NodeThatDies, LosesNoFinishedRowAndOthersAreComputedElsewhereOrByASecondJob) {
  const TemporaryFolder kept_scratch, requeued_scratch;
  const freefem_axi::FakeFreeFem kept(kept_scratch.path(), kEndlessOnNode1),
      requeued(requeued_scratch.path(), kEndlessOnNode1);
  const std::vector<std::string> four_tasks = {"--launcher", "slurm", "--tasks", "4"};
  auto no_requeue = four_tasks;
  no_requeue.insert(no_requeue.end(), {"--slurm-options", "--no-requeue"});
  expect_done(tabulate("out", no_requeue, kept.executable()));
  expect_done(tabulate("requeued", four_tasks, requeued.executable()));
  const auto hangs = [](const TemporaryFolder& scratch, const freefem_axi::FakeFreeFem& fake) {
    std::size_t endless = 0;
    for (const auto& name : scratch.names()) endless += name.starts_with("endless.") ? 1 : 0;
    return endless == 2 && fake.answered().size() == 14;
  };
  wait_until([&] { return hangs(kept_scratch, kept) && hangs(requeued_scratch, requeued); });
  cluster().kill_node(1);
  wait_for_the_jobs();
  // The tasks of one job went on by themselves.
  EXPECT_THAT(requeued.answered(), SizeIs(24));  // each row once
  expect_done(tabulate("requeued", {"--gather"}, requeued.executable()));
  // Those of the other one need a second job, which computes the missing rows only.
  EXPECT_THAT(kept.answered(), SizeIs(14));
  const auto missing = tabulate("out", {"--gather"}, kept.executable());
  EXPECT_EQ(missing.exit_status, results::exit_code_of(ErrorKind::kNotConverged)) << missing.errors;
  EXPECT_THAT(missing.errors, Names("thin.csv", "4 of 12", "thick.csv", "6 of 12"));
  expect_done(tabulate("out", {"--launcher", "slurm"}, kept.executable()));
  wait_for_the_jobs();
  EXPECT_THAT(kept.answered(), SizeIs(24));
  expect_done(tabulate("out", {"--gather"}, kept.executable()));
  expect_tables_of_a_local_run(kept.executable(), {"out", "requeued"});
}

}  // namespace
}  // namespace viscontact
