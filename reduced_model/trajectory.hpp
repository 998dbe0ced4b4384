// A trajectory, as a model computes it and as a file holds it.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/common/optional_double.hpp"
#include "viscontact/reduced_model/momentum_energy_budget.hpp"

namespace viscontact {

/// One instant. Dimensions: [T], [L], [L/T], [M L/T^2], [M L/T^2], [M L/T], [M L/T^2].
struct TrajectoryRow {
  double time = 0;
  double gap = 0;       ///< q, >= 0
  double velocity = 0;  ///< dq/dt
  OptionalDouble lubrication_force{};
  OptionalDouble external_force{};
  OptionalDouble gamma{};        ///< adhesion potential of a contact model, <= 0
  OptionalDouble solid_force{};  ///< of the solids on each other, a contact model's, >= 0
};

/// Raised when the numbers of a model change: trajectories of another revision are made again.
inline constexpr int kModelsRevision = 3;

/// Rows in strictly increasing time, at least one, and what is known of how they were made.
struct Trajectory {
  std::string model;
  std::vector<TrajectoryRow> rows;
  std::optional<double> recovered_minimal_gap;  ///< film thickness that gamma stands for at its
                                                ///< lowest [L]; contact models only
  std::optional<std::array<double, 2>>
      contact_interval;  ///< first landing, last release (or the end) [T]; contact models only
  std::optional<MomentumEnergyBudget> books;  ///< not of a user's own
  long steps = 0;                             ///< of the integrator
  double seconds = 0;                         ///< wall time
  std::map<std::string, std::string>
      provenance;  ///< further "# key: value" lines: fit, case, time step
};

/// Reads a trajectory file, one of ours or a user's own: columns time, gap, velocity are needed.
/// The model's name is that of the "# model:" line, else the file's stem. Throws Error(kBadInput)
/// with file and line for values missing, not finite, a negative gap, or times that do not
/// increase.
Trajectory read_trajectory(const std::filesystem::path& path);

/// The text of the file.
std::string write_trajectory(const Trajectory& trajectory);

}  // namespace viscontact
