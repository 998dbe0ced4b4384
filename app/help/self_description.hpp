// The manual page, and scripts by which shells complete the command line, from CLI11's options.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace viscontact::app {

/// The text of --help below the commands: exit codes and environment variables.
std::string help_footer();

/// The page viscontact(1) in the language roff: every command with its options. `version` is that
/// of Viscontact, such as "1.0". Here and below `app` must have all commands.
std::string manual(const CLI::App& app, const std::string& version);

/// A script for bash that completes the names of commands, options and files, and the values of
/// options that take one of several words. The user sources it, or installs it as "viscontact" in
/// bash's folder of completions.
std::string bash_completion(const CLI::App& app);

/// A function for zsh that completes the same words and shows the descriptions of options. The user
/// installs it as "_viscontact" in a folder of zsh's list fpath.
std::string zsh_completion(const CLI::App& app);

}  // namespace viscontact::app
