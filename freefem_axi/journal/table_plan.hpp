// A table whose rows FreeFEM computes one by one, independent of what its rows contain. Numbers are
// in the units of the table.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/journal/freefem.hpp"

namespace viscontact::freefem_axi {

/// The numbers that identify a row of a table: gap [L] and velocity [L/T], the gap alone, or the
/// gaps between several spheres [L].
using RowPoint = std::vector<double>;

/// A row that was computed.
struct FinishedRow {
  RowPoint point;  ///< which row
  /// As TablePlan::solve returns them.
  std::vector<double> numbers;
  std::string freefem_version;  ///< text of freefem_version() (freefem.hpp); may be empty
};

/// A row that could not be computed.
struct FailedRow {
  RowPoint point;      ///< which row
  std::string reason;  ///< one line, for the user
};

/// The finished and failed rows of a table, by their points.
struct RowRecord {
  std::map<RowPoint, FinishedRow> finished;  ///< by FinishedRow::point
  /// The reasons why rows failed, by their points. No row is also in `finished`.
  std::map<RowPoint, std::string> failed;
};

/// How many numbers a row of a table has; both are >= 1.
struct RowShape {
  std::size_t point = 0;    ///< size of RowPoint
  std::size_t numbers = 0;  ///< size of FinishedRow::numbers
};

/// Names and versions of the programs that made a table.
using Versions = std::map<std::string, std::string>;

/// Another table whose rows the same calls of FreeFEM compute, such as rolling beside sliding.
struct CompanionTable {
  std::filesystem::path path;  ///< of its file
  /// As TablePlan::write.
  std::function<std::string(const RowRecord&, const Versions&)> write;
};

/// A table and the functions that compute, read and write it.
struct TablePlan {
  /// SHA-256 of everything that the numbers depend on, in hexadecimal digits. Tables and rows of
  /// earlier runs are found by it.
  std::string hash;
  /// The points of all rows, in the order of computation; at least one.
  std::vector<RowPoint> points;
  RowShape shape;                ///< of every row
  double relative_accuracy = 0;  ///< largest relative error that the user allows a row [1], > 0
  double typical_seconds = 0;    ///< time of a row on one core [s], > 0, only for estimates of time
  /// Computes the numbers of the row at a point, RowShape::numbers of them. Throws
  /// Error(kExternalProgram) if FreeFEM fails for this row; its message is recorded as the reason.
  /// An Error of another kind ends the computation of all rows.
  std::function<std::vector<double>(const FreeFem&, const RowPoint&)> solve;
  /// Reads the finished rows in the file of the table, and the failed rows that it names. Returns
  /// no rows if there is no such file or if it was computed with other inputs.
  std::function<RowRecord(const std::filesystem::path&)> read;
  /// Makes the text of the file of the table from at least one finished row and from the versions
  /// of the programs. The head of the file names the failed rows.
  std::function<std::string(const RowRecord&, const Versions&)> write;
  /// True if the table cannot be used when rows are missing. `write` must then get all rows.
  bool needs_all_rows = false;
  /// Tables that are written together with this one.
  std::vector<CompanionTable> companions;
  /// The row at a point in words, such as "gap 0.1, velocity -1", unique.
  std::function<std::string(const RowPoint&)> name_of;
  /// The largest relative error estimate of the row in this table and in its companions.
  std::function<double(const FinishedRow&)> estimate_of;
  std::function<double(const FinishedRow&)> seconds_of;  ///< time that the row took [s], >= 0
};

}  // namespace viscontact::freefem_axi
