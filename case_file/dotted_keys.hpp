// Limits the number of parts of a dotted TOML key, because a very long key overflows the stack of
// the TOML parser.
#pragma once

#include <string>

namespace viscontact::case_file {

/// Throws Error(kBadInput), which names `file` and the line, if a key or the name of a section in
/// the TOML text has more than 16 parts joined by dots. Must be called before the text is parsed:
/// toml++ 3.3 makes a nested table for each part and visits these tables by recursion, so that a
/// key of 40 000 parts overflows the stack. toml++ itself limits nested arrays and inline tables to
/// 256 levels.
void check_dotted_keys(const std::string& text, const std::string& file);

}  // namespace viscontact::case_file
