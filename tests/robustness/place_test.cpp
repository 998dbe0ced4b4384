// The whole pipeline, FreeFEM and gnuplot too, in places that programs are not tried in: names that
// a shell takes apart, no home, no temporary folder, a decimal comma. Every number is the same.
#include <gmock/gmock.h>

#include <sstream>

#include "tests/common/temporary_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/robustness/whole_outputs.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/system/process.hpp"

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

/// The pictures' lines but for the one that says when and how they were made.
std::string pictures_below(const fs::path& folder) {
  std::string text;
  for (const auto& [name, content] : files_below(folder)) {
    if (!name.ends_with(".svg")) continue;
    std::istringstream lines(content);
    for (std::string line; std::getline(lines, line);)
      if (line.find("provenance") == std::string::npos) text += line + "\n";
  }
  return text;
}

TEST(Place, OfAnyNamesAndLocaleIsFitForThePipelineWithFreeFem) {
  const TemporaryFolder scratch;
  // A locale of our own, so that nothing need be set up on the machine.
  const auto made = run_process(
      {"localedef", "-i", "fr_FR", "-f", "UTF-8", (scratch.path() / "fr_FR.UTF-8").string()});
  ASSERT_EQ(made.exit_status, 0) << made.output << " (package locales)";
  std::vector<std::string> french = {"LOCPATH=" + scratch.path().string(), "LC_ALL=fr_FR.UTF-8",
                                     "LANG=fr_FR.UTF-8"};
  ASSERT_EQ(run_process({"/usr/bin/printf", "%.1f", "0,5"}, french).output, "0,5");
  // A home that cannot be written, no temporary folder, and a decimal comma.
  french.insert(french.end(), {"HOME=/proc", "TMPDIR=/nonexistent", "XDG_CONFIG_HOME=/proc"});
  const auto comma = scratch.path() / "dossier à l'été, \"bis\" $HOME `x` %d & co; #1";
  const std::string output = "résultats d'août (1)";
  expect_whole_run(comma, "cas n° 1 – final.toml", output, french);
  // Names that are no UTF-8, and no home at all.
  const auto point = scratch.path() / "dossier_\xE9t\xE9";
  const std::string other_output = "sortie_\xE9";
  expect_whole_run(point, "cas_\xE9.toml", other_output, {"LC_ALL=C"},
                   "unset HOME TMPDIR USER LOGNAME;");
  EXPECT_EQ(numbers_below(comma / output), numbers_below(point / other_output));
  EXPECT_EQ(pictures_below(comma / output), pictures_below(point / other_output));
}

}  // namespace
}  // namespace viscontact
