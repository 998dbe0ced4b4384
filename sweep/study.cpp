// Computes the rows of a sweep, and writes, continues and reads its file (study.hpp). Numbers are
// in the units of the case, and a number that is not finite gives an empty field. Rows are numbered
// from 0. There must be at least one row, and `jobs` must be >= 1 (not checked). A file that cannot
// be read or written throws Error(kBadInput), a name that is given twice throws Error(kWrongUsage),
// and a requested stop throws Error(kInterrupted); the errors of Study::run are thrown, too. app/,
// pipeline/ and the sweeps of all kinds of cases use this file. A change must keep that rows of an
// earlier call are kept only if its file has the same head, and kHowMade, with which
// results/provenance.cpp begins a file.
#include "viscontact/sweep/study.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
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

/// The head of the file: the lines "# key: value" and the names of all columns.
std::string header_of(const Study& study) {
  return write_csv_comments(study.comments) + fmt::format("{}\n", fmt::join(study.columns(), ","));
}

constexpr std::string_view kHowMade = "# provenance: ";

/// The number of finished rows of this sweep after the header, and the number of bytes up to the
/// end of the last of these rows.
struct Kept {
  std::uint64_t rows = 0, bytes = 0;
};
/// The rows of this sweep in the file at `path`. Nothing if the file does not begin with `header`,
/// or if it cannot be read.
std::optional<Kept> kept_rows(const fs::path& path, const std::string& header, const Study& study) {
  std::ifstream file(path, std::ios::binary);
  // The line that says how the file was made may differ, because it does not influence the rows.
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

/// The names of all columns: the varied keys, the results and `failure`.
std::vector<std::string> Study::columns() const {
  auto columns = points.keys();
  columns.insert(columns.end(), results.begin(), results.end());
  columns.emplace_back("failure");
  return columns;
}

/// Computes the row `index` and returns its line of the file, with its line end. Commas and line
/// breaks in a failure become ";", because they would divide the line.
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
  std::ranges::replace_if(
      failure, [](char c) { return c == ',' || c == '\n' || c == '\r'; }, ';');
  return fmt::format("{},{}\n", text, failure);
}

/// The lines "# key: value" that every sweep has. `kind` is the kind of the sweep in words, and
/// `case_text` the content of the case file. `identity` is a text that contains everything else
/// that determines the rows.
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

/// The points of the ranges "KEY=RANGE" in the line `line`, counted from 1, of a case. Throws
/// Error(kBadInput), which names file and line, if a range is not valid.
Points points_of_case(const std::vector<std::string>& ranges, const fs::path& case_path, int line) {
  Points points;
  if (!ranges.empty()) points.place = PlaceOfRanges{case_path.string(), line};
  try {
    for (const auto& text : ranges) points.variations.push_back(parse_variation(text));
  } catch (const Error& error) {
    throw with_origin(points, error);
  }
  return points;
}

/// The error with the place of the ranges before its message: "--vary: ..." or "FILE:LINE:
/// sweep.vary: ...". A fault of ranges in a case is an Error(kBadInput), not Error(kWrongUsage).
Error with_origin(const Points& points, const Error& error) {
  if (error.kind() == ErrorKind::kInterrupted) return error;
  std::string message = error.what();
  if (!points.place) return {error.kind(), "--vary: " + message};
  const auto& [file, line] = *points.place;
  // The message of a case that is wrong at a point begins with the file, which is named once.
  if (message.starts_with(file + ": ")) message.erase(0, file.size() + 2);
  return {error.kind() == ErrorKind::kWrongUsage ? ErrorKind::kBadInput : error.kind(),
          fmt::format("{}:{}: sweep.vary: {}", file, line, message)};
}

/// Throws Error(kWrongUsage) if a key is varied twice, or if a grid has a range with one value but
/// two different ends.
void check_ranges(const Points& points) {
  refuse_doubles(points.keys(), "the key");
  for (const auto& v : points.variations)
    if (points.samples == 0 && v.values.empty() && v.count == 1 && v.first != v.last)
      throw Error(ErrorKind::kWrongUsage,
                  "{}={}:{} has COUNT 1, which leaves out {}; it must be at least 2, or the range "
                  "must be one value",
                  v.key, v.first, v.last, v.last);
}

/// Computes the rows `begin` to `size` - 1 with `jobs` threads and passes each row to `take`, in
/// the order of the rows and from one thread at a time, so that the file does not depend on the
/// number of threads. Returns the index after the last row that was passed on. A requested stop
/// ends the function early without an Error; an exception of `row` or `take` is thrown again.
std::uint64_t run_rows(
    std::uint64_t size, std::uint64_t begin, int jobs,
    const std::function<std::string(std::uint64_t index, const StopToken& stop)>& row,
    const std::function<void(std::uint64_t index, const std::string& row)>& take,
    const StopToken& stop) {
  // Largest number of rows that are computed or wait to be passed on, which limits the memory. 32
  // rows for each thread, a free choice, keep the threads busy while one row takes much longer than
  // the others.
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
        // An exception after a stop is the answer of the row to the stop.
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

/// Computes the rows that PATH.part does not have yet with `jobs` threads, adds them to that file
/// and, after the last row, renames the file to `path`. Returns the number of computed rows. The
/// text `how_made`, a line "# provenance: ...\n" or empty, begins a new file. `progress` is called
/// after each row with the number of finished rows and that of all rows.
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
  // if the process is killed. Both limits are free choices.
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

/// Counts the rows of the finished file of this sweep: all of them, those with a failure and some
/// results, and those with a failure and no result.
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
    std::size_t end_of_keys = 0;  // position of the comma after the fields of the varied keys
    for (std::size_t key = 0; key < keys; ++key)
      end_of_keys = line.find(',', end_of_keys + (key > 0 ? 1 : 0));
    const bool has_result = line.find_first_not_of(',', end_of_keys) < last_comma;
    ++(has_result ? outcome.with_some_results : outcome.without_result);
  }
  return outcome;
}

/// The number of rows that the file at `path` or PATH.part has of this sweep; 0 if neither file
/// belongs to it.
std::uint64_t finished_rows(const Study& study, const fs::path& path) {
  const std::string header = header_of(study);
  fs::path part = check_output_file(path);
  part += ".part";
  const auto whole = kept_rows(path, header, study);
  const auto begun = kept_rows(part, header, study);
  return std::max(whole ? whole->rows : 0, begun ? begun->rows : 0);
}

}  // namespace viscontact::sweep
