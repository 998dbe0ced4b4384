// The table of resistance matrices as a TablePlan: its rows, their reflections, and their numbers
// in the journal (collinear_spheres.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viscontact/common/error.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/swimmer/tabulation/collinear_spheres.hpp"

namespace viscontact::swimmer {
namespace {

using Grid = std::vector<std::vector<double>>;

// Revision of the scripts. Raise it when a change of the scripts changes their results: tables of
// another revision are then computed again.
constexpr int kMatrixMethod = 1;

bool is_mirror_image(const CollinearSpheres& spheres, const Grid& grid) {
  return std::ranges::equal(spheres.radii,
                            std::vector(spheres.radii.rbegin(), spheres.radii.rend())) &&
         std::ranges::equal(grid, Grid(grid.rbegin(), grid.rend()));
}

freefem_axi::RowPoint reflected(freefem_axi::RowPoint gaps) {
  std::ranges::reverse(gaps);
  return gaps;
}

/// The row of the spheres in the opposite order.
ResistanceRow reflected(const ResistanceRow& row) {
  const std::size_t spheres = row.gaps.size() + 1;
  ResistanceRow other = row;
  other.gaps = reflected(row.gaps);
  for (std::size_t i = 0; i < spheres; ++i)
    for (std::size_t j = i; j < spheres; ++j) {
      const auto to = entry_position(i, j, spheres);
      const auto from = entry_position(spheres - 1 - i, spheres - 1 - j, spheres);
      other.entries[to] = row.entries[from];
      other.relative_error_estimates[to] = row.relative_error_estimates[from];
    }
  return other;
}

/// All combinations of gaps; the last gap changes fastest.
std::vector<freefem_axi::RowPoint> all_points(const Grid& grid) {
  std::vector<freefem_axi::RowPoint> points = {{}};
  for (const auto& gaps : grid) {
    std::vector<freefem_axi::RowPoint> longer;
    for (const auto& point : points)
      for (const double gap : gaps) {
        longer.push_back(point);
        longer.back().push_back(gap);
      }
    points = std::move(longer);
  }
  return points;
}

std::string hash_of(const CollinearSpheres& spheres, const Grid& grid) {
  std::string text = fmt::format("collinear spheres; {}; {} {} {};", surroundings_in_words(spheres),
                                 format_number(spheres.viscosity),
                                 format_number(spheres.relative_accuracy), kMatrixMethod);
  for (const double radius : spheres.radii) text += " " + format_number(radius);
  for (const auto& gaps : grid) {
    text += ";";
    for (const double gap : gaps) text += " " + format_number(gap);
  }
  return sha256(text);
}

/// The numbers of a row in a journal: entries, their estimates, then three numbers of the
/// computation.
std::vector<double> numbers_of(const ResistanceRow& row) {
  std::vector<double> numbers = row.entries;
  numbers.insert(numbers.end(), row.relative_error_estimates.begin(),
                 row.relative_error_estimates.end());
  numbers.insert(numbers.end(), {row.degrees_of_freedom, row.seconds, row.observed_order});
  return numbers;
}

ResistanceRow row_of(const freefem_axi::FinishedRow& finished) {
  const auto entries = static_cast<std::ptrdiff_t>(entry_count(finished.point.size() + 1));
  const auto start = finished.numbers.begin();
  ResistanceRow row;
  row.gaps = finished.point;
  row.entries.assign(start, start + entries);
  row.relative_error_estimates.assign(start + entries, start + 2 * entries);
  row.degrees_of_freedom = start[2 * entries];
  row.seconds = start[2 * entries + 1];
  row.observed_order = start[2 * entries + 2];
  return row;
}

freefem_axi::RowRecord rows_in_resistance_table(const std::filesystem::path& path,
                                                const std::string& hash) {
  if (!std::filesystem::is_regular_file(path)) return {};
  try {
    const auto table = read_resistance_table(path);
    if (table.case_hash != hash) return {};
    const auto version = table.versions.find("FreeFEM");
    freefem_axi::RowRecord record;
    for (const auto& row : table.rows)
      record.finished[row.gaps] = {row.gaps, numbers_of(row),
                                   version == table.versions.end() ? "" : version->second};
    return record;
  } catch (const Error&) {  // the file is not a table
    return {};
  }
}

/// The time of a row on one core [s], from measurements at an accuracy of 1e-5: 2 to 6 s for three
/// spheres, 12 to 37 s for ten. It grows as for one sphere (force_table_plan.cpp) if more accuracy
/// is asked.
double typical_seconds_of(const CollinearSpheres& spheres) {
  constexpr double kSecondsPerSphere = 1.5, kKnee = 1e-5, kPower = 0.45;
  return kSecondsPerSphere * static_cast<double>(spheres.radii.size()) *
         std::pow(std::max(1.0, kKnee / spheres.relative_accuracy), kPower);
}

}  // namespace

ResistanceTable assemble_table(const CollinearSpheres& spheres, const Grid& grid,
                               const freefem_axi::RowRecord& record) {
  ResistanceTable table;
  table.viscosity = spheres.viscosity;
  table.radii = spheres.radii;
  table.container = surroundings_in_words(spheres);
  table.case_hash = hash_of(spheres, grid);
  for (const auto& point : all_points(grid)) {
    const auto found = record.finished.find(point);
    table.rows.push_back(found != record.finished.end()
                             ? row_of(found->second)
                             : reflected(row_of(record.finished.at(reflected(point)))));
  }
  table.versions["FreeFEM"] = freefem_axi::freefem_versions(record);
  return table;
}

freefem_axi::TablePlan resistance_table_plan(const CollinearSpheres& spheres, const Grid& grid) {
  freefem_axi::TablePlan plan;
  plan.hash = hash_of(spheres, grid);
  const bool has_mirror = is_mirror_image(spheres, grid);
  for (const auto& point : all_points(grid))
    if (!has_mirror || point <= reflected(point)) plan.points.push_back(point);
  plan.shape = {grid.size(), 2 * entry_count(spheres.radii.size()) + 3};
  plan.relative_accuracy = spheres.relative_accuracy;
  plan.typical_seconds = typical_seconds_of(spheres);
  plan.needs_all_rows = true;  // its fit is a polynomial through all of them
  plan.solve = [spheres](const freefem_axi::FreeFem& freefem, const freefem_axi::RowPoint& gaps) {
    return numbers_of(solve_resistance(freefem, spheres, gaps));
  };
  plan.read = [hash = plan.hash](const std::filesystem::path& path) {
    return rows_in_resistance_table(path, hash);
  };
  plan.write = [spheres, grid](const freefem_axi::RowRecord& record,
                               const freefem_axi::Versions& versions) {
    auto table = assemble_table(spheres, grid, record);
    table.versions.insert(versions.begin(), versions.end());
    return write_resistance_table(table);
  };
  plan.name_of = [](const freefem_axi::RowPoint& gaps) {
    std::string words = "gaps";
    for (const double gap : gaps) words += " " + format_number(gap);
    return words;
  };
  plan.estimate_of = [](const freefem_axi::FinishedRow& row) {
    return row_of(row).largest_error_estimate();
  };
  plan.seconds_of = [](const freefem_axi::FinishedRow& row) { return row_of(row).seconds; };
  return plan;
}

}  // namespace viscontact::swimmer
