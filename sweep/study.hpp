// Computes a case again and again with other values of some of its keys, and writes the results as
// rows of a CSV file (docs/file-formats.md), in the units of the case.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/stop_token.hpp"
#include "viscontact/common/text/units.hpp"
#include "viscontact/sweep/variation.hpp"

namespace viscontact::sweep {

/// The results of a row, by the names of their columns (Study::results). A column without a result
/// is empty.
struct RowResults {
  std::map<std::string, double> values;  ///< a value that is not finite gives an empty field
  std::map<std::string, std::uint64_t> numbers;  ///< results that are whole numbers
  std::string failure;                           ///< why results are missing; empty if none is
};

/// Calls `part`, which computes some results of a row. The message of an Error of `part` is added
/// to `results.failure`; only Error(kInterrupted) and exceptions of other types are thrown on.
template <class Part>
void add_part(RowResults& results, const Part& part) {
  try {
    part();
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInterrupted) throw;
    results.failure += (results.failure.empty() ? "" : " | ") + std::string(error.what());
  }
}

/// The points of a sweep, and how the results of a row are computed.
struct Study {
  Points points;  ///< their keys are the first columns
  /// Names of the columns with results, after the keys; the last column, `failure`, follows them.
  std::vector<std::string> results;
  /// Lines "# key: value" for the head of the file. They must contain all that the results depend
  /// on, so that two files with the same head and the same columns have the same rows.
  std::map<std::string, std::string> comments;
  /// Computes the results of row `index`, from 0, in several threads at once. It throws
  /// Error(kInterrupted) if `stop` requests a stop; any other Error that it throws ends the whole
  /// sweep.
  std::function<RowResults(std::uint64_t index, const StopToken& stop)> run;

  std::uint64_t size() const { return points.rows(); }  ///< number of rows, > 0
  std::vector<std::string> columns() const;             ///< all columns, in their order
  /// Row `index` < size() as a line of CSV with its line end. Throws what `run` throws.
  std::string row(std::uint64_t index, const StopToken& stop = {}) const;
};

/// The comments that every study has: its kind, the hash (SHA-256) of `case_text`, the content of
/// the case file, the number of rows, the hash of `identity`, the version of Viscontact, and
/// `units` unless they are empty. `identity` must be a text that contains everything else that
/// determines the rows. Throws as Points::rows() does.
std::map<std::string, std::string> head_of(const std::string& kind, const std::string& case_text,
                                           const Points& points, const std::string& identity,
                                           const std::string& version, const Units& units);

/// Throws Error(kWrongUsage) if a name occurs twice. `kind` is the word for such a name in the
/// message, such as "the key".
void refuse_doubles(const std::vector<std::string>& names, std::string_view kind);

/// The grid of the ranges "KEY=RANGE" (variation.hpp) that the section [sweep] of a case has in
/// line `line` > 0. Throws Error(kBadInput), which names case and line, if a range is not valid.
Points points_of_case(const std::vector<std::string>& ranges,
                      const std::filesystem::path& case_path, int line);

/// `error`, which was caused by the ranges, with their place before its message: "--vary: ..." or
/// "case.toml:3: sweep.vary: ...". If the ranges are in a case, Error(kWrongUsage) becomes
/// Error(kBadInput). Error(kInterrupted) is returned unchanged.
Error with_origin(const Points& points, const Error& error);

/// Calls `check(key)` for each varied key, and throws its Error as with_origin() changes it.
template <class Check>
void check_keys(const Points& points, const Check& check) {
  try {
    for (const auto& key : points.keys()) check(key);
  } catch (const Error& error) {
    throw with_origin(points, error);
  }
}

/// Throws Error(kWrongUsage) if a key is varied twice, or if the grid leaves out the end of a range
/// (the range has different ends, but only one value).
void check_ranges(const Points& points);

/// Returns `make(numbers)` for the keys and values of row `index` < points.rows(). An Error of
/// `make` is thrown with the point in its message.
template <class Make>
auto at_point(const Points& points, std::uint64_t index, const Make& make) {
  const auto numbers = points.numbers(index);
  try {
    return make(numbers);
  } catch (const Error& error) {
    throw Error(error.kind(), error.what() + (" (at the point" + in_words(numbers) + ")"),
                error.at());
  }
}

/// Throws Error(kWrongUsage) if nothing is varied, and as check_ranges() does. Then calls `make`,
/// which makes a case, for the first and the last row only, so that a range that leads to a wrong
/// case is an Error before rows are computed. Throws the Errors of `make` and Points::rows(),
/// changed by with_origin(). If `make` also throws an Error without varied values, this Error is
/// thrown unchanged, because the ranges are not its cause.
template <class Make>
void check_ends(const Points& points, const Make& make) {
  if (points.variations.empty() && points.draws == 0)
    throw Error(ErrorKind::kWrongUsage, "there is nothing to vary; give --vary KEY=FROM:TO:COUNT");
  try {
    check_ranges(points);
    for (const std::uint64_t index : {std::uint64_t{0}, points.rows() - 1})
      at_point(points, index, make);
  } catch (const Error& error) {
    if (points.variations.empty()) throw;
    make(std::vector<std::pair<std::string, double>>{});
    throw with_origin(points, error);
  }
}

/// Computes the rows `begin`, ..., `size` - 1 with `jobs` >= 1 threads and passes them to `take` in
/// order, from one thread at a time. After a stop the function ends early without an Error, even if
/// `row` then throws one. If `row` or `take` throws without a stop, the function ends early and
/// throws the same exception. The memory does not grow with the number of rows. Returns the index
/// of the last row that was passed to `take` plus 1, or `begin` if there was none.
std::uint64_t run_rows(
    std::uint64_t size, std::uint64_t begin, int jobs,
    const std::function<std::string(std::uint64_t index, const StopToken& stop)>& row,
    const std::function<void(std::uint64_t index, const std::string& row)>& take,
    const StopToken& stop = {});

/// Computes the missing rows of a sweep with `jobs` >= 1 threads and writes them into the CSV file
/// at `path`. Until all rows are finished, they are in PATH.part, in order. A later call keeps the
/// rows in that file if they belong to the same sweep (its head has the same comments and columns),
/// and otherwise deletes them. A finished file of the same sweep is left as it is; a finished file
/// of another sweep is replaced at the end. `how_made` is empty or a line "# provenance: ..." with
/// its line end for the head of a new file. `progress(done, size)` is called after each row, by one
/// thread at a time.
///
/// Throws Error(kInterrupted) if `stop` requests a stop, Error(kBadInput) if a file cannot be
/// written or another process writes the same file, and the Errors of Study::run. Finished rows are
/// kept. Returns the number of rows that were computed.
std::uint64_t write_sweep(
    const Study& study, const std::filesystem::path& path, int jobs, const std::string& how_made,
    const std::function<void(std::uint64_t done, std::uint64_t size)>& progress,
    const StopToken& stop = {});

/// How many rows of a finished sweep have results, and why others have none.
struct SweepOutcome {
  std::uint64_t points = 0;          ///< number of all rows
  std::uint64_t without_result = 0;  ///< number of rows with a failure and without any result
  /// Number of rows with a failure and some results, for example of models that did not fail.
  std::uint64_t with_some_results = 0;
  /// The failure of the first row that has one; empty if no row has one.
  std::string first_failure;
};

/// `path` must be the finished file of this sweep. Throws Error(kBadInput) if it cannot be read.
SweepOutcome read_outcome(const Study& study, const std::filesystem::path& path);

/// Number of finished rows of this sweep, in the file at `path` or in PATH.part; 0 if neither file
/// belongs to this sweep. Throws Error(kBadInput) if there is something at `path` that is not a
/// regular file.
std::uint64_t finished_rows(const Study& study, const std::filesystem::path& path);

}  // namespace viscontact::sweep
