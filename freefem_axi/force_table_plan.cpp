// Makes the plan of a force table from the inputs of its tabulation (force_table_plan.hpp).
// Lengths, masses and times are in the units of the case.
#include "viscontact/freefem_axi/force_table_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/freefem_axi/journal/row_record.hpp"

namespace viscontact::freefem_axi {
namespace {

/// Positions in FinishedRow::numbers. Journals of interrupted tabulations have this order.
enum Number : std::size_t { kForce, kDragFactor, kEstimate, kUnknowns, kSeconds, kOrder, kCount };

/// The time of one row on one core [s], from measurements on two cores of 2.1 GHz with one row on
/// each, at gaps of 0.01 and 0.3. The time is constant down to a relative accuracy of 1e-5 (kKnee),
/// because the coarsest meshes suffice there. Below, it grows by a factor of 2.8 = 10^kPower for
/// each decade of the accuracy. The geometry's relative_cost multiplies it.
double typical_seconds(const Tabulation& tabulation) {
  constexpr double kCoarse = 1.3, kKnee = 1e-5, kPower = 0.45;
  const double finer = std::max(1.0, kKnee / tabulation.relative_accuracy);
  return kCoarse * std::pow(finer, kPower) * find_geometry(tabulation.geometry).relative_cost;
}

std::vector<RowPoint> grid_of(const Tabulation& tabulation) {
  std::vector<RowPoint> grid;
  for (const double velocity : tabulation.reference_velocities)
    for (const double gap : tabulation.gaps) grid.push_back({gap, velocity});
  return grid;
}

std::string name_of(const RowPoint& point) {
  return fmt::format("gap {}, velocity {}", format_number(point.at(0)), format_number(point.at(1)));
}

RowRecord rows_in_table(const std::filesystem::path& path, const Tabulation& tabulation) {
  if (!std::filesystem::is_regular_file(path)) return {};
  try {
    const auto table = lubrication::read_force_table(path);
    if (table.case_hash != tabulation_hash(tabulation)) return {};
    const auto version = table.versions.find("FreeFEM");
    RowRecord record;
    for (const auto& row : table.rows)
      record.finished[{row.gap, row.reference_velocity}] =
          finished_row(row, version == table.versions.end() ? "" : version->second);
    record.failed = failed_points(table.failed_rows, grid_of(tabulation), name_of);
    return record;
  } catch (const Error&) {  // the file is not a table
    return {};
  }
}

}  // namespace

FinishedRow finished_row(const lubrication::ForceTableRow& row,
                         const std::string& freefem_version) {
  return {{row.gap, row.reference_velocity},
          {row.force, row.drag_factor, row.relative_error_estimate, row.degrees_of_freedom,
           row.seconds, row.observed_order},
          freefem_version};
}

lubrication::ForceTableRow force_row(const FinishedRow& finished) {
  const auto& numbers = finished.numbers;
  return {finished.point.at(0),    finished.point.at(1),  numbers.at(kForce),
          numbers.at(kDragFactor), numbers.at(kEstimate), numbers.at(kUnknowns),
          numbers.at(kSeconds),    numbers.at(kOrder)};
}

lubrication::ForceTable assemble_table(const Tabulation& tabulation, const RowRecord& record) {
  lubrication::ForceTable table;
  table.viscosity = tabulation.viscosity;
  table.radius = tabulation.radius;
  table.geometry = geometry_in_words(tabulation);
  table.neighbour_moves = neighbour_ratio(tabulation, lubrication::MotionKind::kApproach) != 0;
  table.leading_coefficient = leading_coefficient(tabulation);
  table.container = container_in_words(tabulation);
  table.case_hash = tabulation_hash(tabulation);
  if (tabulation.motions.size() > 1) table.tabulated_motions = tabulation.motions;
  for (const auto& point : grid_of(tabulation))
    if (const auto row = record.finished.find(point); row != record.finished.end())
      table.rows.push_back(force_row(row->second));
  table.failed_rows = failed_rows(record, name_of);
  table.versions["FreeFEM"] = freefem_versions(record);
  return table;
}

TablePlan force_table_plan(const Tabulation& tabulation) {
  TablePlan plan;
  plan.hash = tabulation_hash(tabulation);
  plan.points = grid_of(tabulation);
  plan.shape = {2, kCount};
  plan.relative_accuracy = tabulation.relative_accuracy;
  plan.typical_seconds = typical_seconds(tabulation);
  plan.solve = [tabulation](const FreeFem& freefem, const RowPoint& point) {
    return finished_row(solve_row(freefem, tabulation, point.at(0), point.at(1)), "").numbers;
  };
  plan.read = [tabulation](const std::filesystem::path& path) {
    return rows_in_table(path, tabulation);
  };
  plan.write = [tabulation](const RowRecord& record, const Versions& versions) {
    auto table = assemble_table(tabulation, record);
    table.versions.insert(versions.begin(), versions.end());
    return lubrication::write_force_table(table);
  };
  plan.name_of = name_of;
  plan.estimate_of = [](const FinishedRow& row) { return row.numbers.at(kEstimate); };
  plan.seconds_of = [](const FinishedRow& row) { return row.numbers.at(kSeconds); };
  return plan;
}

}  // namespace viscontact::freefem_axi
