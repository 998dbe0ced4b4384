// Comments, hints and blank lines of CSV files (csv.hpp).
#include "viscontact/common/csv.hpp"

#include <fmt/format.h>

namespace viscontact {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // some spreadsheets write it

}  // namespace

std::string hint_of_separator(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    if (line.find('"') != std::string::npos)
      return ", '" + shortened(line) + "'; the names of columns must stand without quotes";
    if (line.find(',') != std::string::npos) return ", '" + shortened(line) + "'";
    if (line.find('\0') != std::string::npos)
      return "; the file seems to be UTF-16, it must be UTF-8";
    if (line.find(';') != std::string::npos)
      return ", whose fields are separated by semicolons; they must be separated by commas, with "
             "decimal points";
    if (line.find('\t') != std::string::npos)
      return ", whose fields are separated by tabs; they must be separated by commas";
    return "";
  }
  return "";
}

void remove_trailing_blank_lines(std::string& text) {
  const auto last = text.find_last_not_of(" \t\r\n,");
  if (last == std::string::npos) return;
  // Empty fields at the end of the last row belong to it.
  const auto end_of_row = text.find('\n', last);
  if (end_of_row != std::string::npos) text.erase(end_of_row + 1);
}

CsvComments read_csv_comments(const std::string& text, std::set<std::string>* contradictions) {
  CsvComments comments;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
    if (line.empty() || line[0] != '#') continue;
    // The '#' at the begin of the line ends this loop at the latest.
    while (line.back() == '\r' || line.back() == ',') line.pop_back();
    const auto colon = line.find(": ");
    const auto start = line.find_first_not_of("# \t");
    if (colon == std::string::npos || start >= colon) continue;
    const auto [place, is_new] =
        comments.insert({line.substr(start, colon - start), line.substr(colon + 2)});
    if (is_new || place->second == line.substr(colon + 2)) continue;
    place->second = line.substr(colon + 2);
    if (contradictions != nullptr) contradictions->insert(place->first);
  }
  return comments;
}

std::string write_csv_comments(const CsvComments& comments) {
  std::string text;
  for (const auto& [key, value] : comments) text += fmt::format("# {}: {}\n", key, value);
  return text;
}

std::string shortened(const std::string& text) {
  constexpr std::size_t kLongest = 60;
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

double csv_comment_number(const CsvComments& comments, const std::string& key,
                          const std::string& file) {
  const auto found = comments.find(key);
  if (found == comments.end())
    throw_bad_input({file}, fmt::format("the line '# {}: NUMBER' is missing", key));
  const auto value = parse_number(found->second);
  if (!value)
    throw_bad_input(
        {file}, fmt::format("the line '# {}: {}' must give a finite number", key, found->second));
  return *value;
}

}  // namespace viscontact
