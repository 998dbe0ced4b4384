// Blocks of spheres, and incomplete Cholesky factors of the squeezes of strong pairs.
#include "viscontact/suspensions/linear/block_preconditioner.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "viscontact/common/index.hpp"
#include "viscontact/contact_solver/methods/fastest_instructions.hpp"
#include "viscontact/suspensions/pairs/row_blocks.hpp"

namespace viscontact::suspensions {
namespace {

using contact_solver::by_fastest_instructions;

struct FactorTuning {
  // Strong pairs for each sphere. Of 10 000 spheres at the volume fraction 0.55, sheared, a
  // reduction by 1e-3 takes 102 iterations without strong pairs, 37 with 1.6, 38 with 2, 60 with
  // 3.4.
  static constexpr double kStrongPairs = 1.7;
  // Pairs of this part of the least squeeze are strong, too, because equal squeezes have rounding
  // errors.
  static constexpr double kEqual = 1 - 1e-6;
  // The part of the change of a block by an earlier node that is left out for each pair that the
  // factors do not have. Without it a block in a thousand loses its sign, and the factors their
  // use.
  static constexpr double kCompensation = 0.05;
  // A block that earlier nodes have made smaller than this part of it is taken as without them.
  static constexpr double kLeastPivot = 1e-3;
  // Nodes in a block of a loop.
  static constexpr std::size_t kNodes = 256;
};

inline Lanes product(const Columns& matrix, const Lanes& a) {
  return matrix[0] * a[0] + matrix[1] * a[1] + matrix[2] * a[2];
}

inline Lanes transposed_product(const Columns& matrix, const Lanes& a) {
  const Lanes x = matrix[0] * a, y = matrix[1] * a, z = matrix[2] * a, none{};
  const Lanes xy = __builtin_shufflevector(x, y, 0, 4, 2, 6) +
                   __builtin_shufflevector(x, y, 1, 5, 3, 7),
              zz = __builtin_shufflevector(z, none, 0, 4, 2, 6) +
                   __builtin_shufflevector(z, none, 1, 5, 3, 7);
  return __builtin_shufflevector(xy, zz, 0, 1, 4, 5) + __builtin_shufflevector(xy, zz, 2, 3, 6, 7);
}

/// The factors L D L^T of a symmetric matrix, which keep more digits of its inverse than cofactors
/// where one direction is stiff.
struct SymmetricFactors {
  double d1, d2, d3, l21, l31, l32;
  explicit SymmetricFactors(const Columns& m)
      : d1(m[0][0]),
        d2(m[1][1] - m[0][1] * m[0][1] / d1),
        d3(0),
        l21(m[0][1] / d1),
        l31(m[0][2] / d1),
        l32((m[1][2] - l31 * m[0][1]) / d2) {
    d3 = m[2][2] - l31 * m[0][2] - l32 * l32 * d2;
  }
  Columns inverse() const {
    // Rows of the inverse of L.
    const double i31 = l21 * l32 - l31;
    const Lanes row1{1, 0, 0, 0}, row2{-l21, 1, 0, 0}, row3{i31, -l32, 1, 0};
    const Lanes scaled1 = row1 / d1, scaled2 = row2 / d2, scaled3 = row3 / d3;
    return {
        {scaled1 + scaled2 * row2[0] + scaled3 * row3[0], scaled2 + scaled3 * row3[1], scaled3}};
  }
};

inline Columns inverse_of(const Columns& m) { return SymmetricFactors(m).inverse(); }

/// The force on all spheres over their common velocity.
Columns common_block(const Resistance& resistance) {
  Columns sum{};
  const auto add = [&](const Lanes& n, double along, double across) {
    for (int c = 0; c < 3; ++c) {
      auto& column = sum[static_cast<std::size_t>(c)];
      column += ((along - across) * n[c]) * n;
      column[c] += across;
    }
  };
  for (const auto& sphere : resistance.spheres) add(Lanes{}, sphere.move, sphere.move);
  for (const auto& row : resistance.drags) {
    const auto square = [](double a) { return a * a; };
    double across = 0;
    for (const auto& mode : row.drag.transverse) across += square(mode.move[0] + mode.move[1]);
    add(row.normal, square(row.drag.axial[0] + row.drag.axial[1]), across);
  }
  for (const auto& pair : resistance.pairs) {
    if (resistance.fixed == 0) break;
    if (index_of(pair.second) < resistance.free_count()) continue;
    const double across = pair.turn_first + 2 * pair.turn_mixed + pair.turn_second;
    add(pair.normal, pair.squeeze, across * pair.inverse_arm * pair.inverse_arm);
  }
  return sum;
}

}  // namespace

/// The block of a sphere: forces by velocities and torques by angular velocities; an angular
/// velocity w has the force `mixed` x w.
struct alignas(kLaneAlignment) BlockPreconditioner::Block {
  Columns move{}, turn{};
  Lanes mixed{};
  Columns slipping{};  // forces by angular velocities, beside those of `mixed`

  /// Adds what resists motions along n, across n, and turns about n and across n.
  void add(const Lanes& n, double along, double across, double spin, double turned) {
    for (int c = 0; c < 3; ++c) {
      auto &m = move[static_cast<std::size_t>(c)], &t = turn[static_cast<std::size_t>(c)];
      m += ((along - across) * n[c]) * n;
      m[c] += across;
      t += ((spin - turned) * n[c]) * n;
      t[c] += turned;
    }
  }
  /// Adds what a slip takes away; `sign` is 1 for the first sphere and -1 for the second one.
  void add(const SlipRow& row, double arm, double sign) {
    const Lanes across = cross(row.direction, row.normal);
    const Lanes force = row.stiffness * across, torque = row.stiffness * row.direction;
    for (int d = 0; d < 3; ++d) {
      const auto c = static_cast<std::size_t>(d);
      move[c] -= across[d] * force;
      turn[c] -= (arm * arm * row.direction[d]) * torque;
      slipping[c] -= (sign * arm * row.direction[d]) * force;
    }
  }
};

void BlockPreconditioner::add_blocks(const Resistance& resistance, std::vector<Block>& blocks,
                                     ThreadPool& pool) const {
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const auto& [move, turn] = resistance.spheres[k];
    for (int d = 0; d < 3; ++d) {
      blocks[k].move[static_cast<std::size_t>(d)][d] = move;
      blocks[k].turn[static_cast<std::size_t>(d)][d] = turn;
    }
  }
  add_by_blocks(blocks.size(), resistance.pairs, pool,
                [&](std::size_t p, bool to_first, bool to_second) {
                  const auto& pair = resistance.pairs[p];
                  const double first = pair.turn_first + pair.turn_mixed,
                               second = pair.turn_mixed + pair.turn_second;
                  const double across = (first + second) * pair.inverse_arm * pair.inverse_arm;
                  if (to_first) {
                    auto& block = blocks[index_of(pair.first)];
                    block.add(pair.normal, pair.squeeze, across, pair.spin, pair.turn_first);
                    block.mixed -= (first * pair.inverse_arm) * pair.normal;
                  }
                  if (to_second) {
                    auto& block = blocks[index_of(pair.second)];
                    block.add(pair.normal, pair.squeeze, across, pair.spin, pair.turn_second);
                    block.mixed += (second * pair.inverse_arm) * pair.normal;
                  }
                });
  add_by_blocks(blocks.size(), resistance.drags, pool,
                [&](std::size_t p, bool to_first, bool to_second) {
                  const auto& row = resistance.drags[p];
                  for (const std::size_t s : {0U, 1U}) {
                    if (!(s == 0 ? to_first : to_second)) continue;
                    double across = 0, turn = 0, mixed = 0;
                    for (const auto& mode : row.drag.transverse) {
                      across += mode.move[s] * mode.move[s];
                      turn += mode.turn[s] * mode.turn[s];
                      mixed += mode.move[s] * mode.turn[s];
                    }
                    auto& block = blocks[index_of(s == 0 ? row.first : row.second)];
                    block.add(row.normal, row.drag.axial[s] * row.drag.axial[s], across,
                              row.drag.spin[s] * row.drag.spin[s], turn);
                    block.mixed += mixed * row.normal;
                  }
                });
  add_by_blocks(blocks.size(), resistance.slips, pool,
                [&](std::size_t p, bool to_first, bool to_second) {
                  const auto& row = resistance.slips[p];
                  if (to_first) blocks[index_of(row.first)].add(row, row.arm_first, 1);
                  if (to_second) blocks[index_of(row.second)].add(row, row.arm_second, -1);
                });
}

/// The strong pairs of each sphere.
struct BlockPreconditioner::Graph {
  struct Edge {
    std::int32_t sphere = 0;
    std::uint32_t pair = 0;
  };
  std::vector<std::uint32_t> begin;
  std::vector<Edge> edges;

  Graph(const Resistance& resistance, ThreadPool& pool) : begin(resistance.free_count() + 1, 0) {
    const auto& pairs = resistance.pairs;
    const auto most = static_cast<std::size_t>(FactorTuning::kStrongPairs *
                                               static_cast<double>(resistance.free_count()));
    double least = 0;
    if (most < pairs.size()) {
      std::vector<double> squeezes(pairs.size());
      for (std::size_t p = 0; p < pairs.size(); ++p) squeezes[p] = pairs[p].squeeze;
      const auto nth = squeezes.begin() + static_cast<std::ptrdiff_t>(most);
      std::ranges::nth_element(squeezes, nth, std::greater<>());
      least = FactorTuning::kEqual * *nth;
    }
    using Strong = ConcatenatedBlocks<std::uint32_t>;
    const auto strong = pool.sum_of_blocks<Strong>(
        pairs.size(),
        [&](std::size_t from, std::size_t end) {
          Strong found;
          for (std::size_t p = from; p < end; ++p)
            if (pairs[p].squeeze > 0 && pairs[p].squeeze >= least &&
                index_of(pairs[p].second) < resistance.free_count())
              found.values.push_back(static_cast<std::uint32_t>(p));
          return found;
        },
        kPairsInBlock);
    for (const auto p : strong.values) {
      ++begin[index_of(pairs[p].first) + 1];
      ++begin[index_of(pairs[p].second) + 1];
    }
    for (std::size_t k = 1; k < begin.size(); ++k) begin[k] += begin[k - 1];
    edges.resize(begin.back());
    auto next = begin;
    for (const auto p : strong.values) {
      edges[next[index_of(pairs[p].first)]++] = {pairs[p].second, p};
      edges[next[index_of(pairs[p].second)]++] = {pairs[p].first, p};
    }
  }
  std::span<const Edge> of(std::int32_t sphere) const {
    const auto k = index_of(sphere);
    return std::span(edges).subspan(begin[k], begin[k + 1] - begin[k]);
  }
};

inline Lanes BlockPreconditioner::force_by(std::size_t sphere, const Lanes& turn) const {
  const Lanes force = cross(turning_[sphere].mixed, turn);
  return slipping_.empty() ? force : force + product(slipping_[sphere], turn);
}

inline Lanes BlockPreconditioner::torque_by(std::size_t sphere, const Lanes& move) const {
  const Lanes torque = cross(move, turning_[sphere].mixed);
  return slipping_.empty() ? torque : torque + transposed_product(slipping_[sphere], move);
}

BlockPreconditioner::BlockPreconditioner(const Resistance& resistance, ThreadPool& pool) {
  const std::size_t count = resistance.free_count();
  std::vector<Block> blocks(resistance.count());
  turning_.resize(count);
  if (!resistance.slips.empty()) slipping_.resize(count);
  add_blocks(resistance, blocks, pool);
  pool.for_blocks(
      count,
      [&](std::size_t begin, std::size_t end) {
        by_fastest_instructions([&] {
          for (std::size_t k = begin; k < end; ++k) {
            auto& block = blocks[k];
            // What remains of forces by velocities if the sphere turns without a torque.
            turning_[k] = {inverse_of(block.turn), block.mixed};
            if (!slipping_.empty()) slipping_[k] = block.slipping;
            for (std::size_t c = 0; c < 3; ++c) {
              Lanes unit{};
              unit[static_cast<int>(c)] = 1;
              const Lanes torque = torque_by(k, unit);
              block.move[c] -= force_by(k, product(turning_[k].inverse, torque));
            }
          }
          return 0;
        });
      },
      kSpheresInBlock);
  factor(resistance, blocks, pool);
  translation_ = inverse_of(common_block(resistance));
}

void BlockPreconditioner::factor(const Resistance& resistance, std::vector<Block>& blocks,
                                 ThreadPool& pool) {
  const std::size_t count = resistance.free_count();
  const Graph graph(resistance, pool);
  // Rounds of spheres that have fewer strong pairs, of those that are left, than their neighbours.
  std::vector<std::int32_t> left(count), node_of(count, -1), degrees(count);
  std::vector<double> keys(count);
  for (std::size_t k = 0; k < count; ++k) {
    left[k] = static_cast<std::int32_t>(k);
    degrees[k] = static_cast<std::int32_t>(graph.begin[k + 1] - graph.begin[k]);
    keys[k] = blocks[k].move[0][0] + blocks[k].move[1][1] + blocks[k].move[2][2];
  }
  spheres_.reserve(count);
  while (!left.empty()) {
    rounds_.push_back(spheres_.size());
    const auto is_before = [&](std::int32_t a, std::int32_t b) {
      const auto i = index_of(a), j = index_of(b);
      return degrees[i] != degrees[j] ? degrees[i] < degrees[j]
                                      : (keys[i] != keys[j] ? keys[i] < keys[j] : a < b);
    };
    for (const auto k : left)
      if (std::ranges::none_of(graph.of(k), [&](const Graph::Edge& edge) {
            return node_of[index_of(edge.sphere)] < 0 && is_before(edge.sphere, k);
          }))
        spheres_.push_back(k);
    for (std::size_t t = rounds_.back(); t < spheres_.size(); ++t) {
      node_of[index_of(spheres_[t])] = static_cast<std::int32_t>(t);
      for (const auto& edge : graph.of(spheres_[t])) --degrees[index_of(edge.sphere)];
    }
    std::erase_if(left, [&](std::int32_t k) { return node_of[index_of(k)] >= 0; });
  }
  rounds_.push_back(count);

  // Lists of later and earlier spheres.
  later_.assign(count + 1, 0);
  earlier_.assign(count + 1, 0);
  couplings_.reserve(graph.edges.size() / 2);
  for (std::size_t t = 0; t < count; ++t) {
    for (const auto& edge : graph.of(spheres_[t])) {
      const auto other = node_of[index_of(edge.sphere)];
      if (index_of(other) < t) continue;
      Coupling coupling;
      const auto& pair = resistance.pairs[edge.pair];
      coupling.node = other;
      for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
          coupling.entries[static_cast<std::size_t>(3 * c + r)] =
              -pair.squeeze * pair.normal[c] * pair.normal[r];
      couplings_.push_back(coupling);
      ++earlier_[index_of(other) + 1];
    }
    later_[t + 1] = static_cast<std::uint32_t>(couplings_.size());
  }
  for (std::size_t t = 0; t < count; ++t) earlier_[t + 1] += earlier_[t];
  earlier_pairs_.resize(couplings_.size());
  auto next = earlier_;
  for (std::size_t t = 0; t < count; ++t)
    for (std::size_t c = later_[t]; c < later_[t + 1]; ++c)
      earlier_pairs_[next[index_of(couplings_[c].node)]++] = {static_cast<std::int32_t>(t),
                                                              static_cast<std::uint32_t>(c)};

  moves_.resize(count);
  const auto factor_node = [&](std::size_t t) {
    const auto& move = blocks[index_of(spheres_[t])].move;
    Columns reduced = move;
    const auto neighbours = graph.of(spheres_[t]);
    for (std::size_t e = earlier_[t]; e < earlier_[t + 1]; ++e) {
      const auto from = index_of(earlier_pairs_[e].node);
      const auto& pair = couplings_[earlier_pairs_[e].coupling];
      const Columns here = pair.matrix();
      Columns solved;
      for (std::size_t c = 0; c < 3; ++c) solved[c] = product(moves_[from], here[c]);
      int left_out = 0;
      for (std::size_t c = later_[from]; c < later_[from + 1]; ++c) {
        const auto other = couplings_[c].node;
        if (index_of(other) == t) continue;
        if (index_of(other) > t) {
          bool found = false;
          for (std::size_t l = later_[t]; l < later_[t + 1]; ++l) {
            if (couplings_[l].node != other) continue;
            found = true;
            const Columns there = couplings_[c].matrix();
            auto& entries = couplings_[l].entries;
            for (std::size_t column = 0; column < 3; ++column) {
              const Lanes change = transposed_product(solved, there[column]);
              for (int r = 0; r < 3; ++r)
                entries[3 * column + static_cast<std::size_t>(r)] -= change[r];
            }
          }
          if (!found) ++left_out;
        } else if (std::ranges::none_of(neighbours, [&](const Graph::Edge& edge) {
                     return node_of[index_of(edge.sphere)] == other;
                   })) {
          ++left_out;
        }
      }
      const double part = std::max(1 - FactorTuning::kCompensation * left_out, 0.0);
      for (std::size_t c = 0; c < 3; ++c) reduced[c] -= part * transposed_product(here, solved[c]);
    }
    const SymmetricFactors factors(reduced), whole(move);
    const bool is_positive = factors.d1 > FactorTuning::kLeastPivot * whole.d1 &&
                             factors.d2 > FactorTuning::kLeastPivot * whole.d2 &&
                             factors.d3 > FactorTuning::kLeastPivot * whole.d3;
    moves_[t] = (is_positive ? factors : whole).inverse();
  };
  for (std::size_t round = 0; round + 1 < rounds_.size(); ++round) {
    const std::size_t first = rounds_[round];
    pool.for_blocks(
        rounds_[round + 1] - first,
        [&](std::size_t begin, std::size_t end) {
          by_fastest_instructions([&] {
            for (std::size_t t = first + begin; t < first + end; ++t) factor_node(t);
            return 0;
          });
        },
        FactorTuning::kNodes);
  }
  // The sweeps need spheres, not nodes.
  for (auto& coupling : couplings_) coupling.node = spheres_[index_of(coupling.node)];
  for (auto& pair : earlier_pairs_) pair.node = spheres_[index_of(pair.node)];
}

double BlockPreconditioner::apply(std::span<const Motion> loads, std::span<Motion> motions,
                                  ThreadPool& pool) const {
  struct Force {
    std::array<double, 3>
        sum{};  // no Lanes, which code for other processors would return otherwise
    Force& operator+=(const Force& other) {
      for (std::size_t d = 0; d < 3; ++d) sum[d] += other.sum[d];
      return *this;
    }
  };
  const std::size_t count = spheres_.size();
  const auto force = pool.sum_of_blocks<Force>(
      count,
      [&](std::size_t begin, std::size_t end) {
        return by_fastest_instructions([&] {
          Lanes sum{};
          for (std::size_t k = begin; k < end; ++k) {
            sum += loads[k].along;
            motions[k].turn = product(turning_[k].inverse, loads[k].turn);
            motions[k].along = loads[k].along - force_by(k, motions[k].turn);
          }
          return Force{{sum[0], sum[1], sum[2]}};
        });
      },
      kSpheresInBlock);
  const Motion common{product(translation_, lanes_of(force.sum)), {}};
  const auto for_round = [&](std::size_t round, const auto& body) {
    const std::size_t first = rounds_[round];
    pool.for_blocks(
        rounds_[round + 1] - first,
        [&](std::size_t begin, std::size_t end) {
          by_fastest_instructions([&] {
            for (std::size_t t = first + begin; t < first + end; ++t)
              body(t, motions[index_of(spheres_[t])].along);
            return 0;
          });
        },
        FactorTuning::kNodes);
  };
  for (std::size_t round = 0; round + 1 < rounds_.size(); ++round)
    for_round(round, [&](std::size_t t, Lanes& here) {
      Lanes sum = here;
      for (std::size_t e = earlier_[t]; e < earlier_[t + 1]; ++e) {
        const auto& pair = earlier_pairs_[e];
        const auto& coupling = couplings_[pair.coupling];
        sum -= transposed_product(coupling.matrix(), motions[index_of(pair.node)].along);
      }
      here = product(moves_[t], sum);
    });
  for (std::size_t round = rounds_.size() - 1; round-- > 0;)
    for_round(round, [&](std::size_t t, Lanes& here) {
      if (later_[t] == later_[t + 1]) return;
      Lanes sum{};
      for (std::size_t c = later_[t]; c < later_[t + 1]; ++c)
        sum += product(couplings_[c].matrix(), motions[index_of(couplings_[c].node)].along);
      here -= product(moves_[t], sum);
    });
  return pool.sum_of_blocks<double>(
      count,
      [&](std::size_t begin, std::size_t end) {
        return by_fastest_instructions([&] {
          Lanes sum{};
          for (std::size_t k = begin; k < end; ++k) {
            auto& motion = motions[k];
            motion.turn -= product(turning_[k].inverse, torque_by(k, motion.along));
            motion.along += common.along;
            sum += loads[k].along * motion.along + loads[k].turn * motion.turn;
          }
          return sum[0] + sum[1] + sum[2];
        });
      },
      kSpheresInBlock);
}

}  // namespace viscontact::suspensions
