// Regular expressions (ECMAScript) for tests. They are compiled in one file, because <regex> takes
// several seconds in each file that uses it.
#pragma once

#include <string>
#include <vector>

namespace viscontact {

/// `text` with every match replaced; $1 in `replacement` is the first group.
std::string replaced_matches(const std::string& text, const std::string& pattern,
                             const std::string& replacement);

bool has_match(const std::string& text, const std::string& pattern);

/// For each match in the text, the whole match and then its groups.
std::vector<std::vector<std::string>> matches_in(const std::string& text,
                                                 const std::string& pattern);

/// Group number `group` of each match; 0 is the whole match.
std::vector<std::string> matches_in(const std::string& text, const std::string& pattern,
                                    std::size_t group);

}  // namespace viscontact
