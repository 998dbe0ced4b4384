// Ctrl-C, or the loss of the terminal, during a tabulation or while a case is awaited.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>

#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/lubrication/motion_table.hpp"

namespace viscontact {
namespace {

using ::testing::SizeIs;

class Interrupt : public ::testing::TestWithParam<std::string> {};

TEST_P(Interrupt, KeepsFinishedRowsEndsFreeFemAndTheNextRunComputesOnlyTheRest) {
  const TemporaryFolder scratch;
  const auto path = [&](const std::string& name) { return (scratch.path() / name).string(); };
  // The third row interrupts viscontact and would then take an hour; without the marker file it is
  // a row like any other.
  const freefem_axi::FakeFreeFem fake(scratch.path(), R"sh(
if [ -e "$folder/interrupt" ] && [ "$(wc -l < "$folder/answered")" = 2 ]; then
  rm "$folder/interrupt"; echo $$ > "$folder/slow_row"
  kill -)sh" + GetParam() + R"sh( $PPID
  exec sleep 3600
fi
)sh");
  put_text(path("case.toml"), gentle_case_text());
  put_text(path("interrupt"), "");
  put_text(path("answered"), "");
  const std::vector<std::string> arguments = {"tabulate",        path("case.toml"), "-o",
                                              path("table.csv"), "--jobs",          "1"};
  const std::vector<std::string> environment = {"VISCONTACT_FREEFEM=" + fake.executable()};

  const auto interrupted = run_viscontact(arguments, environment);
  expect_refusal(interrupted, ErrorKind::kInterrupted, Names("interrupted"));
  EXPECT_FALSE(std::filesystem::exists(path("table.csv")));
  const std::string journal = read_file(path("table.csv.rows"));
  EXPECT_EQ(std::count(journal.begin(), journal.end(), '\n'), 2);
  const int slow_row = std::stoi(read_file(path("slow_row")));
  EXPECT_EQ(::kill(slow_row, 0), -1);  // signal 0: does the process exist?
  EXPECT_EQ(errno, ESRCH);

  const auto resumed = run_viscontact(arguments, environment);
  expect_done(resumed);
  EXPECT_THAT(resumed.errors, Names("6 rows", "2", "1 processes"));
  EXPECT_THAT(lubrication::read_force_table(path("table.csv")).rows, SizeIs(6));
  EXPECT_THAT(fake.answered(), SizeIs(6));  // no row twice
  EXPECT_FALSE(std::filesystem::exists(path("table.csv.rows")));
}

TEST_P(Interrupt, EndsTheWaitForACaseInAPipe) {
  const TemporaryFolder scratch;
  const auto pipe = (scratch.path() / "case.toml").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  // The signals are sent after viscontact has said that it catches them (bit 2 of the mask is
  // SIGINT), and again, because the first one may come before the pipe is read.
  const auto interrupt =
      "(while kill -0 $$ && ! grep -q 'SigCgt:.*[2367abef]$' /proc/$$/status; do sleep 0.05; done; "
      "sleep 0.1; "
      "while kill -" +
      GetParam() + " $$; do sleep 0.1; done) >/dev/null 2>&1 & ";
  // First nobody writes into the pipe, then somebody who says nothing.
  for (const auto& writer : {std::string(), "exec 3<>'" + pipe + "';"})
    expect_refusal(run_viscontact({"run", pipe, "-o", (scratch.path() / "out").string()}, {},
                                  interrupt + writer),
                   ErrorKind::kInterrupted, Names(pipe));
}

TEST(InterruptUnderNohup, HangupThatIsIgnoredStaysIgnored) {
  const TemporaryFolder scratch;
  const freefem_axi::FakeFreeFem fake(scratch.path(), "kill -HUP $PPID");
  put_text(scratch.path() / "case.toml", gentle_case_text());
  expect_done(run_viscontact({"tabulate", (scratch.path() / "case.toml").string(), "-o",
                              (scratch.path() / "table.csv").string()},
                             {"VISCONTACT_FREEFEM=" + fake.executable()}, "trap '' HUP;"));
}

INSTANTIATE_TEST_SUITE_P(Signals, Interrupt, ::testing::Values("INT", "TERM", "HUP"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace viscontact
