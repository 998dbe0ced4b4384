// The rows of a sweep, whatever is computed for a row: what its file needs to know
// (sweep_file.hpp), and how rows are computed on several threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"

namespace viscontact::sweep {

/// What identifies the rows of a sweep, and the functions that compute them.
struct Rows {
  std::uint64_t size = 0;  ///< number of rows, > 0
  /// Names of the columns. The first `keys` columns identify the row; the last is `failure`.
  std::vector<std::string> columns;
  std::size_t keys = 0;  ///< number of columns that identify the row
  /// The lines "# key: value" at the head of the file. Files with the same head and the same
  /// columns have the same rows.
  std::map<std::string, std::string> comments;
  /// The first `keys` fields of a row, separated by commas. It takes little time.
  std::function<std::string(std::uint64_t index)> key_fields;
  /// A row as a line of CSV. It is called by several threads at once, and throws
  /// Error(kInterrupted) if `stop` requests a stop.
  std::function<std::string(std::uint64_t index, const StopToken& stop)> row;
};

/// The text as a single field of a CSV file.
std::string as_field(std::string text);

/// Computes the rows from `begin` on with `jobs` >= 1 threads and passes them to `take` in order.
/// Ends early if `stop` requests it, or if `take` throws; then throws the same exception. The
/// memory that it needs does not grow with the number of rows. Returns the index of the last row
/// taken plus 1, or `begin` if none was taken.
std::uint64_t run_rows(const Rows& rows, std::uint64_t begin, int jobs,
                       const std::function<void(std::uint64_t index, const std::string& row)>& take,
                       const StopToken& stop = {});

}  // namespace viscontact::sweep
