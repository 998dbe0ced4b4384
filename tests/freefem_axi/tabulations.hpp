// Tabulations that several tests ask for, and their tables.
#pragma once

#include <vector>

#include "viscontact/common/files/file.hpp"
#include "viscontact/freefem_axi/journal/row_record.hpp"
#include "viscontact/freefem_axi/journal/tabulate.hpp"
#include "viscontact/freefem_axi/motion_table_plan.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact::freefem_axi {

/// A sphere of radius 1 that moves at -1 in a fluid of viscosity 1 in a closed cylinder, whose
/// height is twice its radius.
inline Tabulation unit_tabulation(std::vector<double> gaps, double container_radius,
                                  double relative_accuracy) {
  Tabulation tabulation;
  tabulation.viscosity = 1;
  tabulation.radius = 1;
  tabulation.gaps = std::move(gaps);
  tabulation.reference_velocities = {-1};
  tabulation.container = Container{container_radius, 2 * container_radius};
  tabulation.relative_accuracy = relative_accuracy;
  return tabulation;
}

/// The plan of the table of the approach.
inline TablePlan force_table_plan(const Tabulation& tabulation) {
  return motion_table_plan(tabulation, MotionGroup::kAlong,
                           [](lubrication::MotionKind) { return std::filesystem::path(); });
}

/// SHA-256 of everything that the forces depend on.
inline std::string tabulation_hash(const Tabulation& tabulation) {
  return force_table_plan(tabulation).hash;
}

/// Computes all rows, and writes the table to a file beside `table_path` and reads it.
inline lubrication::MotionTable tabulate(const FreeFem& freefem, const Tabulation& tabulation,
                                         int jobs, const std::filesystem::path& table_path,
                                         const TabulateReport& report) {
  const auto plan = force_table_plan(tabulation);
  compute_rows({freefem, jobs, ""}, plan, plan.points, table_path, report);
  const auto copy = table_path.parent_path() / "copy.csv";
  write_file(copy, plan.write(read_row_record(table_path, plan), {}));
  return lubrication::read_motion_table(copy);
}

}  // namespace viscontact::freefem_axi
