// Matches texts by the facts that they name, whatever their wording.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"

namespace viscontact {

/// True if the text contains the fact, and not only as a part of a longer word or number.
inline bool names_fact(std::string_view text, std::string_view fact) {
  const auto continues = [](char inner, char outer) {
    const auto is_of_word = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    };
    return is_of_word(inner) && is_of_word(outer);
  };
  for (auto at = text.find(fact); at != std::string_view::npos; at = text.find(fact, at + 1)) {
    const auto end = at + fact.size();
    if (fact.empty() || ((at == 0 || !continues(fact.front(), text[at - 1])) &&
                         (end == text.size() || !continues(fact.back(), text[end]))))
      return true;
  }
  return false;
}

class NamesMatcher {
 public:
  explicit NamesMatcher(std::vector<std::string> facts) : facts_(std::move(facts)) {}
  bool MatchAndExplain(const Error& error, ::testing::MatchResultListener* listener) const {
    return MatchAndExplain(std::string(error.what()), listener);
  }
  bool MatchAndExplain(const std::string& text, ::testing::MatchResultListener*) const {
    return std::ranges::all_of(facts_, [&](const auto& fact) { return names_fact(text, fact); });
  }
  void DescribeTo(std::ostream* out) const {
    *out << "names";
    for (const auto& fact : facts_) *out << " \"" << fact << "\"";
  }
  void DescribeNegationTo(std::ostream* out) const {
    *out << "does not name all of";
    for (const auto& fact : facts_) *out << " \"" << fact << "\"";
  }

 private:
  std::vector<std::string> facts_;
};

/// Matches an Error or a text that names each of these facts: places such as "case.toml:3", keys,
/// options, names and values. Not for wording.
template <class... Facts>
auto Names(const Facts&... facts) {
  return ::testing::MakePolymorphicMatcher(NamesMatcher({std::string(facts)...}));
}

/// The same for a list.
inline auto NamesAll(const std::vector<std::string>& facts) {
  return ::testing::MakePolymorphicMatcher(NamesMatcher(facts));
}

/// Matches an Error or a text that has this part, for the one test of a wording that matters to the
/// user, such as a remedy.
MATCHER_P(Says, part, "says \"" + std::string(part) + "\"") {
  if constexpr (std::is_base_of_v<Error, std::decay_t<decltype(arg)>>)
    return std::string_view(arg.what()).find(part) != std::string_view::npos;
  else
    return std::string_view(arg).find(part) != std::string_view::npos;
}

}  // namespace viscontact
