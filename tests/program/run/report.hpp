// The report of a run of the lecture's case, which needs no FreeFEM, because the shipped table is
// used.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/common/temporary_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {

class Report : public ::testing::Test {
 protected:
  void run_lecture() {
    std::filesystem::create_directories(folder());
    put_text(folder() / "table.csv",
             read_file(VISCONTACT_SOURCE_FOLDER "/data/tables/lecture.csv"));
    run(lecture_case_text());
  }
  void run(const std::string& case_text) {
    put_text(scratch_.path() / "case.toml", case_text);
    expect_done(
        run_viscontact({"run", (scratch_.path() / "case.toml").string(), "-o", folder().string()},
                       {"VISCONTACT_FREEFEM=no-such-freefem"}));
  }
  void replace_in(const std::string& file, const std::string& old_part,
                  const std::string& new_part) {
    put_text(folder() / file, replaced(read_file(folder() / file), old_part, new_part));
  }
  std::string page() const { return read_file(folder() / "report.html"); }
  std::filesystem::path folder() const { return scratch_.path() / "run"; }

  TemporaryFolder scratch_;
};

}  // namespace viscontact
