#include "tests/common/regular_expressions.hpp"

#include <regex>

namespace viscontact {

std::string replaced_matches(const std::string& text, const std::string& pattern,
                             const std::string& replacement) {
  return std::regex_replace(text, std::regex(pattern), replacement);
}

bool has_match(const std::string& text, const std::string& pattern) {
  return std::regex_search(text, std::regex(pattern));
}

std::vector<std::vector<std::string>> matches_in(const std::string& text,
                                                 const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::vector<std::string>> matches;
  for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
    matches.emplace_back(match->begin(), match->end());
  return matches;
}

std::vector<std::string> matches_in(const std::string& text, const std::string& pattern,
                                    std::size_t group) {
  std::vector<std::string> found;
  for (const auto& match : matches_in(text, pattern)) found.push_back(match.at(group));
  return found;
}

}  // namespace viscontact
