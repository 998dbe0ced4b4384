// The resistance R of all spheres in (9.1) as a product with velocities, pair by pair.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/suspensions/lanes.hpp"
#include "viscontact/suspensions/pair_terms.hpp"

namespace viscontact::suspensions {

/// The balanced part of a pair, BalancedTerms.
struct alignas(kLaneAlignment) PairRow {
  Lanes normal{};  ///< from the first to the second sphere
  double squeeze = 0;
  double turn_first = 0, turn_mixed = 0, turn_second = 0, spin = 0;
  double inverse_arm = 0;
  std::int32_t first = 0, second = 0;
};

/// A pair's resistance to its own rigid motions, PairDrag.
struct alignas(kLaneAlignment) DragRow {
  Lanes normal{};
  PairDrag drag;
  std::int32_t first = 0, second = 0;
};

/// Takes the resistance of a contact that slides, (9.16), in the direction of its slip away from
/// that of the pair, which is the same in all directions.
struct alignas(kLaneAlignment) SlipRow {
  Lanes normal{}, direction{};
  double stiffness = 0;
  double arm_first = 0, arm_second = 0;  ///< whose sum is the arm of the pair
  std::int32_t first = 0, second = 0;
};

/// What a sphere resists beside its pairs.
struct SphereDrag {
  double move = 0;  ///< [M/T]
  double turn = 0;  ///< [M L^2/T]
};

struct Resistance {
  std::vector<SphereDrag> spheres;
  std::vector<PairRow> pairs;
  std::vector<DragRow> drags;
  std::vector<SlipRow> slips;

  std::size_t count() const { return spheres.size(); }
  /// loads = R motions.
  void multiply(std::span<const Motion> motions, std::span<Motion> loads) const;
};

inline void add_loads(const PairRow& pair, std::span<const Motion> x, std::span<Motion> y) {
  const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
  const Lanes n = pair.normal;
  const Lanes d = x[j].along - x[i].along;
  const Lanes rotation = pair.inverse_arm * cross(n, d);
  const double spin1 = dot(n, x[i].turn), spin2 = dot(n, x[j].turn);
  const Lanes a = x[i].turn - spin1 * n - rotation, b = x[j].turn - spin2 * n - rotation;
  const Lanes turn1 = pair.turn_first * a + pair.turn_mixed * b;
  const Lanes turn2 = pair.turn_mixed * a + pair.turn_second * b;
  const Lanes along = (pair.squeeze * dot(n, d)) * n + pair.inverse_arm * cross(n, turn1 + turn2);
  const Lanes spin = (pair.spin * (spin2 - spin1)) * n;
  y[i].along -= along;
  y[i].turn += turn1 - spin;
  y[j].along += along;
  y[j].turn += turn2 + spin;
}

inline void add_loads(const DragRow& row, std::span<const Motion> x, std::span<Motion> y) {
  const std::array at{static_cast<std::size_t>(row.first), static_cast<std::size_t>(row.second)};
  const Lanes n = row.normal;
  const auto& drag = row.drag;
  double axial = 0, spin = 0;
  std::array<Lanes, 2> across{}, turned{};
  for (std::size_t s = 0; s < 2; ++s) {
    const Motion& motion = x[at[s]];
    const double along_n = dot(n, motion.along);
    axial += drag.axial[s] * along_n;
    spin += drag.spin[s] * dot(n, motion.turn);
    across[s] = motion.along - along_n * n;
    turned[s] = cross(n, motion.turn);
  }
  std::array<Lanes, 2> modes{};
  for (std::size_t m = 0; m < 2; ++m) {
    const auto& mode = drag.transverse[m];
    modes[m] = mode.move[0] * across[0] + mode.move[1] * across[1] + mode.turn[0] * turned[0] +
               mode.turn[1] * turned[1];
  }
  for (std::size_t s = 0; s < 2; ++s) {
    const auto &one = drag.transverse[0], &two = drag.transverse[1];
    y[at[s]].along += (drag.axial[s] * axial) * n + one.move[s] * modes[0] + two.move[s] * modes[1];
    y[at[s]].turn +=
        (drag.spin[s] * spin) * n - cross(n, one.turn[s] * modes[0] + two.turn[s] * modes[1]);
  }
}

inline void add_loads(const SlipRow& row, std::span<const Motion> x, std::span<Motion> y) {
  const auto i = static_cast<std::size_t>(row.first), j = static_cast<std::size_t>(row.second);
  const Lanes across = cross(row.direction, row.normal);
  const double slip = row.arm_first * dot(row.direction, x[i].turn) +
                      row.arm_second * dot(row.direction, x[j].turn) -
                      dot(across, x[j].along - x[i].along);
  const double load = -row.stiffness * slip;
  y[i].along += load * across;
  y[i].turn += (row.arm_first * load) * row.direction;
  y[j].along -= load * across;
  y[j].turn += (row.arm_second * load) * row.direction;
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
}

}  // namespace viscontact::suspensions
