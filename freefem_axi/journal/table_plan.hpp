// A table whose rows FreeFEM computes one by one, as the journal and the commands see it, whatever
// its rows contain: forces and torques on a sphere (motion_table_plan.hpp), or resistance matrices
// of spheres on a line (swimmer/tabulation). make_plan.hpp makes it. Times are in seconds; other
// numbers have the units that the plan defines.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/journal/freefem.hpp"

namespace viscontact::freefem_axi {

/// The numbers by which the rows of a table are told apart: gap [L] and velocity [L/T], or the gaps
/// between the spheres [L].
using RowPoint = std::vector<double>;

/// A row that was computed.
struct FinishedRow {
  RowPoint point;  ///< which row
  /// What was computed, in an order that the plan defines.
  std::vector<double> numbers;
  std::string freefem_version;  ///< version of the FreeFEM that computed the row
};

/// A row that could not be computed.
struct FailedRow {
  RowPoint point;      ///< which row
  std::string reason;  ///< one line, for the user
};

/// The finished and failed rows of a table, by their points.
struct RowRecord {
  std::map<RowPoint, FinishedRow> finished;  ///< each by its own point
  /// The reasons of failed rows. A row that was finished later is not among them.
  std::map<RowPoint, std::string> failed;
};

/// How many numbers a row has.
struct RowShape {
  std::size_t point = 0;    ///< size of RowPoint
  std::size_t numbers = 0;  ///< size of FinishedRow::numbers
};

/// Names and versions of the programs that made a table.
using Versions = std::map<std::string, std::string>;

/// Another file with the same rows as the table, but other columns.
struct CompanionTable {
  std::filesystem::path path;  ///< of the file
  /// The text of the file, as TablePlan::write.
  std::function<std::string(const RowRecord&, const Versions&)> write;
};

/// A table and the functions that compute, read and write it.
struct TablePlan {
  /// SHA-256 of everything that the numbers depend on. Equal inputs have equal hashes.
  std::string hash;
  /// All rows, in the order of the table.
  std::vector<RowPoint> points;
  RowShape shape;                ///< of every row
  double relative_accuracy = 0;  ///< asked of every row [1]
  double typical_seconds = 0;    ///< time of a row on one core [s], for estimates
  /// Computes the numbers of one row. Throws Error(kExternalProgram) if FreeFEM fails, and other
  /// errors if no row could be computed.
  std::function<std::vector<double>(const FreeFem&, const RowPoint&)> solve;
  /// The rows of the table in a file, and those that it names as failed; no rows if there is no
  /// such file or if it has other inputs.
  std::function<RowRecord(const std::filesystem::path&)> read;
  /// The text of the file. It names the failed rows of the record, which it lacks.
  std::function<std::string(const RowRecord&, const Versions&)> write;
  /// True if the table is of no use without some of its rows. `write` then needs all of them.
  bool needs_all_rows = false;
  /// Files that are written with the table.
  std::vector<CompanionTable> companions;
  /// The row in words, for messages and for the line of a failed row: "gap 0.1, velocity -1". No
  /// two rows have the same words.
  std::function<std::string(const RowPoint&)> name_of;
  std::function<double(const FinishedRow&)> estimate_of;  ///< relative error of the row [1]
  std::function<double(const FinishedRow&)> seconds_of;   ///< time of the row [s]
};

}  // namespace viscontact::freefem_axi
