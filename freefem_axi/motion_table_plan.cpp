// Which rows the tables of one sphere have, how FreeFEM solves them, and what they depend on.
#include "viscontact/freefem_axi/motion_table_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "viscontact/common/text/number.hpp"
#include "viscontact/freefem_axi/journal/make_plan.hpp"
#include "viscontact/freefem_axi/pair_loads.hpp"
#include "viscontact/lubrication/near_contact.hpp"

namespace viscontact::freefem_axi {
namespace {

using lubrication::MotionKind;
using lubrication::MotionRow;

// Revisions of the FreeFEM scripts for the approach, for the other motions, and for tables with
// strains. If a change of the scripts alters results by more than their error estimates, raise the
// number: tables of the lower number are then computed again.
constexpr int kDragMethod = 3, kMotionMethod = 2, kStrainMethod = 1;

/// Times of rows, measured on two cores of 2.1 GHz with one row on each, at gaps of 0.01 and 0.3
/// radii.
struct RowTimeTuning {
  // Seconds of a row in which a sphere approaches, slides and rolls, or spins, if the coarsest
  // meshes suffice.
  static constexpr double kAlong = 1.3, kAcross = 2.5, kAround = 0.6;
  // The same with strains, whose flows have the same matrices; kTwofold has one strain.
  static constexpr double kAlongStrained = 1.8, kAcrossStrained = 3.2, kTwofold = 2;
  // The coarsest meshes suffice for a relative accuracy of kKnee and more; for smaller values the
  // time grows as the power -kPower of the accuracy.
  static constexpr double kKnee = 1e-5, kPower = 0.45;
};

/// Whether the tables have stresslets, because strains are asked for.
bool has_strains(const Tabulation& tabulation) {
  return std::ranges::any_of(tabulation.motions, lubrication::is_strain);
}

/// The motions that FreeFEM solves for the group.
std::vector<MotionKind> solved_motions(const Tabulation& tabulation, MotionGroup group) {
  return has_strains(tabulation) ? motions_with_strains(group) : motions_of(group);
}

/// Everything that the numbers of the tables of a group depend on. With another text all tables
/// that users have count as out of date and are computed again.
std::string inputs_of(const Tabulation& tabulation, MotionGroup group) {
  const bool strains = has_strains(tabulation), along = group == MotionGroup::kAlong && !strains;
  const int method = strains ? kStrainMethod : along ? kDragMethod : kMotionMethod;
  std::string text =
      fmt::format("{}{}{}; {}; {} {} {} {};", strains ? "strains; " : "",
                  along ? "" : fmt::format("motion {}; ", static_cast<int>(group)),
                  geometry_in_words(tabulation), container_in_words(tabulation),
                  format_number(tabulation.viscosity), format_number(tabulation.radius),
                  format_number(tabulation.relative_accuracy), method);
  for (const double gap : tabulation.gaps) text += " " + format_number(gap);
  text += ";";
  for (const double velocity : tabulation.reference_velocities)
    text += " " + format_number(velocity);
  return text;
}

/// The time of one row on one core [s].
double typical_seconds(const Tabulation& tabulation, MotionGroup group) {
  const bool strains = has_strains(tabulation);
  const auto coarse = [&] {
    switch (group) {
      case MotionGroup::kAlong:
        return strains ? RowTimeTuning::kAlongStrained : RowTimeTuning::kAlong;
      case MotionGroup::kAcross:
        return strains ? RowTimeTuning::kAcrossStrained : RowTimeTuning::kAcross;
      case MotionGroup::kAround:
        break;
      case MotionGroup::kTwofold:
        return RowTimeTuning::kTwofold;
    }
    return RowTimeTuning::kAround;
  };
  return coarse() * time_factor(tabulation.relative_accuracy) *
         find_geometry(tabulation.geometry).relative_cost;
}

/// Sets the leading factors of all loads by theory, but those that head_of() sets.
void add_leading_loads(const Tabulation& tabulation, lubrication::TableHead& head) {
  const auto& geometry = find_geometry(tabulation.geometry);
  const auto [sphere, neighbour] = lubrication::leading_loads(
      head.motion, tabulation.radius * geometry.curvature(tabulation.geometry_parameters));
  // leading_loads() has q in sphere radii: the terms are 1/q, ln q, and q ln q (spin, twofold).
  const bool is_axial = lubrication::is_axial(head.motion);
  const bool is_weak =
      head.motion == MotionKind::kSpin || head.motion == MotionKind::kTwofoldStrain;
  const double unit = is_axial ? tabulation.radius : is_weak ? 1 / tabulation.radius : 1;
  const auto set = [unit](std::optional<double>& member, const std::optional<double>& factor) {
    if (factor) member = unit * *factor;
  };
  if (is_strain(head.motion)) {
    set(head.leading_force_factor, sphere.force);
    set(head.leading_torque_factor, sphere.torque);
  }
  set(head.leading_stresslet_factor, sphere.stresslet);
  set(head.neighbour_leading_force_factor, neighbour.force);
  set(head.neighbour_leading_torque_factor, neighbour.torque);
  set(head.neighbour_leading_stresslet_factor, neighbour.stresslet);
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
  if (has_strains(tabulation) && ratio == 0) add_leading_loads(tabulation, head);
  if (is_strain(motion)) return head;
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

/// The row at another velocity. Its loads are NaN, which complete() replaces by values from the
/// factors.
MotionRow with_velocity(MotionRow row, double velocity) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  row.reference_velocity = velocity;
  row.force = row.torque = row.stresslet = row.trace = kUnknown;
  if (auto& other = row.neighbour)
    other->force = other->torque = other->stresslet = other->trace = kUnknown;
  return row;
}

}  // namespace

double time_factor(double relative_accuracy) {
  return std::pow(std::max(1.0, RowTimeTuning::kKnee / relative_accuracy), RowTimeTuning::kPower);
}

std::vector<MotionKind> asked_motions(const Tabulation& tabulation, MotionGroup group) {
  auto asked = solved_motions(tabulation, group);
  std::erase_if(asked, [&](MotionKind motion) {
    return std::ranges::find(tabulation.motions, motion) == tabulation.motions.end();
  });
  return asked;
}

std::vector<MotionGroup> motion_groups(const Tabulation& tabulation) {
  std::vector<MotionGroup> groups = {MotionGroup::kAlong, MotionGroup::kAcross,
                                     MotionGroup::kAround, MotionGroup::kTwofold};
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
  const bool strains = has_strains(tabulation);
  for (const auto motion : solved_motions(tabulation, group)) {
    const bool is_asked = std::ranges::find(asked, motion) != asked.end();
    auto& row = parts.rows.emplace_back(PlannedRow<MotionRow>{
        head_of(tabulation, motion), {}, is_asked, is_asked ? path_of(motion) : ""});
    if ((strains || group != MotionGroup::kAlong) && neighbour_is_sphere(tabulation))
      row.blank.neighbour.emplace();
    row.blank.has_stresslets = strains;
    row.blank.has_traces = strains && lubrication::is_axial(motion) && !tabulation.container;
  }
  if (group == MotionGroup::kAlong && !strains) {
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
  parts.solve = [tabulation, group, strains](const FreeFem& freefem, const RowPoint& point) {
    const double gap = point.at(0);
    return strains ? rows_of(tabulation, solve_pair_loads(freefem, tabulation, group, gap), gap)
                   : solve_motions(freefem, tabulation, group, gap);
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
