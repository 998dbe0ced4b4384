// Runs `viscontact sweep` on shipped studies in a temporary folder.
#pragma once

#include <gmock/gmock.h>

#include <sstream>
#include <string>
#include <vector>

#include "tests/common/temporary_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {

inline std::string data(const std::string& name) {
  return std::string(VISCONTACT_SOURCE_FOLDER) + "/data/" + name;
}

class SweepCommand : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

  ProgramResult sweep(const std::string& case_file, const std::vector<std::string>& options,
                      const std::string& output = "rows.csv",
                      const std::string& shell_before = "") const {
    std::vector<std::string> arguments = {"sweep", case_file, "-o", path(output), "--jobs", "2"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_viscontact(arguments, {}, shell_before);
  }

  /// The header line and the rows of a file, without comments.
  std::vector<std::string> lines(const std::string& output = "rows.csv") const {
    std::vector<std::string> found;
    std::istringstream text(read_file(path(output)));
    for (std::string line; std::getline(text, line);)
      if (!line.starts_with('#')) found.push_back(line);
    return found;
  }

  /// Expects that the program refuses these options (expect_refusal()) and writes nothing.
  void expect_refused(const std::string& case_file, const std::vector<std::string>& options,
                      ErrorKind kind, const ::testing::Matcher<std::string>& message) const {
    const auto before = files_below(scratch_.path());
    expect_refusal(sweep(case_file, options), kind, message);
    EXPECT_TRUE(files_below(scratch_.path()) == before) << "something was written";
  }

  /// Writes the shipped case `name` with `from` replaced by `to`, and with an absolute path of its
  /// fit. Returns the path of the new case.
  std::string study(const std::string& name, const std::string& from, const std::string& to) const {
    auto text = replaced(read_file(data("cases/" + name)), from, to);
    if (text.find("\"../fits/") != std::string::npos)
      text = replaced(text, "\"../fits/", "\"" + data("fits/"));
    put_text(path("case.toml"), text);
    return path("case.toml");
  }

  TemporaryFolder scratch_;
};

}  // namespace viscontact
