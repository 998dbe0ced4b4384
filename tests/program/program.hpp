// Runs the program viscontact as its users do, and returns its exit status, standard output and
// standard error.
#pragma once

#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/common/names.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact {

struct ProgramResult {
  int exit_status = 0;  ///< 128 + signal if a signal ended it
  std::string output;   ///< standard output
  std::string errors;   ///< standard error
};

/// Runs viscontact. Each element of `environment` is "NAME=value". `shell_before` is a shell
/// command, such as "ulimit ...", that runs before viscontact in the same process; empty: none.
ProgramResult run_viscontact(const std::vector<std::string>& arguments,
                             const std::vector<std::string>& environment = {},
                             const std::string& shell_before = "");

/// Expects the exit status 0. Otherwise the failure shows standard error.
void expect_done(const ProgramResult& result);

/// Expects that the program ended with the exit code of `kind`, and that standard error has, after
/// lines of progress ("tabulate: ..."), one or two lines, the first of which starts with
/// "viscontact: " and matches `matcher`, such as Names("case.toml:3", "sphere.radius").
void expect_refusal(const ProgramResult& result, ErrorKind kind,
                    const ::testing::Matcher<std::string>& matcher = ::testing::_);

/// Matches standard error that says that this result is up to date; "" matches any result.
MATCHER_P(IsUpToDate, what, "says that " + std::string(what) + " is up to date") {
  const std::string text = arg, result(what);
  for (const char* words : {" is up to date", " are up to date", ": up to date"})
    if (text.find(result + words) != std::string::npos) return true;
  return false;
}
/// Matches standard error that says that a run of particles continues an earlier one.
MATCHER(Continues, "says that the run continues") {
  return std::string(arg).find("continues from t = ") != std::string::npos;
}

/// The paths of all files below a folder with their bytes; also those of folders, with an empty
/// text.
std::map<std::string, std::string> files_below(const std::filesystem::path& folder);

}  // namespace viscontact
