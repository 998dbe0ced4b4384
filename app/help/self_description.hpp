// What the program says of its own command line: the manual page, and scripts by which shells
// complete the command line. They are made from CLI11's list of options, so that they always agree
// with --help. main.cpp prints them. A change must keep that every option is in all of them.
// Nothing is thrown; no text is empty. `app` must have all its commands.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace viscontact::app {

/// The text of --help below the commands: exit codes and environment variables.
std::string help_footer();

/// The page viscontact(1) in the language roff: every command with its options. `version` is that
/// of Viscontact, such as "1.0".
std::string manual(const CLI::App& app, const std::string& version);

/// A script for bash that completes commands, options, words of a choice and files. The user
/// sources it, or installs it as "viscontact" in bash's folder of completions.
std::string bash_completion(const CLI::App& app);

/// A function for zsh, with descriptions, to be installed as "_viscontact" in a folder of fpath.
std::string zsh_completion(const CLI::App& app);

}  // namespace viscontact::app
