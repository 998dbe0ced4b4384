// Completion of the command line by the shells, made from the command line itself.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace viscontact {

/// A script for bash, to be sourced or put among its completions as "viscontact": commands, options, words to choose from, files.
std::string bash_completion(const CLI::App& app);

/// A function for zsh, to be put on its fpath as "_viscontact"; with descriptions.
std::string zsh_completion(const CLI::App& app);

}  // namespace viscontact
