// Which rows the tables of one sphere have, how FreeFEM solves them, and what they depend on.
#include "viscontact/freefem_axi/motion_table_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "viscontact/common/text/number.hpp"
#include "viscontact/freefem_axi/journal/make_plan.hpp"
#include "viscontact/lubrication/near_contact.hpp"

namespace viscontact::freefem_axi {
namespace {

using lubrication::MotionKind;
using lubrication::MotionRow;

// Revisions of the FreeFEM scripts for the approach and for the other motions. If a change of the
// scripts alters results by more than their error estimates, raise the number: tables of the lower
// number are then computed again.
constexpr int kDragMethod = 3, kMotionMethod = 2;

/// Times of rows, measured on two cores of 2.1 GHz with one row on each, at gaps of 0.01 and 0.3
/// radii.
struct RowTimeTuning {
  // Seconds of a row in which a sphere approaches, slides and rolls, or spins, if the coarsest
  // meshes suffice.
  static constexpr double kAlong = 1.3, kAcross = 2.5, kAround = 0.6;
  // The coarsest meshes suffice for a relative accuracy of kKnee and more; for smaller values the
  // time grows as the power -kPower of the accuracy.
  static constexpr double kKnee = 1e-5, kPower = 0.45;
};

/// Everything that the numbers of the tables of a group depend on. With another text all tables
/// that users have count as out of date and are computed again.
std::string inputs_of(const Tabulation& tabulation, MotionGroup group) {
  const bool along = group == MotionGroup::kAlong;
  std::string text = fmt::format(
      "{}{}; {}; {} {} {} {};", along ? "" : fmt::format("motion {}; ", static_cast<int>(group)),
      geometry_in_words(tabulation), container_in_words(tabulation),
      format_number(tabulation.viscosity), format_number(tabulation.radius),
      format_number(tabulation.relative_accuracy), along ? kDragMethod : kMotionMethod);
  for (const double gap : tabulation.gaps) text += " " + format_number(gap);
  text += ";";
  for (const double velocity : tabulation.reference_velocities)
    text += " " + format_number(velocity);
  return text;
}

/// The time of one row on one core [s].
double typical_seconds(const Tabulation& tabulation, MotionGroup group) {
  const double coarse = group == MotionGroup::kAlong    ? RowTimeTuning::kAlong
                        : group == MotionGroup::kAcross ? RowTimeTuning::kAcross
                                                        : RowTimeTuning::kAround;
  return coarse * time_factor(tabulation.relative_accuracy) *
         find_geometry(tabulation.geometry).relative_cost;
}

/// With the leading coefficient of the resistance (approach) or the leading factors of force and
/// torque (other motions), where theory knows them.
lubrication::TableHead head_of(const Tabulation& tabulation, MotionKind motion) {
  const auto& geometry = find_geometry(tabulation.geometry);
  lubrication::TableHead head;
  head.motion = motion;
  head.viscosity = tabulation.viscosity;
  head.radius = tabulation.radius;
  head.geometry = geometry_in_words(tabulation);
  head.container = container_in_words(tabulation);
  const double ratio = neighbour_ratio(tabulation, motion);
  head.neighbour_moves = ratio != 0;
  if (tabulation.motions.size() > 1) head.tabulated_motions = tabulation.motions;
  if (motion == MotionKind::kApproach) {
    head.leading_coefficient = leading_coefficient(tabulation);
  } else if (geometry.curvature != nullptr) {
    const auto leading = lubrication::leading_factors(
        motion, {tabulation.radius * geometry.curvature(tabulation.geometry_parameters),
                 geometry.is_shear_free, ratio});
    // leading_factors() has q in sphere radii. With q in the unit of the table the coefficient of
    // ln q (slide, roll) is the same, and that of q ln q (spin) is divided by the radius.
    const double unit = motion == MotionKind::kSpin ? tabulation.radius : 1;
    head.leading_force_factor = leading.force / unit;
    head.leading_torque_factor = leading.torque / unit;
  }
  return head;
}

/// The row at another velocity. Its forces and torques are NaN, which complete() replaces by values
/// from the factors.
MotionRow with_velocity(MotionRow row, double velocity) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  row.reference_velocity = velocity;
  row.force = row.torque = kUnknown;
  if (auto& other = row.neighbour) other->force = other->torque = kUnknown;
  return row;
}

}  // namespace

double time_factor(double relative_accuracy) {
  return std::pow(std::max(1.0, RowTimeTuning::kKnee / relative_accuracy), RowTimeTuning::kPower);
}

std::vector<MotionKind> asked_motions(const Tabulation& tabulation, MotionGroup group) {
  auto asked = motions_of(group);
  std::erase_if(asked, [&](MotionKind motion) {
    return std::ranges::find(tabulation.motions, motion) == tabulation.motions.end();
  });
  return asked;
}

std::vector<MotionGroup> motion_groups(const Tabulation& tabulation) {
  std::vector<MotionGroup> groups = {MotionGroup::kAlong, MotionGroup::kAcross,
                                     MotionGroup::kAround};
  std::erase_if(groups,
                [&](MotionGroup group) { return asked_motions(tabulation, group).empty(); });
  return groups;
}

TablePlan motion_table_plan(const Tabulation& tabulation, MotionGroup group,
                            const TablePath& path_of) {
  PlanParts<MotionRow> parts;
  parts.inputs = inputs_of(tabulation, group);
  parts.relative_accuracy = tabulation.relative_accuracy;
  parts.typical_seconds = typical_seconds(tabulation, group);
  const auto asked = asked_motions(tabulation, group);
  assert(!asked.empty());
  for (const auto motion : motions_of(group)) {
    const bool is_asked = std::ranges::find(asked, motion) != asked.end();
    auto& row = parts.rows.emplace_back(PlannedRow<MotionRow>{
        head_of(tabulation, motion), {}, is_asked, is_asked ? path_of(motion) : ""});
    if (group != MotionGroup::kAlong && neighbour_is_sphere(tabulation))
      row.blank.neighbour.emplace();
  }
  if (group == MotionGroup::kAlong) {
    for (const double velocity : tabulation.reference_velocities)
      for (const double gap : tabulation.gaps) parts.points.push_back({gap, velocity});
    parts.name_of = [](const RowPoint& point) {
      return fmt::format("gap {}, velocity {}", format_number(point.at(0)),
                         format_number(point.at(1)));
    };
    parts.solve = [tabulation](const FreeFem& freefem, const RowPoint& point) {
      return std::vector{solve_row(freefem, tabulation, point.at(0), point.at(1))};
    };
    return make_plan(std::move(parts));
  }
  for (const double gap : tabulation.gaps) parts.points.push_back({gap});
  parts.name_of = [](const RowPoint& point) { return "gap " + format_number(point.at(0)); };
  parts.solve = [tabulation, group](const FreeFem& freefem, const RowPoint& point) {
    return solve_motions(freefem, tabulation, group, point.at(0));
  };
  parts.arrange = [tabulation](const PlanParts<MotionRow>::Computed& computed) {
    std::vector<MotionRow> rows;
    for (const double velocity : tabulation.reference_velocities)
      for (const double gap : tabulation.gaps)
        if (const auto row = computed({gap})) rows.push_back(with_velocity(*row, velocity));
    return rows;
  };
  return make_plan(std::move(parts));
}

}  // namespace viscontact::freefem_axi
