// Splits command lines into words, and quotes words for a POSIX shell.
#pragma once

#include <string>
#include <vector>

namespace viscontact {

/// The words of a command line. Blanks separate them, except between ' or ". Throws
/// Error(kWrongUsage) if a quote is not closed.
std::vector<std::string> split_words(const std::string& text);

/// A word in the form in which a POSIX shell reads it as one word.
std::string shell_word(const std::string& text);

}  // namespace viscontact
