// Makes the plan of a force table from the inputs of its tabulation (force_table_plan.hpp).
#include "viscontact/freefem_axi/force_table_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viscontact/common/error.hpp"

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

std::optional<std::vector<FinishedRow>> rows_in_table(const std::filesystem::path& path,
                                                      const std::string& hash) {
  if (!std::filesystem::is_regular_file(path)) return {};
  try {
    const auto table = lubrication::read_force_table(path);
    if (table.case_hash != hash) return {};
    const auto version = table.versions.find("FreeFEM");
    std::vector<FinishedRow> rows;
    for (const auto& row : table.rows)
      rows.push_back(finished_row(row, version == table.versions.end() ? "" : version->second));
    return rows;
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
  for (const auto& point : grid_of(tabulation))
    table.rows.push_back(force_row(record.finished.at(point)));
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
  plan.read = [hash = plan.hash](const std::filesystem::path& path) {
    return rows_in_table(path, hash);
  };
  plan.write = [tabulation](const RowRecord& record, const Versions& versions) {
    auto table = assemble_table(tabulation, record);
    table.versions.insert(versions.begin(), versions.end());
    return lubrication::write_force_table(table);
  };
  plan.name_of = [](const RowPoint& point) {
    return fmt::format("gap {:.6g}, velocity {:.6g}", point.at(0), point.at(1));
  };
  plan.estimate_of = [](const FinishedRow& row) { return row.numbers.at(kEstimate); };
  plan.seconds_of = [](const FinishedRow& row) { return row.numbers.at(kSeconds); };
  return plan;
}

}  // namespace viscontact::freefem_axi
