// Writes and reads the lines of a journal. A line is "HASH row NUMBERS VERSION CHECKSUM" or "HASH
// failed GAP VELOCITY REASON CHECKSUM".
#include "viscontact/freefem_axi/journal/journal_line.hpp"

#include <fmt/format.h>

#include <initializer_list>
#include <sstream>

#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/common/text/on_one_line.hpp"

namespace viscontact::freefem_axi {
namespace {

constexpr std::string_view kFinished = "row";
constexpr std::string_view kFailed = "failed";

std::string checksum(std::string_view text) {
  // 64 bits of SHA-256 are enough to detect damage.
  constexpr std::size_t kDigits = 16;
  return sha256(text).substr(0, kDigits);
}

/// Reads a number into each of `places`. Returns false if a word is missing or is not a number.
bool read_numbers(std::istream& words, std::initializer_list<double*> places) {
  for (double* place : places) {
    std::string word;
    words >> word;
    const auto number = parse_number(word);
    if (!number) return false;
    *place = *number;
  }
  return true;
}

std::string rest_of(std::istream& words) {
  std::string rest;
  std::getline(words >> std::ws, rest);
  return rest;
}

std::string text_of(const FinishedRow& finished) {
  const auto& row = finished.row;
  return fmt::format("{} {} {} {} {} {} {} {} {} {}", kFinished, format_number(row.gap),
                     format_number(row.reference_velocity), format_number(row.force),
                     format_number(row.drag_factor), format_number(row.relative_error_estimate),
                     format_number(row.degrees_of_freedom), format_number(row.seconds),
                     format_number(row.observed_order), on_one_line(finished.freefem_version));
}

std::string text_of(const FailedRow& failed) {
  return fmt::format("{} {} {} {}", kFailed, format_number(failed.point.gap),
                     format_number(failed.point.reference_velocity), on_one_line(failed.reason));
}

}  // namespace

std::string write_journal_line(const JournalLine& line) {
  const std::string text = line.tabulation_hash + " " +
                           std::visit([](const auto& entry) { return text_of(entry); }, line.entry);
  return fmt::format("{} {}\n", text, checksum(text));
}

std::optional<JournalLine> read_journal_line(std::string_view line) {
  const auto end = line.rfind(' ');
  if (end == std::string_view::npos || checksum(line.substr(0, end)) != line.substr(end + 1))
    return {};
  std::istringstream words{std::string(line.substr(0, end))};
  std::string hash;
  std::string kind;
  words >> hash >> kind;
  if (kind == kFinished) {
    FinishedRow finished;
    auto& row = finished.row;
    if (!read_numbers(words, {&row.gap, &row.reference_velocity, &row.force, &row.drag_factor,
                              &row.relative_error_estimate, &row.degrees_of_freedom, &row.seconds,
                              &row.observed_order}))
      return {};
    finished.freefem_version = rest_of(words);
    return JournalLine{hash, finished};
  }
  FailedRow failed;
  if (kind != kFailed ||
      !read_numbers(words, {&failed.point.gap, &failed.point.reference_velocity}))
    return {};
  failed.reason = rest_of(words);
  return JournalLine{hash, failed};
}

}  // namespace viscontact::freefem_axi
