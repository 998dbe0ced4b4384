// The linear problem of spheres and pairs in several blocks of loops.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tests/common/random.hpp"
#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/setting/pair_lubrication.hpp"
#include "viscontact/suspensions/pairs/pair_system.hpp"
#include "viscontact/suspensions/pairs/resistance.hpp"
#include "viscontact/suspensions/values/lanes.hpp"

namespace viscontact::suspensions {

/// side x side x side spheres of radius 1 with gaps from 0.01 to 0.17 in a periodic cube. Every
/// third pair is that of a contact that slides, if there are slips.
struct ManyPairs {
  ManyPairs(int side, particles::PairTerms pairs, bool has_slips);
  const Resistance& resistance() const { return system.resistance(); }

  ThreadPool pool{2};  // which has three blocks of 1331 spheres
  PairSystem system;

 private:
  static PairSystem system_of(int side, particles::PairTerms pairs, ThreadPool& pool);
};

/// Components from -1 to 1.
std::vector<Motion> random_motions(std::size_t count, Random& random);
/// The sum of the products of all components.
double product(std::span<const Motion> a, std::span<const Motion> b);
/// The largest difference of components.
double largest_difference(std::span<const Motion> a, std::span<const Motion> b);
bool have_same_bits(std::span<const Motion> a, std::span<const Motion> b);

}  // namespace viscontact::suspensions
