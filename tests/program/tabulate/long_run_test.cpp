// Tabulations that are killed: the same command continues, no finished row is computed again, and
// the table is that of an undisturbed run.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <fstream>
#include <random>
#include <thread>

#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/program/tabulate/disturbed_tabulation.hpp"
#include "tests/program/undisturbed.hpp"
#include "viscontact/common/files/file.hpp"

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

/// Two rows for FreeFEM itself, as easy as they are to be had.
std::string case_of_2_rows() {
  const auto text =
      replaced(gentle_case_text(), "relative_accuracy = 1e-3", "relative_accuracy = 1e-2");
  return replaced(text, "to = 1.5, count = 6", "to = 0.3, count = 2");
}

class LongRun : public DisturbedTabulation {
 protected:
  /// Runs the command with a signal at a random moment, within `seconds` at first and ever later,
  /// until it is done.
  void disturb_until_done(const std::string& table, const freefem_axi::FakeFreeFem& fake,
                          double seconds) const {
    std::mt19937 random(20081);  // NOLINT: the same moments each time, as far as a machine has them
    std::uniform_real_distribution<double> moment(0, seconds);
    constexpr int kMostAttempts = 100;
    int disturbed = 0;
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
      const auto before = finished(table);
      const auto answers_before = fake.answered().size();
      const auto signal = std::array{"KILL", "KILL", "INT", "TERM"}.at(random() % 4);
      const double later = seconds * attempt / 10;
      const auto result =
          tabulate(table, fake.executable(), signal_after(later + moment(random), signal));
      const auto answers = fake.answered();
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
};

TEST_F(LongRun, KilledAtRandomMomentsItLosesNoFinishedRowAndEndsWithTheSameTable) {
  const freefem_axi::FakeFreeFem fake(scratch_.path(), "sleep 0.03\n");
  put_text(path("case.toml"), case_of_24_rows());
  expect_done(tabulate(path("undisturbed.csv"), fake.executable()));
  disturb_until_done(path("table.csv"), fake, 0.4);
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
  expect_refusal(failed, ErrorKind::kExternalProgram, Names("1 of 2"));
  EXPECT_THAT(failed.errors,
              AllOf(Names("gap 0.05, velocity -1", "signal 9"), Not(HasSubstr("gap 0.3"))));
  EXPECT_THAT(finished(path("table.csv")), SizeIs(1));
  put_text(path("mended"), "");
  expect_done(tabulate(path("table.csv"), freefem.string()));
}

TEST_F(LongRun, FreeFemDoesNotOutliveAViscontactThatIsKilled) {
  const freefem_axi::FakeFreeFem fake(
      scratch_.path(),
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

}  // namespace
}  // namespace viscontact
