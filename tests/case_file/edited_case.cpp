#include "tests/case_file/edited_case.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "tests/common/failure.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact::case_file {
namespace {

int line_at(const std::string& text, std::size_t position) {
  return 1 + static_cast<int>(std::count(
                 text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n'));
}

/// Where the header before the key begins; 0 for a key without one.
std::size_t find_header(const std::string& text, const std::string& path) {
  const auto dot = path.find('.');
  if (dot == std::string::npos) return 0;
  return text.find("\n[" + path.substr(0, dot) + "]\n") + 1;
}

/// "name = value" as it stands in the case, and where it begins.
std::pair<std::string, std::size_t> find_key(const std::string& text, const LectureKey& key) {
  const std::string path = key.path;
  const auto entry = path.substr(path.rfind('.') + 1) + " = " + key.value;
  const auto found = text.find(entry, find_header(text, path));
  if (found == std::string::npos) throw std::logic_error("not in the lecture's case: " + path);
  return {entry, found};
}

}  // namespace

std::string lecture_text() {
  return read_file(std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "data/cases/lecture.toml");
}

EditedCase with_value(const LectureKey& key, std::string_view value) {
  std::string text = lecture_text();
  const auto [entry, at] = find_key(text, key);
  const int line = line_at(text, at);
  const auto length = std::string(key.value).size();
  text.replace(at + entry.size() - length, length, value);
  return {text, line};
}

EditedCase without_key(const LectureKey& key) {
  std::string text = lecture_text();
  auto [entry, at] = find_key(text, key);
  auto length = entry.size();
  // In an inline table the line is its own; else that of the header, or the first of the file.
  const auto line_start = text.rfind('\n', at) + 1;
  const int line = line_at(text, at == line_start ? find_header(text, key.path) : at);
  // An inline table may not keep the comma.
  if (text.compare(at + length, 2, ", ") == 0) {
    length += 2;
  } else if (text.compare(at - 2, 2, ", ") == 0) {
    at -= 2;
    length += 2;
  }
  text.erase(at, length);
  return {text, line};
}

EditedCase with_text(std::string_view from, std::string_view to) {
  std::string text = lecture_text();
  const auto at = text.find(from);
  if (at == std::string::npos || text.find(from, at + 1) != std::string::npos)
    throw std::logic_error("not once in the lecture's case: " + std::string(from));
  text.replace(at, from.size(), to);
  return {text, line_at(text, at)};
}

std::string text_with(const std::string& path, std::string_view from, std::string_view to) {
  auto text = read_file(path);
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("not in " + path + ": " + std::string(from));
  return text.replace(at, from.size(), to);
}

Case read_text(const std::string& text) {
  const TemporaryFolder folder;
  return read_case(folder.file("case.toml", text));
}

void expect_refused(const EditedCase& edited, const std::string& path, const std::string& words) {
  const TemporaryFolder folder;
  const auto file = folder.file("case.toml", edited.text);
  EXPECT_THAT(
      bad_input([&] { read_case(file); }),
      ::testing::AllOf(IsAt(fmt::format("{}:{}", file.string(), edited.line), path), Names(words)));
}

}  // namespace viscontact::case_file
