// Sweeps that a signal ends: the same command continues from the rows that are finished.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <csignal>
#include <sstream>
#include <string>

#include "tests/program/program.hpp"
#include "tests/program/sweep/sweep_command.hpp"
#include "tests/program/undisturbed.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

using ::testing::StartsWith;

class InterruptedSweep : public SweepCommand {
 protected:
  /// So many that a signal comes in time: on a machine with other work, the shell that sends it may
  /// look at the file only some tenths of a second after the rows it waits for were written.
  static constexpr int kRows = 4000;

  /// Some seconds of work.
  ProgramResult run(const std::string& output, const std::string& shell_before = "") const {
    return sweep(data("cases/time_step.toml"),
                 {"--vary", fmt::format("viscous_contact.time_step=1e-2:2e-2:{}", kRows)}, output,
                 shell_before);
  }

  /// Shell text that sends the signal to the program that the shell becomes, as soon as so many
  /// lines are in a file.
  static std::string signal_at(const std::string& file, std::ptrdiff_t lines,
                               const std::string& signal) {
    return fmt::format(
        "(while kill -0 $$ && ! [ \"$(wc -l < \"{}\")\" -ge {} ]; do sleep 0.005; done; kill -{} "
        "$$) >/dev/null 2>&1 & ",
        file, lines, signal);
  }

  /// Whole rows that an ended run has left.
  std::ptrdiff_t kept(const std::string& output) const {
    const auto part = read_file(path(output + ".part"));
    EXPECT_THAT(part, StartsWith("# provenance: "));
    // The last line is torn, or empty.
    std::ptrdiff_t whole = 0;
    std::istringstream text(part.substr(0, part.rfind('\n') + 1));
    for (std::string line; std::getline(text, line);) whole += line.starts_with('#') ? 0 : 1;
    return whole - 1;  // the columns' names
  }
};

TEST_F(InterruptedSweep, KeepsAllFinishedRowsAndEndsWithTheFileOfAnUndisturbedOne) {
  expect_done(run("undisturbed.csv"));
  std::ptrdiff_t before = 0;
  for (const std::string signal : {"KILL", "INT", "TERM"}) {
    // The number of lines is counted from the rows that are there when the run begins. A run that
    // finds them all would get its signal before the program has taken over its signals.
    const auto at = before + 200;
    const auto ended = run("rows.csv", signal_at(path("rows.csv.part"), at, signal));
    const auto rows = kept("rows.csv");
    if (signal == "KILL") {
      ASSERT_EQ(ended.exit_status, 128 + SIGKILL) << ended.errors;
    } else {
      expect_refusal(ended, ErrorKind::kInterrupted,
                     Names(fmt::format("interrupted; {} of {} rows are kept in", rows, kRows),
                           "rows.csv.part"));
      EXPECT_GT(rows, at - 100);  // lines, with the header
    }
    EXPECT_FALSE(std::filesystem::exists(path("rows.csv")));
    EXPECT_GT(rows, before);
    before = rows;
  }
  ASSERT_LT(before, kRows);
  const auto last = run("rows.csv");
  expect_done(last);
  EXPECT_THAT(last.errors, Names(fmt::format("{} of them already computed", before)));
  EXPECT_EQ(rest_of(path("rows.csv")), rest_of(path("undisturbed.csv")));
  EXPECT_FALSE(std::filesystem::exists(path("rows.csv.part")));
}

}  // namespace
}  // namespace viscontact
