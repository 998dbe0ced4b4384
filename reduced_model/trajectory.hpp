// A trajectory, which every model of motion returns, and its file. Lengths, masses and times are in
// the units of the case. A change must keep the names of the columns, because published files use
// them.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/common/optional_double.hpp"
#include "viscontact/reduced_model/momentum_energy_budget.hpp"

namespace viscontact::reduced_model {

/// The state of the sphere at one time. Forces are > 0 away from the wall.
struct TrajectoryRow {
  double time = 0;      ///< [T]
  double gap = 0;       ///< q [L], >= 0
  double velocity = 0;  ///< u = dq/dt [L/T]
  /// Force of the fluid on the sphere [M L/T^2].
  OptionalDouble lubrication_force{};
  /// Every other force but that of contact, f_ext [M L/T^2].
  OptionalDouble external_force{};
  /// Adhesion potential [M L/T], <= 0; contact models only.
  OptionalDouble gamma{};
  /// Force of the solid contact on the sphere [M L/T^2], >= 0; contact models only.
  OptionalDouble solid_force{};
};

/// An impact of the sphere on the solids, physics.md (4.12).
struct Rebound {
  double time = 0;               ///< [T]
  double approach_velocity = 0;  ///< where gamma began; of inertial_rough see there [L/T], < 0
  double solid_impulse = 0;  ///< that the solids took up, before they gave a part back [M L/T], > 0
  double velocity = 0;       ///< where the sphere leaves the film [L/T], >= 0; 0: it stays
  double coefficient = 0;    ///< of restitution, velocity/|approach_velocity| [1]
  bool operator==(const Rebound&) const = default;  ///< whether all numbers are equal
};

/// Number of the revision of the models. Raise it when a change makes a model compute other
/// numbers; trajectories of another revision are then computed again.
inline constexpr int kModelsRevision = 4;

/// Rows in strictly increasing time, at least one, and how they were made.
struct Trajectory {
  std::string model;                ///< its name
  std::vector<TrajectoryRow> rows;  ///< in strictly increasing time, at least one
  /// Smallest film thickness [L] that is recovered from gamma; contact models only.
  std::optional<double> recovered_minimal_gap;
  /// First landing and last release (or end of the motion) [T]; contact models only.
  std::optional<std::array<double, 2>> contact_interval;
  /// In order of time; only if the case has a restitution.
  std::vector<Rebound> rebounds;
  /// Nothing in a trajectory that Viscontact did not write.
  std::optional<MomentumEnergyBudget> budget;
  long steps = 0;      ///< number of steps of the integrator
  double seconds = 0;  ///< wall time [s]
  /// Further lines "# key: value" of the file, such as fit, case and time step.
  std::map<std::string, std::string> provenance;
};

/// Reads a trajectory file, which Viscontact or a user wrote. The columns time, gap and velocity
/// are required. The name of the model is that of the line "# model:", or else the file name
/// without its ending. Throws Error(kBadInput) with file and line if a value is missing or not
/// finite, if a gap is negative, or if times do not increase.
Trajectory read_trajectory(const std::filesystem::path& path);

/// The text of the trajectory file (CSV).
std::string write_trajectory(const Trajectory& trajectory);

}  // namespace viscontact::reduced_model
