// Preconditioned conjugate gradients, and the products of (9.1).
#include "viscontact/suspensions/conjugate_gradients.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
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

using Block = Eigen::Matrix<double, 6, 6>;

Eigen::Vector3d eigen_of(const Lanes& a) { return {a[0], a[1], a[2]}; }

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& n) {
  Eigen::Matrix3d matrix;
  matrix << 0, -n[2], n[1], n[2], 0, -n[0], -n[1], n[0], 0;
  return matrix;
}

/// Adds to the block of a sphere what resists its own motions along n, across n, and the force by
/// its angular velocity, `mixed` n x w.
void add_block(const Eigen::Vector3d& n, double along, double across, double spin, double turn,
               double mixed, Block& block) {
  const Eigen::Matrix3d nn = n * n.transpose(), rest = Eigen::Matrix3d::Identity() - nn;
  block.topLeftCorner<3, 3>() += along * nn + across * rest;
  block.bottomRightCorner<3, 3>() += spin * nn + turn * rest;
  const Eigen::Matrix3d force_by_turn = mixed * cross_matrix(n);
  block.topRightCorner<3, 3>() += force_by_turn;
  block.bottomLeftCorner<3, 3>() += force_by_turn.transpose();
}

std::vector<Block> blocks_of(const Resistance& resistance) {
  std::vector<Block> blocks(resistance.count(), Block::Zero());
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const auto& [move, turn] = resistance.spheres[k];
    for (int d = 0; d < 3; ++d) {
      blocks[k](d, d) = move;
      blocks[k](d + 3, d + 3) = turn;
    }
  }
  for (const auto& pair : resistance.pairs) {
    const auto n = eigen_of(pair.normal);
    const double inverse = pair.inverse_arm;
    const double first = pair.turn_first + pair.turn_mixed,
                 second = pair.turn_mixed + pair.turn_second;
    const double across = (first + second) * inverse * inverse;
    add_block(n, pair.squeeze, across, pair.spin, pair.turn_first, -first * inverse,
              blocks[static_cast<std::size_t>(pair.first)]);
    add_block(n, pair.squeeze, across, pair.spin, pair.turn_second, second * inverse,
              blocks[static_cast<std::size_t>(pair.second)]);
  }
  for (const auto& row : resistance.drags) {
    const auto n = eigen_of(row.normal);
    for (const std::size_t s : {0U, 1U}) {
      double across = 0, turn = 0, mixed = 0;
      for (const auto& mode : row.drag.transverse) {
        across += mode.move[s] * mode.move[s];
        turn += mode.turn[s] * mode.turn[s];
        mixed += mode.move[s] * mode.turn[s];
      }
      add_block(n, row.drag.axial[s] * row.drag.axial[s], across,
                row.drag.spin[s] * row.drag.spin[s], turn, mixed,
                blocks[static_cast<std::size_t>(s == 0 ? row.first : row.second)]);
    }
  }
  return blocks;
}

/// The force on all spheres over their common velocity.
Eigen::Matrix3d common_block(const Resistance& resistance) {
  Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
  for (const auto& sphere : resistance.spheres) block += sphere.move * Eigen::Matrix3d::Identity();
  for (const auto& row : resistance.drags) {
    const auto n = eigen_of(row.normal);
    const Eigen::Matrix3d nn = n * n.transpose();
    const auto square = [](double a) { return a * a; };
    double across = 0;
    for (const auto& mode : row.drag.transverse) across += square(mode.move[0] + mode.move[1]);
    block += square(row.drag.axial[0] + row.drag.axial[1]) * nn +
             across * (Eigen::Matrix3d::Identity() - nn);
  }
  return block;
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
  const auto blocks = blocks_of(resistance);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const Block inverse = blocks[k].llt().solve(Block::Identity());
    for (int c = 0; c < 6; ++c) {
      auto& column = inverses_[k].columns[static_cast<std::size_t>(c)];
      column.along = Lanes{inverse(0, c), inverse(1, c), inverse(2, c), 0};
      column.turn = Lanes{inverse(3, c), inverse(4, c), inverse(5, c), 0};
    }
  }
  const Eigen::Matrix3d common = common_block(resistance).inverse();
  for (int c = 0; c < 3; ++c)
    translation_[static_cast<std::size_t>(c)] = Lanes{common(0, c), common(1, c), common(2, c), 0};
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
