// Preconditioned conjugate gradients, and the products of (9.1).
#include "viscontact/suspensions/linear/conjugate_gradients.hpp"

#include <algorithm>
#include <cassert>

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

}  // namespace

ConjugateGradients::Result ConjugateGradients::solve(const Resistance& resistance,
                                                     const BlockPreconditioner& preconditioner,
                                                     std::span<const Motion> loads,
                                                     std::span<Motion> motions, const End& end,
                                                     int most_iterations) {
  assert(loads.size() == resistance.count() && motions.size() == resistance.count());
  const std::size_t count = resistance.free_count();
  residual_.resize(count);
  direction_.assign(resistance.count(), {});
  product_.resize(resistance.count());
  rows_.set(resistance);
  const auto for_spheres = [&](const auto& body) {
    pool_->for_blocks(
        count,
        [&](std::size_t begin, std::size_t stop) {
          by_fastest_instructions([&] {
            for (std::size_t k = begin; k < stop; ++k) body(k);
            return 0;
          });
        },
        kSpheresInBlock);
  };
  Result result;
  rows_.multiply(resistance, motions, product_, *pool_);
  for_spheres([&](std::size_t k) {
    residual_[k].along = loads[k].along - product_[k].along;
    residual_[k].turn = loads[k].turn - product_[k].turn;
  });
  result.residual = preconditioner.apply(residual_, direction_, *pool_);
  const double allowed = std::max(end.residual, end.reduction * result.residual);
  result.start = result.residual;
  double best = result.residual, rounding = -1;
  int since_best = 0;
  while (result.residual > allowed && result.iterations < most_iterations) {
    const double curvature = rows_.multiply(resistance, direction_, product_, *pool_);
    if (!(curvature > 0)) break;
    const double length = result.residual / curvature;
    // Directions are orthogonal in the sense of R.
    result.curvature += length * result.residual;
    for_spheres([&](std::size_t k) {
      motions[k].along += length * direction_[k].along;
      motions[k].turn += length * direction_[k].turn;
      residual_[k].along -= length * product_[k].along;
      residual_[k].turn -= length * product_[k].turn;
    });
    // The preconditioned residual stands in place of the product until the direction is new.
    const double next = preconditioner.apply(residual_, product_, *pool_);
    const double share = next / result.residual;
    result.residual = next;
    ++result.iterations;
    if (next < best / 2) {
      best = next;
      since_best = 0;
    } else if (++since_best > GradientTuning::kPatience) {
      if (rounding < 0) {
        std::vector<Motion> solved(count);
        rounding = GradientTuning::kRounding * preconditioner.apply(loads, solved, *pool_);
      }
      if (best < rounding) {
        result.stagnates = true;
        break;
      }
    }
    for_spheres([&](std::size_t k) {
      direction_[k].along = product_[k].along + share * direction_[k].along;
      direction_[k].turn = product_[k].turn + share * direction_[k].turn;
    });
  }
  result.converged = result.stagnates || result.residual <= allowed;
  return result;
}

}  // namespace viscontact::suspensions
