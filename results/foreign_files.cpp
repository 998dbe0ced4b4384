// Recognises files of Viscontact by their provenance (provenance.hpp).
#include "viscontact/results/foreign_files.hpp"

#include <cassert>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "viscontact/common/error.hpp"

namespace viscontact::results {
namespace {

/// True if the text has the word "provenance", then an object whose first key is "command". Other
/// programs may have written the JSON again with other spaces and line ends, so the characters
/// between these two words are not compared.
bool has_provenance(std::string_view text) {
  constexpr std::string_view kName = "provenance", kFirstKey = "\"command\"";
  // A quote, a colon, a brace, spaces and a line end stand between the two words.
  constexpr std::size_t kMostBetween = 40;
  for (auto at = text.find(kName); at != std::string_view::npos; at = text.find(kName, at + 1))
    if (text.substr(at + kName.size(), kMostBetween + kFirstKey.size()).find(kFirstKey) !=
        std::string_view::npos)
      return true;
  return false;
}

}  // namespace

std::string read_head(const std::filesystem::path& path) {
  constexpr std::size_t kMost = std::size_t{1} << 20U;  // bytes; longer than any head
  std::ifstream file(path, std::ios::binary);
  if (!file) throw_bad_input({path.string()}, "cannot be read ({})", std::strerror(errno));
  std::string text;
  const auto read_most = [&] {
    std::string part(kMost, '\0');
    file.read(part.data(), static_cast<std::streamsize>(part.size()));
    text += part.substr(0, static_cast<std::size_t>(file.gcount()));
  };
  read_most();
  // The provenance of a PDF is in its last lines. If the file is shorter than both parts together,
  // a part of it is read twice.
  if (text.starts_with("%PDF-") && file) {
    file.seekg(-static_cast<std::streamoff>(kMost), std::ios::end);
    read_most();
  }
  return text;
}

bool is_written_by_viscontact(const std::filesystem::path& path) {
  return has_provenance(read_head(path));
}

void refuse_other_kind(const std::filesystem::path& path, std::string_view marker,
                       std::string_view kind) {
  assert(!kind.empty());
  // If `path` is a folder or a device, write_file() throws an error that says so.
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return;
  const std::string head = read_head(path);
  if (head.empty() || (head.find(marker) != std::string::npos && has_provenance(head))) return;
  throw_bad_input(
      {path.string()},
      "is not {} {} that Viscontact wrote, so it is not replaced; remove it first, or write "
      "elsewhere",
      std::string_view("aeiou").find(kind.front()) != std::string_view::npos ? "an" : "a", kind);
}

}  // namespace viscontact::results
