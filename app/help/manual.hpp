// The manual page, made from the command line itself.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace viscontact {

/// What --help of the program says below its commands: exit codes and environment.
std::string help_footer();

/// viscontact(1) in the language of man: every command with its options as --help has them.
std::string manual(const CLI::App& app, const std::string& version);

}  // namespace viscontact
