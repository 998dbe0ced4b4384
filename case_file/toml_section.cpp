// Reads TOML by toml++. Every function that reads a key notes it in Node::asked (has() does so),
// because finish() reports all other keys as unknown.
#include "viscontact/case_file/toml_section.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <set>
#include <sstream>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/utf16.hpp"

namespace viscontact::case_file {

struct TomlSection::Node {
  std::shared_ptr<const toml::table> root;  ///< keeps `table` alive
  const toml::table* table = nullptr;
  std::string file;             ///< in messages
  std::string path;             ///< "tabulation.container"; empty for the root
  std::set<std::string> asked;  ///< keys that were asked for
};

namespace {

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

/// The value for a message; a decimal number in its shortest form.
std::string show(const toml::node& node) {
  if (const auto number = node.value_exact<double>()) return fmt::format("{}", *number);
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

/// Nothing if the node is not a finite number that is allowed.
std::optional<double> allowed_number(const toml::node& node, const Allowed& allowed) {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  return value && std::isfinite(*value) && allowed.test(*value) ? value : std::nullopt;
}

/// Position after the string that opens at `at`; the end of the text if it is not closed.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  assert(at < text.size());
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

/// Position after the part of a key that is not in quotes and begins at `at`.
std::size_t end_of_bare_word(std::string_view text, std::size_t at) {
  while (at < text.size() && !is_space(text[at]) && !ends_a_key(text[at]) && text[at] != '.' &&
         text[at] != '"' && text[at] != '\'')
    ++at;
  return at;
}

/// Throws Error(kBadInput) with the line if a key or the name of a section has more than 16 parts
/// joined by dots. The text is scanned before it is parsed, because toml++ 3.3 makes a nested table
/// for each part and visits these tables by recursion, so that a key of 40 000 parts overflows the
/// stack. toml++ itself limits nested arrays and inline tables to 256 levels.
void check_dotted_keys(const std::string& text, const std::string& file) {
  constexpr int kMostParts = 16;  // the longest key of a case has five
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
        throw_bad_input(
            {file, line},
            "has a key of more than {0} parts joined by dots; a key may have at most {0}",
            kMostParts);
      const std::size_t end =
          c == '"' || c == '\'' ? end_of_string(all, i) : end_of_bare_word(all, i);
      line += static_cast<int>(std::ranges::count(all.substr(i, end - i), '\n'));
      i = end;
    }
  }
}

/// True if the number can be stored as an integer without loss.
bool is_integer(double value) {
  constexpr double kLargestInteger = 1e15;  // a double holds each integer up to 2^53
  return value == std::floor(value) && std::abs(value) <= kLargestInteger &&
         !(value == 0 && std::signbit(value));
}

/// The elements of `node`, the value of `key`. Throws Error(kBadInput) unless it is an array of at
/// least one element. In the message, `many` follows "a list of" if the key is missing, and `one`
/// follows "a list of at least one" otherwise.
const toml::array& elements(const TomlSection& section, std::string_view key,
                            const toml::node* node, std::string_view many, std::string_view one) {
  section.require(section.has(key), key, "is missing; it must be a list of {}", many);
  const auto* array = node->as_array();
  section.require(array != nullptr && !array->empty(), key,
                  "is {}; it must be a list of at least one {}", section.shown(key), one);
  return *array;
}

}  // namespace

TomlSection::TomlSection(Node node) : node_(std::make_shared<Node>(std::move(node))) {}

TomlSection TomlSection::parse(const std::string& text, const std::string& file) {
  refuse_utf16(text, file);
  check_dotted_keys(text, file);
  try {
    auto root = std::make_shared<const toml::table>(toml::parse(text, file));
    return TomlSection(Node{root, root.get(), file, "", {}});
  } catch (const toml::parse_error& error) {
    throw_bad_input({file, static_cast<int>(error.source().begin.line)}, "is not valid TOML ({})",
                    error.description());
  }
}

std::string TomlSection::full_name(std::string_view key) const {
  return fmt::format("{}{}{}", node_->path, node_->path.empty() ? "" : ".", key);
}

void TomlSection::fail_of_section(std::string_view key, const std::string& what) const {
  if (node_->path.empty())
    throw_bad_input({node_->file, 0, std::string(key)}, "section [{}] {}", key, what);
  fail(key, what);
}

void TomlSection::fail(std::string_view key, const std::string& what) const {
  const FilePosition at{node_->file, line(key), full_name(key)};
  const auto message = located(at, at.key + " " + what);
  if (!node_->table->contains(key)) throw MissingKey(ErrorKind::kBadInput, message, at);
  throw Error(ErrorKind::kBadInput, message, at);
}

bool TomlSection::has(std::string_view key) const {
  node_->asked.emplace(key);
  return node_->table->contains(key);
}

bool TomlSection::is_text(std::string_view key) const {
  return has(key) && node_->table->get(key)->is_string();
}

bool TomlSection::is_array(std::string_view key) const {
  return has(key) && node_->table->get(key)->is_array();
}

bool TomlSection::is_table(std::string_view key) const {
  return has(key) && node_->table->get(key)->is_table();
}

int TomlSection::line() const { return line_of(*node_->table); }

int TomlSection::line(std::string_view key) const {
  const auto* node = node_->table->get(key);
  return node != nullptr ? line_of(*node) : line();
}

std::string TomlSection::shown(std::string_view key) const {
  return has(key) ? show(*node_->table->get(key)) : "";
}

bool TomlSection::is_array_of_tables(std::string_view key) const {
  if (!is_array(key)) return false;
  const auto* array = node_->table->get(key)->as_array();
  return !array->empty() && array->front().is_table();
}

double TomlSection::number(std::string_view key, const Allowed& allowed) const {
  if (!has(key)) fail(key, "is missing; it must be a number {}", allowed.words);
  const auto* node = node_->table->get(key);
  const auto value = allowed_number(*node, allowed);
  if (!value) fail(key, "is {}; it must be a number {}", show(*node), allowed.words);
  return *value;
}

int TomlSection::count(std::string_view key, int least, int most) const {
  assert(least <= most);
  const std::string allowed = fmt::format("it must be a whole number from {} to {}", least, most);
  if (!has(key)) fail(key, "is missing; " + allowed);
  const auto* node = node_->table->get(key);
  // show() writes 3.0 as "3", which would look allowed. This message writes the decimal point.
  if (const auto decimal = node->value_exact<double>(); decimal && *decimal == std::floor(*decimal))
    fail(key, "is {:.1f}; {}, without a decimal point", *decimal, allowed);
  const auto value = node->is_integer() ? node->value<int>() : std::nullopt;
  if (!value || *value < least || *value > most) fail(key, "is {}; {}", show(*node), allowed);
  return *value;
}

std::string TomlSection::text(std::string_view key) const {
  if (!has(key)) fail(key, "is missing; it must be a text in quotes");
  const auto* node = node_->table->get(key);
  const auto value = node->is_string() ? node->value<std::string>() : std::nullopt;
  if (!value) fail(key, "is {}; it must be a text in quotes", show(*node));
  return *value;
}

std::string TomlSection::file_name(std::string_view key) const {
  auto name = text(key);
  require(!name.empty(), key, "is empty; it must be the name of a file");
  return name;
}

bool TomlSection::truth(std::string_view key) const {
  if (!has(key)) fail(key, "is missing; it must be true or false");
  const auto value = node_->table->get(key)->value_exact<bool>();
  if (!value) fail(key, "is {}; it must be true or false", shown(key));
  return *value;
}

std::vector<bool> TomlSection::truths(std::string_view key, std::size_t count) const {
  const auto allowed = fmt::format("it must be a list of {} values, each true or false", count);
  require(has(key), key, "is missing; {}", allowed);
  std::vector<bool> values;
  const auto* array = node_->table->get(key)->as_array();
  if (array != nullptr)
    for (const auto& element : *array)
      if (const auto value = element.value_exact<bool>()) values.push_back(*value);
  require(array != nullptr && array->size() == count && values.size() == count, key, "is {}; {}",
          shown(key), allowed);
  return values;
}

std::vector<double> TomlSection::numbers(std::string_view key, const Allowed& allowed) const {
  const auto many = fmt::format("numbers {}", allowed.words);
  std::vector<double> values;
  for (const auto& element : elements(*this, key, node_->table->get(key), many,
                                      fmt::format("number, each {}", allowed.words))) {
    const auto value = allowed_number(element, allowed);
    require(value.has_value(), key, "contains {}; it must be a list of {}", show(element), many);
    values.push_back(*value);
  }
  return values;
}

std::vector<std::vector<double>> TomlSection::rows(std::string_view key, std::size_t columns,
                                                   const Allowed& allowed) const {
  const auto many = fmt::format("lists of {} numbers {}", columns, allowed.words);
  std::vector<std::vector<double>> rows;
  for (const auto& element :
       elements(*this, key, node_->table->get(key), many,
                fmt::format("list of {} numbers {}", columns, allowed.words))) {
    std::vector<double> row;
    if (const auto* list = element.as_array())
      for (const auto& number : *list)
        if (const auto value = allowed_number(number, allowed)) row.push_back(*value);
    if (!element.is_array() || row.size() != columns || element.as_array()->size() != columns)
      fail(key, "contains {}; it must be a list of {}", show(element), many);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<std::string> TomlSection::texts(std::string_view key) const {
  std::vector<std::string> values;
  for (const auto& element :
       elements(*this, key, node_->table->get(key), "texts in quotes", "text in quotes")) {
    const auto value = element.value_exact<std::string>();
    if (!value) fail(key, "contains {}; it must be a list of texts in quotes", show(element));
    values.push_back(*value);
  }
  return values;
}

namespace {

/// True if Levenshtein's distance of the words is at most 2, and less than half of the letters.
bool is_similar(std::string_view word, std::string_view other) {
  std::vector<std::size_t> row(other.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < word.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < other.size(); ++j)
      diagonal = std::exchange(row[j + 1],
                               std::min({row[j] + 1, row[j + 1] + 1,
                                         diagonal + (word[i] == other[j] ? std::size_t{0} : 1)}));
  }
  return row.back() <= 2 && 2 * row.back() < other.size();
}

}  // namespace

TomlSection TomlSection::section(std::string_view key) const {
  if (!has(key) && node_->path.empty())
    for (const auto& [name, value] : *node_->table)
      if (value.is_table() && !node_->asked.contains(std::string(name.str())) &&
          is_similar(name.str(), key))
        throw_bad_input(
            {node_->file, static_cast<int>(name.source().begin.line), std::string(name.str())},
            "section [{}] is not known here; section [{}] is missing", name.str(), key);
  if (!has(key))
    fail_of_section(key, node_->path.empty() ? "is missing" : "is missing; it must be a table");
  const auto* table = node_->table->get(key)->as_table();
  require(table != nullptr, key, "is {}; it must be a table", shown(key));
  return TomlSection(Node{node_->root, table, node_->file, full_name(key), {}});
}

std::vector<TomlSection> TomlSection::sections(std::string_view key) const {
  std::vector<TomlSection> sections;
  for (const auto& element :
       elements(*this, key, node_->table->get(key), "tables { ... }", "table { ... }")) {
    const auto* table = element.as_table();
    if (table == nullptr)
      fail(key, "contains {}; it must be a list of tables {{ ... }}", show(element));
    const auto path = fmt::format("{}[{}]", full_name(key), sections.size());
    sections.push_back(TomlSection(Node{node_->root, table, node_->file, path, {}}));
  }
  return sections;
}

void TomlSection::finish() const {
  for (const auto& [key, value] : *node_->table)
    if (!node_->asked.contains(std::string(key.str()))) {
      std::string known;
      for (const auto& name : node_->asked)
        known += fmt::format("{}{}", known.empty() ? "" : ", ", name);
      throw_bad_input(
          {node_->file, static_cast<int>(key.source().begin.line), full_name(key.str())},
          "{} is not a key that is known here; the known keys are: {}", full_name(key.str()),
          known);
    }
}

TomlSection TomlSection::with_numbers(
    std::span<const std::pair<std::string, double>> numbers) const {
  auto root = std::make_shared<toml::table>(*node_->root);
  assert(node_->path.empty());
  for (const auto& number : numbers) {
    const std::string& path = number.first;
    const double value = number.second;
    const auto refuse = [&](const std::string& what) {
      throw_bad_input({node_->file, 0, path}, "{} {}", path, what);
    };
    auto* place = root->at_path(path).node();
    // Puts a new node at `path`, because the existing node of an integer cannot store a fraction.
    const auto replace = [&](auto new_value) {
      const auto dot = path.rfind('.');
      const auto bracket = path.rfind('[');
      if (place != nullptr && bracket != std::string::npos && path.back() == ']') {
        auto* array = root->at_path(path.substr(0, bracket)).as_array();
        const auto index = static_cast<std::size_t>(std::stoul(path.substr(bracket + 1)));
        array->replace(array->cbegin() + static_cast<std::ptrdiff_t>(index), new_value);
        return;
      }
      auto* parent =
          dot == std::string::npos ? root.get() : root->at_path(path.substr(0, dot)).as_table();
      if (parent == nullptr) refuse("is not a key of this case");
      // The reader of the case checks whether this key exists.
      parent->insert_or_assign(path.substr(dot + 1), new_value);
    };
    if (place != nullptr && place->is_floating_point())
      **place->as_floating_point() = value;
    else if (place != nullptr && !place->is_integer())
      refuse("is not a number in this case");
    else if (is_integer(value))
      replace(static_cast<std::int64_t>(value));
    else
      replace(value);
  }
  return TomlSection(Node{root, root.get(), node_->file, "", {}});
}

TomlSection TomlSection::with_texts(
    std::span<const std::pair<std::string, std::string>> texts) const {
  auto root = std::make_shared<toml::table>(*node_->root);
  assert(node_->path.empty());
  for (const auto& [path, text] : texts) {
    auto* place = root->at_path(path).as_string();
    if (place == nullptr)
      throw_bad_input({node_->file, 0, path}, "{} is not a text in this case", path);
    **place = text;
  }
  return TomlSection(Node{root, root.get(), node_->file, "", {}});
}

std::string TomlSection::as_toml() const {
  std::ostringstream text;
  text << *node_->root << "\n";
  return text.str();
}

TomlFile read_toml_file(const std::filesystem::path& path,
                        const std::vector<std::string_view>& sections) {
  auto text = read_file(path);
  auto root = TomlSection::parse(text, path.string());
  std::string missing;
  for (const auto& name : sections)
    if (!root.has(name)) missing += fmt::format("\n[{}]\n", name);
  if (!missing.empty()) root = TomlSection::parse(text + missing, path.string());
  return {std::move(text), std::move(root)};
}

}  // namespace viscontact::case_file
