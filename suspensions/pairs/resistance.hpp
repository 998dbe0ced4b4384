// The resistance R of all spheres in (9.1) as a product with velocities, pair by pair.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "viscontact/suspensions/pairs/pair_terms.hpp"
#include "viscontact/suspensions/pairs/row_blocks.hpp"
#include "viscontact/suspensions/values/lanes.hpp"

namespace viscontact::suspensions {

/// The balanced part of a pair, BalancedTerms.
struct PairRow {
  Packed normal;  ///< from the first to the second sphere; loads_of() reads it here
  double squeeze = 0;
  double turn_first = 0, turn_mixed = 0, turn_second = 0, spin = 0;
  double inverse_arm = 0;
  double gap = 0;  ///< at which the terms are taken [L]
  std::int32_t first = 0, second = 0;
};

/// A pair's resistance to its own rigid motions, PairDrag.
struct DragRow {
  Packed normal;
  PairDrag drag;
  std::int32_t first = 0, second = 0;
};

/// Takes the resistance of a contact that slides, (9.16), in the direction of its slip away from
/// that of the pair, which is the same in all directions.
struct SlipRow {
  Packed normal, direction;
  double stiffness = 0;
  double arm_first = 0, arm_second = 0;  ///< whose sum is the arm of the pair
  std::int32_t first = 0, second = 0;
};

/// What a sphere resists beside its pairs.
struct SphereDrag {
  double move = 0;  ///< [M/T]
  double turn = 0;  ///< [M L^2/T]
};

/// One more unknown, the rate of the flow, as component 0 of the turn of an entry that follows
/// those of the spheres. SphereDrag::turn of this entry is what the rate resists to itself, and
/// nothing moves its other components.
struct RateRow {
  std::vector<Motion> loads;  ///< of the spheres at rate 1
};

struct Resistance {
  std::vector<SphereDrag> spheres;
  std::vector<PairRow> pairs;
  std::vector<DragRow> drags;
  std::vector<SlipRow> slips;
  RowBlocks blocks;  ///< of pairs, and of drags, which are those of the same pairs
  /// Bodies at the end of `spheres` that always move with the flow, the planes. Their loads count
  /// as 0, and no linear problem moves them.
  std::size_t fixed = 0;
  RateRow rate;  ///< without loads: the rate is not among the unknowns

  std::size_t count() const { return spheres.size(); }
  std::size_t free_count() const { return spheres.size() - fixed; }
  /// loads = R motions.
  void multiply(std::span<const Motion> motions, std::span<Motion> loads) const;
};

/// The same product by several threads, with the same bits for any number of them.
class ResistanceProduct {
 public:
  /// The rows of `resistance`, which are in order of their first spheres, may change their numbers,
  /// but neither pairs nor slips.
  ResistanceProduct(const Resistance& resistance, ThreadPool& pool);
  /// loads = R motions. Returns motions.(loads).
  double multiply(std::span<const Motion> motions, std::span<Motion> loads) const;

 private:
  const Resistance* resistance_;
  ThreadPool* pool_;
  RowBlocks slips_;
};

/// The loads of both spheres of a row.
struct RowLoads {
  Motion first, second;
};

inline RowLoads loads_of(const PairRow& pair, const Motion& x1, const Motion& x2) {
  // One load takes less time than three.
  static_assert(std::is_trivially_copyable_v<PairRow>);
  Lanes n;
  std::memcpy(&n, &pair, sizeof n);
  n = first_three(n);
  const Lanes d = x2.along - x1.along;
  const Lanes rotation = pair.inverse_arm * cross(n, d);
  const Lanes spin1 = dots(n, x1.turn), spin2 = dots(n, x2.turn);
  const Lanes a = x1.turn - spin1 * n - rotation, b = x2.turn - spin2 * n - rotation;
  const Lanes turn1 = pair.turn_first * a + pair.turn_mixed * b;
  const Lanes turn2 = pair.turn_mixed * a + pair.turn_second * b;
  const Lanes along = (pair.squeeze * dots(n, d)) * n + pair.inverse_arm * cross(n, turn1 + turn2);
  const Lanes spin = (pair.spin * (spin2 - spin1)) * n;
  return {{-along, turn1 - spin}, {along, turn2 + spin}};
}

inline RowLoads loads_of(const DragRow& row, const Motion& x1, const Motion& x2) {
  const std::array<const Motion*, 2> x{&x1, &x2};
  const Lanes n = row.normal;
  const auto& drag = row.drag;
  Lanes axial{}, spin{};
  std::array<Lanes, 2> across{}, turned{};
  for (std::size_t s = 0; s < 2; ++s) {
    const Motion& motion = *x[s];
    const Lanes along_n = dots(n, motion.along);
    axial += drag.axial[s] * along_n;
    spin += drag.spin[s] * dots(n, motion.turn);
    across[s] = motion.along - along_n * n;
    turned[s] = cross(n, motion.turn);
  }
  std::array<Lanes, 2> modes{};
  for (std::size_t m = 0; m < 2; ++m) {
    const auto& mode = drag.transverse[m];
    modes[m] = mode.move[0] * across[0] + mode.move[1] * across[1] + mode.turn[0] * turned[0] +
               mode.turn[1] * turned[1];
  }
  const auto load = [&](std::size_t s) {
    const auto &one = drag.transverse[0], &two = drag.transverse[1];
    return Motion{
        (drag.axial[s] * axial) * n + one.move[s] * modes[0] + two.move[s] * modes[1],
        (drag.spin[s] * spin) * n - cross(n, one.turn[s] * modes[0] + two.turn[s] * modes[1])};
  };
  return {load(0), load(1)};
}

inline RowLoads loads_of(const SlipRow& row, const Motion& x1, const Motion& x2) {
  const Lanes direction = row.direction, across = cross(direction, row.normal);
  const double slip = row.arm_first * dot(direction, x1.turn) +
                      row.arm_second * dot(direction, x2.turn) - dot(across, x2.along - x1.along);
  const double load = -row.stiffness * slip;
  return {{load * across, (row.arm_first * load) * direction},
          {-load * across, (row.arm_second * load) * direction}};
}

inline void add(const Motion& load, Motion& sum) {
  sum.along += load.along;
  sum.turn += load.turn;
}

template <class Row>
void add_loads(const Row& row, std::span<const Motion> x, std::span<Motion> y) {
  const auto i = static_cast<std::size_t>(row.first), j = static_cast<std::size_t>(row.second);
  const auto loads = loads_of(row, x[i], x[j]);
  add(loads.first, y[i]);
  add(loads.second, y[j]);
}

inline void add_loads(const RateRow& row, std::span<const Motion> x, std::span<Motion> y) {
  const std::size_t count = row.loads.size();
  const double rate = x[count].turn[0];
  Lanes sum{};
  for (std::size_t k = 0; k < count; ++k) {
    y[k].along += rate * row.loads[k].along;
    y[k].turn += rate * row.loads[k].turn;
    sum += row.loads[k].along * x[k].along + row.loads[k].turn * x[k].turn;
  }
  y[count].turn[0] += sum[0] + sum[1] + sum[2];
}

inline void multiply_in_place(const Resistance& resistance, std::span<const Motion> x,
                              std::span<Motion> y) {
  assert(x.size() == resistance.count() && y.size() == resistance.count());
  for (std::size_t k = 0; k < x.size(); ++k) {
    y[k].along = resistance.spheres[k].move * x[k].along;
    y[k].turn = resistance.spheres[k].turn * x[k].turn;
  }
  for (const auto& pair : resistance.pairs) add_loads(pair, x, y);
  for (const auto& row : resistance.drags) add_loads(row, x, y);
  for (const auto& row : resistance.slips) add_loads(row, x, y);
  for (std::size_t k = resistance.free_count(); k < y.size(); ++k) y[k] = {};
  if (!resistance.rate.loads.empty()) add_loads(resistance.rate, x, y);
}

}  // namespace viscontact::suspensions
