// Makes a table of each resistance (entry) from the tables of force and torque, and fits it.
#include "viscontact/motions/fit/fit_pair.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "viscontact/common/equal_up_to_rounding.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/fitting/fit_force_table.hpp"

namespace viscontact::motions {
namespace {

using lubrication::MotionKind;
using lubrication::MotionRow;
using lubrication::MotionTable;

/// The table of an entry: forces at the velocity -1, which are equal to the resistance.
struct EntryTable {
  MotionTable table;
  std::vector<double> scales;    // for each row what its residual is divided by; unit of entry
  std::optional<double> theory;  // theory's coefficient of the leading term; unit of entry/term
};

/// The first table. Throws Error(kBadInput) if the tables are of different pairs.
const MotionTable& first_of_pair(const PairTables& tables) {
  if (tables.empty()) throw Error(ErrorKind::kBadInput, "there is no table to fit");
  const auto require_same = [](bool is_same, const char* what, const auto& one, const auto& other) {
    if (!is_same)
      throw Error(ErrorKind::kBadInput,
                  "the tables are of different pairs: the {} is {} in one and {} in another one",
                  what, one, other);
  };
  const auto& first = tables.begin()->second;
  for (const auto& [motion, table] : tables) {
    if (table.neighbour_moves)
      throw Error(ErrorKind::kBadInput,
                  "the neighbour has a velocity of its own; resistances need tables in which it is "
                  "at rest (velocity_ratio = 0, rotation_ratio = 0)");
    require_same(equal_up_to_rounding(table.viscosity, first.viscosity), "viscosity",
                 first.viscosity, table.viscosity);
    require_same(equal_up_to_rounding(table.radius, first.radius), "radius", first.radius,
                 table.radius);
    require_same(table.geometry == first.geometry, "geometry", first.geometry, table.geometry);
    require_same(table.container == first.container, "container", first.container, table.container);
  }
  return first;
}

/// A table without rows. `pair` is any table of the pair, and `of_motion` that from which the rows
/// will be made.
EntryTable empty_table(const MotionTable& pair, const MotionTable& of_motion) {
  EntryTable entry;
  entry.table.viscosity = pair.viscosity;
  entry.table.radius = pair.radius;
  entry.table.geometry = pair.geometry;
  entry.table.container = pair.container;
  entry.table.failed_rows = of_motion.failed_rows;
  return entry;
}

/// Appends a row: the gap [L], the resistance `value`, `scale`, by which residuals are divided,
/// both in the unit of the entry, and the relative error `estimate` (0: not known).
void add_row(EntryTable& entry, double gap, double value, double scale, double estimate) {
  MotionRow row;
  row.gap = gap;
  row.reference_velocity = -1;
  row.force = value;
  row.relative_error_estimate = estimate;
  entry.table.rows.push_back(row);
  entry.scales.push_back(scale);
}

/// The table of squeeze or slide, which are a force per velocity [M/T], or of roll or spin, which
/// are a torque per angular velocity [M L^2/T], as the motion of `table` says.
EntryTable diagonal_entry(const MotionTable& pair, const MotionTable& table) {
  EntryTable entry = empty_table(pair, table);
  if (table.motion == MotionKind::kApproach) {
    for (const auto& row : table.rows) {
      const double value = -row.force / row.reference_velocity;
      add_row(entry, row.gap, value, value, row.relative_error_estimate);
    }
    entry.theory = entry.table.leading_coefficient = table.leading_coefficient;
    return entry;
  }
  const bool slides = table.motion == MotionKind::kSlide;
  const auto units = lubrication::action_units(table.motion, pair.viscosity, pair.radius);
  const double unit = slides ? units.force : units.torque;
  for (const auto& row : table.rows) {
    const double value = unit * (slides ? row.force_factor : row.torque_factor);
    add_row(entry, row.gap, value, value,
            slides ? row.relative_error_estimate : row.torque_error_estimate);
  }
  const auto leading = slides ? table.leading_force_factor : table.leading_torque_factor;
  if (leading) entry.theory = unit * *leading;
  return entry;
}

/// slide_roll at one gap [M L/T], from the torque of sliding or the force of rolling, and the
/// estimate of its error (0: not known). `diagonal` is slide [M/T] or roll [M L^2/T] from the same
/// row of the table.
struct Coupling {
  double value = 0, error = 0, diagonal = 0;
};

Coupling coupling_of(const MotionTable& pair, const MotionTable& table, const MotionRow& row) {
  const auto units = lubrication::action_units(table.motion, pair.viscosity, pair.radius);
  if (table.motion == MotionKind::kSlide)
    return {-units.torque * row.torque_factor,
            units.torque * row.torque_error_estimate * std::abs(row.force_factor),
            units.force * row.force_factor};
  return {-units.force * row.force_factor,
          units.force * row.relative_error_estimate * std::abs(row.torque_factor),
          units.torque * row.torque_factor};
}

/// Throws Error(kBadInput) if the values of slide_roll from both tables, which are equal by the
/// reciprocal theorem, differ by more than the sum of their error estimates.
void check_symmetry(double gap, const Coupling& slide, const Coupling& roll) {
  // The difference that is allowed if the tables have no error estimates, relative to sqrt(slide
  // roll): published tables usually have at least three digits.
  constexpr double kUnknown = 1e-3;
  const double scale = std::sqrt(slide.diagonal * roll.diagonal);
  const double error = slide.error + roll.error;
  const double allowed = error > 0 ? error : kUnknown * scale;
  const double difference = std::abs(slide.value - roll.value);
  if (difference > allowed)
    throw Error(
        ErrorKind::kBadInput,
        "at gap {} the matrix is not symmetric: slide_roll is {} by the torque of sliding and {} "
        "by the force of rolling; their error estimates allow a difference of {:.2g}",
        gap, slide.value, roll.value, allowed);
}

/// The table of slide_roll [M L/T]. With tables of sliding and rolling, it has the mean of both
/// values at each gap of sliding; other rows of rolling are not used. Throws Error(kBadInput) if
/// rolling lacks a gap of sliding, and the error of check_symmetry().
EntryTable coupling_entry(const MotionTable& pair, const PairTables& tables) {
  const auto slide = tables.find(MotionKind::kSlide), roll = tables.find(MotionKind::kRoll);
  const bool slides = slide != tables.end(), both = slides && roll != tables.end();
  assert(slides || roll != tables.end());
  const auto& first = slides ? slide->second : roll->second;
  EntryTable entry = empty_table(pair, first);
  for (const auto& row : first.rows) {
    const auto one = coupling_of(pair, first, row);
    if (!both) {
      const double length = slides ? pair.radius : 1 / pair.radius;
      add_row(entry, row.gap, one.value, one.diagonal * length,
              one.error / (one.diagonal * length));
      continue;
    }
    const auto& others = roll->second.rows;
    const auto match = std::ranges::find(others, row.gap, &MotionRow::gap);
    if (match == others.end())
      throw Error(ErrorKind::kBadInput,
                  "the table of rolling has no row at gap {}, which that of sliding has", row.gap);
    const auto other = coupling_of(pair, roll->second, *match);
    check_symmetry(row.gap, one, other);
    const double scale = std::sqrt(one.diagonal * other.diagonal);
    add_row(entry, row.gap, (one.value + other.value) / 2, scale,
            (one.error + other.error) / (2 * scale));
  }
  const auto units = lubrication::action_units(first.motion, pair.viscosity, pair.radius);
  const auto leading = slides ? first.leading_torque_factor : first.leading_force_factor;
  if (leading) entry.theory = -(slides ? units.torque : units.force) * *leading;
  return entry;
}

/// The entry that motions without strains determine.
bool is_of_motions(PairEntry which) { return which <= PairEntry::kSpin; }

double own_factor(const MotionTable& table, const MotionRow& row) {
  if (is_strain(table.motion)) return row.stresslet_factor;
  const bool turns = table.motion == MotionKind::kRoll || table.motion == MotionKind::kSpin;
  return turns ? row.torque_factor : row.force_factor;
}

/// Whether all rows have the load of the entry.
bool has_load(const NamedEntry& entry, const MotionTable& table) {
  return std::ranges::all_of(table.rows, [&](const MotionRow& row) {
    return row.has_stresslets && (!entry.of_neighbour || row.neighbour) &&
           (entry.load != PairLoad::kTrace || row.has_traces);
  });
}

/// The table of an entry by one load of one motion. Residuals are relative to the diagonal entry of
/// the motion, times that power of the radius which gives the unit.
EntryTable entry_by_load(const NamedEntry& named, const MotionTable& table) {
  EntryTable entry = empty_table(table, table);
  const auto units = lubrication::action_units(table.motion, table.viscosity, table.radius);
  const bool strained = is_strain(table.motion);
  const bool turns = table.motion == MotionKind::kRoll || table.motion == MotionKind::kSpin;
  const double own_unit = strained ? units.stresslet : turns ? units.torque : units.force;
  const double length = std::pow(table.radius, named.power - (strained || turns ? 3 : 1));
  double unit = units.stresslet;
  double lubrication::Action::*factor = &lubrication::Action::stresslet_factor;
  double lubrication::Action::*error = &lubrication::Action::stresslet_error_estimate;
  auto leading = named.of_neighbour ? table.neighbour_leading_stresslet_factor
                                    : table.leading_stresslet_factor;
  if (named.load == PairLoad::kForce) {
    unit = units.force;
    factor = &lubrication::Action::force_factor;
    error = &lubrication::Action::relative_error_estimate;
    leading =
        named.of_neighbour ? table.neighbour_leading_force_factor : table.leading_force_factor;
  } else if (named.load == PairLoad::kTorque) {
    unit = units.torque;
    factor = &lubrication::Action::torque_factor;
    error = &lubrication::Action::torque_error_estimate;
    leading =
        named.of_neighbour ? table.neighbour_leading_torque_factor : table.leading_torque_factor;
  } else if (named.load == PairLoad::kTrace) {
    factor = &lubrication::Action::trace_factor;
    error = &lubrication::Action::trace_error_estimate;
    // Near contact the traction acts at the pole along the axis: S_zz is 2/3 of its moment.
    if (leading) *leading *= 1.5;
  }
  for (const auto& row : table.rows) {
    const lubrication::Action& on = named.of_neighbour ? *row.neighbour : row;
    const double own = own_factor(table, row), scale = own_unit * own * length;
    add_row(entry, row.gap, unit * on.*factor, scale, unit * on.*error * own / scale);
  }
  if (leading) entry.theory = unit * *leading;
  return entry;
}

/// Errors of the fit get the name of the resistance `which`.
EntryFit fit_entry(PairEntry which, const EntryTable& entry, const PairFitSettings& settings,
                   const StopToken& stop) {
  const auto& named = pair_entries()[static_cast<std::size_t>(which)];
  fitting::FitSettings one;
  one.basis = basis_of_entry(named, settings.basis, entry.theory);
  one.loss = settings.loss;
  one.row_scales = entry.scales;
  one.shape = named.shape;
  return with_place(std::string(named.name), [&] {
    return EntryFit{fitting::fit_force_table(entry.table, one, stop), entry.theory};
  });
}

}  // namespace

PairFit fit_pair(const PairTables& tables, const PairFitSettings& settings, const StopToken& stop) {
  const auto& pair = first_of_pair(tables);
  std::map<PairEntry, EntryTable> entries;
  const std::map<MotionKind, PairEntry> diagonal = {{MotionKind::kApproach, PairEntry::kSqueeze},
                                                    {MotionKind::kSlide, PairEntry::kSlide},
                                                    {MotionKind::kRoll, PairEntry::kRoll},
                                                    {MotionKind::kSpin, PairEntry::kSpin}};
  for (const auto& [motion, table] : tables)
    if (const auto which = diagonal.find(motion); which != diagonal.end())
      entries.emplace(which->second, diagonal_entry(pair, table));
  if (tables.contains(MotionKind::kSlide) || tables.contains(MotionKind::kRoll))
    entries.emplace(PairEntry::kSlideRoll, coupling_entry(pair, tables));
  for (std::size_t i = 0; i < pair_entries().size(); ++i) {
    const auto which = static_cast<PairEntry>(i);
    const auto& named = pair_entries()[i];
    const auto table = tables.find(named.motion);
    if (!is_of_motions(which) && table != tables.end() && has_load(named, table->second))
      entries.emplace(which, entry_by_load(named, table->second));
  }

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
