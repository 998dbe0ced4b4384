#include "tests/app/undisturbed.hpp"

#include <sstream>

#include "common/file.hpp"

namespace viscontact {

std::string without_seconds(const std::filesystem::path& table) {
  std::istringstream lines(read_file(table));
  std::string text;
  for (std::string line; std::getline(lines, line);)
    text += (line.starts_with('#') ? line : line.substr(0, line.rfind(','))) + "\n";
  return text;
}

}  // namespace viscontact
