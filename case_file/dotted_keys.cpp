// Scans a TOML text for long dotted keys without parsing it (dotted_keys.hpp). The scan must skip
// the contents of strings and comments, because dots in them separate no keys.
#include "viscontact/case_file/dotted_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "viscontact/common/error.hpp"

namespace viscontact::case_file {
namespace {

/// Position after the string whose opening quote is at `at`; the end of the text if the string is
/// not closed.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string three(3, quote);
  const bool is_long = text.substr(at).starts_with(three);
  const std::size_t width = is_long ? 3 : 1;
  for (std::size_t i = at + width; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\')
      ++i;  // also skips the next character, which may be a quote
    else if (is_long ? text.substr(i).starts_with(three) : text[i] == quote)
      return i + width;
    else if (!is_long && text[i] == '\n')
      return i;  // not valid TOML; the parser reports it
  }
  return text.size();
}

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// True for characters that end a dotted key.
bool ends_a_key(char c) { return std::string_view("=,[]{}\n#").find(c) != std::string_view::npos; }

std::size_t end_of_bare_word(std::string_view text, std::size_t at) {
  while (at < text.size() && !is_space(text[at]) && !ends_a_key(text[at]) && text[at] != '.' &&
         text[at] != '"' && text[at] != '\'')
    ++at;
  return at;
}

}  // namespace

void check_dotted_keys(const std::string& text, const std::string& file) {
  constexpr int kMostParts = 16;  // the longest key of a case has five parts
  const std::string_view all = text;
  int line = 1, parts = 0;
  bool after_dot = false;
  for (std::size_t i = 0; i < all.size();) {
    const char c = all[i];
    if (is_space(c)) {
      ++i;
    } else if (c == '.') {
      after_dot = true;
      ++i;
    } else if (ends_a_key(c)) {
      parts = 0;
      after_dot = false;
      if (c == '#')
        i = std::min(all.find('\n', i), all.size());
      else
        ++i;
      if (c == '\n') ++line;
    } else {
      parts = after_dot ? parts + 1 : 1;
      after_dot = false;
      if (parts > kMostParts)
        throw_bad_input({file, line},
                        fmt::format("has a key of more than {0} parts joined by dots; a key may "
                                    "have at most {0}",
                                    kMostParts));
      const std::size_t end =
          c == '"' || c == '\'' ? end_of_string(all, i) : end_of_bare_word(all, i);
      line += static_cast<int>(std::ranges::count(all.substr(i, end - i), '\n'));
      i = end;
    }
  }
}

}  // namespace viscontact::case_file
