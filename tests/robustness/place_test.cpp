// The whole pipeline, FreeFEM and gnuplot too, in places that programs are not tried in: names that
// a shell takes apart, no home, no temporary folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/common/temporary_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/robustness/whole_outputs.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

/// The case run from within its folder, by names that are relative to it.
void expect_whole_run(const fs::path& folder, const std::string& case_name,
                      const std::string& output, const std::vector<std::string>& environment,
                      const std::string& shell_before = "") {
  fs::create_directories(folder);
  put_text(folder / case_name, quick_case_text());
  // The shell takes the folder from its environment: no quoting of ours stands between.
  auto with_folder = environment;
  with_folder.push_back("FOLDER_OF_THE_TEST=" + folder.string());
  expect_done(run_viscontact({"run", case_name, "-o", output, "--jobs", "2"}, with_folder,
                             "cd \"$FOLDER_OF_THE_TEST\"; " + shell_before));
  expect_whole_files(folder);
  for (const char* file : {"table.csv", "fit.json", "comparison.json", "report.html",
                           "plots/gap.svg", "trajectories/viscous_contact.csv"})
    EXPECT_TRUE(fs::exists(folder / output / file)) << file;
  EXPECT_EQ(read_file(folder / case_name), quick_case_text());
}

TEST(Place, NamesWithSpacesAccentsQuotesAndSigns) {
  const TemporaryFolder scratch;
  expect_whole_run(scratch.path() / "dossier à l'été, \"bis\" $HOME `x` %d & co; #1",
                   "cas n° 1 – final.toml", "résultats d'août (1)", {});
}

TEST(Place, NamesThatAreNoUtf8) {
  const TemporaryFolder scratch;
  expect_whole_run(scratch.path() / "dossier_\xE9t\xE9", "cas_\xE9.toml", "sortie_\xE9", {});
}

TEST(Place, AHomeThatCannotBeWrittenAndNoTemporaryFolder) {
  const TemporaryFolder scratch;
  expect_whole_run(scratch.path(), "case.toml", "out",
                   {"HOME=/proc", "TMPDIR=/nonexistent", "XDG_CONFIG_HOME=/proc"});
}

TEST(Place, NoHomeAtAll) {
  const TemporaryFolder scratch;
  expect_whole_run(scratch.path(), "case.toml", "out", {}, "unset HOME TMPDIR USER LOGNAME;");
}

}  // namespace
}  // namespace viscontact
