// Newton's method on the coefficients of polynomial_loop.hpp. Energies are those in a period of 1,
// which LoopSums::energy_times_period is.
#include "viscontact/swimmer/optimal_stroke.hpp"

#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>

#include "viscontact/common/error.hpp"
#include "viscontact/common/matrices/decompositions.hpp"

namespace viscontact::swimmer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Free choices of the search.
struct OptimalStrokeTuning {
  // Steps that scale a loop to a displacement, and its relative error then, near round-off. The
  // displacement grows nearly like the square of the size of the loop, so that a few steps suffice;
  // the limit only ends a search that fails.
  static constexpr int kMostScalings = 50;
  static constexpr double kDisplacementTolerance = 1e-13;
  // Step of the differences of gradients over the size of a loop. The best one balances the
  // relative rounding error of the gradients, 1e-14, with the error of the differences by third
  // derivatives. It is about the cube root of the rounding error.
  static constexpr double kDifference = 1e-5;
  // Multiple of the Hessian for a constant metric that makes another one positive definite: its
  // first value, and the factor by which it grows until it suffices.
  static constexpr double kFirstShift = 1e-4, kShiftFactor = 4;
  // Newton's method ends at this norm of the gradient. With exact gradients and a Hessian by
  // differences, a step multiplies the error by 1e-4 or less, so that 1e-8 is reached with a step
  // to spare. The relative error of the energy is about its square.
  static constexpr double kTolerance = 1e-8;
  // Limits that only end a search that fails.
  static constexpr int kMostSteps = 200, kMostHalvings = 30;
  // Relative rise of the energy in a step that counts as its rounding error near the end.
  static constexpr double kEnergyRounding = 1e-13;
  // Intervals of the parameter at whose ends a loop must be in the table, fifty times the points of
  // the quadrature for 8 polynomials.
  static constexpr int kPoints = 2000;
  // Polynomials on the way to the wanted displacement; more are added at the end.
  static constexpr Index kPolynomials = 8;
  // The displacement begins at kFirstShare times the wanted one and grows by kFirstFactor, which is
  // reduced when a search fails, but not below kSmallestFactor.
  static constexpr double kFirstShare = 1. / 64, kFirstFactor = 2, kSmallestFactor = 1.02;
};

/// A loop of least energy at its displacement, with the multiplier of the displacement [M L/T^2]
/// and the energy in a period of 1 [M L^2/T^2].
struct Extremal {
  PolynomialLoop loop;
  double multiplier = 0;
  double energy = 0;
};

/// Finds loops of least energy with a fixed number of polynomials.
class LoopOptimizer {
 public:
  LoopOptimizer(const Swimmer& swimmer, const VectorXd& through, Index polynomials)
      : functional_(swimmer, polynomials),
        scale_(functional_.constant_metric_hessian(swimmer.at(through).metric)),
        factor_(scale_) {}

  /// The loop of least energy with this displacement [L], by Newton's method from `start`. Nothing
  /// if it does not converge or all steps leave the table.
  std::optional<Extremal> solve(const Extremal& start, double displacement,
                                const StopToken& stop) const;

 private:
  /// The multiple of the loop, seen from `through`, that has this displacement [L]. Nothing if none
  /// was found in the table.
  std::optional<PolynomialLoop> scaled_to(PolynomialLoop loop, double displacement) const;
  /// The Hessian of the Lagrangian (energy minus multiplier times displacement) by all
  /// coefficients, from central differences of the exact gradient. Nothing if a difference leaves
  /// the table.
  std::optional<MatrixXd> lagrangian_hessian(const PolynomialLoop& loop, double multiplier) const;
  /// Newton's step of the coefficients, which keeps the displacement to first order; the last entry
  /// is the new multiplier.
  std::optional<VectorXd> newton_step(const PolynomialLoop& loop, const LoopSums& sums,
                                      double multiplier) const;

  LoopFunctional functional_;
  MatrixXd scale_;
  Eigen::LLT<MatrixXd> factor_;
};

/// The loop whose coefficients are changed by `share` times `step` [L], which lists the
/// coefficients column by column.
PolynomialLoop moved(const PolynomialLoop& loop, const VectorXd& step, double share) {
  return {loop.through, loop.coefficients + share * step.reshaped(loop.coefficients.rows(),
                                                                  loop.coefficients.cols())};
}

std::optional<PolynomialLoop> LoopOptimizer::scaled_to(PolynomialLoop loop,
                                                       double displacement) const {
  for (int step = 0; step < OptimalStrokeTuning::kMostScalings; ++step) {
    if (!functional_.contains(loop)) return {};
    const double ratio = displacement / functional_.displacement(loop);
    if (std::abs(ratio - 1) <= OptimalStrokeTuning::kDisplacementTolerance) return loop;
    if (!(ratio > 0)) return {};
    loop.coefficients *= std::sqrt(ratio);
  }
  return {};
}

std::optional<MatrixXd> LoopOptimizer::lagrangian_hessian(const PolynomialLoop& loop,
                                                          double multiplier) const {
  const double step = OptimalStrokeTuning::kDifference * loop.coefficients.norm();
  MatrixXd hessian(loop.coefficients.size(), loop.coefficients.size());
  for (Index i = 0; i < hessian.cols(); ++i) {
    const VectorXd direction = VectorXd::Unit(hessian.cols(), i);
    if (!functional_.contains(moved(loop, direction, step)) ||
        !functional_.contains(moved(loop, direction, -step)))
      return {};
    const auto gradient = [&](double share) -> VectorXd {
      const auto sums = functional_(moved(loop, direction, share));
      return sums.energy_gradient - multiplier * sums.displacement_gradient;
    };
    hessian.col(i) = (gradient(step) - gradient(-step)) / (2 * step);
  }
  return MatrixXd((hessian + hessian.transpose()) / 2);
}

std::optional<VectorXd> LoopOptimizer::newton_step(const PolynomialLoop& loop, const LoopSums& sums,
                                                   double multiplier) const {
  const VectorXd& normal = sums.displacement_gradient;
  const auto exact = lagrangian_hessian(loop, multiplier);
  if (!exact) return {};
  // On the plane of constant displacement the Hessian must be positive definite; otherwise Newton's
  // method would go to a saddle point. A multiple of the Hessian for a constant metric makes it so.
  const Eigen::HouseholderQR<MatrixXd> qr(normal);
  const MatrixXd basis = whole_q(qr).rightCols(normal.size() - 1);
  MatrixXd hessian = *exact;
  const auto is_positive = [&] {
    const MatrixXd on_plane = basis.transpose() * hessian * basis;
    return Eigen::LLT<MatrixXd>(on_plane).info() == Eigen::Success;
  };
  for (double shift = OptimalStrokeTuning::kFirstShift; !is_positive();
       shift *= OptimalStrokeTuning::kShiftFactor)
    hessian = *exact + shift * scale_;
  MatrixXd conditions = MatrixXd::Zero(normal.size() + 1, normal.size() + 1);
  conditions.topLeftCorner(normal.size(), normal.size()) = hessian;
  conditions.topRightCorner(normal.size(), 1) = -normal;
  conditions.bottomLeftCorner(1, normal.size()) = normal.transpose();
  VectorXd rest(normal.size() + 1);
  rest.head(normal.size()) = -sums.energy_gradient;
  rest[normal.size()] = 0;
  return VectorXd(conditions.partialPivLu().solve(rest));
}

std::optional<Extremal> LoopOptimizer::solve(const Extremal& start, double displacement,
                                             const StopToken& stop) const {
  auto loop = scaled_to(start.loop, displacement);
  double multiplier = start.multiplier;
  for (int iteration = 0; loop && iteration < OptimalStrokeTuning::kMostSteps; ++iteration) {
    stop.throw_if_stop_requested();
    const auto sums = functional_(*loop);
    const VectorXd gradient = sums.energy_gradient - multiplier * sums.displacement_gradient;
    if (std::sqrt(gradient.dot(factor_.solve(gradient)) / sums.energy_times_period) <
        OptimalStrokeTuning::kTolerance)
      return Extremal{*loop, multiplier, sums.energy_times_period};
    const auto step = newton_step(*loop, sums, multiplier);
    if (!step) return {};
    const VectorXd direction = step->head(step->size() - 1);
    multiplier = (*step)[step->size() - 1];
    // Along a straight step the displacement changes to second order. Each trial is therefore
    // scaled to the wanted displacement; then only the energy must fall.
    std::optional<PolynomialLoop> next;
    double share = 1;
    for (int halvings = 0; !next && halvings < OptimalStrokeTuning::kMostHalvings;
         ++halvings, share /= 2) {
      next = scaled_to(moved(*loop, direction, share), displacement);
      if (next && functional_(*next).energy_times_period >
                      sums.energy_times_period * (1 + OptimalStrokeTuning::kEnergyRounding))
        next.reset();
    }
    loop = next;
  }
  return {};
}

/// True if the table contains the loop at many equidistant parameters, not only at the points of
/// the quadrature.
bool is_contained(const Swimmer& swimmer, const PolynomialLoop& loop) {
  for (int i = 0; i <= OptimalStrokeTuning::kPoints; ++i) {
    const auto basis =
        loop_basis(static_cast<double>(i) / OptimalStrokeTuning::kPoints, loop.coefficients.cols());
    if (!swimmer.contains(loop.through + loop.coefficients * basis.values)) return false;
  }
  return true;
}

/// The plane of arm velocities in which small loops of a given energy have the largest
/// displacement. The two columns of `directions` span it and have unit power; `curl` is the
/// displacement of a small loop per area in the coordinates along them.
struct BestPlane {
  MatrixXd directions;
  double curl = 0;
};

/// The best plane at the shape `through` [L], by a singular value decomposition of the curl of the
/// displacement form, scaled by the metric.
BestPlane best_plane(const Swimmer& swimmer, const VectorXd& through) {
  const auto mechanics = swimmer.at(through, true);
  const Index arms = through.size();
  MatrixXd curl(arms, arms);
  for (Index i = 0; i < arms; ++i)
    for (Index j = 0; j < arms; ++j)
      curl(i, j) = mechanics.displacement_form_slopes[static_cast<std::size_t>(i)][j] -
                   mechanics.displacement_form_slopes[static_cast<std::size_t>(j)][i];
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(mechanics.metric);
  const MatrixXd root = eigen.operatorInverseSqrt();
  const Eigen::JacobiSVD<MatrixXd> svd(root * curl * root,
                                       Eigen::ComputeFullU | Eigen::ComputeFullV);
  MatrixXd directions(arms, 2);
  directions << root * svd.matrixU().col(0), root * svd.matrixV().col(0);
  return {directions, svd.singularValues()[0]};
}

/// A small circle through the shape `through` in the best plane, with about this displacement [L].
/// `angle` [rad] is the direction in this plane from `through` to the centre.
PolynomialLoop small_loop(const BestPlane& plane, const VectorXd& through, double displacement,
                          double angle, Index polynomials) {
  const double radius = std::sqrt(std::abs(displacement) / (std::numbers::pi * plane.curl));
  const double turn = displacement > 0 ? 2 * std::numbers::pi : -2 * std::numbers::pi;
  return project_loop(
      [&](double s) -> VectorXd {
        const double now = angle + std::numbers::pi + turn * s;
        const Eigen::Vector2d place(std::cos(angle) + std::cos(now),
                                    std::sin(angle) + std::sin(now));
        return through + radius * plane.directions * place;
      },
      polynomials);
}

/// The optimal loop, followed from a small displacement to the wanted one. Nothing if a loop on the
/// way leaves the table.
std::optional<Extremal> follow(const Swimmer& swimmer, const OptimalStrokeRequest& request,
                               double angle, const StopToken& stop) {
  constexpr Index kPolynomials = OptimalStrokeTuning::kPolynomials;
  const LoopOptimizer optimizer(swimmer, request.through, kPolynomials);
  const auto plane = best_plane(swimmer, request.through);
  double share = OptimalStrokeTuning::kFirstShare;
  const double first = share * request.displacement;
  const double sign = first > 0 ? 1 : -1;
  // The energy of a circle is 4 pi |displacement| / curl.
  auto now = optimizer.solve({small_loop(plane, request.through, first, angle, kPolynomials),
                              sign * 4 * std::numbers::pi / plane.curl, 0},
                             first, stop);
  for (double factor = OptimalStrokeTuning::kFirstFactor; now && share < 1;) {
    const double next = std::min(1.0, share * factor);
    Extremal start = *now;
    start.loop.coefficients *= std::sqrt(next / share);
    const auto larger = optimizer.solve(start, next * request.displacement, stop);
    if (larger) {
      now = larger;
      share = next;
    } else {
      factor = std::sqrt(factor);
      if (factor < OptimalStrokeTuning::kSmallestFactor) return {};
    }
  }
  return now;
}

}  // namespace

OptimalStroke find_optimal_stroke(const Swimmer& swimmer, const OptimalStrokeRequest& request,
                                  const StopToken& stop) {
  assert(request.displacement != 0 && request.polynomials >= kFewestPolynomials);
  assert(request.through.size() == swimmer.arms() && swimmer.arms() >= 2);
  std::optional<Extremal> best;
  for (const double quarter : {0, 1, 2, 3}) {
    const auto found = follow(swimmer, request, quarter * std::numbers::pi / 2, stop);
    if (found && is_contained(swimmer, found->loop) && (!best || found->energy < best->energy))
      best = found;
  }
  if (!best)
    throw Error(
        ErrorKind::kBadInput,
        "no loop through this shape with the displacement {:.6g} was found within the table; ask "
        "for less, begin at a shape farther from the table's borders, or make a table of more arms",
        request.displacement);
  // With fewer polynomials than `best` has, the search starts from its first ones. The result then
  // does not replace `best`, because it may be far from the results with more polynomials.
  OptimalStroke optimal;
  for (Index count = kFewestPolynomials;; count += 2) {
    count = std::min(count, request.polynomials);
    const LoopOptimizer optimizer(swimmer, request.through, count);
    Extremal start = *best;
    if (count < start.loop.coefficients.cols())
      start.loop.coefficients = start.loop.coefficients.leftCols(count).eval();
    else
      start.loop = with_more_polynomials(start.loop, count);
    const auto found = optimizer.solve(start, request.displacement, stop);
    if (found) {
      if (count >= best->loop.coefficients.cols()) best = found;
      optimal.convergence.push_back(
          {count, found->energy, euler_lagrange_residual(swimmer, found->loop, found->multiplier)});
    }
    if (count == request.polynomials) {
      if (!found)
        throw Error(ErrorKind::kNotConverged,
                    "Newton's method for the optimal stroke fails with {} polynomials an arm; ask "
                    "for fewer",
                    count);
      optimal.loop = found->loop;
      optimal.multiplier = found->multiplier;
      return optimal;
    }
  }
}

}  // namespace viscontact::swimmer
