#include "freefem_axi/row_journal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/file.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/expect_error.hpp"

namespace viscontact {
namespace {

using ::testing::HasSubstr;

constexpr const char* kHash = "hash-of-this-tabulation";

// Numbers with no short decimal form: they must come back bit by bit.
const ForceTableRow kFirst = {1.0 / 3, -1, 56.0 / 9, 1.0 / 7, 1e-7 / 3, 12345, 0.1};
const ForceTableRow kSecond = {2.0 / 3, -1, 28.0 / 9, 1.0 / 11, 1e-300, 54321, 0.2};

void expect_equal(const ForceTableRow& a, const ForceTableRow& b) {
  EXPECT_EQ(a.gap, b.gap);
  EXPECT_EQ(a.reference_velocity, b.reference_velocity);
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.drag_factor, b.drag_factor);
  EXPECT_EQ(a.relative_error_estimate, b.relative_error_estimate);
  EXPECT_EQ(a.degrees_of_freedom, b.degrees_of_freedom);
  EXPECT_EQ(a.seconds, b.seconds);
}

class RowJournalFile : public ::testing::Test {
 protected:
  /// A journal that holds both rows, closed.
  void write_both() const {
    RowJournal journal(path(), kHash);
    journal.append(kFirst);
    journal.append(kSecond);
  }
  std::filesystem::path path() const { return scratch_.path() / "sub" / "table.csv.rows"; }

  TemporaryFolder scratch_;
};

TEST_F(RowJournalFile, FindsAppendedRowsAtOnceAndWhenOpenedAgain) {
  {
    RowJournal journal(path(), kHash);
    EXPECT_FALSE(journal.find(kFirst.gap, -1));
    journal.append(kFirst);
    ASSERT_TRUE(journal.find(kFirst.gap, -1));
    journal.append(kSecond);
  }
  const RowJournal journal(path(), kHash);
  ASSERT_TRUE(journal.find(kFirst.gap, -1));
  ASSERT_TRUE(journal.find(kSecond.gap, -1));
  expect_equal(*journal.find(kFirst.gap, -1), kFirst);
  expect_equal(*journal.find(kSecond.gap, -1), kSecond);
}

TEST_F(RowJournalFile, RowOfAnotherVelocityOrGapIsNotFound) {
  write_both();
  const RowJournal journal(path(), kHash);
  EXPECT_FALSE(journal.find(kFirst.gap, 1));
  EXPECT_FALSE(journal.find(0.33333, -1));
}

TEST_F(RowJournalFile, LineTornByACrashIsDroppedWhereverItBroke) {
  write_both();
  const std::string whole = read_file(path());
  const auto second_line = whole.find('\n') + 1;
  for (std::size_t length = second_line; length < whole.size(); ++length) {
    put_text(path(), whole.substr(0, length));
    RowJournal journal(path(), kHash);
    EXPECT_TRUE(journal.find(kFirst.gap, -1)) << "cut after " << length << " bytes";
    EXPECT_FALSE(journal.find(kSecond.gap, -1)) << "cut after " << length << " bytes";
  }
}

TEST_F(RowJournalFile, RowAppendedAfterATornLineIsWhole) {
  write_both();
  const std::string whole = read_file(path());
  put_text(path(), whole.substr(0, whole.size() - 5));
  RowJournal(path(), kHash).append(kSecond);
  EXPECT_EQ(read_file(path()), whole);
}

TEST_F(RowJournalFile, RowsOfAnotherTabulationAreDroppedFromTheFileToo) {
  write_both();
  {
    const RowJournal journal(path(), "another-hash");
    EXPECT_FALSE(journal.find(kFirst.gap, -1));
  }
  EXPECT_EQ(read_file(path()), "");
}

TEST_F(RowJournalFile, SecondHolderIsRefusedUntilTheFirstLetsGo) {
  {
    RowJournal journal(path(), kHash);
    journal.append(kFirst);
    expect_error([&] { const RowJournal second(path(), kHash); }, ExitCode::kBadInput,
                 HasSubstr("another tabulation"));
    journal.append(kSecond);
  }
  const RowJournal later(path(), kHash);
  EXPECT_TRUE(later.find(kFirst.gap, -1));
  EXPECT_TRUE(later.find(kSecond.gap, -1));
}

TEST_F(RowJournalFile, PlaceThatCannotBeWrittenIsBadInputThatNamesIt) {
  // A folder where the file should be, and a file where its folder should be: refused to root as well.
  const auto folder = scratch_.path() / "folder.rows";
  std::filesystem::create_directory(folder);
  expect_error([&] { const RowJournal journal(folder, kHash); }, ExitCode::kBadInput,
               HasSubstr(folder.string()));
  put_text(scratch_.path() / "file", "");
  const auto below = scratch_.path() / "file" / "table.csv.rows";
  expect_error([&] { const RowJournal journal(below, kHash); }, ExitCode::kBadInput,
               HasSubstr((scratch_.path() / "file").string()));
}

}  // namespace
}  // namespace viscontact
