// Declarations of the keys of a case file. A function with a Keys object as its first argument
// declares the keys of a section, each once: name, place in a struct, allowed values, default and
// meaning. The same function reads the section of a case, with the errors of TomlSection, and
// describes it for the tables of docs/case-file.md and for `viscontact init`:
//
//     void solver_keys(Keys& keys, SolverSettings& settings) {
//       keys.optional("tolerance", number(settings.tolerance, kTolerance), {"tolerance of the
//       gaps"});
//     }
//     read_keys(root.section("solver"), solver_keys, settings);
//     describe_keys("[solver]", solver_keys);
//
// The readers of cases in case_file/, particles/, rolling/ and swimmer/ use it. Values have the
// units of the case. Reading throws Error(kBadInput) with file, line and key; describing throws
// nothing. After a change of a declaration the tables of docs/case-file.md must be made again; the
// test CaseFilePage makes them and says where.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
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

/// Calls `check`, with which another part of the program tests the value of `key`, and returns what
/// it returns. If it throws an Error of any kind, throws an Error(kBadInput) that also names the
/// key and its line in the case file.
template <class Check>
auto at_key(const TomlSection& section, std::string_view key, const Check& check)
    -> decltype(auto) {
  try {
    return check();
  } catch (const Error& error) {
    section.fail(key, "is not accepted: {}", error.what());
  }
}

/// What the tables of docs/case-file.md say about a section.
struct KeyTable {
  /// A row of such a table, which describes a key in Markdown.
  struct Row {
    std::string key;       ///< its name
    std::string value;     ///< which values are allowed
    std::string fallback;  ///< its default, or "required"
    std::string meaning;   ///< what it does
    std::string example;   ///< a value for `viscontact init`; empty: none
  };
  std::string section;    ///< such as "[solver]" or "[[plane]]"
  std::vector<Row> rows;  ///< in the order of the declarations

  /// The rows as a table in Markdown.
  std::string markdown() const;
};

/// The text of a case with these sections, for `viscontact init`: each key has a value as an
/// example, under a comment with its meaning. Keys with a default are commented out. A table is
/// left out if a required key has no example, or if its name does not begin with "[", because it
/// then describes keys within a value.
std::string commented_case(std::span<const KeyTable> tables);

/// What a declaration says about a key in words, in Markdown.
struct Help {
  std::string_view meaning = {};   ///< what the key does
  std::string_view fallback = {};  ///< the default, if the place does not have it
  std::string_view value = {};     ///< the allowed values, if those of the type do not say it all
  std::string_view example = {};   ///< for `viscontact init`, if it is not the default
};

/// How the value of a key is read and described. It refers to the place into which it reads, such
/// as a member of a struct, which must outlive it.
struct KeyValue {
  /// Reads the value of a key that the section has.
  std::function<void(const TomlSection& section, std::string_view key)> read;
  std::function<std::string()> words;  ///< which values are allowed, in Markdown
  /// The value that the place has now, which is the default, in Markdown; empty: none.
  std::function<std::string()> fallback = [] { return std::string(); };
};

/// The first argument of a declaration. It either reads the keys of a section into their places, or
/// describes them in a table.
class Keys {
 public:
  explicit Keys(const TomlSection& section) : section_(&section) {}  ///< for reading this section
  explicit Keys(KeyTable& table) : table_(&table) {}                 ///< for describing: adds rows

  bool reads() const { return section_ != nullptr; }        ///< true: reads; false: describes
  const TomlSection& section() const { return *section_; }  ///< only if reads() (not checked)
  /// True if it reads and the section has the key.
  bool has(std::string_view key) const { return reads() && section_->has(key); }

  // The declarations below throw the Error(kBadInput) of TomlSection for a key that is missing or
  // has a value that is not allowed.
  /// Declares a key that a case must have.
  void required(std::string_view key, const KeyValue& value, const Help& help);
  /// Declares a key that a case may have. Without it the place keeps the value that it has. Returns
  /// true if it was read.
  bool optional(std::string_view key, const KeyValue& value, const Help& help);
  /// Declares a key that the case must have if the condition is true.
  void required_if(bool condition, std::string_view key, const KeyValue& value, const Help& help);

  /// Throws the error of TomlSection::require, if it reads and the condition is false.
  template <class... Arguments>
  void require(bool condition, std::string_view key, fmt::format_string<Arguments...> what,
               Arguments&&... arguments) const {
    if (reads()) section_->require(condition, key, what, std::forward<Arguments>(arguments)...);
  }

 private:
  void describe(std::string_view key, const KeyValue& value, std::string fallback,
                const Help& help);

  const TomlSection* section_ = nullptr;
  KeyTable* table_ = nullptr;
};

/// Reads a section by its declaration. All its other keys are errors, Error(kBadInput).
template <class Declaration, class... Places>
void read_keys(const TomlSection& section, const Declaration& declaration, Places&&... places) {
  Keys keys(section);
  declaration(keys, places...);
  section.finish();
}

/// The table of `section`, with a row for each key that `declaration` declares. Its first place is
/// a new object, whose values are the defaults in the table; `more` are its other places.
template <class Place, class... More>
KeyTable describe_keys(std::string section, void (*declaration)(Keys&, Place&, More...),
                       std::type_identity_t<More>... more) {
  KeyTable table{std::move(section), {}};
  Keys keys(table);
  Place place{};
  declaration(keys, place, more...);
  return table;
}

/// A whole number that may be greater than the largest int, such as a number of rows. The limit is
/// a free choice, that of the points of a sweep (sweep/variation.cpp); doubles are exact to 9e15.
inline constexpr Allowed kWholeNumber = {
    [](double v) { return v >= 1 && v <= 1e12 && v == std::floor(v); },
    "from 1 to 1e12 without a fraction"};

/// A number between 0 and 1, such as an accuracy.
inline constexpr Allowed kFraction = {[](double v) { return v > 0 && v < 1; }, "> 0 and < 1"};

/// A number as text for the tables, such as "1e-6".
std::string number_in_words(double number);

// The functions below make the value of a key. It refers to the `place`, which must live until the
// key is declared.

/// A value that is described by `words`, and that read(section, key, places...) reads into the
/// places.
template <class Read, class... Places>
KeyValue custom(std::string_view words, Read read, Places&... places) {
  return {[read, &places...](const TomlSection& section, std::string_view key) {
            read(section, key, places...);
          },
          [words] { return std::string(words); }};
}

/// A finite number that is `allowed`. `place` is a double, a whole number (`allowed` must then
/// refuse fractions and what the type does not hold), or a std::optional<double>, which shows no
/// default in the tables. `allowed` must outlive the value.
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

/// A whole number in [least, most], written without a decimal point.
template <class Place>
KeyValue count(Place& place, int least, int most) {
  return {[&place, least, most](const TomlSection& section, std::string_view key) {
            place = static_cast<Place>(section.count(key, least, most));
          },
          [=] { return fmt::format("whole number from {} to {}", least, most); },
          [&place] { return fmt::format("{}", place); }};
}

/// A text, which may be empty.
KeyValue text(std::string& place);
/// The name of a file, which is not empty.
KeyValue file_name(std::string& place);
/// A list of at least one text.
KeyValue texts(std::vector<std::string>& place);
/// A list of at least one number, each of which is `allowed`.
KeyValue numbers(std::vector<double>& place, const Allowed& allowed, std::string_view words);

/// A text that `parse` turns into the value, or refuses with an Error.
template <class Place, class Parse>
KeyValue parsed(std::string_view words, Place& place, const Parse& parse) {
  return custom(words, [&place, parse](const TomlSection& section, std::string_view key) {
    const auto text = section.text(key);
    place = at_key(section, key, [&] { return parse(text); });
  });
}

/// A text that must be one of `words`, each of which stands for a value of `place`.
template <class Meaning>
KeyValue one_of(Meaning& place, std::initializer_list<std::pair<std::string_view, Meaning>> words) {
  using Word = std::pair<std::string_view, Meaning>;
  const std::span<const Word> allowed(words.begin(), words.size());
  const auto joined = [allowed](std::string_view between) {
    std::string text;
    for (const auto& [word, meaning] : allowed)
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

/// Declares the key `viscosity` [M/(L T)], > 0, of the section [fluid].
void viscosity_keys(Keys& keys, double& viscosity);

}  // namespace viscontact::case_file
