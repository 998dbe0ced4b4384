// Words of command lines, split and quoted for a POSIX shell.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace viscontact {

/// Blanks, tabs and line ends separate words, except between two ' or two ", which do not belong to
/// the word. A backslash has no special meaning. '' is an empty word. Throws Error(kWrongUsage) if
/// a quotation mark is not closed.
std::vector<std::string> split_words(const std::string& text);

/// The text, which has no NUL, in quotation marks if a shell would not read it as one word.
std::string shell_word(const std::string& text);

/// The words, each quoted by shell_word() and after a blank.
std::string shell_arguments(std::span<const std::string> words);

}  // namespace viscontact
