// Selects the rows that fewer_rows.hpp describes. Rows are copied unchanged, and nothing is thrown.
// A change must keep all rows that a comparison looks for.
#include "viscontact/reduced_model/fewer_rows.hpp"

#include <algorithm>
#include <cstddef>

namespace viscontact::reduced_model {
namespace {

bool in_contact(const TrajectoryRow& row) { return row.gamma && *row.gamma < 0; }
bool on_solid(const TrajectoryRow& row) { return row.solid_force && *row.solid_force > 0; }

/// The rows that differ from the row before in contact or in solid contact.
std::vector<std::size_t> changes_of_contact(const std::vector<TrajectoryRow>& rows) {
  std::vector<std::size_t> changes;
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (in_contact(rows[i]) != in_contact(rows[i - 1]) ||
        on_solid(rows[i]) != on_solid(rows[i - 1]))
      changes.push_back(i);
  return changes;
}

/// The first row with the smallest `value`.
template <class Value>
std::size_t first_of_least(const std::vector<TrajectoryRow>& rows, const Value& value) {
  return static_cast<std::size_t>(std::ranges::min_element(rows, {}, value) - rows.begin());
}

}  // namespace

std::vector<TrajectoryRow> fewer_rows(const std::vector<TrajectoryRow>& rows, int count) {
  const auto wanted = static_cast<std::size_t>(count);
  if (rows.size() <= wanted) return rows;
  std::vector<char> kept(rows.size(), 0);
  const double from = rows.front().time, to = rows.back().time;
  std::size_t row = 0;
  for (std::size_t n = 0; n < wanted; ++n) {
    const double w = static_cast<double>(n) / static_cast<double>(wanted - 1);
    // The factor makes the time slightly earlier, so that rounding cannot skip its row.
    const double time = from + w * (to - from) * (1 - 1e-12);
    while (row + 1 < rows.size() && rows[row].time < time) ++row;
    kept[row] = 1;
  }
  kept.front() = kept.back() = 1;
  kept[first_of_least(rows, [](const TrajectoryRow& r) { return r.gap; })] = 1;
  kept[first_of_least(rows, [](const TrajectoryRow& r) { return -r.gap; })] = 1;
  kept[first_of_least(rows, [](const TrajectoryRow& r) { return r.gamma ? *r.gamma : 0; })] = 1;
  auto changes = changes_of_contact(rows);
  if (changes.size() > wanted) changes = {changes.front(), changes.back()};
  for (const std::size_t i : changes) kept[i - 1] = kept[i] = 1;
  std::vector<TrajectoryRow> result;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (kept[i] != 0) result.push_back(rows[i]);
  return result;
}

}  // namespace viscontact::reduced_model
