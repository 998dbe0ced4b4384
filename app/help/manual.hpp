// The manual page. It is made from CLI11's list of options, so that it always agrees with --help.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace viscontact::app {

/// The text of --help below the commands: exit codes and environment variables.
std::string help_footer();

/// The page viscontact(1) in the language roff: every command with its options.
std::string manual(const CLI::App& app, const std::string& version);

}  // namespace viscontact::app
