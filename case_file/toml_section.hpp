// A table of a TOML file, read strictly: every key is asked for by name, and one that nobody asked
// for is an error.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "viscontact/common/allowed.hpp"

namespace viscontact {

/// Every function throws Error(kBadInput) with file, line, key and what is allowed for a missing
/// key (optional_... excepted), a wrong type, a value that is not finite or not allowed.
class TomlSection {
 public:
  /// The root table of a text; `file` is for messages. Throws Error(kBadInput) with the line where
  /// the text is no TOML.
  static TomlSection parse(const std::string& text, const std::string& file);

  /// A root table like this root, with other numbers: each at a path such as "motion.external_force[0].value". Of a path only its last key may be
  /// new. Throws Error(kBadInput) if it leads nowhere or to something that is no number.
  TomlSection with_numbers(std::span<const std::pair<std::string, double>> numbers) const;

  bool has(std::string_view key) const;
  bool is_text(std::string_view key) const;   ///< the key is there and holds text
  bool is_array(std::string_view key) const;  ///< the key is there and holds an array

  /// The key holds an array whose first element is a table.
  bool is_array_of_tables(std::string_view key) const;

  double number(std::string_view key, const Allowed& allowed) const;
  int count(std::string_view key, int least, int most) const;  ///< a whole number in [least, most]
  std::string text(std::string_view key) const;
  std::vector<double> numbers(std::string_view key,
                              const Allowed& allowed) const;   ///< an array of at least one number
  std::vector<std::string> texts(std::string_view key) const;  ///< an array of at least one text
  TomlSection section(std::string_view key) const;
  std::vector<TomlSection> sections(
      std::string_view key) const;  ///< an array of tables, at least one

  /// Throws for a key of this table that none of the functions above was asked for.
  void finish() const;

  /// Throws Error(kBadInput) at this key's line (this table's, if the key is not there):
  /// "section.key what".
  [[noreturn]] void fail(std::string_view key, const std::string& what) const;

 private:
  struct Node;
  /// As fail; of a section of the root without a line, since it stands nowhere.
  [[noreturn]] void fail_of_section(std::string_view key, const std::string& what) const;
  explicit TomlSection(std::shared_ptr<Node> node) : node_(std::move(node)) {}
  std::shared_ptr<Node> node_;
};

}  // namespace viscontact
