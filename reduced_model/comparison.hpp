// The distances of trajectories of a sphere near a wall from one of them, the reference. q is the
// gap and u the velocity of a trajectory, q_ref and u_ref are those of the reference.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact::reduced_model {

/// What the comparison finds for the trajectory of one model, in the units of the trajectories.
struct ModelComparison {
  std::string model;            ///< its name
  double minimal_gap = 0;       ///< smallest gap of the rows [L], >= 0
  double minimal_gap_time = 0;  ///< time of the first row with this gap [T]
  /// Film thickness that a contact model computes from the lowest gamma (TrajectoryRow::gamma) [L],
  /// >= 0; nothing if gamma is never < 0 or if the model is not a contact model.
  std::optional<double> film_from_gamma;
  /// First time at which contact begins and last time at which it ends [T], or the times of the
  /// first and last row with gamma < 0 if the trajectory does not state them.
  std::optional<std::array<double, 2>> contact_interval;
  /// The first touch of the solids; nothing if they never touch, or if the model has no solids.
  std::optional<SolidTouch> solid_contact_from{};
  /// When each gap that the case asks for (motion.time_to_gap) is first reached.
  std::vector<GapTime> gap_times{};
  /// Impacts of the sphere on the solid wall, in order of time; only if the case has a restitution.
  std::vector<Rebound> rebounds;
  /// Nothing in a trajectory that Viscontact did not write.
  std::optional<MomentumEnergyBudget> budget;
  double sup_gap_distance = 0;                 ///< max over time of |q - q_ref| [L], >= 0
  double l1_gap_distance = 0;                  ///< integral over time of |q - q_ref| [L T], >= 0
  double l1_velocity_distance = 0;             ///< integral over time of |u - u_ref| [L], >= 0
  std::optional<double> reynolds_number{};     ///< Trajectory::reynolds_number
  std::optional<double> stokes_number{};       ///< Trajectory::stokes_number
  std::optional<double> film_stokes_number{};  ///< Trajectory::film_stokes_number
  long steps = 0;      ///< number of steps of the integrator; 0 if not stated
  double seconds = 0;  ///< computing time on a clock [s]; 0 if not stated
};

/// A model that should have run but failed.
struct ModelWithoutTrajectory {
  std::string model;   ///< its name
  std::string reason;  ///< message of the error with which the model failed
};

/// The comparison of all models with one of them.
struct Comparison {
  std::string reference_model;                          ///< its name
  std::vector<ModelComparison> models;                  ///< in the order of the trajectories
  std::vector<ModelWithoutTrajectory> failed_models{};  ///< empty until the caller fills it in
  std::string units{};  ///< units in words, as the first trajectory says; may be empty
};

/// Compares each trajectory with that of `reference_model` over the times that both cover. Each
/// trajectory counts as linear between its rows, and must have a row. Comparison::failed_models
/// stays empty. Throws Error(kBadInput) if no trajectory has that name, if two have the same name,
/// or if one has no time in common with the reference, and Error(kInterrupted) at a stop.
Comparison compare_trajectories(const std::vector<Trajectory>& trajectories,
                                std::string_view reference_model, const StopToken& stop = {});

/// Reads the comparison file (JSON). Throws Error(kBadInput), which names
/// file and line, if the file is missing or of another form.
Comparison read_comparison(const std::filesystem::path& path);
/// The text of the comparison file (docs/file-formats.md).
std::string write_comparison(const Comparison& comparison);

}  // namespace viscontact::reduced_model
