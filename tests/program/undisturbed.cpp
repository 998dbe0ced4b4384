#include "tests/program/undisturbed.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

}  // namespace

std::string rest_of(const std::filesystem::path& file) {
  std::istringstream lines(read_file(file));
  std::string rest;
  for (std::string line; std::getline(lines, line);)
    if (line.find("provenance") == std::string::npos) rest += line + "\n";
  return rest;
}

std::string without_seconds(const std::filesystem::path& table) {
  std::istringstream lines(rest_of(table));
  std::string text;
  std::ptrdiff_t seconds = -1;  // its place in the header, the first line that is no comment
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('#')) {
      auto fields = fields_of(line);
      if (seconds < 0) seconds = std::ranges::find(fields, "seconds") - fields.begin();
      fields.erase(fields.begin() + seconds);
      line.clear();
      for (const auto& field : fields) line += field + ",";
    }
    text += line + "\n";
  }
  return text;
}

}  // namespace viscontact
