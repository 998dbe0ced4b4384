// All pairs at one arrangement of the spheres: their resistance, the loads of the strain, (9.1),
// and the stresslets, (9.9).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/setting/pair_lubrication.hpp"
#include "viscontact/suspensions/cell/pair_search.hpp"
#include "viscontact/suspensions/pairs/resistance.hpp"
#include "viscontact/suspensions/values/lanes.hpp"
#include "viscontact/suspensions/values/stress.hpp"

namespace viscontact::suspensions {

using particles::PairLubrication;

/// Where the resistance of a pair is taken.
struct PlacedPair {
  std::int32_t first = 0, second = 0;
  Vector normal{};  ///< from the first to the second sphere
  double gap = 0;   ///< [L], > 0
};

/// Pairs where they are. Gaps below `least_gap` [L], such as rounding errors, count as `least_gap`.
std::vector<PlacedPair> placed(std::span<const NearPair> pairs, std::span<const double> radii,
                               double least_gap);

/// `radii` are those of the spheres and then of the planes, which are infinite.
class PairSystem {
 public:
  PairSystem(const PairLubrication& lubrication, std::span<const double> radii,
             std::span<const PlacedPair> pairs, ThreadPool& pool);

  /// Frees the memory of all pairs. Only assignment may follow.
  void release() {
    resistance_ = {};
    strains_ = {};
    gaps_ = {};
  }

  const Resistance& resistance() const { return resistance_; }
  Resistance& resistance() { return resistance_; }

  /// Subtracts what the strain E makes the spheres exert on the fluid from `loads`.
  void subtract_strain_loads(const SymmetricTensor& strain, std::span<Motion> loads) const;
  /// Sum of the stresslets [M L^2/T^2] of all spheres that move relative to the flow with
  /// `motions`.
  SymmetricTensor stresslets(std::span<const Motion> motions, const SymmetricTensor& strain) const;

  /// The terms of BalancedTerms for the strain; row k belongs to Resistance::pairs[k].
  struct StrainRow {
    double squeeze = 0, turn_first = 0, turn_second = 0;
    double stress_axial = 0, stress_transverse = 0, stress_twofold = 0;
    double radii = 0;  ///< PairSizes::touching
  };
  double gap_of(std::size_t pair) const { return gaps_[pair]; }  ///< PlacedPair::gap
  std::vector<StrainRow>& strains() { return strains_; }
  const std::vector<StrainRow>& strains() const { return strains_; }

 private:
  void add_pair(std::span<const double> radii, const PlacedPair& pair, std::size_t p);
  void share_drag(std::span<const double> radii, std::span<const PlacedPair> pairs);

  PairLubrication lubrication_;
  ThreadPool* pool_;
  Resistance resistance_;
  std::vector<StrainRow> strains_;
  std::vector<double> gaps_;
  double sphere_stress_ = 0;  // of all spheres alone, over E [M L^2/T]
};

}  // namespace viscontact::suspensions
