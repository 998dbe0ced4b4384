// Declarations of the keys of case files. One function of a Keys object declares the keys of a
// section, reads them, and describes them for docs/case-file.md and `viscontact init`.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/common/allowed.hpp"
#include "viscontact/common/error.hpp"

namespace viscontact::case_file {

/// Returns check(), which tests the value of `key`. If it throws an Error of any kind, throws an
/// Error(kBadInput) that also names the key and its line in the case file.
template <class Check>
auto at_key(const TomlSection& section, std::string_view key, const Check& check)
    -> decltype(auto) {
  try {
    return check();
  } catch (const Error& error) {
    section.fail(key, "is not accepted: {}", error.what());
  }
}

/// A section in docs/case-file.md (made by the test CaseFilePage): a table with a row for each key.
struct KeyTable {
  /// The texts are in Markdown.
  struct Row {
    std::string key;
    std::string value;     ///< allowed values
    std::string fallback;  ///< its default, or "required"
    std::string meaning;
    std::string example;  ///< for `viscontact init`; empty: none
  };
  std::string section;    ///< such as "[solver]" or "[[plane]]"
  std::vector<Row> rows;  ///< in the order of the declarations

  /// The table in Markdown.
  std::string markdown() const;
};

/// The text of a case with these sections, for `viscontact init`: each key has its example as
/// value, under a comment with its meaning. Keys with a default are commented out. A table is left
/// out if a required key has no example, or if its name does not begin with "[", because it then
/// describes keys within a value.
std::string commented_case(std::span<const KeyTable> tables);

/// The words of a declaration, in Markdown; each text may be empty.
struct Help {
  std::string_view meaning = {};
  std::string_view fallback = {};  ///< the default, if the place does not contain it
  std::string_view value = {};     ///< the allowed values, if KeyValue::words is not enough
  std::string_view example = {};   ///< for `viscontact init`, if it is not the default
};

/// How the value of a key is read and described. The place must outlive the KeyValue.
struct KeyValue {
  /// Called only if the section has the key.
  std::function<void(const TomlSection& section, std::string_view key)> read;
  std::function<std::string()> words;  ///< allowed values, in Markdown
  /// The value of the place, which is the default, in Markdown; empty: none.
  std::function<std::string()> fallback = [] { return std::string(); };
};

/// The first argument of a declaration. It either reads a section or describes it in a table:
///
///     void solver_keys(Keys& keys, SolverSettings& settings) {
///       keys.optional("tolerance", number(settings.tolerance, kTolerance), {"of the gaps"});
///     }
///     read_keys(root.section("solver"), solver_keys, settings);
///     describe_keys("[solver]", solver_keys);
///
/// Each key is declared once, with its name, its place (the variable into which its value is read),
/// allowed values, default and meaning.
class Keys {
 public:
  explicit Keys(const TomlSection& section) : section_(&section) {}
  explicit Keys(KeyTable& table) : table_(&table) {}  ///< adds rows

  bool reads() const { return section_ != nullptr; }
  const TomlSection& section() const {
    assert(reads());
    return *section_;
  }
  /// False if this object describes.
  bool has(std::string_view key) const { return reads() && section_->has(key); }

  // If this object reads, the declarations below throw Error(kBadInput) with file, line and key for
  // a key that is missing or has a value that is not allowed.

  /// A key that a case must have.
  void required(std::string_view key, const KeyValue& value, const Help& help);
  /// A key that a case may have. If the case does not have it, the place keeps its value, which is
  /// the default. Returns true if the key was read.
  bool optional(std::string_view key, const KeyValue& value, const Help& help);
  /// A key that the case must have if the condition is true, and may have otherwise.
  void required_if(bool condition, std::string_view key, const KeyValue& value, const Help& help);

  /// Throws Error(kBadInput) if this object reads and the condition is false.
  template <class... Arguments>
  void require(bool condition, std::string_view key, fmt::format_string<Arguments...> what,
               Arguments&&... arguments) const {
    if (reads()) section_->require(condition, key, what, std::forward<Arguments>(arguments)...);
  }

 private:
  // Adds a row. A text of `help` that is not empty replaces that of `value` or `fallback`; without
  // an example in `help` the default is the example.
  void describe(std::string_view key, const KeyValue& value, std::string fallback,
                const Help& help);

  const TomlSection* section_ = nullptr;
  KeyTable* table_ = nullptr;
};

/// Throws Error(kBadInput) for a key that is not in the table.
void refuse_unknown_keys(const TomlSection& section, const KeyTable& table);

/// Reads the section into `places`. Throws Error(kBadInput) for a key that is missing, has a value
/// that is not allowed, or is not declared.
template <class Declaration, class... Places>
void read_keys(const TomlSection& section, const Declaration& declaration, Places&&... places) {
  Keys keys(section);
  try {
    declaration(keys, places...);
  } catch (const MissingKey&) {
    // A key that is not known may be a misspelt one, and is named before the missing one.
    KeyTable table;
    Keys all(table);
    declaration(all, places...);
    refuse_unknown_keys(section, table);
    throw;
  }
  section.finish();
}

/// The table of `section`. The first place of the declaration is a new object, whose values are the
/// defaults in the table; `more` are its other places.
template <class Place, class... More>
KeyTable describe_keys(std::string section, void (*declaration)(Keys&, Place&, More...),
                       std::type_identity_t<More>... more) {
  KeyTable table{std::move(section), {}};
  Keys keys(table);
  Place place{};
  declaration(keys, place, more...);
  return table;
}

/// A whole number that may be greater than the largest int, such as a number of rows. A double
/// holds each whole number up to 9e15. sweep/variation.cpp has the same limit.
inline constexpr Allowed kWholeNumber = {
    [](double v) { return v >= 1 && v <= 1e12 && v == std::floor(v); },
    "from 1 to 1e12 without a fraction"};

/// A number such as an accuracy.
inline constexpr Allowed kFraction = {[](double v) { return v > 0 && v < 1; }, "> 0 and < 1"};

/// The number in its shortest form, such as "1e-6".
std::string number_in_words(double number);

// Each function below returns the KeyValue of a key, with a reference to `place`, which must live
// until the key is declared.

/// A value of any type. `words` says which are allowed; read(section, key, places...) throws for
/// others.
template <class Read, class... Places>
KeyValue custom(std::string_view words, Read read, Places&... places) {
  return {[read, &places...](const TomlSection& section, std::string_view key) {
            read(section, key, places...);
          },
          [words] { return std::string(words); }};
}

/// A finite number that passes the test `allowed`. `place` is a double, an integer type (`allowed`
/// must then refuse fractions and numbers beyond the type), or a std::optional<double>, for which
/// the tables show no default. `allowed` must outlive the KeyValue.
template <class Place>
KeyValue number(Place& place, const Allowed& allowed) {
  return {[&](const TomlSection& section, std::string_view key) {
            place = static_cast<Place>(section.number(key, allowed));
          },
          [&] { return &allowed == &kFinite ? "a number" : std::string(allowed.words); },
          [&] {
            if constexpr (std::is_arithmetic_v<Place>)
              return number_in_words(static_cast<double>(place));
            return std::string();
          }};
}

/// A whole number in [least, most], which the case gives without a decimal point.
template <class Place>
KeyValue count(Place& place, int least, int most) {
  assert(least <= most);
  return {[&place, least, most](const TomlSection& section, std::string_view key) {
            place = static_cast<Place>(section.count(key, least, most));
          },
          [=] { return fmt::format("whole number from {} to {}", least, most); },
          [&place] { return fmt::format("{}", place); }};
}

/// A text, which may be empty.
KeyValue text(std::string& place);
/// A text that is not empty.
KeyValue file_name(std::string& place);
/// A list of at least one text.
KeyValue texts(std::vector<std::string>& place);
/// A list of at least one finite number, each of which passes the test `allowed`, which must
/// outlive the KeyValue. `words` says in the tables which values are allowed.
KeyValue numbers(std::vector<double>& place, const Allowed& allowed, std::string_view words);

/// A text that parse(text) turns into the value. An Error that `parse` throws becomes an
/// Error(kBadInput) with file, line and key.
template <class Place, class Parse>
KeyValue parsed(std::string_view words, Place& place, const Parse& parse) {
  return custom(words, [&place, parse](const TomlSection& section, std::string_view key) {
    const auto text = section.text(key);
    place = at_key(section, key, [&] { return parse(text); });
  });
}

/// A text that must be one of `words`, each of which stands before its value. The words after the
/// first `named` are accepted and not named. `words` must live as long as the KeyValue, as they do
/// if both are made in one expression.
template <class Meaning>
KeyValue one_of(Meaning& place, std::initializer_list<std::pair<std::string_view, Meaning>> words,
                std::size_t named = std::numeric_limits<std::size_t>::max()) {
  assert(words.size() > 0);
  using Word = std::pair<std::string_view, Meaning>;
  const std::span<const Word> allowed(words.begin(), words.size());
  const auto joined = [allowed, named](std::string_view between) {
    std::string text;
    for (const auto& [word, meaning] : allowed.first(std::min(named, allowed.size())))
      text += fmt::format("{}\"{}\"", text.empty() ? "" : between, word);
    return text;
  };
  return {[=, &place](const TomlSection& section, std::string_view key) {
            const auto text = section.text(key);
            const auto found = std::ranges::find(allowed, text, &Word::first);
            section.require(found != allowed.end(), key, "is '{}'; it must be {}", text,
                            joined(" or "));
            place = found->second;
          },
          [=] { return "`" + joined("`, `") + "`"; },
          [=, &place] {
            const auto found = std::ranges::find(allowed, place, &Word::second);
            return found == allowed.end() ? "" : fmt::format("`\"{}\"`", found->first);
          }};
}

/// The key `viscosity` [M/(L T)], > 0, of the section [fluid].
void viscosity_keys(Keys& keys, double& viscosity);

}  // namespace viscontact::case_file
