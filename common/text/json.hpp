// Reads JSON texts (RFC 8259) and remembers the line of each value, so that an error can name it. A
// text that is not valid JSON throws Error(kBadInput) with the line of the fault; units and meaning
// of the values are not checked here. Readers of fit files, comparisons, provenance and records of
// runs use this file. The limits of eight levels and 200 characters below are free choices. A
// change must keep the order of the keys, because files are written in this order.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace viscontact {

/// A JSON value, whose objects keep their keys in the order of the text.
using Json = nlohmann::ordered_json;

/// A JSON text that has been read, with the line of each of its values.
class JsonDocument {
 public:
  /// Reads a whole text; `file` is its name in messages. Throws Error(kBadInput) with line, column
  /// and cause if the text is not valid JSON or a number is too large for a double, and with the
  /// line if an object has the same key twice.
  static JsonDocument parse(const std::string& text, std::string file);

  /// The value of the whole text.
  const Json& root() const { return root_; }
  /// Name of the file in messages.
  const std::string& file() const { return file_; }

  /// Line, from 1, of the value at a path such as "terms[2].name"; the path of the whole text is
  /// "". If there is no such value, or it lies deeper than eight levels, returns the line of the
  /// array or object that would contain it.
  int line_of(std::string path) const;

 private:
  Json root_;
  std::string file_;
  std::map<std::string, int> lines_;
};

/// The cause that an error of the JSON library states, without the library's error name and without
/// a position, shortened to about 200 characters.
std::string cause_in_words(const Json::exception& error);

/// Calls `read` with the JSON value in the file at `path`. Throws Error(kBadInput), which names the
/// file, if the file cannot be read or is not valid JSON, or if a value that `read` asks for is
/// missing or of another type (a Json::exception). Other exceptions of `read` pass unchanged.
void read_json(const std::filesystem::path& path, const std::function<void(const Json&)>& read);

}  // namespace viscontact
