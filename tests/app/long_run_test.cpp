// What may befall a tabulation of many hours: kill -9 of viscontact or of a FreeFEM, a torn journal, a full disk. The same command
// goes on, no finished row is computed again, and the table is that of an undisturbed run. (Ctrl-C in order: interrupt_test.cpp.)
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <random>
#include <set>
#include <thread>

#include "tests/app/program.hpp"
#include "tests/app/sample_files.hpp"
#include "tests/app/undisturbed.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/number.hpp"
#include "viscontact/freefem_axi/row_record.hpp"

namespace viscontact {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

/// Shell text that sends the signal to the program that the shell becomes.
std::string signal_after(double seconds, const std::string& signal) {
  return fmt::format("(sleep {:.3f}; kill -{} $$ 2>/dev/null) & ", seconds, signal);
}

/// Twelve gaps at two velocities.
std::string case_of_24_rows() {
  return replaced(replaced(gentle_case_text(), "count = 6", "count = 12"),
                  "reference_velocities = [-1.0]", "reference_velocities = [-1.0, 2.0]");
}

/// Two rows for FreeFEM itself, as easy as they are to be had.
std::string case_of_2_rows() {
  const auto text =
      replaced(gentle_case_text(), "relative_accuracy = 1e-3", "relative_accuracy = 1e-2");
  return replaced(text, "to = 1.5, count = 6", "to = 0.3, count = 2");
}

class LongRun : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

  ProgramResult tabulate(const std::string& table, const std::string& freefem,
                         const std::string& shell_before = "") const {
    return run_viscontact({"tabulate", path("case.toml"), "-o", table, "--jobs", "2"},
                          {"VISCONTACT_FREEFEM=" + freefem}, shell_before);
  }

  /// "GAP VELOCITY" of the rows that are finished: on disk.
  std::set<std::string> finished(const std::string& table) const {
    std::set<std::string> rows;
    const auto hash = tabulation_hash(*read_case(path("case.toml")).tabulation);
    for (const auto& [point, row] : read_row_record(table, hash).finished)
      rows.insert(format_number(point.gap) + " " + format_number(point.reference_velocity));
    return rows;
  }

  /// Runs the command with a signal at a random moment, within `seconds` at first and ever later, until it is
  /// done. `answered` gives the rows that FreeFEM has answered so far.
  template <class Answered>
  void disturb_until_done(const std::string& table, const std::string& freefem, double seconds,
                          const Answered& answered) const {
    std::mt19937 random(20081);  // NOLINT: the same moments each time, as far as a machine has them
    std::uniform_real_distribution<double> moment(0, seconds);
    constexpr int kMostAttempts = 100;
    int disturbed = 0;
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
      const auto before = finished(table);
      const auto answers_before = answered().size();
      const auto signal = std::array{"KILL", "KILL", "INT", "TERM"}.at(random() % 4);
      const double later = seconds * attempt / 10;
      const auto result = tabulate(table, freefem, signal_after(later + moment(random), signal));
      const auto answers = answered();
      for (auto i = answers_before; i < answers.size(); ++i)
        EXPECT_FALSE(before.contains(answers[i])) << answers[i] << " was finished";
      const auto after = finished(table);
      EXPECT_TRUE(std::ranges::includes(after, before)) << "a finished row was lost";
      if (result.exit_status == 0 && disturbed > 0) break;
      if (result.exit_status == 0) {  // faster than `seconds`: nothing was disturbed yet
        std::filesystem::remove(table);
        seconds /= 2;
        moment = std::uniform_real_distribution<double>(0, seconds);
        continue;
      }
      EXPECT_THAT(result.exit_status, AnyOf(128 + SIGKILL, 130, 128 + SIGINT, 128 + SIGTERM))
          << result.errors;
      EXPECT_FALSE(std::filesystem::exists(table));
      ++disturbed;
    }
    EXPECT_GT(disturbed, 0);
    EXPECT_FALSE(std::filesystem::exists(table + ".rows"));
  }

  TemporaryFolder scratch_;
};

TEST_F(LongRun, KilledAtRandomMomentsItLosesNoFinishedRowAndEndsWithTheSameTable) {
  const FakeFreeFem fake(scratch_.path(), "sleep 0.03\n");
  put_text(path("case.toml"), case_of_24_rows());
  expect_done(tabulate(path("undisturbed.csv"), fake.executable()));
  disturb_until_done(path("table.csv"), fake.executable(), 0.4, [&] { return fake.answered(); });
  EXPECT_EQ(without_seconds(path("table.csv")), without_seconds(path("undisturbed.csv")));
}

TEST_F(LongRun, WithFreeFemToo) {
  // FreeFEM in a shell that notes which rows it answers.
  const auto freefem = scratch_.file("freefem", R"sh(#!/bin/sh
FreeFem++-nw "$@" || exit
case $4 in
  *version.edp) exit 0 ;;
esac
shift 4
while [ $# -gt 1 ]; do
  case $1 in
    -gap) gap=$2 ;;
    -velocity) velocity=$2 ;;
  esac
  shift 2
done
echo "$gap $velocity" >> ")sh" + path("answered") + "\"\n");
  make_executable(freefem);
  put_text(path("case.toml"), replaced(case_of_2_rows(), "count = 2", "count = 3"));
  const auto start = std::chrono::steady_clock::now();
  expect_done(tabulate(path("undisturbed.csv"), freefem.string()));
  const std::chrono::duration<double> undisturbed = std::chrono::steady_clock::now() - start;
  disturb_until_done(path("table.csv"), freefem.string(), undisturbed.count(), [&] {
    std::vector<std::string> lines;
    std::ifstream file(path("answered"));
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  });
  EXPECT_EQ(without_seconds(path("table.csv")), without_seconds(path("undisturbed.csv")));
}

TEST_F(LongRun, KilledFreeFemIsARowThatFailedTheOthersGoOnAndTheSameCommandFinishes) {
  // FreeFEM itself, killed in the middle of one row as the kernel does when memory is short.
  const auto freefem = scratch_.file("freefem", R"sh(#!/bin/sh
case "$*" in
  *"-gap 0.05 "*) [ -e ")sh" + path("mended") +
                                                    R"sh(" ] || (sleep 0.2; kill -KILL $$) & ;;
esac
exec FreeFem++-nw "$@"
)sh");
  make_executable(freefem);
  put_text(path("case.toml"), case_of_2_rows());
  const auto failed = tabulate(path("table.csv"), freefem.string());
  expect_refusal(failed, ErrorKind::kExternalProgram, HasSubstr("1 of 2 rows failed"));
  EXPECT_THAT(failed.errors,
              AllOf(HasSubstr("gap 0.05, velocity -1"), HasSubstr("ended by signal 9 (Killed)"),
                    Not(HasSubstr("gap 0.3"))));
  EXPECT_THAT(finished(path("table.csv")), SizeIs(1));
  put_text(path("mended"), "");
  expect_done(tabulate(path("table.csv"), freefem.string()));
}

TEST_F(LongRun, FreeFemDoesNotOutliveAViscontactThatIsKilled) {
  const FakeFreeFem fake(scratch_.path(),
                         "[ -e \"$folder/calm\" ] || { echo $$ > \"$folder/row\"; kill -KILL "
                         "$PPID; exec sleep 3600; }\n");
  put_text(path("case.toml"), gentle_case_text());
  const auto killed =
      run_viscontact({"tabulate", path("case.toml"), "-o", path("table.csv"), "--jobs", "1"},
                     {"VISCONTACT_FREEFEM=" + fake.executable()});
  EXPECT_EQ(killed.exit_status, 128 + SIGKILL);
  // Within moments it is gone, or a zombie whose new parent has not looked.
  const std::string row = read_file(path("row"));
  const auto state = [&] {
    std::string number, name, letter;
    std::ifstream("/proc/" + row.substr(0, row.find('\n')) + "/stat") >> number >> name >> letter;
    return letter;
  };
  const auto is_gone = AnyOf("", "Z", "X");
  for (int i = 0; i < 100 && !::testing::Matches(is_gone)(state()); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_THAT(state(), is_gone);
  put_text(path("calm"), "");
  expect_done(tabulate(path("table.csv"), fake.executable()));
  EXPECT_THAT(fake.answered(), SizeIs(6));
}

TEST_F(LongRun, TornLineAndRowsOfAnotherCaseInTheJournalAreNoRows) {
  const FakeFreeFem fake(scratch_.path(), "[ -e \"$folder/full\" ] && exit 1\n");
  put_text(path("case.toml"), gentle_case_text());
  // The journal of another case, finished but for its last row...
  put_text(path("case.toml"), replaced(gentle_case_text(), "viscosity = 3.0", "viscosity = 5.0"));
  expect_done(tabulate(path("other.csv"), fake.executable(), ""));
  const FakeFreeFem failing(scratch_.path(), "[ $gap = 1.5 ] && exit 1\n");
  EXPECT_EQ(tabulate(path("table.csv"), failing.executable()).exit_status, 5);
  EXPECT_THAT(finished(path("table.csv")), SizeIs(5));
  // ... to which this case adds its own, the last of them torn.
  put_text(path("case.toml"), gentle_case_text());
  EXPECT_EQ(tabulate(path("table.csv"), failing.executable()).exit_status, 5);
  const std::string journal = read_file(path("table.csv.rows"));
  const auto last_row = journal.rfind(" row ");
  put_text(path("table.csv.rows"), journal.substr(0, last_row + 40));
  EXPECT_THAT(finished(path("table.csv")), SizeIs(4));

  const FakeFreeFem mended(scratch_.path());
  const auto answers_before = mended.answered().size();
  expect_done(tabulate(path("table.csv"), mended.executable()));
  EXPECT_EQ(mended.answered().size(), answers_before + 2);
  expect_done(tabulate(path("undisturbed.csv"), mended.executable()));
  EXPECT_EQ(without_seconds(path("table.csv")), without_seconds(path("undisturbed.csv")));
  // The other case's rows are in no table of that name yet: they are kept.
  put_text(path("case.toml"), replaced(gentle_case_text(), "viscosity = 3.0", "viscosity = 5.0"));
  const auto answers = mended.answered().size();
  expect_done(tabulate(path("table.csv"), mended.executable()));
  EXPECT_EQ(mended.answered().size(), answers + 1);
  EXPECT_EQ(without_seconds(path("table.csv")), without_seconds(path("other.csv")));
  EXPECT_FALSE(std::filesystem::exists(path("table.csv.rows")));
}

/// A file system of a few pages of 4 KiB.
class SmallDisk {
 public:
  explicit SmallDisk(std::filesystem::path place) : place_(std::move(place)) {
    std::filesystem::create_directory(place_);
    mounted_ = ::mount("tmpfs", place_.c_str(), "tmpfs", 0, "size=16k") == 0;
    if (!mounted_) reason_ = std::strerror(errno);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    if (mounted_) ::umount2(place_.c_str(), MNT_DETACH);
  }
  bool mounted() const { return mounted_; }
  const std::string& reason() const { return reason_; }

  /// Leaves so many bytes free.
  void fill_but(std::size_t bytes) const {
    const auto space = std::filesystem::space(place_).available;
    if (space > bytes) put_text(place_ / "filler", std::string(space - bytes, 'x'));
  }
  void make_room() const { std::filesystem::remove(place_ / "filler"); }

 private:
  std::filesystem::path place_;
  bool mounted_ = false;
  std::string reason_;
};

class FullDisk : public LongRun {
 protected:
  void SetUp() override {
    // Root may mount, and the tests of a clone that scripts/setup made run as root: there nothing is skipped. To another user a
    // full disk is shown by the limit on file sizes alone (disk_full_test.cpp).
    if (::geteuid() == 0) {
      ASSERT_TRUE(disk_.mounted()) << disk_.reason();
    }
    if (!disk_.mounted()) GTEST_SKIP() << "mounting a tmpfs is not permitted: " << disk_.reason();
  }
  static constexpr std::size_t kPage = 4096;
  SmallDisk disk_{scratch_.path() / "disk"};
};

TEST_F(FullDisk, JournalThatFindsNoRoomStopsTheRunAndTheSameCommandGoesOn) {
  const FakeFreeFem fake(scratch_.path());
  put_text(path("case.toml"), case_of_24_rows());
  expect_done(tabulate(path("undisturbed.csv"), fake.executable()));
  const auto answers_before = fake.answered().size();
  disk_.fill_but(kPage);  // about 20 rows
  const auto full = tabulate(path("disk/table.csv"), fake.executable());
  expect_refusal(full, ErrorKind::kBadInput,
                 AllOf(HasSubstr("table.csv.rows: cannot be written (No space left on device)"),
                       HasSubstr("the same command goes on")));
  const auto kept = finished(path("disk/table.csv")).size();
  EXPECT_GT(kept, 10U);
  const auto answers_full = fake.answered().size();
  // Two processes: at most two rows found no room.
  EXPECT_LE(answers_full - answers_before, kept + 2);
  disk_.make_room();
  expect_done(tabulate(path("disk/table.csv"), fake.executable()));
  EXPECT_EQ(fake.answered().size(), answers_full + 24 - kept);
  EXPECT_EQ(without_seconds(path("disk/table.csv")), without_seconds(path("undisturbed.csv")));
}

TEST_F(FullDisk, TableThatFindsNoRoomIsWrittenLaterWithoutComputing) {
  const FakeFreeFem fake(scratch_.path());
  put_text(path("case.toml"), gentle_case_text());
  disk_.fill_but(kPage);  // enough for six rows' journal
  const auto full = tabulate(path("disk/table.csv"), fake.executable());
  expect_refusal(full, ErrorKind::kBadInput,
                 HasSubstr("table.csv: cannot be written (No space left on device)"));
  EXPECT_FALSE(std::filesystem::exists(path("disk/table.csv")));
  EXPECT_THAT(finished(path("disk/table.csv")), SizeIs(6));
  disk_.make_room();
  expect_done(tabulate(path("disk/table.csv"), "no-such-freefem"));
  EXPECT_THAT(fake.answered(), SizeIs(6));
  EXPECT_FALSE(std::filesystem::exists(path("disk/table.csv.rows")));
}

}  // namespace
}  // namespace viscontact
