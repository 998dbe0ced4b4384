// Words of command lines.
#include "viscontact/common/text/shell_words.hpp"

#include <algorithm>
#include <string_view>

#include "viscontact/common/error.hpp"

namespace viscontact {

std::vector<std::string> split_words(const std::string& text) {
  std::vector<std::string> words;
  bool in_word = false;
  char quote = '\0';
  for (const char character : text) {
    if (quote != '\0') {
      if (character == quote)
        quote = '\0';
      else
        words.back() += character;
      continue;
    }
    if (character == ' ' || character == '\t' || character == '\n') {
      in_word = false;
      continue;
    }
    if (!in_word) words.emplace_back();
    in_word = true;
    if (character == '\'' || character == '"')
      quote = character;
    else
      words.back() += character;
  }
  if (quote != '\0')
    throw Error(ErrorKind::kWrongUsage, "the quotation mark {} in {} is not closed", quote, text);
  return words;
}

std::string shell_word(const std::string& text) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./=+,:@").find(c) != std::string_view::npos;
  };
  if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
  std::string word = "'";
  for (const char character : text) word += character == '\'' ? "'\\''" : std::string(1, character);
  return word + "'";
}

std::string shell_arguments(std::span<const std::string> words) {
  std::string text;
  for (const auto& word : words) text += " " + shell_word(word);
  return text;
}

}  // namespace viscontact
