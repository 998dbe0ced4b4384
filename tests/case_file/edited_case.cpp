#include "tests/case_file/edited_case.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <stdexcept>

#include "tests/common/failure.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact::case_file {
namespace {

int line_at(const std::string& text, std::size_t position) {
  return 1 + static_cast<int>(std::count(
                 text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n'));
}

/// Where "name = value" begins.
std::size_t find_key(const std::string& text, const LectureKey& key) {
  const auto header = *key.header == '\0' ? 0 : text.find(std::string("\n") + key.header + "\n");
  const auto found = header == std::string::npos
                         ? header
                         : text.find(std::string(key.name) + " = " + key.value, header);
  if (found == std::string::npos)
    throw std::logic_error(std::string("no such key in the lecture's case: ") + key.path);
  return found;
}

}  // namespace

std::string lecture_text() {
  return read_file(std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "data/cases/lecture.toml");
}

EditedCase with_value(const LectureKey& key, std::string_view value) {
  std::string text = lecture_text();
  const auto at = find_key(text, key);
  const int line = line_at(text, at);
  text.replace(at + std::string(key.name).size() + 3, std::string(key.value).size(), value);
  return {text, line};
}

EditedCase without_key(const LectureKey& key) {
  std::string text = lecture_text();
  auto at = find_key(text, key);
  auto length = std::string(key.name).size() + 3 + std::string(key.value).size();
  // In an inline table the line is its own; else that of the header, or the first of the file.
  const auto line_start = text.rfind('\n', at) + 1;
  const auto header =
      *key.header == '\0' ? 0 : text.find(std::string("\n") + key.header + "\n") + 1;
  const int line = line_at(text, at == line_start ? header : at);
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
      ::testing::AllOf(IsAt(fmt::format("{}:{}", file.string(), edited.line), path), Says(words)));
}

}  // namespace viscontact::case_file
