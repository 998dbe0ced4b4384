// Runs tabulations that tests interrupt or let fail, in a temporary folder, and reads which rows
// are finished.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/tabulations.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/freefem_axi/journal/row_record.hpp"

namespace viscontact {

/// The text of gentle_case_text() with twelve gaps and two velocities.
inline std::string case_of_24_rows() {
  return replaced(replaced(gentle_case_text(), "count = 6", "count = 12"),
                  "reference_velocities = [-1.0]", "reference_velocities = [-1.0, 2.0]");
}

class DisturbedTabulation : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

  ProgramResult tabulate(const std::string& table, const std::string& freefem,
                         const std::string& shell_before = "") const {
    return run_viscontact({"tabulate", path("case.toml"), "-o", table, "--jobs", "2"},
                          {"VISCONTACT_FREEFEM=" + freefem}, shell_before);
  }

  /// "GAP VELOCITY" of the rows of a table that are finished, in its journal or in the table.
  std::set<std::string> finished(const std::string& table) const {
    std::set<std::string> rows;
    const auto plan =
        freefem_axi::force_table_plan(*case_file::read_case(path("case.toml")).tabulation);
    for (const auto& [point, row] : freefem_axi::read_row_record(table, plan).finished)
      rows.insert(format_number(point.at(0)) + " " + format_number(point.at(1)));
    return rows;
  }

  TemporaryFolder scratch_;
};

}  // namespace viscontact
