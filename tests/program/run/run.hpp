// `viscontact run` on a case of six gaps, with a script in the place of FreeFEM.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"

namespace viscontact {

/// The path of each file below a folder, and the time at which it was last written.
inline std::map<std::string, std::filesystem::file_time_type> write_times(
    const std::filesystem::path& folder) {
  std::map<std::string, std::filesystem::file_time_type> times;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) times[entry.path().string()] = entry.last_write_time();
  return times;
}

/// The text of gentle_case_text() with the exact drag of a plane instead of a fit.
inline std::string exact_case_text() {
  return replaced(replaced(gentle_case_text(), "basis = \"lecture\"", "exact = \"plane\""),
                  "weights = \"relative\"", "");
}

class Run : public ::testing::Test {
 protected:
  Run() : fake_(scratch_.path()) { put_text(case_file(), gentle_case_text()); }

  ProgramResult run() const {
    return run_viscontact({"run", case_file().string(), "-o", folder().string(), "--jobs", "2"},
                          {"VISCONTACT_FREEFEM=" + fake_.executable()});
  }
  std::filesystem::path case_file() const { return scratch_.path() / "case.toml"; }
  std::filesystem::path folder() const { return scratch_.path() / "run"; }
  std::filesystem::path trajectory(const std::string& model) const {
    return folder() / "trajectories" / (model + ".csv");
  }

  TemporaryFolder scratch_;
  freefem_axi::FakeFreeFem fake_;
};

}  // namespace viscontact
