// JSON texts, read so that an error can name the line of a value.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace viscontact {

using Json = nlohmann::ordered_json;

/// A JSON text that was read, with the line on which each of its values stands.
class JsonDocument {
 public:
  /// Reads a whole text; `file` is its name for messages. Throws Error(kBadInput): with line,
  /// column and cause where the text is not JSON or a number is too large for a double, and with
  /// the line where an object has a key for the second time.
  static JsonDocument parse(const std::string& text, std::string file);

  const Json& root() const { return root_; }
  const std::string& file() const { return file_; }

  /// The line of the value at a path such as "terms[2].name". Where there is none, or it lies
  /// deeper than eight levels, the line of what would contain it; the whole text is "".
  int line_of(std::string path) const;

 private:
  Json root_;
  std::string file_;
  std::map<std::string, int> lines_;
};

/// What an error of the JSON library says, without the library's own name for it and without a
/// place; at most some 200 characters.
std::string cause_in_words(const Json::exception& error);

}  // namespace viscontact
