// Reads TOML tables with toml++ (toml_section.hpp). Every function that reads a key must note it in
// `asked`, because finish() reports all other keys as unknown.
#include "viscontact/case_file/toml_section.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "viscontact/case_file/dotted_keys.hpp"
#include "viscontact/case_file/toml_node.hpp"
#include "viscontact/common/error.hpp"

namespace viscontact::case_file {

namespace {

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

/// The value of a node as text for a message.
std::string show(const toml::node& node) {
  if (const auto number = node.value_exact<double>()) return fmt::format("{}", *number);
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

/// The value of a node, or nothing if it is not a finite number that is allowed.
std::optional<double> allowed_number(const toml::node& node, const Allowed& allowed) {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  return value && std::isfinite(*value) && allowed.test(*value) ? value : std::nullopt;
}

}  // namespace

TomlSection TomlSection::parse(const std::string& text, const std::string& file) {
  check_dotted_keys(text, file);
  try {
    auto root = std::make_shared<const toml::table>(toml::parse(text, file));
    const auto* table = root.get();
    return TomlSection(std::make_shared<Node>(Node{std::move(root), table, file, "", {}}));
  } catch (const toml::parse_error& error) {
    throw_bad_input({file, static_cast<int>(error.source().begin.line)},
                    fmt::format("is not valid TOML ({})", error.description()));
  }
}

void TomlSection::fail_of_section(std::string_view key, const std::string& what) const {
  if (node_->path.empty())
    throw_bad_input({node_->file}, fmt::format("section [{}] {}", key, what));
  fail(key, what);
}

void TomlSection::fail(std::string_view key, const std::string& what) const {
  const auto* node = node_->table->get(key);
  const int line = node != nullptr ? line_of(*node) : line_of(*node_->table);
  throw_bad_input({node_->file, line},
                  fmt::format("{}{}{} {}", node_->path, node_->path.empty() ? "" : ".", key, what));
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

std::string TomlSection::shown(std::string_view key) const {
  return has(key) ? show(*node_->table->get(key)) : "";
}

bool TomlSection::is_array_of_tables(std::string_view key) const {
  if (!is_array(key)) return false;
  const auto* array = node_->table->get(key)->as_array();
  return !array->empty() && array->front().is_table();
}

double TomlSection::number(std::string_view key, const Allowed& allowed) const {
  if (!has(key)) fail(key, fmt::format("is missing; it must be a number {}", allowed.words));
  const auto* node = node_->table->get(key);
  const auto value = allowed_number(*node, allowed);
  if (!value) fail(key, fmt::format("is {}; it must be a number {}", show(*node), allowed.words));
  return *value;
}

int TomlSection::count(std::string_view key, int least, int most) const {
  const std::string allowed = fmt::format("it must be a whole number from {} to {}", least, most);
  if (!has(key)) fail(key, "is missing; " + allowed);
  const auto* node = node_->table->get(key);
  // show() leaves out the decimal point of such a number, so this message needs a case of its own.
  if (const auto decimal = node->value_exact<double>(); decimal && *decimal == std::floor(*decimal))
    fail(key, fmt::format("is {:.1f}; {}, without a decimal point", *decimal, allowed));
  const auto value = node->is_integer() ? node->value<int>() : std::nullopt;
  if (!value || *value < least || *value > most)
    fail(key, fmt::format("is {}; {}", show(*node), allowed));
  return *value;
}

std::string TomlSection::text(std::string_view key) const {
  if (!has(key)) fail(key, "is missing; it must be a text in quotes");
  const auto* node = node_->table->get(key);
  const auto value = node->is_string() ? node->value<std::string>() : std::nullopt;
  if (!value) fail(key, fmt::format("is {}; it must be a text in quotes", show(*node)));
  return *value;
}

bool TomlSection::truth(std::string_view key) const {
  if (!has(key)) fail(key, "is missing; it must be true or false");
  const auto value = node_->table->get(key)->value_exact<bool>();
  if (!value) fail(key, fmt::format("is {}; it must be true or false", shown(key)));
  return *value;
}

std::vector<bool> TomlSection::truths(std::string_view key, std::size_t count) const {
  const auto allowed = fmt::format("it must be a list of {} values, each true or false", count);
  if (!has(key)) fail(key, "is missing; " + allowed);
  const auto* array = node_->table->get(key)->as_array();
  std::vector<bool> values;
  if (array != nullptr)
    for (const auto& element : *array)
      if (const auto value = element.value_exact<bool>()) values.push_back(*value);
  if (array == nullptr || array->size() != count || values.size() != count)
    fail(key, fmt::format("is {}; {}", shown(key), allowed));
  return values;
}

std::vector<double> TomlSection::numbers(std::string_view key, const Allowed& allowed) const {
  if (!has(key))
    fail(key, fmt::format("is missing; it must be a list of numbers {}", allowed.words));
  const auto* array = node_->table->get(key)->as_array();
  if (array == nullptr || array->empty())
    fail(key, fmt::format("is {}; it must be a list of at least one number, each {}",
                          show(*node_->table->get(key)), allowed.words));
  std::vector<double> values;
  for (const auto& element : *array) {
    const auto value = allowed_number(element, allowed);
    if (!value)
      fail(key, fmt::format("contains {}; it must be a list of numbers {}", show(element),
                            allowed.words));
    values.push_back(*value);
  }
  return values;
}

std::vector<std::vector<double>> TomlSection::rows(std::string_view key, std::size_t columns,
                                                   const Allowed& allowed) const {
  const auto wanted =
      fmt::format("it must be a list of lists of {} numbers {}", columns, allowed.words);
  if (!has(key)) fail(key, "is missing; " + wanted);
  const auto* array = node_->table->get(key)->as_array();
  if (array == nullptr || array->empty())
    fail(key, fmt::format("is {}; {}", show(*node_->table->get(key)), wanted));
  std::vector<std::vector<double>> rows;
  for (const auto& element : *array) {
    std::vector<double> row;
    if (const auto* list = element.as_array())
      for (const auto& number : *list)
        if (const auto value = allowed_number(number, allowed)) row.push_back(*value);
    if (!element.is_array() || row.size() != columns || element.as_array()->size() != columns)
      fail(key, fmt::format("contains {}; {}", show(element), wanted));
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<std::string> TomlSection::texts(std::string_view key) const {
  if (!has(key)) fail(key, "is missing; it must be a list of texts in quotes");
  const auto* array = node_->table->get(key)->as_array();
  if (array == nullptr || array->empty())
    fail(key, fmt::format("is {}; it must be a list of at least one text in quotes",
                          show(*node_->table->get(key))));
  std::vector<std::string> values;
  for (const auto& element : *array) {
    const auto value = element.value_exact<std::string>();
    if (!value)
      fail(key, fmt::format("contains {}; it must be a list of texts in quotes", show(element)));
    values.push_back(*value);
  }
  return values;
}

TomlSection TomlSection::section(std::string_view key) const {
  if (!has(key))
    fail_of_section(key, node_->path.empty() ? "is missing" : "is missing; it must be a table");
  const auto* table = node_->table->get(key)->as_table();
  if (table == nullptr)
    fail(key, fmt::format("is {}; it must be a table", show(*node_->table->get(key))));
  const std::string path =
      node_->path.empty() ? std::string(key) : fmt::format("{}.{}", node_->path, key);
  return TomlSection(std::make_shared<Node>(Node{node_->root, table, node_->file, path, {}}));
}

std::vector<TomlSection> TomlSection::sections(std::string_view key) const {
  if (!has(key)) fail(key, "is missing; it must be a list of tables { ... }");
  const auto* array = node_->table->get(key)->as_array();
  if (array == nullptr || array->empty())
    fail(key, fmt::format("is {}; it must be a list of at least one table {{ ... }}",
                          show(*node_->table->get(key))));
  std::vector<TomlSection> sections;
  for (const auto& element : *array) {
    const auto* table = element.as_table();
    if (table == nullptr)
      fail(key, fmt::format("contains {}; it must be a list of tables {{ ... }}", show(element)));
    const std::string path = fmt::format("{}{}{}[{}]", node_->path, node_->path.empty() ? "" : ".",
                                         key, sections.size());
    sections.push_back(
        TomlSection(std::make_shared<Node>(Node{node_->root, table, node_->file, path, {}})));
  }
  return sections;
}

void TomlSection::finish() const {
  for (const auto& [key, value] : *node_->table)
    if (!node_->asked.contains(std::string(key.str()))) {
      std::string known;
      for (const auto& name : node_->asked)
        known += fmt::format("{}{}", known.empty() ? "" : ", ", name);
      throw_bad_input({node_->file, static_cast<int>(key.source().begin.line)},
                      fmt::format("{}{}{} is not a key that is known here; the known keys are: {}",
                                  node_->path, node_->path.empty() ? "" : ".", key.str(), known));
    }
}

}  // namespace viscontact::case_file
