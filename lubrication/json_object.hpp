// A JSON object that is read with errors fit for a user.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "viscontact/common/error.hpp"
#include "viscontact/common/json.hpp"

namespace viscontact {

/// A value for a message. What holds others is named only: it may be deeper than the stack.
inline std::string shown(const Json& value) {
  return value.is_structured() ? value.is_array() ? "an array" : "an object" : value.dump();
}

/// A JSON object whose keys are read one by one and that knows where it stands, for errors such as
/// "FILE:LINE: terms[2].name is ...". Every function throws Error(kBadInput) for a missing key, a
/// value of another type and a value that is not allowed. The document must outlive the object.
class JsonObject {
 public:
  explicit JsonObject(const JsonDocument& document) : JsonObject(document, document.root(), "") {}

  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    const std::string where = path_ + (path_.empty() || key.empty() ? "" : ".") + key;
    throw_bad_input({document_.file(), document_.line_of(where)},
                    fmt::format("{} {}", where.empty() ? "the file" : where, what));
  }

  const Json& at(const std::string& key) const {
    if (!json_.contains(key)) fail(key, "is missing; a fit file must have this key");
    return json_.at(key);
  }

  double number(const std::string& key) const { return finite(key, at(key)); }

  double finite(const std::string& key, const Json& value) const {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      fail(key, fmt::format("is {}; it must be a finite number", shown(value)));
    return value.get<double>();
  }

  double number_above(const std::string& key, double bound, bool bound_allowed) const {
    const double value = number(key);
    if (value < bound || (value == bound && !bound_allowed))
      fail(key, fmt::format("is {}; it must be {} {}", value, bound_allowed ? ">=" : ">", bound));
    return value;
  }

  std::string text(const std::string& key) const {
    if (!at(key).is_string())
      fail(key, fmt::format("is {}; it must be a text in quotes", shown(at(key))));
    return at(key).get<std::string>();
  }

  /// A number, or null for none.
  std::optional<double> number_or_null(const std::string& key) const {
    return at(key).is_null() ? std::nullopt : std::optional(number(key));
  }

  std::size_t count(const std::string& key) const {
    if (!at(key).is_number_unsigned())
      fail(key, fmt::format("is {}; it must be a whole number >= 0", shown(at(key))));
    return at(key).get<std::size_t>();
  }

  bool truth(const std::string& key) const {
    if (!at(key).is_boolean())
      fail(key, fmt::format("is {}; it must be true or false", shown(at(key))));
    return at(key).get<bool>();
  }

  /// A word that `parse` knows. It throws Error("...; what is allowed") for another one, which becomes an error at the key.
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

  bool has(const std::string& key) const { return json_.contains(key); }

  const Json& array(const std::string& key) const {
    if (!at(key).is_array()) fail(key, fmt::format("is {}; it must be an array", shown(at(key))));
    return at(key);
  }

  /// An element of an array of objects.
  JsonObject element(const std::string& key, std::size_t index) const {
    const std::string inner =
        fmt::format("{}{}{}[{}]", path_, path_.empty() ? "" : ".", key, index);
    return {document_, array(key).at(index), inner};
  }

  /// The object at a key.
  JsonObject object(const std::string& key) const {
    return {document_, at(key), fmt::format("{}{}{}", path_, path_.empty() ? "" : ".", key)};
  }

  void allow_only(std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, value] : json_.items())
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        fail(key, "is not a key of a fit file");
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

}  // namespace viscontact
