// Makes a table of each resistance of a pair from the tables of the motions, and fits it
// (fit_pair.hpp). Lengths, masses and times are in the units of the tables.
#include "viscontact/motions/fit/fit_pair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "viscontact/common/equal_up_to_rounding.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/fitting/fit_force_table.hpp"

namespace viscontact::motions {
namespace {

using lubrication::ForceTable;

/// An entry as a table of forces at the velocity -1, so that the force is the resistance.
struct EntryTable {
  ForceTable table;
  std::vector<double> scales;  ///< FitSettings::row_scales
  std::optional<double> theory;
};

/// What all tables of a pair have in common.
struct Pair {
  double viscosity = 0, radius = 0;
  std::string geometry, container;
};

template <class Table>
Pair pair_of(const Table& table) {
  if (table.neighbour_moves)
    throw Error(
        ErrorKind::kBadInput,
        "the neighbour has a velocity of its own; resistances need tables in which it is at "
        "rest (velocity_ratio = 0, rotation_ratio = 0)");
  return {table.viscosity, table.radius, table.geometry, table.container};
}

Pair common_pair(const PairTables& tables) {
  std::vector<Pair> pairs;
  if (tables.approach) pairs.push_back(pair_of(*tables.approach));
  for (const auto* table : {&tables.slide, &tables.roll, &tables.spin})
    if (*table) pairs.push_back(pair_of(**table));
  if (pairs.empty()) throw Error(ErrorKind::kBadInput, "there is no table to fit");
  const auto refuse = [](const char* what, const auto& one, const auto& other) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("the tables are of different pairs: the {} is {} in one and {} in "
                            "another one",
                            what, one, other));
  };
  const auto& first = pairs.front();
  for (const auto& pair : pairs) {
    if (!equal_up_to_rounding(pair.viscosity, first.viscosity))
      refuse("viscosity", first.viscosity, pair.viscosity);
    if (!equal_up_to_rounding(pair.radius, first.radius))
      refuse("radius", first.radius, pair.radius);
    if (pair.geometry != first.geometry) refuse("geometry", first.geometry, pair.geometry);
    if (pair.container != first.container) refuse("container", first.container, pair.container);
  }
  return first;
}

EntryTable empty_table(const Pair& pair) {
  EntryTable entry;
  entry.table.viscosity = pair.viscosity;
  entry.table.radius = pair.radius;
  entry.table.geometry = pair.geometry;
  entry.table.container = pair.container;
  return entry;
}

void add_row(EntryTable& entry, double gap, double value, double scale, double estimate) {
  lubrication::ForceTableRow row;
  row.gap = gap;
  row.reference_velocity = -1;
  row.force = value;
  row.relative_error_estimate = estimate;
  entry.table.rows.push_back(row);
  entry.scales.push_back(scale);
}

/// The resistance of a motion to itself.
EntryTable diagonal_entry(const Pair& pair, const MotionTable& table) {
  const bool slides = table.motion == lubrication::MotionKind::kSlide;
  const auto units = action_units(table.motion, pair.viscosity, pair.radius);
  const double unit = slides ? units.force : units.torque;
  EntryTable entry = empty_table(pair);
  entry.table.failed_rows = table.failed_rows;
  for (const auto& row : table.rows) {
    const double value = unit * (slides ? row.sphere.force : row.sphere.torque);
    add_row(entry, row.gap, value, value,
            slides ? row.sphere.force_error_estimate : row.sphere.torque_error_estimate);
  }
  const auto leading = slides ? table.leading_force_factor : table.leading_torque_factor;
  if (leading) entry.theory = unit * *leading;
  return entry;
}

/// slide_roll from the table of one motion, the torque of sliding or the force of rolling, with its
/// error.
struct Coupling {
  double value = 0, error = 0, diagonal = 0;
};

Coupling coupling_of(const MotionTable& table, const MotionTableRow& row, const Pair& pair) {
  const auto units = action_units(table.motion, pair.viscosity, pair.radius);
  if (table.motion == lubrication::MotionKind::kSlide)
    return {-units.torque * row.sphere.torque,
            units.torque * row.sphere.torque_error_estimate * std::abs(row.sphere.force),
            units.force * row.sphere.force};
  return {-units.force * row.sphere.force,
          units.force * row.sphere.force_error_estimate * std::abs(row.sphere.torque),
          units.torque * row.sphere.torque};
}

/// Both values of slide_roll at a gap must agree, because the matrix is symmetric.
void check_symmetry(double gap, const Coupling& slide, const Coupling& roll) {
  // Tables without estimates are compared to the precision that is usual for published ones.
  constexpr double kUnknown = 1e-3;
  const double scale = std::sqrt(slide.diagonal * roll.diagonal);
  const double error = slide.error + roll.error;
  const double allowed = error > 0 ? error : kUnknown * scale;
  const double difference = std::abs(slide.value - roll.value);
  if (difference > allowed)
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("at gap {} the matrix is not symmetric: slide_roll is {} by the torque of "
                    "sliding and {} by the force of rolling; their error estimates allow a "
                    "difference of {:.2g}",
                    gap, slide.value, roll.value, allowed));
}

EntryTable coupling_entry(const Pair& pair, const PairTables& tables) {
  EntryTable entry = empty_table(pair);
  const auto& first = tables.slide ? *tables.slide : *tables.roll;
  entry.table.failed_rows = first.failed_rows;
  for (const auto& row : first.rows) {
    const auto one = coupling_of(first, row, pair);
    if (!tables.slide || !tables.roll) {
      const double length = tables.slide ? pair.radius : 1 / pair.radius;
      add_row(entry, row.gap, one.value, one.diagonal * length,
              one.error / (one.diagonal * length));
      continue;
    }
    const auto match = std::ranges::find(tables.roll->rows, row.gap, &MotionTableRow::gap);
    if (match == tables.roll->rows.end())
      throw Error(
          ErrorKind::kBadInput,
          fmt::format("the table of rolling has no row at gap {}, which that of sliding has",
                      row.gap));
    const auto other = coupling_of(*tables.roll, *match, pair);
    check_symmetry(row.gap, one, other);
    const double scale = std::sqrt(one.diagonal * other.diagonal);
    add_row(entry, row.gap, (one.value + other.value) / 2, scale,
            (one.error + other.error) / (2 * scale));
  }
  const auto units = action_units(first.motion, pair.viscosity, pair.radius);
  if (tables.slide && first.leading_torque_factor)
    entry.theory = -units.torque * *first.leading_torque_factor;
  if (!tables.slide && first.leading_force_factor)
    entry.theory = -units.force * *first.leading_force_factor;
  return entry;
}

EntryFit fit_entry(PairEntry which, const EntryTable& entry, const PairFitSettings& settings,
                   const StopToken& stop) {
  const auto& named = pair_entries()[static_cast<std::size_t>(which)];
  fitting::FitSettings one;
  one.basis = basis_of_entry(named, settings.basis, entry.theory);
  one.loss = settings.loss;
  one.row_scales = entry.scales;
  one.shape = named.shape;
  try {
    return {fitting::fit_force_table(entry.table, one, stop), entry.theory};
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", named.name, error.what()));
  }
}

}  // namespace

PairFit fit_pair(const PairTables& tables, const PairFitSettings& settings, const StopToken& stop) {
  const Pair pair = common_pair(tables);
  std::map<PairEntry, EntryTable> entries;
  if (tables.approach) {
    auto& squeeze = entries.emplace(PairEntry::kSqueeze, empty_table(pair)).first->second;
    squeeze.table.failed_rows = tables.approach->failed_rows;
    for (const auto& row : tables.approach->rows) {
      const double value = -row.force / row.reference_velocity;
      add_row(squeeze, row.gap, value, value, row.relative_error_estimate);
    }
    squeeze.theory = squeeze.table.leading_coefficient = tables.approach->leading_coefficient;
  }
  if (tables.slide) entries.emplace(PairEntry::kSlide, diagonal_entry(pair, *tables.slide));
  if (tables.roll) entries.emplace(PairEntry::kRoll, diagonal_entry(pair, *tables.roll));
  if (tables.slide || tables.roll)
    entries.emplace(PairEntry::kSlideRoll, coupling_entry(pair, tables));
  if (tables.spin) entries.emplace(PairEntry::kSpin, diagonal_entry(pair, *tables.spin));

  PairFit fit;
  fit.viscosity = pair.viscosity;
  fit.radius = pair.radius;
  fit.geometry = pair.geometry;
  fit.gap_interval = {0, std::numeric_limits<double>::infinity()};
  for (const auto& [which, entry] : entries) {
    const auto& one = fit.entries[which] = fit_entry(which, entry, settings, stop);
    fit.gap_interval[0] = std::max(fit.gap_interval[0], one.fit.gap_interval[0]);
    fit.gap_interval[1] = std::min(fit.gap_interval[1], one.fit.gap_interval[1]);
  }
  if (!(fit.gap_interval[0] < fit.gap_interval[1]))
    throw Error(ErrorKind::kBadInput, "the tables have no interval of gaps in common");
  return fit;
}

}  // namespace viscontact::motions
