// A line is "HASH row POINT NUMBERS VERSION CHECKSUM" or "HASH failed POINT REASON CHECKSUM", with
// TablePlan::hash and the version of FreeFEM.
#include "viscontact/freefem_axi/journal/row_journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fnmatch.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cstring>
#include <sstream>

#include "viscontact/common/files/file.hpp"
#include "viscontact/common/files/locks.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/common/text/on_one_line.hpp"

namespace viscontact::freefem_axi {
namespace {

constexpr std::string_view kFinished = "row";
constexpr std::string_view kFailed = "failed";

std::string checksum(std::string_view text) {
  // 64 bits of SHA-256 are enough to detect damage. With another number all lines of earlier
  // journals count as damaged.
  constexpr std::size_t kDigits = 16;
  return sha256(text).substr(0, kDigits);
}

/// The next `count` words. Nothing if a word is missing or is not a finite number.
std::optional<std::vector<double>> read_numbers(std::istream& words, std::size_t count) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    std::string word;
    words >> word;
    const auto number = parse_number(word);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

std::string text_of(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += format_number(number) + " ";
  return text;
}

std::string rest_of(std::istream& words) {
  std::string rest;
  std::getline(words >> std::ws, rest);
  return rest;
}

/// The part of a line between HASH and CHECKSUM; a line end in a version or reason becomes a blank.
std::string text_of(const FinishedRow& finished) {
  return fmt::format("{} {}{}{}", kFinished, text_of(finished.point), text_of(finished.numbers),
                     on_one_line(finished.freefem_version));
}

std::string text_of(const FailedRow& failed) {
  return fmt::format("{} {}{}", kFailed, text_of(failed.point), on_one_line(failed.reason));
}

/// Nothing if the checksum is wrong.
std::optional<std::string> checked_text(std::string_view line) {
  const auto end = line.rfind(' ');
  if (end == std::string_view::npos || checksum(line.substr(0, end)) != line.substr(end + 1))
    return {};
  return std::string(line.substr(0, end));
}

}  // namespace

std::string write_journal_line(const std::string& hash, const JournalEntry& entry) {
  assert(hash.find(' ') == std::string::npos);
  const std::string text =
      hash + " " + std::visit([](const auto& row) { return text_of(row); }, entry);
  return fmt::format("{} {}\n", text, checksum(text));
}

std::optional<std::string> hash_of_journal_line(std::string_view line) {
  const auto text = checked_text(line);
  if (!text) return {};
  return text->substr(0, text->find(' '));
}

std::optional<JournalEntry> read_journal_line(std::string_view line, const RowShape& shape) {
  const auto text = checked_text(line);
  if (!text) return {};
  std::istringstream words(*text);
  std::string hash;
  std::string kind;
  words >> hash >> kind;
  if (kind != kFinished && kind != kFailed) return {};
  const auto point = read_numbers(words, shape.point);
  if (!point) return {};
  if (kind == kFailed) return FailedRow{*point, rest_of(words)};
  const auto numbers = read_numbers(words, shape.numbers);
  if (!numbers) return {};
  return FinishedRow{*point, *numbers, rest_of(words)};
}

namespace {

bool ends_with_line_end(int file) {
  const off_t size = ::lseek(file, 0, SEEK_END);
  char last = '\n';
  return size <= 0 || (::pread(file, &last, 1, size - 1) == 1 && last == '\n');
}

}  // namespace

std::filesystem::path journal_path(const std::filesystem::path& table_path,
                                   const std::string& writer) {
  return table_path.string() + (writer.empty() ? ".rows" : ".rows." + writer);
}

std::string writer_name(std::size_t number, std::size_t count) {
  assert(number < count);
  std::array<char, 256> host{};  // names of hosts have at most 64 characters in Linux
  ::gethostname(host.data(), host.size() - 1);
  return fmt::format("{}-of-{}.{}.{}", number, count, host.data(), ::getpid());
}

bool is_writer_name(const std::string& name) {
  return ::fnmatch("+([0-9])-of-+([0-9]).?*.+([0-9])", name.c_str(), FNM_EXTMATCH) == 0;
}

RowJournal::RowJournal(std::filesystem::path path, std::string hash)
    : path_(std::move(path)), hash_(std::move(hash)) {
  if (path_.has_parent_path()) make_folder(path_.parent_path());
  file_ = open_and_lock(
      path_, "is locked by another tabulation of the same table; wait for it, or write elsewhere");
  sync_folder_of(path_);
  at_line_start_ = ends_with_line_end(file_.get());
}

void RowJournal::append(const JournalEntry& entry) {
  const std::string line = (at_line_start_ ? "" : "\n") + write_journal_line(hash_, entry);
  at_line_start_ = false;
  append_to(file_, line, path_);
  sync_file(file_, path_);
  at_line_start_ = true;
}

}  // namespace viscontact::freefem_axi
