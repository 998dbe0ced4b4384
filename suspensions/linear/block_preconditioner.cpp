// Blocks of spheres, and incomplete Cholesky factors of the squeezes of strong pairs.
#include "viscontact/suspensions/linear/block_preconditioner.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

#include "viscontact/common/index.hpp"
#include "viscontact/contact_solver/methods/fastest_instructions.hpp"

namespace viscontact::suspensions {
namespace {

using contact_solver::by_fastest_instructions;

struct FactorTuning {
  // The part of the change of a block by an earlier node that is left out for each pair that the
  // factors do not have. Without it a block in a thousand loses its sign, and the factors their
  // use.
  static constexpr double kCompensation = 0.05;
  // A block that earlier nodes have made smaller than this part of it is taken as without them.
  static constexpr double kLeastPivot = 1e-3;
};

using Symmetric = std::array<double, 6>;

inline Lanes product(const Symmetric& m, const Lanes& a) {
  // Few shuffles, which take most of the time.
  const Lanes xx_xy_xz_yy = four_at(m.data()), xz_yy_yz_zz = four_at(m.data() + 2);
  const Lanes xy_yy_yz = __builtin_shufflevector(
      __builtin_shufflevector(xx_xy_xz_yy, xx_xy_xz_yy, 1, 3, 3, 3), xz_yy_yz_zz, 0, 1, 6, 7);
  const Lanes xz_yz_zz = __builtin_shufflevector(xz_yy_yz_zz, xz_yy_yz_zz, 0, 2, 3, 3);
  return first_three(xx_xy_xz_yy * __builtin_shufflevector(a, a, 0, 0, 0, 0) +
                     xy_yy_yz * __builtin_shufflevector(a, a, 1, 1, 1, 1) +
                     xz_yz_zz * __builtin_shufflevector(a, a, 2, 2, 2, 2));
}

inline void add_dyad(double factor, const Lanes& n, Symmetric& m) {
  const Lanes scaled = factor * n;
  m[0] += scaled[0] * n[0];
  m[1] += scaled[0] * n[1];
  m[2] += scaled[0] * n[2];
  m[3] += scaled[1] * n[1];
  m[4] += scaled[1] * n[2];
  m[5] += scaled[2] * n[2];
}

/// Adds what resists along n and across n.
inline void add(const Lanes& n, double along, double across, Symmetric& m) {
  add_dyad(along - across, n, m);
  for (const std::size_t diagonal : {0U, 3U, 5U}) m[diagonal] += across;
}

/// The factors L D L^T of a symmetric matrix, which keep more digits of its inverse than cofactors
/// where one direction is stiff.
struct SymmetricFactors {
  double d1, d2, d3, l21, l31, l32;
  explicit SymmetricFactors(const Symmetric& m)
      : d1(m[0]),
        d2(m[3] - m[1] * m[1] / d1),
        d3(0),
        l21(m[1] / d1),
        l31(m[2] / d1),
        l32((m[4] - l31 * m[1]) / d2) {
    d3 = m[5] - l31 * m[2] - l32 * l32 * d2;
  }
  Symmetric inverse() const {
    const double i31 = l21 * l32 - l31, i1 = 1 / d1, i2 = 1 / d2, i3 = 1 / d3;
    return {i1 + i2 * l21 * l21 + i3 * i31 * i31,
            -i2 * l21 - i3 * i31 * l32,
            i3 * i31,
            i2 + i3 * l32 * l32,
            -i3 * l32,
            i3};
  }
};

inline Symmetric inverse_of(const Symmetric& m) { return SymmetricFactors(m).inverse(); }

/// The force on all spheres over their common velocity.
Symmetric common_block(const Resistance& resistance, ThreadPool& pool) {
  struct Block {
    Symmetric sum{};
    Block& operator+=(const Block& other) {
      for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += other.sum[c];
      return *this;
    }
  };
  const auto sum_of = [&](const auto& rows, const auto& add_row) {
    return pool.sum_of_blocks<Block>(
        rows.size(),
        [&](std::size_t begin, std::size_t end) {
          Block part;
          for (std::size_t r = begin; r < end; ++r) add_row(rows[r], part.sum);
          return part;
        },
        kPairsInBlock);
  };
  auto block = sum_of(resistance.spheres, [](const SphereDrag& sphere, Symmetric& sum) {
    for (const std::size_t diagonal : {0U, 3U, 5U}) sum[diagonal] += sphere.move;
  });
  block += sum_of(resistance.drags, [](const DragRow& row, Symmetric& sum) {
    const auto square = [](double a) { return a * a; };
    double across = 0;
    for (const auto& mode : row.drag.transverse) across += square(mode.move[0] + mode.move[1]);
    add(row.normal, square(row.drag.axial[0] + row.drag.axial[1]), across, sum);
  });
  if (resistance.fixed == 0) return block.sum;
  block += sum_of(resistance.pairs, [&](const PairRow& pair, Symmetric& sum) {
    if (index_of(pair.second) < resistance.free_count()) return;
    const double across = pair.turn_first + 2 * pair.turn_mixed + pair.turn_second;
    add(pair.normal, pair.squeeze, across * pair.inverse_arm * pair.inverse_arm, sum);
  });
  return block.sum;
}

}  // namespace

inline Lanes BlockPreconditioner::force_by(std::size_t node, const Lanes& turn) const {
  const Lanes force = cross(four_at(nodes_[node].mixed.data()), turn);
  if (slipping_.empty()) return force;
  const auto& s = slipping_[node];
  return force + Lanes{s[0], s[1], s[2], 0} * turn[0] + Lanes{s[3], s[4], s[5], 0} * turn[1] +
         Lanes{s[6], s[7], s[8], 0} * turn[2];
}

inline Lanes BlockPreconditioner::torque_by(std::size_t node, const Lanes& move) const {
  const Lanes torque = cross(move, four_at(nodes_[node].mixed.data()));
  if (slipping_.empty()) return torque;
  const auto& s = slipping_[node];
  return torque + Lanes{s[0], s[3], s[6], 0} * move[0] + Lanes{s[1], s[4], s[7], 0} * move[1] +
         Lanes{s[2], s[5], s[8], 0} * move[2];
}

std::vector<std::int32_t> BlockPreconditioner::add_blocks(const Resistance& resistance,
                                                          ThreadPool& pool) {
  const std::size_t count = nodes_.size();
  std::vector<std::int32_t> node_of(count);
  pool.for_blocks(
      count,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
          const auto k = index_of(strong_.spheres[t]);
          node_of[k] = static_cast<std::int32_t>(t);
          const auto& [move, turn] = resistance.spheres[k];
          nodes_[t] = {{move, 0, 0, move, 0, move}, {turn, 0, 0, turn, 0, turn}, {}};
        }
      },
      kPairsInBlock);
  // Calls add_to(row, node, whether its sphere is the first one).
  const auto add_rows = [&](const auto& rows, const RowBlocks& blocks, const auto& add_to) {
    add_by_blocks(blocks, rows, pool, [&](std::size_t r, bool to_first, bool to_second) {
      const auto i = index_of(rows[r].first), j = index_of(rows[r].second);
      if (to_first) add_to(rows[r], index_of(node_of[i]), true);
      if (to_second && j < count) add_to(rows[r], index_of(node_of[j]), false);
    });
  };
  const auto add_mixed = [](double factor, const Lanes& n, Node& node) {
    for (int d = 0; d < 3; ++d) node.mixed[static_cast<std::size_t>(d)] += factor * n[d];
  };
  add_rows(resistance.pairs, resistance.blocks,
           [&](const PairRow& pair, std::size_t t, bool is_first) {
             const double first = pair.turn_first + pair.turn_mixed,
                          second = pair.turn_mixed + pair.turn_second;
             const double across = (first + second) * pair.inverse_arm * pair.inverse_arm;
             auto& node = nodes_[t];
             add(pair.normal, pair.squeeze, across, node.move);
             add(pair.normal, pair.spin, is_first ? pair.turn_first : pair.turn_second, node.turn);
             add_mixed((is_first ? -first : second) * pair.inverse_arm, pair.normal, node);
           });
  if (!resistance.drags.empty())
    add_rows(resistance.drags, resistance.blocks,
             [&](const DragRow& row, std::size_t t, bool is_first) {
               const std::size_t s = is_first ? 0 : 1;
               double across = 0, turn = 0, mixed = 0;
               for (const auto& mode : row.drag.transverse) {
                 across += mode.move[s] * mode.move[s];
                 turn += mode.turn[s] * mode.turn[s];
                 mixed += mode.move[s] * mode.turn[s];
               }
               auto& node = nodes_[t];
               add(row.normal, row.drag.axial[s] * row.drag.axial[s], across, node.move);
               add(row.normal, row.drag.spin[s] * row.drag.spin[s], turn, node.turn);
               add_mixed(mixed, row.normal, node);
             });
  slipping_.clear();
  if (resistance.slips.empty()) return node_of;
  slipping_.resize(count);
  // A slip takes away.
  add_rows(resistance.slips,
           RowBlocks(resistance.blocks.spheres(), resistance.slips, resistance.blocks.threads()),
           [&](const SlipRow& row, std::size_t t, bool is_first) {
             const Lanes direction = row.direction, across = cross(direction, row.normal);
             const double arm = is_first ? row.arm_first : row.arm_second;
             add_dyad(-row.stiffness, across, nodes_[t].move);
             add_dyad(-row.stiffness * arm * arm, direction, nodes_[t].turn);
             const Lanes mixed = (row.stiffness * (is_first ? -arm : arm)) * across;
             for (int c = 0; c < 3; ++c)
               for (int d = 0; d < 3; ++d)
                 slipping_[t][static_cast<std::size_t>(3 * c + d)] += direction[c] * mixed[d];
           });
  return node_of;
}

void BlockPreconditioner::eliminate_turns(std::size_t t) {
  auto& node = nodes_[t];
  node.turn = inverse_of(node.turn);
  std::array<Lanes, 3> columns{};
  for (int c = 0; c < 3; ++c) {
    Lanes unit{};
    unit[c] = 1;
    columns[static_cast<std::size_t>(c)] = force_by(t, product(node.turn, torque_by(t, unit)));
  }
  node.move[0] -= columns[0][0];
  node.move[1] -= columns[0][1];
  node.move[2] -= columns[0][2];
  node.move[3] -= columns[1][1];
  node.move[4] -= columns[1][2];
  node.move[5] -= columns[2][2];
}

void BlockPreconditioner::set(const Resistance& resistance, ThreadPool& pool) {
  if (strong_.stages.empty()) strong_ = StrongPairs(resistance, pool);
  const std::size_t count = resistance.free_count();
  assert(strong_.spheres.size() == count);
  nodes_.resize(count);
  roots_.resize(strong_.pairs.size());
  const auto node_of = add_blocks(resistance, pool);
  pool.for_blocks(
      roots_.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e) {
          const auto& row = resistance.pairs[strong_.pairs[e].row];
          const double root = std::sqrt(std::max(row.squeeze, 0.0));
          roots_[e].along = root * lanes_of(row.normal);
        }
      },
      kPairsInBlock);
  const auto factor_node = [&](std::size_t t) {
    eliminate_turns(t);
    auto& node = nodes_[t];
    Symmetric reduced = node.move;
    for (std::size_t e = strong_.with_earlier_begin[t]; e < strong_.with_earlier_begin[t + 1];
         ++e) {
      const auto pair = strong_.with_earlier[e];
      const auto from = index_of(node_of[index_of(strong_.pairs[pair].earlier)]);
      const auto left_out = strong_.pairs_begin[from + 1] - strong_.pairs_begin[from] - 1;
      const Lanes root = roots_[pair].along;
      const double part = std::max(1 - FactorTuning::kCompensation * left_out, 0.0);
      add_dyad(-part * dot(root, product(nodes_[from].move, root)), root, reduced);
    }
    const SymmetricFactors factors(reduced), whole(node.move);
    const bool is_positive = factors.d1 > FactorTuning::kLeastPivot * whole.d1 &&
                             factors.d2 > FactorTuning::kLeastPivot * whole.d2 &&
                             factors.d3 > FactorTuning::kLeastPivot * whole.d3;
    node.move = (is_positive ? factors : whole).inverse();
  };
  for (std::size_t stage = 0; stage + 1 < strong_.stages.size(); ++stage) {
    const std::uint32_t* chunks = strong_.chunks.data() + strong_.stages[stage];
    pool.for_blocks(
        strong_.stages[stage + 1] - strong_.stages[stage],
        [&](std::size_t begin, std::size_t end) {
          by_fastest_instructions([&] {
            for (std::size_t t = chunks[begin]; t < chunks[end]; ++t) factor_node(t);
            return 0;
          });
        },
        1);
  }
  translation_ = inverse_of(common_block(resistance, pool));
}

double BlockPreconditioner::subtract_and_solve(double length, std::span<Motion> loads,
                                               std::span<Motion> motions, ThreadPool& pool) const {
  struct Force {
    // No Lanes, which code for other processors would return otherwise.
    std::array<double, 3> sum{};
    Force& operator+=(const Force& other) {
      for (std::size_t d = 0; d < 3; ++d) sum[d] += other.sum[d];
      return *this;
    }
  };
  constexpr std::size_t kAhead = BlockTuning::kAhead;
  const auto& strong = strong_;
  // Calls body(t, sphere, sum) for the nodes t of a stage, the first or the last one of a chunk
  // first.
  const auto sum_of_stage = [&]<class Sum>(std::size_t stage, bool is_forward, Sum,
                                           const auto& body) {
    const std::uint32_t* chunks = strong.chunks.data() + strong.stages[stage];
    return pool.sum_of_blocks<Sum>(
        strong.stages[stage + 1] - strong.stages[stage],
        [&](std::size_t begin, std::size_t end) {
          return by_fastest_instructions([&] {
            Lanes sum{};
            const std::size_t first = chunks[begin], last = chunks[end] - 1;
            for (std::size_t n = 0; n <= last - first; ++n) {
              const std::size_t t = is_forward ? first + n : last - n;
              if (n + kAhead <= last - first) {
                const auto k = index_of(strong.spheres[is_forward ? t + kAhead : t - kAhead]);
                prefetch(loads[k]);
                prefetch(motions[k]);
              }
              body(t, index_of(strong.spheres[t]), sum);
            }
            if constexpr (std::is_same_v<Sum, Force>)
              return Force{{sum[0], sum[1], sum[2]}};
            else
              return sum[0] + sum[1] + sum[2];
          });
        },
        1);
  };
  Force force;
  const std::size_t stages = strong.stages.size() - 1;
  for (std::size_t stage = 0; stage < stages; ++stage)
    force += sum_of_stage(stage, true, Force{}, [&](std::size_t t, std::size_t k, Lanes& sum) {
      auto &load = loads[k], &motion = motions[k];
      load.along -= length * motion.along;
      load.turn -= length * motion.turn;
      sum += load.along;
      motion.turn = product(nodes_[t].turn, load.turn);
      Lanes along = load.along - force_by(t, motion.turn);
      for (std::size_t e = strong.with_earlier_begin[t]; e < strong.with_earlier_begin[t + 1];
           ++e) {
        const auto pair = strong.with_earlier[e];
        if (e + 2 * kAhead < strong.with_earlier.size()) {
          const auto ahead = strong.with_earlier[e + 2 * kAhead];
          prefetch(strong.pairs[ahead]);
          prefetch(roots_[ahead]);
        }
        const Lanes root = roots_[pair].along;
        along += dots(root, motions[index_of(strong.pairs[pair].earlier)].along) * root;
      }
      motion.along = product(nodes_[t].move, along);
    });
  const Lanes translation = product(translation_, lanes_of(force.sum));
  double power = 0;
  for (std::size_t stage = stages; stage-- > 0;)
    power += sum_of_stage(stage, false, 0.0, [&](std::size_t t, std::size_t k, Lanes& sum) {
      const auto& load = loads[k];
      auto& motion = motions[k];
      const auto begin = strong.pairs_begin[t], end = strong.pairs_begin[t + 1];
      if (begin != end) {
        Lanes along{};
        for (std::size_t e = begin; e < end; ++e) {
          const Lanes root = roots_[e].along;
          along += dots(root, motions[index_of(strong.pairs[e].later)].along - translation) * root;
        }
        motion.along += product(nodes_[t].move, along);
      }
      motion.turn -= product(nodes_[t].turn, torque_by(t, motion.along));
      motion.along += translation;
      sum += load.along * motion.along + load.turn * motion.turn;
    });
  return power;
}

}  // namespace viscontact::suspensions
