// Command lines taken apart into words, and words made fit for a shell.
#pragma once

#include <string>
#include <vector>

namespace viscontact {

/// The words of a command line: blanks part them, except between ' or ". Throws Error(kWrongUsage) for a quote
/// without an end.
std::vector<std::string> split_words(const std::string& text);

/// A word as a POSIX shell must be given it.
std::string shell_word(const std::string& text);

}  // namespace viscontact
