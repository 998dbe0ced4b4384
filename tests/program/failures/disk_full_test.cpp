// A disk that takes no more, played by the shell's limit on the size of files: the kernel then
// refuses the write (EFBIG).
#include <gmock/gmock.h>

#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// In units of 512 bytes: enough for the messages on standard error, which is a file too, and for
// three rows of a journal, not for any output of a stage.
constexpr const char* kSmallFilesOnly = "ulimit -f 1;";

class DiskFull : public ::testing::Test {
 protected:
  DiskFull() { put_text(path("table.csv"), exact_table_text()); }
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

  TemporaryFolder scratch_;
};

TEST_F(DiskFull, FitFailsCleanlyAndTheOldFileStays) {
  put_text(path("fit.json"),
           R"({"provenance": {"command":[]}, "gap_interval": "of an older fit"})");
  const auto before = files_below(scratch_.path());
  const auto result =
      run_viscontact({"fit", path("table.csv"), "-o", path("fit.json")}, {}, kSmallFilesOnly);
  expect_refusal(result, ErrorKind::kBadInput, Names("fit.json"));
  EXPECT_EQ(files_below(scratch_.path()), before);
}

TEST_F(DiskFull, ParticlesFailCleanlyIfNotEvenTheFirstFrameFits) {
  std::string text = read_file(VISCONTACT_SOURCE_FOLDER "/data/cases/particles/raft.toml");
  put_text(path("raft.toml"), text);
  put_text(path("raft.csv"), read_file(VISCONTACT_SOURCE_FOLDER "/data/cases/particles/raft.csv"));
  const auto result =
      run_viscontact({"particles", path("raft.toml"), "-o", path("out")}, {}, kSmallFilesOnly);
  expect_refusal(result, ErrorKind::kBadInput, Names("particles_00000.vtp"));
  EXPECT_FALSE(std::filesystem::exists(path("out")));  // nothing was put there
}

TEST_F(DiskFull, FolderThatCannotBeWrittenIsSaidWithoutAPromiseOfKeptRows) {
  // Nobody, not even root, can make a file in /sys.
  const TemporaryFolder elsewhere;
  const freefem_axi::FakeFreeFem fake(elsewhere.path());
  put_text(path("case.toml"), gentle_case_text());
  const std::string exact =
      replaced(replaced(gentle_case_text(), "basis = \"lecture\"", "exact = \"plane\""),
               "weights = \"relative\"", "");
  put_text(path("exact.toml"), exact);
  const std::vector<std::vector<std::string>> commands = {
      {"tabulate", path("case.toml"), "-o", "/sys/table.csv"},
      {"sweep", path("exact.toml"), "-o", "/sys/rows.csv", "--vary", "fluid.viscosity=1,2"}};
  for (const auto& command : commands)
    expect_refusal(run_viscontact(command, {"VISCONTACT_FREEFEM=" + fake.executable()}),
                   ErrorKind::kBadInput,
                   AllOf(Not(HasSubstr("kept")), Not(HasSubstr("continues"))));
  EXPECT_TRUE(fake.answered().empty());
}

TEST_F(DiskFull, TabulateFailsCleanlyWhenTheJournalIsFull) {
  const TemporaryFolder elsewhere;
  const freefem_axi::FakeFreeFem fake(elsewhere.path());
  put_text(path("case.toml"), lecture_case_text());
  const auto result =
      run_viscontact({"tabulate", path("case.toml"), "-o", path("table2.csv"), "--jobs", "1"},
                     {"VISCONTACT_FREEFEM=" + fake.executable()}, kSmallFilesOnly);
  expect_refusal(result, ErrorKind::kBadInput, Names("table2.csv.rows"));
  EXPECT_FALSE(std::filesystem::exists(path("table2.csv")));
  // With room again, the rows that fitted are used.
  EXPECT_GT(fake.answered().size(), 1U);
  expect_done(
      run_viscontact({"tabulate", path("case.toml"), "-o", path("table2.csv"), "--jobs", "1"},
                     {"VISCONTACT_FREEFEM=" + fake.executable()}));
  EXPECT_EQ(fake.answered().size(), 40U + 1U);  // once each, and twice the one that found no room
}

}  // namespace
}  // namespace viscontact
