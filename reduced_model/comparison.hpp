// Trajectories side by side: how thin the film gets, when there is contact, how far each is from
// the one taken as reference.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {

struct ModelComparison {
  std::string model;
  double minimal_gap = 0;                       ///< smallest gap among the rows [L]
  double minimal_gap_time = 0;                  ///< of the first such row [T]
  std::optional<double> recovered_minimal_gap;  ///< from gamma, where the model has one [L]
  std::optional<std::array<double, 2>>
      contact_interval;  ///< first landing and last release [T]; of a user's own, first and last row with gamma < 0
  std::optional<MomentumEnergyBudget> books;  ///< impulses and works; not of a user's own
  double sup_gap_distance = 0;                ///< max |q - q_ref| [L]
  double l1_gap_distance = 0;                 ///< int |q - q_ref| dt [L T]
  double l1_velocity_distance = 0;            ///< int |u - u_ref| dt [L]
  long steps = 0;
  double seconds = 0;
};

/// A model that was to be run and failed.
struct ModelWithoutTrajectory {
  std::string model;
  std::string reason;
};

struct Comparison {
  std::string reference_model;
  std::vector<ModelComparison> models;                  ///< in the order of the trajectories
  std::vector<ModelWithoutTrajectory> failed_models{};  ///< left to the caller to fill in
};

/// Compares each trajectory with the one of `reference_model`, over the times that both cover, each
/// linear between its rows. Throws Error(kBadInput) when no trajectory has that name, two have the
/// same, or two have no time in common.
Comparison compare_trajectories(const std::vector<Trajectory>& trajectories,
                                std::string_view reference_model);

/// Reads and writes the comparison file (JSON).
Comparison read_comparison(const std::filesystem::path& path);
std::string write_comparison(const Comparison& comparison);

}  // namespace viscontact
