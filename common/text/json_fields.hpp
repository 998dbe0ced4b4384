// Structs as JSON objects, read and written by one list of their fields.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "viscontact/common/allowed.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/text/json.hpp"

namespace viscontact {

/// Whether a file may lack a key. kRefused: the file must have it; kAllowed: it may lack it;
/// kLeftOutIfEmpty: it may lack it, and it is written without the key if the value is an empty text
/// or list, an optional without a value, or 0.
enum class Absence { kRefused, kAllowed, kLeftOutIfEmpty };

/// Writes or reads the fields of a JSON object. The namespace of a struct S has the function
///
///     void fields_of(JsonFields& json, S& s) {
///       json("radius", s.radius, kPositive);   // key, member, what is allowed
///       json("geometry", s.geometry, kLeftOutIfEmpty);
///     }
///
/// with the fields in the order of the file. Every error of reading is an Error(kBadInput), which
/// names the file, the line, the key and what is allowed there. A NaN or infinity is written as
/// null. An object that reads must not outlive the JsonDocument from which it reads.
class JsonFields {
 public:
  /// The struct that `text`, the content of `file`, describes. Messages of errors end with
  /// `remedy`.
  template <class Struct>
  static Struct read(const std::string& text, const std::string& file,
                     const std::string& remedy = "") {
    try {
      const auto document = JsonDocument::parse(text, file);
      Struct value;
      JsonFields(document, document.root(), "").read_into(value);
      return value;
    } catch (const Error& error) {
      throw Error(error.kind(), error.what() + remedy, error.at());
    }
  }

  template <class Struct>
  static Json write(Struct value) {
    JsonFields fields;
    fields_of(fields, value);
    return fields.written_;
  }

  /// The text of a JSON file, with `indent` >= 0 spaces for each level.
  template <class Struct>
  static std::string text_of(const Struct& value, int indent = 2) {
    assert(indent >= 0);
    // Texts from the head of a table may contain bytes that are not UTF-8. dump() replaces them.
    return write(value).dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
  }

  /// fields_of() may check values while they are read, not written.
  bool reads() const { return json_ != nullptr; }

  /// Throws Error(kBadInput) with "FILE:LINE: KEY WHAT". An empty `key` stands for the object
  /// itself. Only for objects that read.
  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    assert(reads());
    const std::string where = path_of(key);
    throw_bad_input({document_->file(), document_->line_of(where), where}, "{} {}",
                    where.empty() ? "the file" : where, what);
  }
  template <class First, class... Rest>
  [[noreturn]] void fail(const std::string& key, fmt::format_string<First, Rest...> what,
                         First&& first, Rest&&... rest) const {
    fail(key, fmt::format(what, std::forward<First>(first), std::forward<Rest>(rest)...));
  }

  /// The type of `value` is double (finite), bool, std::size_t, long, std::string, std::optional
  /// (without a value it is written as null, or left out with kLeftOutIfEmpty), a map of texts, an
  /// array of two numbers, a struct with fields_of(), or a vector of any of these. If the key is
  /// missing and may be missing, `value` is not changed.
  template <class Value>
  void operator()(const std::string& key, Value& value, Absence absence = Absence::kRefused) {
    if (!reads()) {
      if (absence == Absence::kLeftOutIfEmpty && is_empty(value)) return;
      written_[key] = json_of(value);
    } else if (is_there(key, absence)) {
      if constexpr (requires {
                      value.emplace();
                      value.has_value();
                    })
        if (absence == Absence::kLeftOutIfEmpty) return take(key, json_->at(key), value.emplace());
      take(key, json_->at(key), value);
    }
  }

  /// A finite number; when it is read, the key must exist and the number be `allowed`.
  void operator()(const std::string& key, double& value, const Allowed& allowed) {
    (*this)(key, value);
    if (reads() && !allowed.test(value)) fail(key, "is {}; it must be {}", value, allowed.words);
  }

  /// Two gaps [L]. When they are read, the first must be > 0 and less than the second.
  void gap_interval(const std::string& key, std::array<double, 2>& interval) {
    (*this)(key, interval);
    if (reads() && !(interval[0] > 0 && interval[1] > interval[0]))
      fail(key, "is {}; it must be two gaps with 0 < first < second", json_->at(key).dump());
  }

  /// A vector as a JSON object that has one key for each element of `values`. The key is the member
  /// `name` of the element, and the value is part(element), a reference to another member.
  template <class Value, class Part>
  void by_name(const std::string& key, std::vector<Value>& values, std::string Value::*name,
               const Part& part, Absence absence = Absence::kRefused) {
    if (!reads()) {
      if (values.empty() && absence == Absence::kLeftOutIfEmpty) return;
      written_[key] = Json::object();
      for (auto& value : values) written_[key][value.*name] = json_of(part(value));
    } else if (is_there(key, absence)) {
      const Json& object = json_->at(key);
      require(object.is_object(), key, object, "an object");
      for (const auto& [word, json] : object.items()) {
        values.emplace_back().*name = word;
        take(key + "." + word, json, part(values.back()));
      }
    }
  }

  /// A value, such as an enumerator, as a word: to_string(value) gives the word, and parse(word)
  /// the value. For a wrong word `parse` must throw an Error whose message ends with "; " and what
  /// is allowed; this end becomes the end of the Error(kBadInput) that is thrown here.
  template <class Value, class Parse>
  void word(const std::string& key, Value& value, const Parse& parse,
            Absence absence = Absence::kRefused) {
    std::string word(to_string(value));
    (*this)(key, word, absence);
    if (!reads()) return;
    try {
      value = parse(word);
    } catch (const Error& error) {
      const std::string said = error.what();
      const auto allowed = said.find("; ");
      fail(key, "is '{}'{}", word, allowed == std::string::npos ? "" : said.substr(allowed));
    }
  }

  /// A key that must exist and have the value `text`.
  void constant(const std::string& key, const std::string& text) {
    std::string found = text;
    (*this)(key, found);
    if (found != text) fail(key, "is '{}'; it must be '{}'", found, text);
  }

  /// A key whose object other code reads and writes, and that a file may lack. Nothing is written.
  void foreign_object(const std::string& key) {
    if (reads() && is_there(key, Absence::kAllowed))
      JsonFields(*document_, json_->at(key), path_of(key));
  }

 private:
  JsonFields() = default;
  JsonFields(const JsonDocument& document, const Json& json, std::string path)
      : document_(&document), json_(&json), path_(std::move(path)) {
    if (!json.is_object()) fail("", "is {}; it must be an object", shown(json));
  }

  /// Refuses a key that fields_of() does not know.
  template <class Struct>
  void read_into(Struct& value) {
    fields_of(*this, value);
    for (const auto& [key, member] : json_->items())
      if (!keys_.contains(key)) fail(key, "is not a key of this file");
  }

  bool is_there(const std::string& key, Absence absence) {
    keys_.insert(key);
    const bool is = json_->contains(key);
    if (!is && absence == Absence::kRefused) fail(key, "is missing; the file must have this key");
    return is;
  }

  std::string path_of(const std::string& key) const {
    return path_ + (path_.empty() || key.empty() ? "" : ".") + key;
  }

  /// An array or object is only named as such, because dump() is recursive and a file may nest
  /// values so deeply that the stack overflows.
  static std::string shown(const Json& value) {
    return value.is_structured() ? value.is_array() ? "an array" : "an object" : value.dump();
  }

  void require(bool holds, const std::string& key, const Json& json, const char* what) const {
    if (!holds) fail(key, "is {}; it must be {}", shown(json), what);
  }

  template <class Value>
  static bool is_empty(const Value& value) {
    if constexpr (requires { value.has_value(); })
      return !value.has_value();
    else if constexpr (requires { value.empty(); })
      return value.empty();
    else if constexpr (requires { value == Value(); })
      return value == Value();
    else
      return false;
  }

  template <class Value>
  static Json json_of(const Value& value) {
    if constexpr (requires(JsonFields & fields, Value & copy) { fields_of(fields, copy); })
      return write(value);
    else
      return value;
  }
  template <class Value>
  static Json json_of(const std::optional<Value>& value) {
    return value ? json_of(*value) : Json(nullptr);
  }
  template <class Value>
  static Json json_of(const std::vector<Value>& values) {
    auto array = Json::array();
    for (const auto& value : values) array.push_back(json_of(value));
    return array;
  }

  void take(const std::string& key, const Json& json, double& value) const {
    require(json.is_number() && std::isfinite(json.get<double>()), key, json, "a finite number");
    json.get_to(value);
  }
  void take(const std::string& key, const Json& json, bool& value) const {
    require(json.is_boolean(), key, json, "true or false");
    json.get_to(value);
  }
  void take(const std::string& key, const Json& json, std::size_t& value) const {
    require(json.is_number_unsigned(), key, json, "a whole number >= 0");
    json.get_to(value);
  }
  void take(const std::string& key, const Json& json, long& value) const {
    require(json.is_number_integer(), key, json, "a whole number");
    json.get_to(value);
  }
  void take(const std::string& key, const Json& json, std::string& value) const {
    require(json.is_string(), key, json, "a text in quotes");
    json.get_to(value);
  }
  void take(const std::string& key, const Json& json,
            std::map<std::string, std::string>& texts) const {
    require(json.is_object(), key, json, "an object");
    for (const auto& [name, text] : json.items()) take(key + "." + name, text, texts[name]);
  }
  void take(const std::string& key, const Json& json, std::array<double, 2>& two) const {
    std::vector<double> numbers;
    take(key, json, numbers);
    if (numbers.size() != 2) fail(key, "has {} elements; it must be two numbers", numbers.size());
    two = {numbers[0], numbers[1]};
  }
  template <class Value>
  void take(const std::string& key, const Json& json, std::optional<Value>& value) const {
    if (!json.is_null()) take(key, json, value.emplace());
  }
  template <class Value>
  void take(const std::string& key, const Json& json, std::vector<Value>& values) const {
    require(json.is_array(), key, json, "an array");
    for (std::size_t i = 0; i < json.size(); ++i)
      take(fmt::format("{}[{}]", key, i), json[i], values.emplace_back());
  }
  template <class Struct>
  requires requires(JsonFields& fields, Struct& value) { fields_of(fields, value); }
  void take(const std::string& key, const Json& json, Struct& value) const {
    JsonFields(*document_, json, path_of(key)).read_into(value);
  }

  std::set<std::string> keys_;  ///< keys that fields_of() has named
  Json written_ = Json::object();
  const JsonDocument* document_ = nullptr;
  const Json* json_ = nullptr;
  std::string path_;
};

}  // namespace viscontact
