// All pairs at one arrangement of the spheres: their resistance, the loads of the strain, (9.1),
// and the stresslets, (9.9).
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/setting/pair_lubrication.hpp"
#include "viscontact/suspensions/cell/pair_search.hpp"
#include "viscontact/suspensions/pairs/pair_sizes.hpp"
#include "viscontact/suspensions/pairs/pair_terms.hpp"
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
  /// Returns where pair p is taken.
  using Places = std::function<PlacedPair(std::size_t)>;

  PairSystem(const PairLubrication& lubrication, std::span<const double> radii,
             std::span<const PlacedPair> pairs, ThreadPool& pool);
  PairSystem(const PairLubrication& lubrication, std::span<const double> radii, std::size_t pairs,
             const Places& places, ThreadPool& pool);
  /// Takes the same pairs elsewhere.
  void place(const Places& places);
  /// From now on the loads of the strain and the stresslets are without the squeezes of the pairs
  /// and what the strain adds to them.
  void leave_out_squeezes() { has_squeezes_ = false; }

  const Resistance& resistance() const { return resistance_; }
  Resistance& resistance() { return resistance_; }

  /// Subtracts what the strain E makes the spheres exert on the fluid from `loads`.
  void subtract_strain_loads(const SymmetricTensor& strain, std::span<Motion> loads) const;
  /// Sum of the stresslets [M L^2/T^2] of all spheres that move relative to the flow with
  /// `motions`.
  SymmetricTensor stresslets(std::span<const Motion> motions, const SymmetricTensor& strain) const;

  /// The terms of BalancedTerms for the strain.
  struct StrainTerms {
    double squeeze = 0, turn_first = 0, turn_second = 0;
    double stress_axial = 0, stress_transverse = 0, stress_twofold = 0;
  };
  StrainTerms strain_terms(std::size_t pair) const;
  PairSizes sizes(std::size_t pair) const {
    const auto& row = resistance_.pairs[pair];
    return sizes_of(radii_[static_cast<std::size_t>(row.first)],
                    radii_[static_cast<std::size_t>(row.second)]);
  }

 private:
  TableTerms terms_of(const PairRow& pair) const;
  void add_pair(const PlacedPair& pair, std::size_t p);
  void share_drag();
  StrainTerms strain_loads(std::size_t pair) const;

  PairLubrication lubrication_;
  ThreadPool* pool_;
  std::vector<double> radii_;
  Resistance resistance_;
  // Of tables. Terms near contact are computed anew, which takes 20 ns, because this is needed some
  // times in a step.
  std::vector<StrainTerms> strains_;
  bool has_squeezes_ = true;
  double sphere_stress_ = 0;  // of all spheres alone, over E [M L^2/T]
};

}  // namespace viscontact::suspensions
