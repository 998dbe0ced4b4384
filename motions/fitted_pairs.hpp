// Own fits of pairs in place of the shipped tables, at the ratios of radii and the gaps that they
// have.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "viscontact/lubrication/pairs/pair_resistances.hpp"
#include "viscontact/lubrication/terms.hpp"
#include "viscontact/motions/pair_fit.hpp"

namespace viscontact::motions {

class FittedPairs : public lubrication::PairResistances {
 public:
  /// Throws Error(kBadInput) for a neighbour that is no plane and no sphere at rest, for a second
  /// fit of a pair, and for two spheres unless all loads on both are there, in two fits if their
  /// radii differ: their entries nearly cancel in a common motion.
  explicit FittedPairs(std::span<const PairFit> fits);

  /// Radii are those of a fit if their ratio is that of its pair to 1e-6. Outside of the gaps of
  /// the fit it is pair_resistance().
  lubrication::PairMatrix resistance(double radius1, double radius2, double gap,
                                     double viscosity) const override;

 private:
  struct Entry {
    std::size_t place = 0;                                    // row in the table of places
    int power = 1;                                            // NamedEntry::power
    std::vector<std::pair<double, lubrication::Term>> terms;  // with their coefficients
  };
  struct Pair {
    double neighbour = 0;  // its radius over that of the sphere, infinite for a plane
    double viscosity = 0, radius = 0;
    std::array<double, 2> gap_interval{};  // in radii of the sphere
    std::vector<Entry> entries;
    bool has_gap(double gap_over_radius) const;
    // Puts the loads by motions of sphere 2, which is the sphere of the fit.
    void put(double radius, double gap, double viscosity, lubrication::PairMatrix& matrix) const;
  };
  const Pair* find(double neighbour) const;
  std::vector<Pair> pairs_;
};

/// The path itself if it is a file, or the files *.json of a folder in order of name. Throws
/// Error(kBadInput) if there are none.
std::vector<std::filesystem::path> fit_files_in(const std::filesystem::path& path);

/// Reads such files. A fit of the squeezing force alone has the entry `squeeze`.
FittedPairs read_fitted_pairs(std::span<const std::filesystem::path> files);

}  // namespace viscontact::motions
