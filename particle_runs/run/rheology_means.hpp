// Means over time of the rheology of a run, with their standard errors.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/suspensions/values/rheology.hpp"

namespace viscontact::particles {

/// The time from the beginning of the means to the end of the case is divided into blocks of equal
/// length, which at a constant rate are blocks of equal strain. The standard error is that of the
/// means of blocks, as if these were independent of each other.
struct RheologyMeans {
  /// Ten blocks of a unit strain or more are nearly independent, and the standard error of their
  /// mean is known to a quarter.
  static constexpr std::size_t kBlocks = 10;

  struct Block {
    double duration = 0;        ///< of the steps in it [T]; 0: the block is empty
    std::vector<double> means;  ///< of numbers_to_average() (rheology_file.hpp)
  };
  std::vector<Block> blocks;

  /// Adds what has lasted for the time from `begin` to `end`; what is before `from` does not count.
  /// `end_of_case` is the end of the last block. All four are [T]. A case that ends at `from` has
  /// one instant, which is its own mean. Numbers that are not finite, of a fluid at rest, are left
  /// out.
  void add(const Rheology& rheology, double begin, double end, double from, double end_of_case);

  std::size_t filled_blocks() const;
  /// Of number `k` of kRheologyMeans; nothing if no time has been added.
  std::optional<double> mean(std::size_t k) const;
  /// Nothing if fewer than two blocks are filled.
  std::optional<double> standard_error(std::size_t k) const;
};

/// The keys of number `k` of kRheologyMeans in run.json, such as "mean_viscosity" and
/// "mean_viscosity_error".
std::string mean_name(std::size_t k);
std::string standard_error_name(std::size_t k);

}  // namespace viscontact::particles
