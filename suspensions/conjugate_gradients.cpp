// Preconditioned conjugate gradients, and the products of (9.1).
#include "viscontact/suspensions/conjugate_gradients.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "viscontact/contact_solver/methods/fastest_instructions.hpp"

namespace viscontact::suspensions {
namespace {

using contact_solver::by_fastest_instructions;
struct GradientTuning {
  // Below this part of the loads, squared, rounding errors may keep the residual from falling. They
  // do if it has not halved in so many iterations.
  static constexpr double kRounding = 1e-25;
  static constexpr int kPatience = 100;
};

/// The columns of a symmetric 3 x 3 matrix.
using Columns = std::array<Lanes, 3>;

inline Lanes product(const Columns& matrix, const Lanes& a) {
  return matrix[0] * a[0] + matrix[1] * a[1] + matrix[2] * a[2];
}

/// By factors L D L^T, which keep more digits than cofactors where one direction is stiff.
inline Columns inverse_of(const Columns& m) {
  const double d1 = m[0][0], l21 = m[0][1] / d1, l31 = m[0][2] / d1;
  const double d2 = m[1][1] - l21 * m[0][1], l32 = (m[1][2] - l31 * m[0][1]) / d2;
  const double d3 = m[2][2] - l31 * m[0][2] - l32 * l32 * d2;
  // Rows of the inverse of L.
  const double i31 = l21 * l32 - l31;
  const Lanes row1{1, 0, 0, 0}, row2{-l21, 1, 0, 0}, row3{i31, -l32, 1, 0};
  const Lanes scaled1 = row1 / d1, scaled2 = row2 / d2, scaled3 = row3 / d3;
  return {scaled1 + scaled2 * row2[0] + scaled3 * row3[0], scaled2 + scaled3 * row3[1], scaled3};
}

/// The block of a sphere: forces by velocities and torques by angular velocities; an angular velocity
/// w has the force `mixed` x w.
struct alignas(kLaneAlignment) Block {
  Columns move{}, turn{};
  Lanes mixed{};

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
};

void add_blocks(const Resistance& resistance, std::vector<Block>& blocks) {
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const auto& [move, turn] = resistance.spheres[k];
    for (int d = 0; d < 3; ++d) {
      blocks[k].move[static_cast<std::size_t>(d)][d] = move;
      blocks[k].turn[static_cast<std::size_t>(d)][d] = turn;
    }
  }
  for (const auto& pair : resistance.pairs) {
    auto& one = blocks[static_cast<std::size_t>(pair.first)];
    auto& two = blocks[static_cast<std::size_t>(pair.second)];
    const double first = pair.turn_first + pair.turn_mixed,
                 second = pair.turn_mixed + pair.turn_second;
    const double across = (first + second) * pair.inverse_arm * pair.inverse_arm;
    one.add(pair.normal, pair.squeeze, across, pair.spin, pair.turn_first);
    one.mixed -= (first * pair.inverse_arm) * pair.normal;
    two.add(pair.normal, pair.squeeze, across, pair.spin, pair.turn_second);
    two.mixed += (second * pair.inverse_arm) * pair.normal;
  }
  for (const auto& row : resistance.drags)
    for (const std::size_t s : {0U, 1U}) {
      double across = 0, turn = 0, mixed = 0;
      for (const auto& mode : row.drag.transverse) {
        across += mode.move[s] * mode.move[s];
        turn += mode.turn[s] * mode.turn[s];
        mixed += mode.move[s] * mode.turn[s];
      }
      auto& block = blocks[static_cast<std::size_t>(s == 0 ? row.first : row.second)];
      block.add(row.normal, row.drag.axial[s] * row.drag.axial[s], across,
                row.drag.spin[s] * row.drag.spin[s], turn);
      block.mixed += mixed * row.normal;
    }
}

/// The force on all spheres over their common velocity.
Columns common_block(const Resistance& resistance) {
  Block block;
  for (const auto& sphere : resistance.spheres)
    for (int d = 0; d < 3; ++d) block.move[static_cast<std::size_t>(d)][d] += sphere.move;
  for (const auto& row : resistance.drags) {
    const auto square = [](double a) { return a * a; };
    double across = 0;
    for (const auto& mode : row.drag.transverse) across += square(mode.move[0] + mode.move[1]);
    block.add(row.normal, square(row.drag.axial[0] + row.drag.axial[1]), across, 0, 0);
  }
  return block.move;
}

inline double dot(const Motion& a, const Motion& b) {
  const Lanes c = a.along * b.along + a.turn * b.turn;
  return c[0] + c[1] + c[2];
}

}  // namespace

void Resistance::multiply(std::span<const Motion> motions, std::span<Motion> loads) const {
  by_fastest_instructions([&] {
    multiply_in_place(*this, motions, loads);
    return 0;
  });
}

BlockPreconditioner::BlockPreconditioner(const Resistance& resistance)
    : inverses_(resistance.count()) {
  by_fastest_instructions([&] {
    std::vector<Block> blocks(resistance.count());
    add_blocks(resistance, blocks);
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      const auto& block = blocks[k];
      // With the rows of X = [mixed]x turn^-1, the block is inverted by move - X [mixed]x^T.
      const Columns turn = inverse_of(block.turn);
      Columns x, rest = block.move;
      for (std::size_t c = 0; c < 3; ++c) x[c] = cross(block.mixed, turn[c]);
      for (std::size_t c = 0; c < 3; ++c) {
        Lanes unit{};
        unit[static_cast<int>(c)] = 1;
        rest[c] -= product(x, cross(unit, block.mixed));
      }
      const Columns move = inverse_of(rest);
      auto& columns = inverses_[k].columns;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto transposed = [&](const Lanes& a) {
          return Lanes{suspensions::dot(x[0], a), suspensions::dot(x[1], a),
                       suspensions::dot(x[2], a), 0};
        };
        columns[c] = {move[c], -transposed(move[c])};
        const Lanes moved = product(move, x[c]);
        columns[c + 3] = {-moved, turn[c] + transposed(moved)};
      }
    }
    return 0;
  });
  translation_ = inverse_of(common_block(resistance));
}

ConjugateGradients::Result ConjugateGradients::solve(const Resistance& resistance,
                                                     const BlockPreconditioner& preconditioner,
                                                     std::span<const Motion> loads,
                                                     std::span<Motion> motions, const End& end,
                                                     int most_iterations) {
  const std::size_t count = resistance.count();
  assert(loads.size() == count && motions.size() == count);
  residual_.resize(count);
  direction_.resize(count);
  product_.resize(count);
  return by_fastest_instructions([&] {
    Result result;
    multiply_in_place(resistance, motions, product_);
    Lanes force{}, common{};
    double rounding = 0;
    for (std::size_t k = 0; k < count; ++k) {
      rounding += dot(loads[k], preconditioner.times(k, loads[k])) +
                  suspensions::dot(loads[k].along, preconditioner.translation_by(loads[k].along));
      residual_[k].along = loads[k].along - product_[k].along;
      residual_[k].turn = loads[k].turn - product_[k].turn;
      force += residual_[k].along;
      direction_[k] = preconditioner.times(k, residual_[k]);
      result.residual += dot(residual_[k], direction_[k]);
    }
    common = preconditioner.translation_by(force);
    result.residual += suspensions::dot(force, common);
    for (std::size_t k = 0; k < count; ++k) direction_[k].along += common;
    const double allowed = std::max(end.residual, end.reduction * result.residual);
    result.start = result.residual;
    double best = result.residual;
    int since_best = 0;
    while (result.residual > allowed && result.iterations < most_iterations) {
      multiply_in_place(resistance, direction_, product_);
      double curvature = 0;
      for (std::size_t k = 0; k < count; ++k) curvature += dot(direction_[k], product_[k]);
      if (!(curvature > 0)) break;
      const double length = result.residual / curvature;
      double next = 0;
      force = Lanes{};
      for (std::size_t k = 0; k < count; ++k) {
        motions[k].along += length * direction_[k].along;
        motions[k].turn += length * direction_[k].turn;
        residual_[k].along -= length * product_[k].along;
        residual_[k].turn -= length * product_[k].turn;
        force += residual_[k].along;
        // The preconditioned residual stands in place of the product until the direction is new.
        product_[k] = preconditioner.times(k, residual_[k]);
        next += dot(residual_[k], product_[k]);
      }
      common = preconditioner.translation_by(force);
      next += suspensions::dot(force, common);
      const double share = next / result.residual;
      for (std::size_t k = 0; k < count; ++k) {
        direction_[k].along = product_[k].along + common + share * direction_[k].along;
        direction_[k].turn = product_[k].turn + share * direction_[k].turn;
      }
      result.residual = next;
      ++result.iterations;
      if (next < best / 2) {
        best = next;
        since_best = 0;
      } else if (++since_best > GradientTuning::kPatience &&
                 best < GradientTuning::kRounding * rounding) {
        result.stagnates = true;
        break;
      }
    }
    result.converged = result.stagnates || result.residual <= allowed;
    return result;
  });
}

}  // namespace viscontact::suspensions
