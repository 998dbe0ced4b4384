// Declarations of the keys of a case file. A function with a Keys object as its first argument
// declares the keys of a section, each once: name, place in a struct, allowed values, default and
// meaning. The same function reads the section of a case, with the errors of TomlSection, and
// describes it for the tables of docs/case-file.md:
//
//     void solver_keys(Keys& keys, SolverSettings& settings) {
//       keys.optional("tolerance", number(settings.tolerance, kTolerance), "tolerance of the gaps");
//     }
//     read_keys(root.section("solver"), solver_keys, settings);
//     describe_keys("[solver]", solver_keys);
//
// Keys have the units of the case. After a change of a declaration the tables of the page must be
// written again; the test CaseFilePage says how.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/common/allowed.hpp"
#include "viscontact/common/error.hpp"

namespace viscontact::case_file {

/// Calls `check`, with which another part of the program tests the value of `key`. If it throws an
/// Error, throws one that also names the key and its line in the case file.
template <class Check>
auto at_key(const TomlSection& section, std::string_view key, const Check& check)
    -> decltype(auto) {
  try {
    return check();
  } catch (const Error& error) {
    section.fail(key, fmt::format("is not accepted: {}", error.what()));
  }
}

/// What the tables of docs/case-file.md say about a section.
struct KeyTable {
  /// What they say about a key, in Markdown.
  struct Row {
    std::string key;       ///< its name
    std::string value;     ///< which values are allowed
    std::string fallback;  ///< its default, or "required"
    std::string meaning;   ///< what it does
  };
  std::string section;    ///< such as "[solver]" or "[[plane]]"
  std::vector<Row> rows;  ///< in the order of the declarations

  /// The rows as a table in Markdown.
  std::string markdown() const;
};

/// What a declaration says about a key in words, in Markdown.
struct Help {
  std::string_view meaning = {};   ///< what the key does
  std::string_view fallback = {};  ///< the default, if it is not that of the struct
  std::string_view value = {};     ///< the allowed values, if those of the type do not say it all
};

/// The visitor of declarations. It either reads the keys of a section, or describes them.
class Keys {
 public:
  explicit Keys(const TomlSection& section) : section_(&section) {}  ///< reads this section
  explicit Keys(KeyTable& table) : table_(&table) {}                 ///< adds rows to this table

  bool reads() const { return section_ != nullptr; }        ///< false: describes
  const TomlSection& section() const { return *section_; }  ///< only if it reads
  /// True if it reads and the section has the key.
  bool has(std::string_view key) const { return reads() && section_->has(key); }

  /// Declares a key that a case must have. `value` is what one of the functions below returns.
  template <class Value>
  void required(std::string_view key, const Value& value, const Help& help) {
    if (reads())
      value.read(*section_, key);
    else
      describe(key, value.words(), "required", help);
  }

  /// Declares a key that a case may have. Without it the place keeps the value that it has. Returns
  /// true if it was read.
  template <class Value>
  bool optional(std::string_view key, const Value& value, const Help& help) {
    if (!reads()) describe(key, value.words(), value.fallback(), help);
    if (!has(key)) return false;
    value.read(*section_, key);
    return true;
  }

  /// Declares a key that the case must have if the condition is true.
  template <class Value>
  void required_if(bool condition, std::string_view key, const Value& value, const Help& help) {
    if (condition)
      required(key, value, help);
    else
      optional(key, value, help);
  }

  /// Throws the error of TomlSection::require, if it reads and the condition is false.
  template <class... Arguments>
  void require(bool condition, std::string_view key, fmt::format_string<Arguments...> what,
               Arguments&&... arguments) const {
    if (reads()) section_->require(condition, key, what, std::forward<Arguments>(arguments)...);
  }

 private:
  void describe(std::string_view key, std::string value, std::string fallback, const Help& help);

  const TomlSection* section_ = nullptr;
  KeyTable* table_ = nullptr;
};

/// Reads a section by its declaration. All its other keys are errors.
template <class Declaration, class... Places>
void read_keys(const TomlSection& section, const Declaration& declaration, Places&&... places) {
  Keys keys(section);
  declaration(keys, places...);
  section.finish();
}

/// Describes a section by its declaration.
KeyTable describe_keys(std::string section, const std::function<void(Keys&)>& declaration);

/// The same for a declaration with a place, whose values are the defaults.
template <class Place>
KeyTable describe_keys(std::string section, void (*declaration)(Keys&, Place&)) {
  return describe_keys(std::move(section), [&](Keys& keys) {
    Place place{};
    declaration(keys, place);
  });
}

/// A whole number that may be greater than the largest int.
inline constexpr Allowed kWholeNumber = {
    [](double v) { return v >= 1 && v <= 1e12 && v == std::floor(v); },
    "from 1 to 1e12 without a fraction"};

/// A number between 0 and 1, such as an accuracy.
inline constexpr Allowed kFraction = {[](double v) { return v > 0 && v < 1; }, "between 0 and 1"};

/// A number as text for the tables, such as "1e-6".
std::string number_in_words(double number);

// Values of keys: each reads a value into its place and says which values are allowed.

/// A value with a reader and words of its own. `read` is called with the section, the key and the
/// places.
template <class Read, class... Places>
auto custom(std::string_view words, Read read, Places&... places) {
  const auto read_places = [read, &places...](const TomlSection& section, std::string_view key) {
    read(section, key, places...);
  };
  struct Value {
    std::string_view allowed;
    decltype(read_places) on_read;
    void read(const TomlSection& section, std::string_view key) const { on_read(section, key); }
    std::string words() const { return std::string(allowed); }
    std::string fallback() const { return ""; }
  };
  return Value{words, read_places};
}

/// A number. `place` is a double, an optional one, which has no default, or a whole number.
template <class Place>
struct NumberValue {
  Place& place;
  const Allowed& allowed;
  void read(const TomlSection& section, std::string_view key) const {
    const double number = section.number(key, allowed);
    if constexpr (std::is_integral_v<Place>)
      place = static_cast<Place>(number);
    else
      place = number;
  }
  std::string words() const {
    return &allowed == &kFinite ? "a number" : std::string(allowed.words);
  }
  std::string fallback() const {
    if constexpr (std::is_same_v<Place, double>) return number_in_words(place);
    return "";
  }
};
template <class Place>
NumberValue<Place> number(Place& place, const Allowed& allowed) {
  return {place, allowed};
}

/// A whole number in [least, most].
template <class Place>
auto count(Place& place, int least, int most) {
  struct Value {
    Place& place;
    int least, most;
    void read(const TomlSection& section, std::string_view key) const {
      place = static_cast<Place>(section.count(key, least, most));
    }
    std::string words() const { return fmt::format("whole number from {} to {}", least, most); }
    std::string fallback() const { return fmt::format("{}", place); }
  };
  return Value{place, least, most};
}

/// A text, which is assigned to `place`.
template <class Place>
auto text(Place& place) {
  return custom("a text", [&place](const TomlSection& section, std::string_view key) {
    place = section.text(key);
  });
}

/// A list of at least one text.
inline auto texts(std::vector<std::string>& place) {
  return custom("a list of texts", [&place](const TomlSection& section, std::string_view key) {
    place = section.texts(key);
  });
}

/// A list of at least one number.
inline auto numbers(std::vector<double>& place, const Allowed& allowed, std::string_view words) {
  return custom(words, [&place, &allowed](const TomlSection& section, std::string_view key) {
    place = section.numbers(key, allowed);
  });
}

/// A text that `parse` turns into the value, or refuses with an Error.
template <class Place, class Parse>
auto parsed(std::string_view words, Place& place, const Parse& parse) {
  return custom(words, [&place, parse](const TomlSection& section, std::string_view key) {
    const auto text = section.text(key);
    place = at_key(section, key, [&] { return parse(text); });
  });
}

/// A word and what it means.
template <class Meaning>
using Word = std::pair<std::string_view, Meaning>;

/// One of some words, each with its meaning.
template <class Meaning>
struct WordValue {
  Meaning& place;
  std::span<const Word<Meaning>> allowed;
  void read(const TomlSection& section, std::string_view key) const {
    const auto text = section.text(key);
    const auto found = std::ranges::find(allowed, text, &Word<Meaning>::first);
    section.require(found != allowed.end(), key, "is '{}'; it must be {}", text, joined(" or "));
    place = found->second;
  }
  std::string words() const { return "`" + joined("`, `") + "`"; }
  std::string fallback() const {
    const auto found = std::ranges::find(allowed, place, &Word<Meaning>::second);
    return found == allowed.end() ? "" : fmt::format("`\"{}\"`", found->first);
  }
  std::string joined(std::string_view between) const {
    std::string words;
    for (const auto& [word, meaning] : allowed)
      words += fmt::format("{}\"{}\"", words.empty() ? "" : between, word);
    return words;
  }
};
/// The words must live until the declaration is done, as those of a braced list in its call do.
template <class Meaning>
WordValue<Meaning> one_of(Meaning& place, std::initializer_list<Word<Meaning>> words) {
  return {place, {words.begin(), words.size()}};
}

/// The section [fluid] of a case of spheres without other particles.
inline void viscosity_keys(Keys& keys, double& viscosity) {
  keys.required("viscosity", number(viscosity, kPositive), {"dynamic viscosity mu"});
}

}  // namespace viscontact::case_file
