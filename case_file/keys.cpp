// Reads keys by their declarations, and describes them.
#include "viscontact/case_file/keys.hpp"

#include <regex>
#include <sstream>

namespace viscontact::case_file {
namespace {

/// The text without backticks and with only the words of its links.
std::string plain(const std::string& markdown) {
  static const std::regex link("\\[([^\\]]*)\\]\\([^)]*\\)");
  auto text = std::regex_replace(markdown, link, "$1");
  std::erase(text, '`');
  return text;
}

/// The text as lines of a TOML comment, each of at most 100 bytes unless one word is longer.
std::string comment(const std::string& text) {
  constexpr std::size_t kWidth = 100;
  std::string lines, line = "#";
  std::istringstream words(text);
  for (std::string word; words >> word; line += " " + word)
    if (line.size() + 1 + word.size() > kWidth) {
      lines += line + "\n";
      line = "#";
    }
  return lines + line + "\n";
}

}  // namespace

std::string commented_case(std::span<const KeyTable> tables) {
  std::string text;
  for (const auto& table : tables) {
    const auto is_required = [](const KeyTable::Row& row) {
      return row.fallback.starts_with("required");
    };
    if (!table.section.starts_with("[") || std::ranges::any_of(table.rows, [&](const auto& row) {
          return is_required(row) && row.example.empty();
        }))
      continue;
    text += "\n" + table.section + "\n";
    for (const auto& row : table.rows) {
      const bool required = is_required(row);
      const auto fallback = required ? "" : "; default: " + row.fallback;
      text += comment(plain(fmt::format("{} ({}{})", row.meaning, row.value, fallback)));
      if (!row.example.empty())
        text += fmt::format("{}{} = {}\n", required ? "" : "# ", row.key, row.example);
    }
  }
  return text;
}

std::string KeyTable::markdown() const {
  std::string table = "| key | value | default | meaning |\n| --- | --- | --- | --- |\n";
  for (const auto& row : rows)
    table +=
        fmt::format("| `{}` | {} | {} | {} |\n", row.key, row.value, row.fallback, row.meaning);
  return table;
}

void Keys::required(std::string_view key, const KeyValue& value, const Help& help) {
  if (reads())
    value.read(*section_, key);
  else
    describe(key, value, "required", help);
}

void refuse_unknown_keys(const TomlSection& section, const KeyTable& table) {
  for (const auto& row : table.rows) (void)section.has(row.key);
  section.finish();
}

bool Keys::optional(std::string_view key, const KeyValue& value, const Help& help) {
  if (!reads()) describe(key, value, value.fallback(), help);
  if (!has(key)) return false;
  value.read(*section_, key);
  return true;
}

void Keys::required_if(bool condition, std::string_view key, const KeyValue& value,
                       const Help& help) {
  if (condition)
    required(key, value, help);
  else
    optional(key, value, help);
}

void Keys::describe(std::string_view key, const KeyValue& value, std::string fallback,
                    const Help& help) {
  auto example =
      help.example.empty() && fallback != "required" ? plain(fallback) : std::string(help.example);
  if (!help.fallback.empty()) fallback = help.fallback;
  table_->rows.push_back({std::string(key),
                          help.value.empty() ? value.words() : std::string(help.value),
                          fallback.empty() ? "none" : std::move(fallback),
                          std::string(help.meaning), std::move(example)});
}

std::string number_in_words(double number) {
  auto text = fmt::format("{}", number);
  // fmt writes exponents with at least two digits; "1e-06" becomes "1e-6".
  if (const auto at = text.find("e-0"); at != std::string::npos) text.erase(at + 2, 1);
  return text;
}

KeyValue text(std::string& place) {
  return custom("a text", [&place](const TomlSection& section, std::string_view key) {
    place = section.text(key);
  });
}

KeyValue file_name(std::string& place) {
  return custom("a text", [&place](const TomlSection& section, std::string_view key) {
    place = section.file_name(key);
  });
}

KeyValue texts(std::vector<std::string>& place) {
  return custom("a list of texts", [&place](const TomlSection& section, std::string_view key) {
    place = section.texts(key);
  });
}

KeyValue numbers(std::vector<double>& place, const Allowed& allowed, std::string_view words) {
  return custom(words, [&](const TomlSection& section, std::string_view key) {
    place = section.numbers(key, allowed);
  });
}

void viscosity_keys(Keys& keys, double& viscosity) {
  keys.required("viscosity", number(viscosity, kPositive),
                {.meaning = "dynamic viscosity mu", .example = "3.0"});
}

}  // namespace viscontact::case_file
