// Computes the rows of a sweep, and writes, continues and reads its file.
#include "viscontact/sweep/study.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <fstream>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "viscontact/common/files/file.hpp"
#include "viscontact/common/files/locks.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact::sweep {
namespace {

namespace fs = std::filesystem;

std::string header_of(const Study& study) {
  return write_csv_comments(study.comments) + fmt::format("{}\n", fmt::join(study.columns(), ","));
}

constexpr std::string_view kHowMade = "# provenance: ";

/// Finished rows of this sweep after the header, and the bytes up to the end of the last of them.
struct Kept {
  std::uint64_t rows = 0, bytes = 0;
};
/// Nothing if the file does not begin with `header`, or if it cannot be read.
std::optional<Kept> kept_rows(const fs::path& path, const std::string& header, const Study& study) {
  std::ifstream file(path, std::ios::binary);
  // The line that says how the file was made (kHowMade, as results/provenance.cpp begins a file)
  // may differ, because it does not influence the rows.
  std::string first;
  if (!std::getline(file, first) || !first.starts_with(kHowMade)) {
    file.clear();
    file.seekg(0);
    first.clear();
  }
  const std::uint64_t header_at = first.empty() ? 0 : first.size() + 1;
  std::string begin(header.size(), '\0');
  if (!file.read(begin.data(), static_cast<std::streamsize>(begin.size())) || begin != header)
    return {};
  const auto separators = static_cast<std::ptrdiff_t>(study.columns().size() - 1);
  Kept kept{0, header_at + header.size()};
  std::string line;
  // After a power cut a file may contain anything after the last row that was flushed to disk.
  // Reading therefore stops at the first line that is not a row of this sweep.
  while (kept.rows < study.size() && std::getline(file, line) && !file.eof() &&
         line.starts_with(study.points.key_fields(kept.rows) + ",") &&
         std::ranges::count(line, ',') == separators) {
    ++kept.rows;
    kept.bytes += line.size() + 1;
  }
  return kept;
}

}  // namespace

std::vector<std::string> Study::columns() const {
  auto columns = points.keys();
  columns.insert(columns.end(), results.begin(), results.end());
  columns.emplace_back("failure");
  return columns;
}

std::string Study::row(std::uint64_t index, const StopToken& stop) const {
  const auto found = run(index, stop);
  std::string text = points.key_fields(index);
  for (const auto& column : results) {
    text += ',';
    if (const auto value = found.values.find(column);
        value != found.values.end() && std::isfinite(value->second))
      text += format_number(value->second);
    else if (const auto number = found.numbers.find(column); number != found.numbers.end())
      text += std::to_string(number->second);
  }
  std::string failure = found.failure;
  // Commas and line breaks would divide the line.
  std::ranges::replace_if(
      failure, [](char c) { return c == ',' || c == '\n' || c == '\r'; }, ';');
  return fmt::format("{},{}\n", text, failure);
}

std::map<std::string, std::string> head_of(const std::string& kind, const std::string& case_text,
                                           const Points& points, const std::string& identity,
                                           const std::string& version, const Units& units) {
  std::map<std::string, std::string> head = {{"viscontact", kind},
                                             {"case", sha256(case_text)},
                                             {"rows", std::to_string(points.rows())},
                                             {"sweep", sha256(identity)},
                                             {"version of Viscontact", version}};
  if (units.are_said()) head["units"] = units.words();
  return head;
}

void refuse_doubles(const std::vector<std::string>& names, std::string_view kind) {
  std::set<std::string> seen;
  for (const auto& name : names)
    if (!seen.insert(name).second)
      throw Error(ErrorKind::kWrongUsage, "{} {} is given twice", kind, name);
}

Points points_of_case(const std::vector<std::string>& ranges, const fs::path& case_path, int line) {
  assert(ranges.empty() || line > 0);
  Points points;
  if (!ranges.empty()) points.place = PlaceOfRanges{case_path.string(), line};
  try {
    for (const auto& text : ranges) points.variations.push_back(parse_variation(text));
  } catch (const Error& error) {
    throw with_origin(points, error);
  }
  return points;
}

Error with_origin(const Points& points, const Error& error) {
  if (error.kind() == ErrorKind::kInterrupted) return error;
  std::string message = error.what();
  if (!points.place) return {error.kind(), "--vary: " + message, error.at()};
  const auto& [file, line] = *points.place;
  if (message.starts_with(file + ": ")) message.erase(0, file.size() + 2);
  return {error.kind() == ErrorKind::kWrongUsage ? ErrorKind::kBadInput : error.kind(),
          fmt::format("{}:{}: sweep.vary: {}", file, line, message),
          {file, line, error.at().key.empty() ? "sweep.vary" : error.at().key}};
}

void check_ranges(const Points& points) {
  refuse_doubles(points.keys(), "the key");
  for (const auto& v : points.variations)
    if (points.samples == 0 && v.values.empty() && v.count == 1 && v.first != v.last)
      throw Error(ErrorKind::kWrongUsage,
                  "{}={}:{} has COUNT 1, which leaves out {}; it must be at least 2, or the range "
                  "must be one value",
                  v.key, v.first, v.last, v.last);
}

std::uint64_t run_rows(
    std::uint64_t size, std::uint64_t begin, int jobs,
    const std::function<std::string(std::uint64_t index, const StopToken& stop)>& row,
    const std::function<void(std::uint64_t index, const std::string& row)>& take,
    const StopToken& stop) {
  assert(jobs >= 1 && begin <= size);
  // Rows that are computed or wait to be passed on, which limits the memory. 32 rows for each
  // thread keep the threads busy while one row takes much longer than the others.
  const std::uint64_t window = 32 * static_cast<std::uint64_t>(jobs);
  std::mutex mutex;
  std::condition_variable row_taken;
  std::map<std::uint64_t, std::string> finished;
  std::uint64_t next = begin, taken = begin;
  std::exception_ptr error;
  bool is_stopped = false;  // a row ended because of the stop, so that `taken` no longer grows
  const auto work = [&] {
    std::unique_lock lock(mutex);
    for (;;) {
      row_taken.wait(lock,
                     [&] { return error || is_stopped || next >= size || next < taken + window; });
      if (error || is_stopped || next >= size || stop.stop_requested()) return;
      const std::uint64_t index = next++;
      lock.unlock();
      std::string text;
      std::exception_ptr thrown;
      try {
        text = row(index, stop);
      } catch (...) {
        thrown = std::current_exception();
      }
      lock.lock();
      if (thrown) {
        if (stop.stop_requested())
          is_stopped = true;
        else
          error = thrown;
        row_taken.notify_all();
        return;
      }
      finished.emplace(index, std::move(text));
      try {
        for (auto first = finished.begin();
             first != finished.end() && first->first == taken && !error;
             first = finished.erase(first)) {
          take(taken, first->second);
          ++taken;
        }
      } catch (...) {
        error = std::current_exception();
      }
      row_taken.notify_all();
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < jobs; ++i) threads.emplace_back(work);
  }
  if (error) std::rethrow_exception(error);
  return taken;
}

std::uint64_t write_sweep(
    const Study& study, const fs::path& path, int jobs, const std::string& how_made,
    const std::function<void(std::uint64_t done, std::uint64_t size)>& progress,
    const StopToken& stop) {
  const std::uint64_t size = study.size();
  const std::string header = header_of(study);
  const fs::path target = check_output_file(path);
  if (const auto finished = kept_rows(path, header, study); finished && finished->rows == size)
    return 0;
  fs::path part = target;
  part += ".part";
  if (part.has_parent_path()) make_folder(part.parent_path());
  const Descriptor file = open_and_lock(part,
                                        "is locked by another sweep that writes the same file; "
                                        "wait until it has ended, or write elsewhere");
  auto kept = kept_rows(part, header, study);
  // Removes an incomplete last row, or all rows if they are those of another sweep.
  if (::ftruncate(file.get(), kept ? static_cast<off_t>(kept->bytes) : 0) != 0)
    throw_bad_input({part.string()}, "cannot be written ({})", std::strerror(errno));
  if (!kept) {
    append_to(file, how_made + header, part);
    kept = {0, how_made.size() + header.size()};
  }
  // Rows are written when 64 kB have gathered or after one second, so that slow rows are not lost
  // if the process is killed.
  constexpr std::size_t kBuffer = 1 << 16;
  constexpr auto kLongest = std::chrono::seconds(1);
  std::string waiting;
  auto written_at = std::chrono::steady_clock::now();
  const auto write = [&] {
    append_to(file, waiting, part);
    waiting.clear();
    written_at = std::chrono::steady_clock::now();
  };
  const auto take = [&](std::uint64_t index, const std::string& row) {
    waiting += row;
    if (waiting.size() > kBuffer || std::chrono::steady_clock::now() - written_at > kLongest)
      write();
    progress(index + 1, size);
  };
  std::uint64_t taken = 0;
  try {
    taken = run_rows(
        size, kept->rows, jobs,
        [&](std::uint64_t index, const StopToken& s) { return study.row(index, s); }, take, stop);
  } catch (...) {
    write();  // finished rows are kept, whatever error ended the sweep
    throw;
  }
  write();
  if (taken < size)
    throw Error(ErrorKind::kInterrupted,
                "interrupted; {} of {} rows are kept in {}; the same command continues from there",
                taken, size, part.string());
  sync_file(file, part);
  std::error_code error;
  fs::rename(part, target, error);
  if (error) throw_bad_input({target.string()}, "cannot be written ({})", error.message());
  sync_folder_of(target);
  return size - kept->rows;
}

SweepOutcome read_outcome(const Study& study, const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw_bad_input({path.string()}, "cannot be read");
  const auto keys = study.points.keys().size();
  SweepOutcome outcome;
  bool header_is_read = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    if (!header_is_read) {
      header_is_read = true;
      continue;
    }
    ++outcome.points;
    const auto last_comma = line.rfind(',');
    const std::string failure = line.substr(last_comma + 1);
    if (failure.empty()) continue;
    if (outcome.first_failure.empty()) outcome.first_failure = failure;
    std::size_t end_of_keys = 0;  // the comma after the fields of the varied keys
    for (std::size_t key = 0; key < keys; ++key)
      end_of_keys = line.find(',', end_of_keys + (key > 0 ? 1 : 0));
    const bool has_result = line.find_first_not_of(',', end_of_keys) < last_comma;
    ++(has_result ? outcome.with_some_results : outcome.without_result);
  }
  return outcome;
}

std::uint64_t finished_rows(const Study& study, const fs::path& path) {
  const std::string header = header_of(study);
  fs::path part = check_output_file(path);
  part += ".part";
  const auto whole = kept_rows(path, header, study);
  const auto begun = kept_rows(part, header, study);
  return std::max(whole ? whole->rows : 0, begun ? begun->rows : 0);
}

}  // namespace viscontact::sweep
