// A table of a TOML file, read strictly: a key that the reader did not ask for is an error.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "viscontact/common/allowed.hpp"
#include "viscontact/common/error.hpp"

namespace viscontact::case_file {

/// An Error(kBadInput) for a key that a table lacks.
class MissingKey : public Error {
 public:
  using Error::Error;
};

/// A table of a TOML file. All functions that read a value throw Error(kBadInput), with the file,
/// the line, the key and what is allowed, if the key is missing, the value has the wrong type, or
/// the value is not finite or not allowed.
class TomlSection {
 public:
  /// The root table of a TOML text, which messages call `file`. Throws Error(kBadInput) with the
  /// line if the text is not valid TOML, nests more than 256 arrays or tables, or if a key or the
  /// name of a section has more than 16 parts joined by dots.
  static TomlSection parse(const std::string& text, const std::string& file);

  /// A copy of this root table with other numbers, each at a path such as
  /// "motion.external_force[0].value". Only the last key of a path need not exist yet. A number
  /// without a fraction is stored as an integer, unless it replaces a decimal number. Throws
  /// Error(kBadInput), without a line, if another part of a path does not exist, or if the value at
  /// a path is not a number.
  TomlSection with_numbers(std::span<const std::pair<std::string, double>> numbers) const;

  /// A copy with other texts, each at a path of the same form. Throws Error(kBadInput), without a
  /// line, if there is no text at a path yet.
  TomlSection with_texts(std::span<const std::pair<std::string, std::string>> texts) const;

  /// This root table without the comments of the file and with its keys in alphabetical order, so
  /// that tables with equal keys and values give equal texts. Numbers read back exactly.
  std::string as_toml() const;

  /// This and the next four return false for a missing key; finish() counts the key as asked for.
  bool has(std::string_view key) const;
  bool is_text(std::string_view key) const;
  bool is_array(std::string_view key) const;
  bool is_table(std::string_view key) const;

  /// Only the first element of the array is looked at.
  bool is_array_of_tables(std::string_view key) const;

  /// A decimal or an integer.
  double number(std::string_view key, const Allowed& allowed) const;
  int count(std::string_view key, int least, int most) const;  ///< written without a decimal point
  std::string text(std::string_view key) const;                ///< may be empty
  std::string file_name(std::string_view key) const;           ///< not empty
  bool truth(std::string_view key) const;
  /// An array of exactly `count` values.
  std::vector<bool> truths(std::string_view key, std::size_t count) const;
  /// An array of at least one number.
  std::vector<double> numbers(std::string_view key, const Allowed& allowed) const;
  /// An array of at least one array, each of `columns` numbers.
  std::vector<std::vector<double>> rows(std::string_view key, std::size_t columns,
                                        const Allowed& allowed) const;
  std::vector<std::string> texts(std::string_view key) const;  ///< at least one
  TomlSection section(std::string_view key) const;
  /// An array of at least one table, in the order of the file.
  std::vector<TomlSection> sections(std::string_view key) const;

  /// Throws Error(kBadInput), which lists the known keys, if this table has a key for which none of
  /// the functions above was called.
  void finish() const;

  // Lines are counted from 1; they are 0 in a copy by with_numbers() or with_texts().
  int line() const;
  int line(std::string_view key) const;           ///< of the table if the key is missing
  std::string shown(std::string_view key) const;  ///< the value, for a message; empty if missing

  /// Throws Error(kBadInput) with the message "section.key what" at the line of this key, or of
  /// this table if the key does not exist; the Error is then a MissingKey.
  [[noreturn]] void fail(std::string_view key, const std::string& what) const;
  template <class First, class... Rest>
  [[noreturn]] void fail(std::string_view key, fmt::format_string<First, Rest...> what,
                         First&& first, Rest&&... rest) const {
    fail(key, fmt::format(what, std::forward<First>(first), std::forward<Rest>(rest)...));
  }

  /// Throws the error of fail() if the condition is false.
  template <class... Arguments>
  void require(bool condition, std::string_view key, fmt::format_string<Arguments...> what,
               Arguments&&... arguments) const {
    if (!condition) fail(key, fmt::format(what, std::forward<Arguments>(arguments)...));
  }

 private:
  struct Node;
  /// The error of fail() for a missing section. If the section is missing from the root table, the
  /// message has no line, because the file has no such line.
  [[noreturn]] void fail_of_section(std::string_view key, const std::string& what) const;
  std::string full_name(std::string_view key) const;  // "tabulation.gaps"
  explicit TomlSection(Node node);
  std::shared_ptr<Node> node_;
};

struct TomlFile {
  std::string text;
  TomlSection root;
};

/// The root table has an empty table for each of `sections` that the file lacks; the text stays
/// that of the file. Throws Error(kBadInput) if the file cannot be read or is not valid TOML.
TomlFile read_toml_file(const std::filesystem::path& path,
                        const std::vector<std::string_view>& sections = {});

}  // namespace viscontact::case_file
