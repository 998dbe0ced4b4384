#include "viscontact/freefem_axi/journal/row_journal.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/tabulations.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/freefem_axi/journal/row_record.hpp"
#include "viscontact/freefem_axi/motion_table_plan.hpp"

namespace viscontact::freefem_axi {
namespace {

using ::testing::StartsWith;

constexpr const char* kHash = "hash-of-this-tabulation";

// Numbers with no short decimal form: they must come back bit by bit.
const FinishedRow kFirst = {
    {1.0 / 3, -1}, {56.0 / 9, 1.0 / 7, 1e-7 / 3, 12345, 0.1, 35.0 / 9}, "4.9"};
const FinishedRow kSecond = {
    {2.0 / 3, -1}, {28.0 / 9, 1.0 / 11, 1e-300, 54321, 0.2, -0.1}, "4.9 (of 2021)"};

RowPoint point_of(const FinishedRow& finished) { return finished.point; }

/// A plan with this hash, whose rows have two numbers for the point and six more.
TablePlan plan_of(const std::string& hash) {
  auto plan = force_table_plan(unit_tabulation({0.5}, 5, 1e-3));
  plan.hash = hash;
  return plan;
}

void expect_equal(const FinishedRow& a, const FinishedRow& b) {
  EXPECT_EQ(a.point, b.point);
  EXPECT_EQ(a.numbers, b.numbers);
  EXPECT_EQ(a.freefem_version, b.freefem_version);
}

class RowJournalFile : public ::testing::Test {
 protected:
  void write(const std::vector<JournalEntry>& entries, const std::string& writer = "") const {
    RowJournal journal(journal_path(table(), writer), kHash);
    for (const auto& entry : entries) journal.append(entry);
  }
  RowRecord record(const std::string& hash = kHash) const {
    return read_row_record(table(), plan_of(hash));
  }
  std::filesystem::path table() const { return scratch_.path() / "sub" / "table.csv"; }
  std::filesystem::path path() const { return journal_path(table()); }

  TemporaryFolder scratch_;
};

TEST(WriterName, IsRecognised) {
  EXPECT_THAT(writer_name(12, 345), StartsWith("12-of-345."));
  EXPECT_TRUE(is_writer_name(writer_name(12, 345)));
  for (const char* name : {"", "old", "0-of-1", "0-of-1.host", "0-of-1.host.old", "x-of-1.host.7"})
    EXPECT_FALSE(is_writer_name(name)) << name;
}

TEST_F(RowJournalFile, AppendedRowsAreFoundAtOnceAndLater) {
  {
    RowJournal journal(path(), kHash);
    EXPECT_TRUE(record().finished.empty());
    journal.append(kFirst);
    EXPECT_TRUE(record().finished.contains(point_of(kFirst)));
    journal.append(kSecond);
  }
  ASSERT_EQ(record().finished.size(), 2U);
  expect_equal(record().finished.at(point_of(kFirst)), kFirst);
  expect_equal(record().finished.at(point_of(kSecond)), kSecond);
}

TEST_F(RowJournalFile, RowOfAnotherVelocityGapOrTabulationIsNotFound) {
  write({kFirst});
  EXPECT_FALSE(record().finished.contains({kFirst.point[0], 1}));
  EXPECT_FALSE(record().finished.contains({0.33333, -1}));
  EXPECT_TRUE(record("another-hash").finished.empty());
}

TEST_F(RowJournalFile, RowsOfAllWritersAreFoundTogether) {
  write({kFirst});
  write({kSecond}, "3-of-40.node.17");
  EXPECT_EQ(record().finished.size(), 2U);
}

TEST_F(RowJournalFile, JournalsOfATableOfSimilarNameAreNotTaken) {
  RowJournal(journal_path(table().parent_path() / "other_table.csv"), kHash).append(kFirst);
  RowJournal(journal_path(table().parent_path() / "table.csv2"), kHash).append(kFirst);
  EXPECT_TRUE(record().finished.empty());
}

TEST_F(RowJournalFile, FailureIsKeptUntilTheRowIsFinishedWhoeverDoesIt) {
  const FailedRow failed = {point_of(kFirst), "FreeFEM failed at gap 1/3:\nno solution"};
  write({failed}, "0-of-2.node.1");
  EXPECT_EQ(record().failed.at(point_of(kFirst)), "FreeFEM failed at gap 1/3: no solution");
  write({kFirst}, "0-of-2.node.2");
  EXPECT_TRUE(record().failed.empty());
}

TEST_F(RowJournalFile, LineTornByACrashIsIgnoredWhereverItBrokeAndTheNextRowIsWhole) {
  write({kFirst, kSecond});
  const std::string whole = read_file(path());
  const auto second_line = whole.find('\n') + 1;
  for (std::size_t length = second_line; length < whole.size(); ++length) {
    put_text(path(), whole.substr(0, length));
    EXPECT_TRUE(record().finished.contains(point_of(kFirst))) << "cut after " << length;
    EXPECT_FALSE(record().finished.contains(point_of(kSecond))) << "cut after " << length;
    write({kSecond});
    ASSERT_TRUE(record().finished.contains(point_of(kSecond))) << "cut after " << length;
    expect_equal(record().finished.at(point_of(kSecond)), kSecond);
  }
}

TEST_F(RowJournalFile, LineWithAByteLostOrChangedIsIgnored) {
  write({kFirst});
  const std::string line = read_file(path());
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    put_text(path(), line.substr(0, i) + line.substr(i + 1));
    EXPECT_TRUE(record().finished.empty()) << "without byte " << i;
    std::string changed = line;
    changed[i] = changed[i] == '\0' ? ' ' : '\0';  // what a power cut leaves of a block
    put_text(path(), changed);
    EXPECT_TRUE(record().finished.empty()) << "byte " << i << " changed";
  }
}

TEST_F(RowJournalFile, RowAppendedAfterTheDiskWasFullForAWhileIsWhole) {
  // The first row fits, the second does not, and the same process continues when the disk has room.
  write({kFirst});
  const auto room = std::filesystem::file_size(path()) + 10;
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before = {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit full = before;
  full.rlim_cur = room;
  RowJournal journal(path(), kHash);
  ::setrlimit(RLIMIT_FSIZE, &full);
  EXPECT_THAT(failure(ErrorKind::kBadInput, [&] { journal.append(kSecond); }),
              IsAt(path().string()));
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(record().finished.size(), 1U);
  journal.append(kSecond);
  EXPECT_EQ(record().finished.size(), 2U);
}

TEST_F(RowJournalFile, SecondHolderIsRefusedUntilTheFirstLetsGo) {
  {
    RowJournal journal(path(), kHash);
    journal.append(kFirst);
    EXPECT_THAT(failure(ErrorKind::kBadInput, [&] { const RowJournal second(path(), kHash); }),
                IsAt(path().string()));
    journal.append(kSecond);
  }
  write({});
  EXPECT_EQ(record().finished.size(), 2U);
}

TEST_F(RowJournalFile, JournalsOfAWrittenTableAreRemoved) {
  write({kFirst});
  write({kSecond}, "1-of-2.node.1");
  remove_journals(table(), kHash);
  EXPECT_TRUE(std::filesystem::is_empty(table().parent_path()));
}

TEST_F(RowJournalFile, FilesOfTheUserWhoseNamesBeginLikeAJournalsStay) {
  write({kFirst});
  for (const auto* name : {"table.csv.rows.notes.txt", "table.csv.rows.csv", "table.csv.rows2"})
    put_text(table().parent_path() / name, "mine");
  remove_journals(table(), kHash);
  EXPECT_FALSE(std::filesystem::exists(path()));
  for (const auto* name : {"table.csv.rows.notes.txt", "table.csv.rows.csv", "table.csv.rows2"})
    EXPECT_TRUE(std::filesystem::exists(table().parent_path() / name)) << name;
}

TEST_F(RowJournalFile, RowsOfAnotherTabulationStayInTheJournal) {
  write({kFirst});
  RowJournal(path(), "another-hash").append(kSecond);
  remove_journals(table(), kHash);
  EXPECT_TRUE(record().finished.empty());
  EXPECT_EQ(record("another-hash").finished.size(), 1U);
  remove_journals(table(), "another-hash");
  EXPECT_FALSE(std::filesystem::exists(path()));
}

TEST_F(RowJournalFile, JournalThatIsHeldIsLeftAsItIs) {
  RowJournal held(journal_path(table(), "1-of-2.node.2"), kHash);
  remove_journals(table(), kHash);
  held.append(kFirst);
  EXPECT_EQ(record().finished.size(), 1U);
}

TEST_F(RowJournalFile, RowsOfAFinishedTableCountAsFinished) {
  const auto tabulation = unit_tabulation({0.5}, 5, 1e-3);
  lubrication::MotionTable table_of_first;
  table_of_first.viscosity = table_of_first.radius = 1;
  table_of_first.case_hash = tabulation_hash(tabulation);
  table_of_first.versions["FreeFEM"] = "4.9";
  auto& row = table_of_first.rows.emplace_back();
  row.gap = kFirst.point[0];
  row.reference_velocity = kFirst.point[1];
  row.force = kFirst.numbers[0];
  row.force_factor = kFirst.numbers[1];
  row.relative_error_estimate = kFirst.numbers[2];
  row.degrees_of_freedom = kFirst.numbers[3];
  row.seconds = kFirst.numbers[4];
  row.observed_order = kFirst.numbers[5];
  write_file(table(), lubrication::write_motion_table(table_of_first));
  const auto of_table = read_row_record(table(), force_table_plan(tabulation));
  ASSERT_TRUE(of_table.finished.contains(point_of(kFirst)));
  expect_equal(of_table.finished.at(point_of(kFirst)), kFirst);
  const auto other = read_row_record(table(), force_table_plan(unit_tabulation({0.5}, 6, 1e-3)));
  EXPECT_TRUE(other.finished.empty());
}

TEST_F(RowJournalFile, PlaceThatCannotBeWrittenIsBadInputThatNamesIt) {
  // A folder where the file should be, and a file where its folder should be: refused to root as
  // well.
  const auto folder = scratch_.path() / "folder.rows";
  std::filesystem::create_directory(folder);
  EXPECT_THAT(failure(ErrorKind::kBadInput, [&] { const RowJournal journal(folder, kHash); }),
              IsAt(folder.string()));
  put_text(scratch_.path() / "file", "");
  const auto below = scratch_.path() / "file" / "table.csv.rows";
  EXPECT_THAT(failure(ErrorKind::kBadInput, [&] { const RowJournal journal(below, kHash); }),
              Names((scratch_.path() / "file").string()));
}

}  // namespace
}  // namespace viscontact::freefem_axi
