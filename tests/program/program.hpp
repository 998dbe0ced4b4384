// Runs the program viscontact as its users do, and returns its exit status, standard output and
// standard error.
#pragma once

#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

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
/// "viscontact: " and matches `message`.
void expect_refusal(const ProgramResult& result, ErrorKind kind,
                    const ::testing::Matcher<std::string>& message);

/// The paths of all files below a folder with their bytes; also those of folders, with an empty
/// text.
std::map<std::string, std::string> files_below(const std::filesystem::path& folder);

}  // namespace viscontact
