// The viscontact program as its users meet it: arguments in; exit status, standard output and
// standard error out.
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

/// Runs viscontact. `environment` is "NAME=value" each; `shell_before` is run by the shell that
/// then becomes viscontact ("ulimit ...").
ProgramResult run_viscontact(const std::vector<std::string>& arguments,
                             const std::vector<std::string>& environment = {},
                             const std::string& shell_before = "");

/// Expects exit status 0, and standard error as a trailing message if not.
void expect_done(const ProgramResult& result);

/// Expects an ordinary refusal: that exit code; after progress lines ("tabulate: ...") one or two
/// lines, the first of which starts with "viscontact: " and matches `message`.
void expect_refusal(const ProgramResult& result, ErrorKind kind,
                    const ::testing::Matcher<std::string>& message);

/// Every file below a folder with its bytes; folders too, with none.
std::map<std::string, std::string> files_below(const std::filesystem::path& folder);

}  // namespace viscontact
