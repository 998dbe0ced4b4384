#include "viscontact/results/foreign_files.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include "viscontact/common/error.hpp"

namespace viscontact {
namespace {

/// The first MiB of a file. Throws Error(kBadInput) that names the path if it cannot be read.
std::string head_of(const std::filesystem::path& path) {
  constexpr std::size_t kMost = std::size_t{1} << 20U;
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw_bad_input({path.string()}, fmt::format("cannot be read ({})", std::strerror(errno)));
  std::string head(kMost, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

/// True if the text holds a line of provenance (provenance.hpp), or the same as other programs
/// write JSON out again: "provenance", then an object whose first key is "command".
bool has_provenance(std::string_view text) {
  constexpr std::string_view kName = "provenance", kFirstKey = "\"command\"";
  constexpr std::size_t kMostBetween = 40;  // a quote, a colon, a brace, spaces, a line end
  for (auto at = text.find(kName); at != std::string_view::npos; at = text.find(kName, at + 1))
    if (text.substr(at + kName.size(), kMostBetween + kFirstKey.size()).find(kFirstKey) !=
        std::string_view::npos)
      return true;
  return false;
}

}  // namespace

bool is_written_by_viscontact(const std::filesystem::path& path) {
  return has_provenance(head_of(path));
}

void refuse_other_kind(const std::filesystem::path& path, std::string_view marker,
                       std::string_view kind) {
  // For what is there and is no regular file, write_file has errors of its own.
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return;
  const std::string head = head_of(path);
  if (head.empty() || (head.find(marker) != std::string::npos && has_provenance(head))) return;
  throw_bad_input({path.string()},
                  fmt::format("is there and is no {} that Viscontact wrote; remove it first, or "
                              "write elsewhere",
                              kind));
}

}  // namespace viscontact
