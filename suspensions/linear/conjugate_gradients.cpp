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
  direction_.resize(resistance.count());
  product_.resize(resistance.count());
  const auto change = std::span(product_).first(count);
  const auto for_spheres = [&](const auto& body) {
    pool_->for_blocks(
        count,
        [&](std::size_t begin, std::size_t stop) {
          by_fastest_instructions([&] {
            for (std::size_t k = begin; k < stop; ++k) body(k);
            return 0;
          });
        },
        BlockTuning::kSpheres);
  };
  const ResistanceProduct product(resistance, *pool_);
  Result result;
  product.multiply(motions, product_);
  for_spheres([&](std::size_t k) { residual_[k] = loads[k]; });
  result.residual = preconditioner.subtract_and_solve(1, residual_, change, *pool_);
  std::ranges::fill(std::span(direction_).subspan(count), Motion{});
  for_spheres([&](std::size_t k) { direction_[k] = change[k]; });
  const double allowed = std::max(end.residual, end.reduction * result.residual);
  result.start = result.residual;
  double best = result.residual, rounding = -1;
  int since_best = 0;
  while (result.residual > allowed && result.iterations < most_iterations) {
    const double curvature = product.multiply(direction_, product_);
    if (!(curvature > 0)) break;
    const double length = result.residual / curvature;
    // Directions are orthogonal in the sense of R.
    result.curvature += length * result.residual;
    // The preconditioned residual takes the place of the product.
    const double next = preconditioner.subtract_and_solve(length, residual_, change, *pool_);
    const double share = next / result.residual;
    result.residual = next;
    ++result.iterations;
    for_spheres([&](std::size_t k) {
      auto &direction = direction_[k], &motion = motions[k];
      motion.along += length * direction.along;
      motion.turn += length * direction.turn;
      direction.along = change[k].along + share * direction.along;
      direction.turn = change[k].turn + share * direction.turn;
    });
    if (next < best / 2) {
      best = next;
      since_best = 0;
    } else if (++since_best > GradientTuning::kPatience) {
      if (rounding < 0) {
        std::vector<Motion> all(loads.begin(), loads.begin() + static_cast<std::ptrdiff_t>(count)),
            solved(count);
        rounding =
            GradientTuning::kRounding * preconditioner.subtract_and_solve(0, all, solved, *pool_);
      }
      if (best < rounding) {
        result.stagnates = true;
        break;
      }
    }
  }
  result.converged = result.stagnates || result.residual <= allowed;
  return result;
}

}  // namespace viscontact::suspensions
