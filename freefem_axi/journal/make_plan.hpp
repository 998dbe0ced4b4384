// Makes a TablePlan for any type Row of rows (lubrication/table.hpp) from what differs between
// types of rows.
#pragma once

#include <fmt/format.h>

#include <cassert>
#include <memory>
#include <set>

#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/text/on_one_line.hpp"
#include "viscontact/freefem_axi/journal/table_plan.hpp"
#include "viscontact/lubrication/table_codec.hpp"

namespace viscontact::freefem_axi {

/// One of the rows that one call of FreeFEM computes at a point, with its table. Sliding and
/// rolling, for example, are computed together.
template <class Row>
struct PlannedRow {
  lubrication::TableHead head;  ///< of the table; make_plan() adds hash, versions, failures
  Row blank;                    ///< a row with any numbers; its vectors have their final sizes
  /// False if the user did not ask for the table, so that it is not written.
  bool is_asked = true;
  std::filesystem::path path;  ///< of the table; not used for the first one with is_asked
};

/// The argument of make_plan().
template <class Row>
struct PlanParts {
  /// Everything that the numbers depend on; a table from another text is computed again.
  std::string inputs;
  /// In the order of computation, at least one. All have the same number of entries, which are the
  /// first columns of a row.
  std::vector<RowPoint> points;
  /// In the order in which `solve` returns them; is_asked is true for at least one.
  std::vector<PlannedRow<Row>> rows;
  double relative_accuracy = 0;  ///< as in TablePlan
  double typical_seconds = 0;    ///< as in TablePlan
  bool needs_all_rows = false;   ///< as in TablePlan
  /// Computes the rows at a point, one for each element of `rows`. Throws Error(kExternalProgram)
  /// if FreeFEM fails for this point; another Error ends the computation of all rows.
  std::function<std::vector<Row>(const FreeFem&, const RowPoint&)> solve;
  std::function<std::string(const RowPoint&)> name_of;  ///< as in TablePlan
  /// Returns the row that was computed at a point; nothing if no row was computed there.
  using Computed = std::function<std::optional<Row>(const RowPoint&)>;
  /// Makes all rows of a table from the computed ones. If this function is empty, the table has the
  /// computed rows in the order of `points`.
  std::function<std::vector<Row>(const Computed&)> arrange{};
};

/// The addresses of those numbers of `row` that a journal stores behind the numbers of the point:
/// all columns but the first `size_of_point` ones and those that complete() always computes from
/// others. Journals of earlier runs are read in this order.
template <class Row>
std::vector<double*> stored_numbers(const lubrication::TableHead& head, Row& row,
                                    std::size_t size_of_point) {
  std::vector<double*> numbers;
  const auto columns = columns_of(head, row);
  for (std::size_t i = size_of_point; i < columns.size(); ++i)
    if (columns[i].if_absent != lubrication::IfAbsent::kAlwaysComputed)
      numbers.push_back(columns[i].number);
  return numbers;
}

/// Makes the plan of a table from `given`. A row in a journal consists of a point and of the
/// numbers of all `given.rows` at this point, one row after the other. TablePlan::solve throws what
/// given.solve throws, and TablePlan::write what given.arrange throws.
template <class Row>
TablePlan make_plan(PlanParts<Row> given) {
  assert(!given.points.empty());
  const std::size_t size_of_point = given.points.front().size();
  TablePlan plan;
  plan.hash = sha256(given.inputs);
  plan.points = given.points;
  plan.shape = {size_of_point, 0};
  // `asked` has the indices of those given.rows whose is_asked is true. `begins` has, for each of
  // given.rows, the index of its first number in FinishedRow::numbers.
  std::vector<std::size_t> asked, begins;
  for (auto& row : given.rows) {
    row.head.case_hash = plan.hash;
    if (row.is_asked) asked.push_back(begins.size());
    begins.push_back(plan.shape.numbers);
    plan.shape.numbers += stored_numbers(row.head, row.blank, size_of_point).size();
  }
  assert(!asked.empty());
  plan.relative_accuracy = given.relative_accuracy;
  plan.typical_seconds = given.typical_seconds;
  plan.needs_all_rows = given.needs_all_rows;
  plan.name_of = given.name_of;
  const auto parts = std::make_shared<const PlanParts<Row>>(std::move(given));

  plan.solve = [=](const FreeFem& freefem, const RowPoint& point) {
    assert(point.size() == size_of_point);
    std::vector<double> numbers;
    auto rows = parts->solve(freefem, point);
    assert(rows.size() == parts->rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (const double* number : stored_numbers(parts->rows[i].head, rows[i], size_of_point))
        numbers.push_back(*number);
    return numbers;
  };
  // A row of the table of given.rows[i], from the numbers that a journal has stored.
  const auto row_of = [=](std::size_t i, const FinishedRow& finished) {
    const auto& head = parts->rows[i].head;
    auto row = parts->rows[i].blank;
    const auto columns = columns_of(head, row);
    for (std::size_t k = 0; k < size_of_point; ++k) *columns[k].number = finished.point.at(k);
    auto next = finished.numbers.begin() + static_cast<std::ptrdiff_t>(begins[i]);
    for (double* number : stored_numbers(head, row, size_of_point)) *number = *next++;
    complete(head, row);
    return row;
  };
  // Returns false if the file is not the planned table.
  const auto add_rows = [=](std::size_t i, const std::filesystem::path& path, RowRecord& record) {
    const auto& planned = parts->rows[i];
    const auto table = lubrication::read_table<Row>(path);
    if (table.case_hash != planned.head.case_hash || table.motion != planned.head.motion)
      return false;
    const auto version = table.versions.find("FreeFEM");
    auto blank = planned.blank;
    const auto column_count = columns_of(planned.head, blank).size();
    for (auto row : table.rows) {
      // A file may have the hash and yet other rows, such as those of more spheres.
      if (columns_of(table, row).size() != column_count) return false;
      const auto columns = columns_of(planned.head, row);
      RowPoint point;
      for (std::size_t k = 0; k < size_of_point; ++k) point.push_back(*columns[k].number);
      auto& finished = record.finished[point];
      finished.point = point;
      finished.freefem_version = version == table.versions.end() ? "" : version->second;
      finished.numbers.resize(plan.shape.numbers);
      auto next = finished.numbers.begin() + static_cast<std::ptrdiff_t>(begins[i]);
      for (const double* number : stored_numbers(planned.head, row, size_of_point))
        *next++ = *number;
    }
    for (const auto& point : parts->points)
      if (const auto row = table.failed_rows.find(parts->name_of(point));
          row != table.failed_rows.end())
        record.failed[point] = row->second;
    return true;
  };
  plan.read = [=](const std::filesystem::path& path) {
    RowRecord record;
    for (const auto i : asked) {
      const auto& file = i == asked.front() ? path : parts->rows[i].path;
      try {
        if (!std::filesystem::is_regular_file(file) || !add_rows(i, file, record))
          return RowRecord();
      } catch (const Error&) {  // the file is not a table
        return RowRecord();
      }
    }
    return record;
  };
  const auto write = [=](std::size_t i) {
    return [=](const RowRecord& record, const Versions& versions) {
      lubrication::Table<Row> table{parts->rows[i].head, {}};
      const auto computed = [&](const RowPoint& point) -> std::optional<Row> {
        const auto found = record.finished.find(point);
        if (found == record.finished.end()) return {};
        return row_of(i, found->second);
      };
      if (parts->arrange)
        table.rows = parts->arrange(computed);
      else
        for (const auto& point : parts->points)
          if (const auto row = computed(point)) table.rows.push_back(*row);
      std::set<std::string> freefem;
      for (const auto& [point, row] : record.finished) freefem.insert(row.freefem_version);
      table.versions = versions;
      table.versions["FreeFEM"] = fmt::format("{}", fmt::join(freefem, ", "));
      for (const auto& [point, reason] : record.failed)
        table.failed_rows[parts->name_of(point)] = on_one_line(reason);
      return lubrication::write_table(table);
    };
  };
  plan.write = write(asked.front());
  for (std::size_t k = 1; k < asked.size(); ++k)
    plan.companions.push_back({parts->rows[asked[k]].path, write(asked[k])});
  plan.estimate_of = [=](const FinishedRow& finished) {
    double largest = 0;
    for (const auto i : asked) largest = std::max(largest, largest_estimate(row_of(i, finished)));
    return largest;
  };
  plan.seconds_of = [=](const FinishedRow& finished) { return row_of(0, finished).seconds; };
  return plan;
}

}  // namespace viscontact::freefem_axi
