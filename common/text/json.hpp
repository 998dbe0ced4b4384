// JSON texts (RFC 8259) with the line of each value, so that an error can name it.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace viscontact {

/// Objects keep their keys in the order of the text.
using Json = nlohmann::ordered_json;

class JsonDocument {
 public:
  /// Messages call the text `file`. Throws Error(kBadInput) with line and cause if the text is not
  /// valid JSON, a number is too large for a double, or an object has the same key twice.
  static JsonDocument parse(const std::string& text, std::string file);

  const Json& root() const { return root_; }
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

/// The cause that an error of the library states, without the library's error name and position,
/// shortened to about 200 bytes.
std::string cause_in_words(const Json::exception& error);

/// Calls `read` with the JSON value in the file. Throws Error(kBadInput), which names the file, if
/// it cannot be read or is not valid JSON, or if a value that `read` asks for is missing or of
/// another type (a Json::exception). Other exceptions of `read` pass unchanged.
void read_json(const std::filesystem::path& path, const std::function<void(const Json&)>& read);

}  // namespace viscontact
