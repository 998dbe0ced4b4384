// The trajectory of one sphere near a wall as a model computes it: its rows, its budget of momentum
// and energy, and its CSV file. Numbers are in the units of the case.
#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/reduced_model/gap_time.hpp"

namespace viscontact::reduced_model {

struct Motion;

/// Like std::optional<double>, but no larger than a double, because millions of rows store several.
/// NaN stands for a missing value, so that -ffast-math, which ignores NaN, must not be used.
class OptionalDouble {
 public:
  constexpr OptionalDouble() = default;  ///< a missing value
  /// NaN becomes a missing value.
  // The conversion is implicit, as in std::optional.
  // NOLINTNEXTLINE(google-explicit-constructor)
  constexpr OptionalDouble(double value) : value_(value) {}

  bool has_value() const { return !std::isnan(value_); }  ///< false if the value is missing
  explicit operator bool() const { return has_value(); }  ///< has_value()
  /// The value, which must not be missing.
  double operator*() const {
    assert(has_value());
    return value_;
  }
  double value() const { return **this; }  ///< operator*

  /// Two missing values are equal.
  friend bool operator==(const OptionalDouble& a, const OptionalDouble& b) {
    return a.value_ == b.value_ || (!a && !b);
  }

 private:
  double value_ = std::numeric_limits<double>::quiet_NaN();
};

/// Impulses on the sphere along the outward normal [M L/T] and works done on it [M L^2/T^2], from
/// the start of the motion to its end:
///
///     m u(end) - m v0              = sum of the impulses,
///     m u(end)^2/2 - m v0^2/2      = sum of the works,
///
/// with the mass m, the velocity u and its value v0 at the start. The left sides are 0 for a model
/// without inertia. Contact models add up the impulses and works of each step. In the other models
/// film_impulse and film_work are those of the whole drag. There film_impulse is the change of
/// momentum minus the impulses of the other forces; film_work is a sum over the rows, with an error
/// of second order in their spacing, and external_work is set so that the works are balanced. In
/// inertial_rough external_work is the sum over the rows, and film_work balances the works.
struct MomentumEnergyBudget {
  double external_impulse = 0;  ///< of the external force
  /// Minus the change of gamma in contact models, else the impulse of the whole drag.
  double film_impulse = 0;
  double drag_impulse = 0;   ///< of the resolved drag, contact models only
  double solid_impulse = 0;  ///< of the solid contact, >= 0
  double external_work = 0;  ///< of the external force
  double film_work = 0;      ///< of the film
  double drag_work = 0;      ///< of the resolved drag, <= 0
  double solid_work = 0;     ///< of the solid contact, <= 0
};

/// An entry of the budget.
struct BudgetEntry {
  std::string_view name;                ///< column or key
  double MomentumEnergyBudget::*value;  ///< member
};
/// In the order in which files list them.
inline constexpr std::array kBudgetEntries = {
    BudgetEntry{"external_impulse", &MomentumEnergyBudget::external_impulse},
    BudgetEntry{"film_impulse", &MomentumEnergyBudget::film_impulse},
    BudgetEntry{"drag_impulse", &MomentumEnergyBudget::drag_impulse},
    BudgetEntry{"solid_impulse", &MomentumEnergyBudget::solid_impulse},
    BudgetEntry{"external_work", &MomentumEnergyBudget::external_work},
    BudgetEntry{"film_work", &MomentumEnergyBudget::film_work},
    BudgetEntry{"drag_work", &MomentumEnergyBudget::drag_work},
    BudgetEntry{"solid_work", &MomentumEnergyBudget::solid_work}};

/// The state of the sphere at one time. A force is > 0 if it points away from the wall.
struct TrajectoryRow {
  double time = 0;      ///< [T]
  double gap = 0;       ///< q [L], >= 0
  double velocity = 0;  ///< u = dq/dt [L/T]
  /// Force of the fluid [M L/T^2]; in contact models that of the film and of the resolved drag.
  OptionalDouble lubrication_force{};
  /// f_ext [M L/T^2]: all forces except those of the fluid and of the solids.
  OptionalDouble external_force{};
  /// The memory of the film, minus the impulse that the film has absorbed [M L/T], <= 0; contact
  /// models only.
  OptionalDouble gamma{};
  /// Force of the solid contact [M L/T^2], >= 0; models with solid contact only.
  OptionalDouble solid_force{};
};

/// An impact of the sphere on the solid wall (physics.md (4.12)).
struct Rebound {
  double time = 0;  ///< [T]
  /// Velocity before the film acts [L/T], < 0; in the model inertial_rough the largest one since
  /// the last rebound.
  double approach_velocity = 0;
  /// Impulse that the solids took up before they gave a part back [M L/T], > 0.
  double solid_impulse = 0;
  /// Velocity at which the sphere leaves the film [L/T], >= 0; 0: the sphere stays in contact.
  double velocity = 0;
  double coefficient = 0;  ///< of restitution, velocity/|approach_velocity| [1], >= 0
  bool operator==(const Rebound&) const = default;  ///< exact
};

/// When the solids touch for the first time.
struct SolidTouch {
  double time = 0;  ///< [T]
  /// Rate just before this time [L/T], <= 0: that of the gap, or in contact models that of the film
  /// thickness that gamma stands for.
  double velocity = 0;
  bool operator==(const SolidTouch&) const = default;  ///< exact
};

/// Raise it when a change makes a model compute other numbers or record more of them. A run
/// computes a stored trajectory again if the number in its head differs from this one.
inline constexpr int kModelsRevision = 6;

/// Rows of a motion, and how they were made.
struct Trajectory {
  std::string model;                ///< name of the model, such as inertial
  std::vector<TrajectoryRow> rows;  ///< in strictly increasing time, at least one
  /// Smallest film thickness [L], >= 0, that gamma stands for; nothing if gamma is never < 0.
  /// Contact models only.
  std::optional<double> film_from_gamma;
  /// Beginning of the first contact, and end of the last one or of a motion that ends in contact
  /// [T]; nothing if there is no contact. Contact models only.
  std::optional<std::array<double, 2>> contact_interval;
  /// The first touch of the solids; nothing if they never touch or if the model has no solids.
  std::optional<SolidTouch> solid_contact_from{};
  /// For each gap of Motion::gaps_to_reach, when it is first reached.
  std::vector<GapTime> gap_times{};
  /// Impacts on the solids in order of time; only if the case has a restitution.
  std::vector<Rebound> rebounds;
  /// The largest Reynolds number 2 r rho_f |u|/mu of the rows; nothing if the density of the fluid
  /// is not known, or the model has no fluid.
  std::optional<double> reynolds_number{};
  /// The largest Stokes number m |u|/(6 pi mu r^2) of the rows; nothing if the model has no fluid.
  std::optional<double> stokes_number{};
  /// The largest m |u| of the rows over the impulse that the film has absorbed, |gamma|; nothing if
  /// there was no contact with a film, or if the model resolves the drag before contact.
  std::optional<double> film_stokes_number{};
  /// Nothing if the file of the trajectory has no line of it.
  std::optional<MomentumEnergyBudget> budget;
  long steps = 0;      ///< number of steps of the integrator, >= 0; 0 if not stated
  double seconds = 0;  ///< computing time on a clock [s]; 0 if not stated
  /// Further lines "# key: value" of the file, such as fit, case and time step.
  std::map<std::string, std::string> provenance;
};

/// Reads a trajectory file, which Viscontact or a user wrote. The columns time, gap and velocity
/// are required; further columns are ignored. The name of the model is that of the line "# model:",
/// or else the file name without its ending. Throws Error(kBadInput), with the file and, for a
/// fault of a row, its line, if the file cannot be read or was cut short, a required column or
/// value is missing, a number is not finite, a gap is negative, times do not increase, there is no
/// row, or the head has a number that is not finite, a `steps` outside 0 to 1e15, or `rebounds`
/// that are not five numbers each.
Trajectory read_trajectory(const std::filesystem::path& path);

/// The text of the trajectory file (CSV, docs/file-formats.md).
std::string write_trajectory(const Trajectory& trajectory);

/// If the motion ended before `motion.end_time` because the sphere reached the wall opposite, at
/// the gap `largest_gap` [L], a sentence that says so; otherwise nothing.
std::optional<std::string> reached_wall(const Trajectory& trajectory, const Motion& motion,
                                        double largest_gap);

/// Warnings of Reynolds and Stokes numbers at which Stokes flow or viscous contact do not hold
/// (lubrication/regime.hpp).
std::vector<std::string> regime_warnings(const std::vector<Trajectory>& trajectories);

/// About `count` >= 2 of the rows, in their order; all rows if there are at most `count`. The
/// result has the first row at or after each of `count` equidistant times, and the rows that a
/// comparison needs: the first, the last, the first with the smallest gap, with the largest gap and
/// with the lowest gamma, and the two rows around each instant at which contact (gamma < 0) or
/// solid contact (solid_force > 0) begins or ends. If there are more than `count` such instants,
/// only the rows around the first and the last of them are kept.
std::vector<TrajectoryRow> fewer_rows(const std::vector<TrajectoryRow>& rows, int count);

}  // namespace viscontact::reduced_model
