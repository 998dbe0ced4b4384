// Splits command lines into words, and quotes words for a POSIX shell. app/, freefem_flow/,
// motions/, particles/, pipeline/ and report/ use it for commands in messages, in scripts of Slurm
// and in provenance (the record in a file of how it was made). A quotation mark that is not closed
// throws Error(kWrongUsage); every other text is accepted. A change must keep how words are quoted,
// because files of users contain them.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace viscontact {

/// The words of a command line. Blanks, tabs and line ends separate words, except between two ' or
/// two ", which do not belong to the word. A backslash has no special meaning. '' is an empty word;
/// a text of blanks has no word. Throws Error(kWrongUsage) if a quotation mark is not closed.
std::vector<std::string> split_words(const std::string& text);

/// The text in quotation marks, if it needs them, so that a POSIX shell reads it as one word; '' if
/// it is empty. Throws nothing.
std::string shell_word(const std::string& text);

/// The words, each quoted by shell_word() and after a blank; empty if there are no words. Throws
/// nothing.
std::string shell_arguments(std::span<const std::string> words);

}  // namespace viscontact
