// The driver over several rows: with a script in FreeFEM's place, and once with FreeFEM.
#include "viscontact/freefem_axi/journal/tabulate.hpp"

#include <gmock/gmock.h>

#include <thread>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/freefem_axi/tabulations.hpp"
#include "tests/oracles/brenner.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/freefem_axi/journal/row_journal.hpp"
#include "viscontact/freefem_axi/journal/row_record.hpp"
#include "viscontact/freefem_axi/motion_table_plan.hpp"

namespace viscontact::freefem_axi {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

void no_report(const TabulateProgress&) {}

/// What identifies and answers a row; its seconds differ from run to run.
std::vector<std::array<double, 7>> values_of(const lubrication::MotionTable& table) {
  std::vector<std::array<double, 7>> values;
  for (const auto& row : table.rows)
    values.push_back({row.gap, row.reference_velocity, row.force, row.force_factor,
                      row.relative_error_estimate, row.degrees_of_freedom, row.observed_order});
  return values;
}

class Tabulate : public ::testing::Test {
 protected:
  std::filesystem::path table_path() const { return scratch_.path() / "table.csv"; }

  TemporaryFolder scratch_;
  Tabulation tabulation_ = unit_tabulation({0.125, 0.25, 0.5, 1}, 5, 1e-3);
};

TEST_F(Tabulate, RowsAreGapsInTheirOrderForEachVelocityWhicheverIsFinishedFirst) {
  tabulation_.reference_velocities = {-1, 2};
  const FakeFreeFem fake(scratch_.path(),
                         "[ $gap = 0.125 ] && sleep 0.3\n");  // the first comes last
  const auto table = tabulate(fake.freefem(), tabulation_, 4, table_path(), no_report);
  std::vector<std::pair<double, double>> order;
  for (const auto& row : table.rows) order.emplace_back(row.reference_velocity, row.gap);
  EXPECT_THAT(order, ElementsAre(std::pair(-1, 0.125), std::pair(-1, 0.25), std::pair(-1, 0.5),
                                 std::pair(-1, 1), std::pair(2, 0.125), std::pair(2, 0.25),
                                 std::pair(2, 0.5), std::pair(2, 1)));
  for (const auto& row : table.rows)
    EXPECT_NEAR(row.force / FakeFreeFem::force(1, 1, row.gap, row.reference_velocity), 1,
                1e-15);  // round-off of awk
}

TEST_F(Tabulate, NumberOfProcessesDoesNotChangeTheRows) {
  const FakeFreeFem fake(scratch_.path());
  const auto one = tabulate(fake.freefem(), tabulation_, 1, table_path(), no_report);
  const auto four =
      tabulate(fake.freefem(), tabulation_, 4, scratch_.path() / "other.csv", no_report);
  EXPECT_EQ(values_of(one), values_of(four));
  EXPECT_EQ(fake.answered().size(), 8U);
}

TEST_F(Tabulate, TableSaysWhatItIsOf) {
  const FakeFreeFem fake(scratch_.path());
  tabulation_.viscosity = 3;
  const auto table = tabulate(fake.freefem(), tabulation_, 2, table_path(), no_report);
  EXPECT_EQ(table.viscosity, 3);
  EXPECT_EQ(table.radius, 1);
  EXPECT_EQ(table.geometry, "plane");
  EXPECT_THAT(table.container, AllOf(HasSubstr("radius 5"), HasSubstr("height 10")));
  EXPECT_EQ(table.case_hash, tabulation_hash(tabulation_));
  EXPECT_EQ(table.versions.at("FreeFEM"), "0-fake");
}

TEST_F(Tabulate, TableSaysItsGeometrysParameters) {
  const FakeFreeFem fake(scratch_.path());
  tabulation_.geometry = "cavity";
  tabulation_.geometry_parameters = {5};
  tabulation_.container.reset();
  const auto table = tabulate(fake.freefem(), tabulation_, 2, table_path(), no_report);
  EXPECT_EQ(table.geometry, "cavity, radius 5");
  EXPECT_EQ(table.container, "none");
}

TEST_F(Tabulate, ProgressCountsUpToAllRows) {
  const FakeFreeFem fake(scratch_.path());
  std::vector<std::size_t> done;
  (void)tabulate(fake.freefem(), tabulation_, 4, table_path(),
                 [&](const TabulateProgress& progress) {
                   EXPECT_EQ(progress.rows, 4U);
                   EXPECT_GE(progress.seconds_left, 0);
                   done.push_back(progress.rows_done);
                 });
  EXPECT_THAT(done, ElementsAre(1U, 2U, 3U, 4U));
}

TEST_F(Tabulate, FailingRowIsNamedInTheTableTheOthersAreKeptAndNotComputedAgain) {
  const FakeFreeFem fake(
      scratch_.path(),
      "[ $gap = 0.25 ] && [ ! -e \"$folder/mended\" ] && { echo no luck; exit 4; }\n");
  const auto without = tabulate(fake.freefem(), tabulation_, 2, table_path(), no_report);
  EXPECT_EQ(without.rows.size(), 3U);
  EXPECT_THAT(without.failed_rows,
              ElementsAre(Pair("gap 0.25, velocity -1",
                               AllOf(HasSubstr("gap 0.25, velocity -1"), HasSubstr("no luck")))));
  EXPECT_THAT(fake.answered(), UnorderedElementsAre("0.125 -1", "0.5 -1", "1 -1"));
  // The file names the row, too, and whoever reads the record of the table learns of it.
  put_text(table_path(), lubrication::write_motion_table(without));
  std::filesystem::remove(journal_path(table_path()));
  EXPECT_EQ(lubrication::read_force_table(table_path()).failed_rows, without.failed_rows);
  const auto plan = force_table_plan(tabulation_);
  const auto record = read_row_record(table_path(), plan);
  EXPECT_EQ(record.finished.size(), 3U);
  EXPECT_THAT(failures_of(record, plan.points), ElementsAre(HasSubstr("no luck")));

  put_text(scratch_.path() / "mended", "");
  std::vector<std::size_t> done;
  const auto table =
      tabulate(fake.freefem(), tabulation_, 2, table_path(),
               [&](const TabulateProgress& progress) { done.push_back(progress.rows_done); });
  EXPECT_EQ(table.rows.size(), 4U);
  EXPECT_TRUE(table.failed_rows.empty());
  EXPECT_THAT(done, ElementsAre(4U));  // three were there
  EXPECT_THAT(fake.answered(), UnorderedElementsAre("0.125 -1", "0.5 -1", "1 -1", "0.25 -1"));
}

TEST_F(Tabulate, RowThatAnotherProcessFinishesMeanwhileIsNotComputed) {
  // While the first row is computed, a process of a cluster finishes the third.
  const FakeFreeFem fake(scratch_.path(),
                         "[ $gap = 0.125 ] && { touch \"$folder/first\"; sleep 0.5; }\n");
  const FinishedRow elsewhere = {{0.5, -1}, {42, 1, 1e-6, 1000, 1, 4}, "0-fake"};
  std::jthread other([&] {
    while (!std::filesystem::exists(scratch_.path() / "first"))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    RowJournal(journal_path(table_path(), "2-of-4.node.1"), tabulation_hash(tabulation_))
        .append(elsewhere);
  });
  const auto made = tabulate(fake.freefem(), tabulation_, 1, table_path(), no_report);
  EXPECT_EQ(made.rows[2].force, 42);
  EXPECT_THAT(fake.answered(), ElementsAre("0.125 -1", "0.25 -1", "1 -1"));
}

TEST_F(Tabulate, WithAllRowsFinishedNeedsNoFreeFem) {
  const FakeFreeFem fake(scratch_.path());
  const auto made = tabulate(fake.freefem(), tabulation_, 2, table_path(), no_report);
  const auto again = tabulate({"no-such-freefem", "."}, tabulation_, 2, table_path(), no_report);
  EXPECT_EQ(values_of(made), values_of(again));
  EXPECT_EQ(made.versions, again.versions);
}

TEST_F(Tabulate, WorkerOfAClusterLeavesInItsJournalThatFreeFemIsMissing) {
  const RowWorker worker = {{"no-such-freefem", "."}, 1, "0-of-1.node.1"};
  const auto plan = force_table_plan(tabulation_);
  EXPECT_THAT(failure(ErrorKind::kExternalProgram,
                      [&] { compute_rows(worker, plan, plan.points, table_path(), no_report); }),
              Names("no-such-freefem"));
  const auto record = read_row_record(table_path(), plan);
  EXPECT_EQ(record.failed.size(), 4U);
  EXPECT_THAT(record.failed.at({0.5, -1}), Names("no-such-freefem"));
}

TEST_F(Tabulate, JournalOfAnotherTabulationIsNotUsed) {
  const FakeFreeFem fake(scratch_.path());
  (void)tabulate(fake.freefem(), tabulation_, 1, table_path(), no_report);
  tabulation_.container->radius = 6;
  (void)tabulate(fake.freefem(), tabulation_, 1, table_path(), no_report);
  EXPECT_EQ(fake.answered().size(), 8U);
}

TEST(TabulationHash, ChangesWithEverythingThatTheForceDependsOn) {
  const auto base = unit_tabulation({0.5, 1}, 5, 1e-3);
  const auto changed = [&](auto change) {
    auto other = base;
    change(other);
    return tabulation_hash(other);
  };
  const std::vector<std::string> hashes = {
      tabulation_hash(base),
      changed([](Tabulation& t) { t.viscosity = 2; }),
      changed([](Tabulation& t) { t.radius = 2; }),
      changed([](Tabulation& t) {
        t.gaps = {0.5, 1.0000000000000002};
      }),
      changed([](Tabulation& t) { t.reference_velocities = {1}; }),
      changed([](Tabulation& t) {
        t.reference_velocities = {-1, 1};
      }),
      changed([](Tabulation& t) { t.container->radius = 6; }),
      changed([](Tabulation& t) { t.container->height = 11; }),
      changed([](Tabulation& t) { t.relative_accuracy = 1e-4; }),
      changed([](Tabulation& t) { t.geometry = "free_surface"; }),
  };
  for (std::size_t i = 0; i < hashes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(hashes[i], hashes[j]) << i << " and " << j;
  EXPECT_EQ(tabulation_hash(base), tabulation_hash(unit_tabulation({0.5, 1}, 5, 1e-3)));
}

TEST(TabulateWithFreeFem, TwoGapsInAWideContainerAreBrenners) {
  const TemporaryFolder scratch;
  constexpr double kAccuracy = 1e-3;
  const auto tabulation = unit_tabulation({0.05, 0.5}, 40, kAccuracy);
  const auto table =
      tabulate(default_freefem(), tabulation, 2, scratch.path() / "table.csv", no_report);
  ASSERT_EQ(table.rows.size(), 2U);
  for (const auto& row : table.rows) {
    EXPECT_LE(row.relative_error_estimate, kAccuracy);
    // The walls add 4e-6 at 40 x 80 radii (docs/theory.md, section 1), well below what was asked.
    EXPECT_NEAR(row.force_factor / brenner_drag_factor(row.gap), 1, kAccuracy);
  }
  EXPECT_FALSE(table.versions.at("FreeFEM").empty());
}

}  // namespace
}  // namespace viscontact::freefem_axi
