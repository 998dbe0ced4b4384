// A limit on how many parts a dotted TOML key has.
#pragma once

#include <string>

namespace viscontact {

/// Throws Error(kBadInput) that names `file` and the line if a key or the name of a section in the
/// TOML text has more than 16 parts joined by dots. To be called before the text is parsed: toml++
/// 3.3 makes a nested table for each part and visits them by recursion, so that a key of 40 000
/// parts overflows the stack. It limits nested arrays and inline tables by itself, to 256.
void check_dotted_keys(const std::string& text, const std::string& file);

}  // namespace viscontact
