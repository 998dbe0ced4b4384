// How the rows of a table of resistance matrices are computed, written and read (TablePlan).
#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "viscontact/common/text/number.hpp"
#include "viscontact/freefem_axi/journal/make_plan.hpp"
#include "viscontact/freefem_axi/motion_table_plan.hpp"
#include "viscontact/swimmer/tabulation/collinear_spheres.hpp"

namespace viscontact::swimmer {
namespace {

// grid[k] has the gaps between spheres k and k + 1 [L].
using Grid = std::vector<std::vector<double>>;

// Revision of the FreeFEM scripts that compute the matrices. Raise it when a change of the scripts
// changes their results; tables of another revision are then computed again.
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

/// The row of the same spheres in the opposite order.
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

/// A text with everything that the rows depend on. A table is computed again if it has changed.
std::string inputs_of(const CollinearSpheres& spheres, const Grid& grid) {
  std::string text = fmt::format("collinear spheres; {}; {} {} {};", surroundings_in_words(spheres),
                                 format_number(spheres.viscosity),
                                 format_number(spheres.relative_accuracy), kMatrixMethod);
  for (const double radius : spheres.radii) text += " " + format_number(radius);
  for (const auto& gaps : grid) {
    text += ";";
    for (const double gap : gaps) text += " " + format_number(gap);
  }
  return text;
}

/// An estimate of the time of a row on one core [s], from measurements at a relative accuracy of
/// 1e-5: 2 to 6 s for three spheres, 12 to 37 s for ten. If more accuracy is asked for, the time
/// grows as for one sphere.
double typical_seconds_of(const CollinearSpheres& spheres) {
  constexpr double kSecondsPerSphere = 1.5;
  return kSecondsPerSphere * static_cast<double>(spheres.radii.size()) *
         freefem_axi::time_factor(spheres.relative_accuracy);
}

}  // namespace

freefem_axi::TablePlan resistance_table_plan(const CollinearSpheres& spheres, const Grid& grid) {
  assert(grid.size() + 1 == spheres.radii.size());
  freefem_axi::PlanParts<ResistanceRow> parts;
  auto& planned = parts.rows.emplace_back();
  planned.head.viscosity = spheres.viscosity;
  planned.head.radii = spheres.radii;
  planned.head.container = surroundings_in_words(spheres);
  prepare(planned.head, planned.blank);
  parts.inputs = inputs_of(spheres, grid);
  const bool has_mirror = is_mirror_image(spheres, grid);
  for (const auto& point : all_points(grid))
    if (!has_mirror || point <= reflected(point)) parts.points.push_back(point);
  parts.relative_accuracy = spheres.relative_accuracy;
  parts.typical_seconds = typical_seconds_of(spheres);
  parts.needs_all_rows = true;  // because the fit is a polynomial through all rows
  parts.solve = [spheres](const freefem_axi::FreeFem& freefem, const freefem_axi::RowPoint& gaps) {
    return std::vector{solve_resistance(freefem, spheres, gaps)};
  };
  parts.name_of = [](const freefem_axi::RowPoint& gaps) {
    std::string words = "gaps";
    for (const double gap : gaps) words += " " + format_number(gap);
    return words;
  };
  parts.arrange = [grid](const freefem_axi::PlanParts<ResistanceRow>::Computed& computed) {
    std::vector<ResistanceRow> rows;
    for (const auto& point : all_points(grid)) {
      const auto row = computed(point);
      rows.push_back(row ? *row : reflected(computed(reflected(point)).value()));
    }
    return rows;
  };
  return make_plan(std::move(parts));
}

}  // namespace viscontact::swimmer
