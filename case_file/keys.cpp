// Makes the tables of docs/case-file.md and the case that the command `init` writes, from the
// declarations of keys in case_file/, particles/, rolling/ and swimmer/. The same declarations read
// cases. Values and examples have the units of the case. A declaration gives the allowed range of
// each number. The default of a key is the value that its place (the variable into which it is
// read) has before. Reading a missing, wrong or disallowed value throws an Error(kBadInput) with
// file, line and key; describing throws nothing. The words and the layout of the tables may be
// changed; the test CaseFilePage then fails until the page is made again. A change must keep that
// users' cases can be read.
#include "viscontact/case_file/keys.hpp"

#include <regex>
#include <sstream>

namespace viscontact::case_file {
namespace {

/// The text `markdown` without backticks and with only the words of its links.
std::string plain(const std::string& markdown) {
  static const std::regex link("\\[([^\\]]*)\\]\\([^)]*\\)");
  auto text = std::regex_replace(markdown, link, "$1");
  std::erase(text, '`');
  return text;
}

/// The text as lines of a TOML comment, each of at most 100 bytes unless one word is longer. The
/// width is a free choice; all files of the project have it.
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

/// The text of a case with these sections, for `viscontact init`: each key has a comment with its
/// meaning, and its example as value. Keys with a default are commented out. A table is left out if
/// a required key has no example, or if its name does not begin with "[", because it then describes
/// keys within a value.
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

/// Reads the key, which the section must have, or describes it.
void Keys::required(std::string_view key, const KeyValue& value, const Help& help) {
  if (reads())
    value.read(*section_, key);
  else
    describe(key, value, "required", help);
}

bool names_missing_key(const Error& error) {
  return std::string_view(error.what()).find("is missing") != std::string_view::npos;
}

void refuse_unknown_keys(const TomlSection& section, const KeyTable& table) {
  for (const auto& row : table.rows) (void)section.has(row.key);
  section.finish();
}

/// Reads the key if the section has it, or describes it. Returns true if the key was read;
/// otherwise its place keeps its value.
bool Keys::optional(std::string_view key, const KeyValue& value, const Help& help) {
  if (!reads()) describe(key, value, value.fallback(), help);
  if (!has(key)) return false;
  value.read(*section_, key);
  return true;
}

/// Does what required() does if the condition is true, and what optional() does otherwise.
void Keys::required_if(bool condition, std::string_view key, const KeyValue& value,
                       const Help& help) {
  if (condition)
    required(key, value, help);
  else
    optional(key, value, help);
}

/// Adds the row of a key to the table. `fallback` is its default in Markdown, "required", or empty
/// for none. A text of `help` that is not empty replaces that of `value` or `fallback`; without an
/// example in `help` the default is the example.
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

/// The number in its shortest form, such as "1e-6".
std::string number_in_words(double number) {
  auto text = fmt::format("{}", number);
  // fmt writes exponents with at least two digits; "1e-06" becomes "1e-6".
  if (const auto at = text.find("e-0"); at != std::string::npos) text.erase(at + 2, 1);
  return text;
}

/// A text, which may be empty. This value and those below have a reference to `place`, which must
/// live until the key is declared.
KeyValue text(std::string& place) {
  return custom("a text", [&place](const TomlSection& section, std::string_view key) {
    place = section.text(key);
  });
}

/// A text that is not empty.
KeyValue file_name(std::string& place) {
  return custom("a text", [&place](const TomlSection& section, std::string_view key) {
    place = section.file_name(key);
  });
}

/// A list of at least one text.
KeyValue texts(std::vector<std::string>& place) {
  return custom("a list of texts", [&place](const TomlSection& section, std::string_view key) {
    place = section.texts(key);
  });
}

/// A list of at least one finite number, each of which passes the test `allowed`. `words` says in
/// the tables which values are allowed.
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
