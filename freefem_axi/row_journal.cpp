#include "freefem_axi/row_journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sstream>

#include "common/error.hpp"
#include "common/file.hpp"
#include "common/number.hpp"

namespace viscontact {
namespace {

constexpr std::size_t kNumbers = 7;

std::string to_line(const std::string& hash, const ForceTableRow& row) {
  return fmt::format("{} {} {} {} {} {} {} {}\n", hash, format_number(row.gap),
                     format_number(row.reference_velocity), format_number(row.force),
                     format_number(row.drag_factor), format_number(row.relative_error_estimate),
                     format_number(row.degrees_of_freedom), format_number(row.seconds));
}

/// The row of a line, if it is whole and of that tabulation.
std::optional<ForceTableRow> from_line(const std::string& hash, const std::string& line) {
  std::istringstream stream(line);
  std::string word;
  stream >> word;
  if (word != hash) return {};
  std::vector<double> numbers;
  while (stream >> word) {
    const auto number = parse_number(word);
    if (!number) return {};
    numbers.push_back(*number);
  }
  if (numbers.size() != kNumbers) return {};
  return ForceTableRow{numbers[0], numbers[1], numbers[2], numbers[3],
                       numbers[4], numbers[5], numbers[6]};
}

}  // namespace

RowJournal::RowJournal(std::filesystem::path path, std::string tabulation_hash)
    : path_(std::move(path)), hash_(std::move(tabulation_hash)) {
  if (path_.has_parent_path()) make_folder(path_.parent_path());
  const auto fail = [&](int code) {
    throw_bad_input({path_.string()}, fmt::format("cannot be written ({})", std::strerror(code)));
  };
  file_ = Descriptor(::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  if (file_.get() < 0) fail(errno);
  if (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0)
    throw_bad_input(
        {path_.string()},
        "is held by another tabulation of the same table; wait for it, or write elsewhere");

  std::string kept;
  const std::string text = read_file(path_);
  for (std::size_t start = 0, end = 0; (end = text.find('\n', start)) != std::string::npos;
       start = end + 1) {
    const auto row = from_line(hash_, text.substr(start, end - start));
    if (!row) continue;
    rows_.push_back(*row);
    kept += to_line(hash_, *row);
  }
  if (kept != text) {
    // In place: the lock is on this file. A crash in between loses rows at worst, it never invents
    // one.
    if (::ftruncate(file_.get(), 0) != 0) fail(errno);
    if (::write(file_.get(), kept.data(), kept.size()) != static_cast<ssize_t>(kept.size()))
      fail(errno);
  }
}

std::optional<ForceTableRow> RowJournal::find(double gap, double reference_velocity) const {
  const auto found = std::ranges::find_if(rows_, [&](const ForceTableRow& row) {
    return row.gap == gap && row.reference_velocity == reference_velocity;
  });
  return found == rows_.end() ? std::nullopt : std::optional(*found);
}

void RowJournal::append(const ForceTableRow& row) {
  const std::string line = to_line(hash_, row);
  std::string_view rest = line;
  while (!rest.empty()) {
    const ssize_t written = ::write(file_.get(), rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0)
      throw_bad_input({path_.string()},
                      fmt::format("cannot be written ({})", std::strerror(errno)));
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::fsync(file_.get()) != 0)
    throw_bad_input({path_.string()}, fmt::format("cannot be written ({})", std::strerror(errno)));
  rows_.push_back(row);
}

}  // namespace viscontact
