// The rows of motion tables, their numbers in the journal, and their tables. Lengths, masses and
// times are in the units of the case.
#include "viscontact/motions/tabulation/motion_table_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viscontact/common/error.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/freefem_axi/journal/row_record.hpp"
#include "viscontact/motions/motion_table.hpp"
#include "viscontact/motions/near_contact.hpp"

namespace viscontact::motions {
namespace {

using lubrication::ActionFactors;
using lubrication::MotionKind;

// Revision of the scripts for these motions. Raise it when a change of the scripts changes their
// results: tables of another revision are then computed again.
constexpr int kMotionMethod = 2;

// Numbers of a body in a journal, and numbers of a row after those of its results.
constexpr std::size_t kOfBody = 4, kOfRow = 2;

std::string hash_of(const freefem_axi::Tabulation& tabulation, freefem_axi::MotionGroup group) {
  std::string text = fmt::format(
      "motion {}; {}; {}; {} {} {} {};", static_cast<int>(group),
      freefem_axi::geometry_in_words(tabulation), freefem_axi::container_in_words(tabulation),
      format_number(tabulation.viscosity), format_number(tabulation.radius),
      format_number(tabulation.relative_accuracy), kMotionMethod);
  for (const double gap : tabulation.gaps) text += " " + format_number(gap);
  text += ";";
  for (const double velocity : tabulation.reference_velocities)
    text += " " + format_number(velocity);
  return sha256(text);
}

std::vector<freefem_axi::RowPoint> points_of(const freefem_axi::Tabulation& tabulation) {
  std::vector<freefem_axi::RowPoint> points;
  for (const double gap : tabulation.gaps) points.push_back({gap});
  return points;
}

std::size_t numbers_of_result(const freefem_axi::Tabulation& tabulation) {
  return kOfBody * (freefem_axi::neighbour_is_sphere(tabulation) ? 2 : 1) + 1;
}

void append(std::vector<double>& numbers, const ActionFactors& body) {
  numbers.insert(numbers.end(),
                 {body.force, body.torque, body.force_error_estimate, body.torque_error_estimate});
}

std::vector<double> numbers_of(const freefem_axi::MotionRow& row) {
  std::vector<double> numbers;
  for (const auto& result : row.results) {
    append(numbers, result.sphere);
    if (result.neighbour) append(numbers, *result.neighbour);
    numbers.push_back(result.observed_order);
  }
  numbers.insert(numbers.end(), {row.degrees_of_freedom, row.seconds});
  return numbers;
}

ActionFactors factors_at(const std::vector<double>& numbers, std::size_t at) {
  return {numbers.at(at), numbers.at(at + 1), numbers.at(at + 2), numbers.at(at + 3)};
}

std::string name_of_gap(const freefem_axi::RowPoint& point) {
  return "gap " + format_number(point.at(0));
}

/// The table of one motion, without rows.
MotionTable head_of(const freefem_axi::Tabulation& tabulation, freefem_axi::MotionGroup group,
                    MotionKind motion) {
  const auto& geometry = freefem_axi::find_geometry(tabulation.geometry);
  MotionTable table;
  table.motion = motion;
  table.viscosity = tabulation.viscosity;
  table.radius = tabulation.radius;
  table.geometry = freefem_axi::geometry_in_words(tabulation);
  table.container = freefem_axi::container_in_words(tabulation);
  const double ratio = freefem_axi::neighbour_ratio(tabulation, motion);
  table.neighbour_moves = ratio != 0;
  table.case_hash = hash_of(tabulation, group);
  if (tabulation.motions.size() > 1) table.tabulated_motions = tabulation.motions;
  if (geometry.curvature == nullptr) return table;
  const auto leading = leading_factors(
      motion, {tabulation.radius * geometry.curvature(tabulation.geometry_parameters),
               geometry.is_shear_free, ratio});
  // In theory's coefficient q is in sphere radii; the coefficient of q ln q with q in the unit of
  // the table is smaller by the radius.
  const double unit = motion == MotionKind::kSpin ? tabulation.radius : 1;
  table.leading_force_factor = leading.force / unit;
  table.leading_torque_factor = leading.torque / unit;
  return table;
}

MotionTable table_of(const freefem_axi::Tabulation& tabulation, freefem_axi::MotionGroup group,
                     MotionKind motion, const freefem_axi::RowRecord& record) {
  auto table = head_of(tabulation, group, motion);
  const auto motions = freefem_axi::motions_of(group);
  const auto place = static_cast<std::size_t>(std::ranges::find(motions, motion) - motions.begin());
  const std::size_t size = numbers_of_result(tabulation), first = place * size;
  for (const double velocity : tabulation.reference_velocities)
    for (const double gap : tabulation.gaps) {
      const auto finished = record.finished.find({gap});
      if (finished == record.finished.end()) continue;
      const auto& numbers = finished->second.numbers;
      MotionTableRow row;
      row.gap = gap;
      row.reference_velocity = velocity;
      row.sphere = factors_at(numbers, first);
      if (size > kOfBody + 1) row.neighbour = factors_at(numbers, first + kOfBody);
      row.observed_order = numbers.at(first + size - 1);
      row.degrees_of_freedom = numbers.at(motions.size() * size);
      row.seconds = numbers.at(motions.size() * size + 1);
      table.rows.push_back(row);
    }
  table.failed_rows = freefem_axi::failed_rows(record, name_of_gap);
  table.versions["FreeFEM"] = freefem_axi::freefem_versions(record);
  return table;
}

/// The table in the file, or nothing if there is none or if it has other inputs.
std::optional<MotionTable> finished_table(const std::filesystem::path& path, MotionKind motion,
                                          const std::string& hash) {
  if (!std::filesystem::is_regular_file(path)) return {};
  try {
    auto table = read_motion_table(path);
    if (table.case_hash != hash || table.motion != motion) return {};
    return table;
  } catch (const Error&) {  // the file is not a table
    return {};
  }
}

/// The rows of finished tables. The numbers of a motion that no table contains are set to 0,
/// because no table that is written uses them.
freefem_axi::RowRecord finished_rows(const freefem_axi::Tabulation& tabulation,
                                     freefem_axi::MotionGroup group, const TablePath& path_of) {
  const auto motions = freefem_axi::motions_of(group);
  const std::string hash = hash_of(tabulation, group);
  const std::size_t size = numbers_of_result(tabulation);
  freefem_axi::RowRecord record;
  for (const auto motion : asked_motions(tabulation, group)) {
    const auto table = finished_table(path_of(motion), motion, hash);
    if (!table) return {};
    const auto version = table->versions.find("FreeFEM");
    const auto place = std::ranges::find(motions, motion) - motions.begin();
    record.failed =
        freefem_axi::failed_points(table->failed_rows, points_of(tabulation), name_of_gap);
    for (const auto& row : table->rows) {
      auto& finished = record.finished[{row.gap}];
      finished.point = {row.gap};
      finished.freefem_version = version == table->versions.end() ? "" : version->second;
      finished.numbers.resize(motions.size() * size + kOfRow);
      std::vector<double> numbers;
      append(numbers, row.sphere);
      if (row.neighbour) append(numbers, *row.neighbour);
      numbers.push_back(row.observed_order);
      if (numbers.size() != size) return {};
      std::ranges::copy(numbers, finished.numbers.begin() + place * static_cast<long>(size));
      finished.numbers[motions.size() * size] = row.degrees_of_freedom;
      finished.numbers[motions.size() * size + 1] = row.seconds;
    }
  }
  return record;
}

/// The time of one row on one core [s], measured as that of force_table_plan.cpp.
double typical_seconds_of(const freefem_axi::Tabulation& tabulation,
                          freefem_axi::MotionGroup group) {
  constexpr double kKnee = 1e-5, kPower = 0.45;
  const double coarse = group == freefem_axi::MotionGroup::kAcross ? 2.5 : 0.6;
  return coarse * std::pow(std::max(1.0, kKnee / tabulation.relative_accuracy), kPower) *
         freefem_axi::find_geometry(tabulation.geometry).relative_cost;
}

/// The largest error estimate of the motions that are asked for.
double estimate_of(const freefem_axi::Tabulation& tabulation, freefem_axi::MotionGroup group,
                   const freefem_axi::FinishedRow& row) {
  const auto motions = freefem_axi::motions_of(group);
  const std::size_t size = numbers_of_result(tabulation);
  double largest = 0;
  for (const auto motion : asked_motions(tabulation, group)) {
    const auto place =
        static_cast<std::size_t>(std::ranges::find(motions, motion) - motions.begin());
    for (std::size_t at = place * size; at + kOfBody < (place + 1) * size; at += kOfBody)
      largest = std::max({largest, row.numbers.at(at + 2), row.numbers.at(at + 3)});
  }
  return largest;
}

}  // namespace

std::vector<MotionKind> asked_motions(const freefem_axi::Tabulation& tabulation,
                                      freefem_axi::MotionGroup group) {
  std::vector<MotionKind> asked;
  for (const auto motion : freefem_axi::motions_of(group))
    if (std::ranges::find(tabulation.motions, motion) != tabulation.motions.end())
      asked.push_back(motion);
  return asked;
}

std::vector<freefem_axi::MotionGroup> motion_groups(const freefem_axi::Tabulation& tabulation) {
  std::vector<freefem_axi::MotionGroup> groups;
  for (const auto group : {freefem_axi::MotionGroup::kAcross, freefem_axi::MotionGroup::kAround})
    if (!asked_motions(tabulation, group).empty()) groups.push_back(group);
  return groups;
}

freefem_axi::TablePlan motion_table_plan(const freefem_axi::Tabulation& tabulation,
                                         freefem_axi::MotionGroup group, const TablePath& path_of) {
  freefem_axi::TablePlan plan;
  plan.hash = hash_of(tabulation, group);
  plan.points = points_of(tabulation);
  plan.shape = {1, freefem_axi::motions_of(group).size() * numbers_of_result(tabulation) + kOfRow};
  plan.relative_accuracy = tabulation.relative_accuracy;
  plan.typical_seconds = typical_seconds_of(tabulation, group);
  plan.solve = [tabulation, group](const freefem_axi::FreeFem& freefem,
                                   const freefem_axi::RowPoint& point) {
    return numbers_of(freefem_axi::solve_motions(freefem, tabulation, group, point.at(0)));
  };
  plan.read = [tabulation, group, path_of](const std::filesystem::path&) {
    return finished_rows(tabulation, group, path_of);
  };
  const auto write = [tabulation, group](MotionKind motion) {
    return [tabulation, group, motion](const freefem_axi::RowRecord& record,
                                       const freefem_axi::Versions& versions) {
      auto table = table_of(tabulation, group, motion, record);
      table.versions.insert(versions.begin(), versions.end());
      return write_motion_table(table);
    };
  };
  const auto asked = asked_motions(tabulation, group);
  plan.write = write(asked.front());
  for (std::size_t i = 1; i < asked.size(); ++i)
    plan.companions.push_back({path_of(asked[i]), write(asked[i])});
  plan.name_of = name_of_gap;
  plan.estimate_of = [tabulation, group](const freefem_axi::FinishedRow& row) {
    return estimate_of(tabulation, group, row);
  };
  plan.seconds_of = [](const freefem_axi::FinishedRow& row) { return row.numbers.back(); };
  return plan;
}

}  // namespace viscontact::motions
