// Reads a JSON object key by key, for the readers of the three kinds of fit files. Every error
// message names the file, the line, the key and what is allowed there; a change must keep that.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>
#include <string>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/json.hpp"

namespace viscontact::lubrication {

/// A value as text for a message. For an array or object it says only which of the two it is,
/// because dump() is recursive and a file may nest values so deeply that the stack overflows.
inline std::string shown(const Json& value) {
  return value.is_structured() ? value.is_array() ? "an array" : "an object" : value.dump();
}

/// A JSON object and its place in the document, for messages such as "FILE:LINE: terms[2].name is
/// ...". Every function that reads throws Error(kBadInput) if the key is missing, or if its value
/// has another type or is not allowed. The document must outlive the object.
class JsonObject {
 public:
  /// The whole document, whose value must be an object.
  explicit JsonObject(const JsonDocument& document) : JsonObject(document, document.root(), "") {}

  /// Throws Error(kBadInput) with "FILE:LINE: KEY WHAT". An empty `key` stands for the object
  /// itself.
  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    const std::string where = path_ + (path_.empty() || key.empty() ? "" : ".") + key;
    throw_bad_input({document_.file(), document_.line_of(where)},
                    fmt::format("{} {}", where.empty() ? "the file" : where, what));
  }

  /// The value of the key, of any type.
  const Json& at(const std::string& key) const {
    if (!has(key)) fail(key, "is missing; a fit file must have this key");
    return json_.at(key);
  }

  /// A finite number.
  double number(const std::string& key) const { return finite(key, at(key)); }

  /// `value` as a finite number. `key` is its name in messages.
  double finite(const std::string& key, const Json& value) const {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      fail(key, fmt::format("is {}; it must be a finite number", shown(value)));
    return value.get<double>();
  }

  /// A number > `bound`, or >= `bound` if `bound_allowed`.
  double number_above(const std::string& key, double bound, bool bound_allowed) const {
    const double value = number(key);
    if (value < bound || (value == bound && !bound_allowed))
      fail(key, fmt::format("is {}; it must be {} {}", value, bound_allowed ? ">=" : ">", bound));
    return value;
  }

  /// A text, which may be empty.
  std::string text(const std::string& key) const {
    if (!at(key).is_string())
      fail(key, fmt::format("is {}; it must be a text in quotes", shown(at(key))));
    return at(key).get<std::string>();
  }

  /// A number, or nothing if the value is null.
  std::optional<double> number_or_null(const std::string& key) const {
    return at(key).is_null() ? std::nullopt : std::optional(number(key));
  }

  /// A whole number >= 0.
  std::size_t count(const std::string& key) const {
    if (!at(key).is_number_unsigned())
      fail(key, fmt::format("is {}; it must be a whole number >= 0", shown(at(key))));
    return at(key).get<std::size_t>();
  }

  /// True or false.
  bool boolean(const std::string& key) const {
    if (!at(key).is_boolean())
      fail(key, fmt::format("is {}; it must be true or false", shown(at(key))));
    return at(key).get<bool>();
  }

  /// A text that `parse` translates. `parse` throws Error("...; what is allowed") for other texts;
  /// the part of that text from the semicolon on is added to the message about this key.
  template <class Parse>
  auto word(const std::string& key, const Parse& parse) const {
    try {
      return parse(text(key));
    } catch (const Error& error) {
      const std::string said = error.what();
      const auto allowed = said.find("; ");
      fail(key, fmt::format("is '{}'{}", text(key),
                            allowed == std::string::npos ? "" : said.substr(allowed)));
    }
  }

  /// True if the object has the key.
  bool has(const std::string& key) const { return json_.contains(key); }

  /// An array, which may be empty.
  const Json& array(const std::string& key) const {
    if (!at(key).is_array()) fail(key, fmt::format("is {}; it must be an array", shown(at(key))));
    return at(key);
  }

  /// The element `index` of the array at `key`, which must be an object.
  JsonObject element(const std::string& key, std::size_t index) const {
    const std::string inner =
        fmt::format("{}{}{}[{}]", path_, path_.empty() ? "" : ".", key, index);
    return {document_, array(key).at(index), inner};
  }

  /// The object at `key`.
  JsonObject object(const std::string& key) const {
    return {document_, at(key), fmt::format("{}{}{}", path_, path_.empty() ? "" : ".", key)};
  }

  /// Throws Error(kBadInput) if the object has a key that is not among `keys`, a list separated by
  /// blanks.
  void allow_only(const std::string& keys) const {
    std::istringstream words(keys);
    const std::set<std::string> allowed{std::istream_iterator<std::string>(words), {}};
    for (const auto& [key, value] : json_.items())
      if (!allowed.contains(key)) fail(key, "is not a key of a fit file");
  }

 private:
  JsonObject(const JsonDocument& document, const Json& json, std::string path)
      : document_(document), json_(json), path_(std::move(path)) {
    if (!json_.is_object()) fail("", fmt::format("is {}; it must be an object", shown(json_)));
  }

  const JsonDocument& document_;
  const Json& json_;
  std::string path_;
};

struct Fit;

/// Reads a Fit from an object that has the keys of a fit file, and perhaps `further_keys`, which
/// are separated by spaces and which the caller reads.
Fit read_fit_object(const JsonObject& root, const std::string& further_keys = "");

}  // namespace viscontact::lubrication
