// Makes strokes, which are closed paths of the arms of a swimmer, from corners, samples and
// ellipses, and the points of a quadrature by the eigenvalues of the Jacobi matrix (Golub & Welsch
// 1969, Math. Comp. 23, 221). Arms [L], times [T], which rise, and periods [T], > 0, are in the
// units of the case. The quadrature is that on [0, 1] and has at least one point. Nothing of this
// is checked, and only samples that do not close the loop throw Error(kBadInput). swimmer_case.cpp
// uses the strokes, and swim.cpp and polynomial_loop.cpp use the quadrature. A leg is a part of a
// stroke on which the arms are smooth. A change must keep the times at which legs meet, because
// forces jump there.
#include "viscontact/swimmer/stroke.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "viscontact/common/error.hpp"
#include "viscontact/common/matrices/decompositions.hpp"

namespace viscontact::swimmer {
namespace {

/// A leg from the arms `from` at the time `start` to the arms `to` at the time `end`, at constant
/// velocity.
StrokeLeg straight_leg(double start, double end, const Eigen::VectorXd& from,
                       const Eigen::VectorXd& to) {
  return {start, end, [=](double time) {
            const double share = (time - start) / (end - start);
            return ArmState{from + share * (to - from), (to - from) / (end - start)};
          }};
}

}  // namespace

/// A stroke along straight legs from corner to corner and back to the first corner, in `period`.
/// All legs take the same time. There are at least two corners, each with a number for each arm
/// [L].
Stroke polygon_stroke(const std::vector<Eigen::VectorXd>& corners, double period) {
  Stroke stroke{period, {}};
  const auto count = static_cast<double>(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto number = static_cast<double>(i);
    const double end = i + 1 == corners.size() ? period : period * (number + 1) / count;
    stroke.legs.push_back(
        straight_leg(period * number / count, end, corners[i], corners[(i + 1) % corners.size()]));
  }
  return stroke;
}

/// A stroke along straight legs between the samples of the arms [L] at these times [T]; the first
/// time becomes 0. Throws Error(kBadInput) if the last sample differs from the first one by more
/// than rounding.
Stroke sampled_stroke(const std::vector<double>& times,
                      const std::vector<Eigen::VectorXd>& samples) {
  // Largest relative difference of the first and the last sample, a free choice. Samples that were
  // written with ten digits close the loop.
  constexpr double kRounding = 1e-9;
  const Eigen::VectorXd opening = samples.back() - samples.front();
  if (opening.cwiseAbs().maxCoeff() > kRounding * samples.front().cwiseAbs().maxCoeff())
    throw Error(ErrorKind::kBadInput,
                "the loop is open: its last arms differ from its first ones by {:.3g}; add a row "
                "with the first arms at the end of the period",
                opening.cwiseAbs().maxCoeff());
  Stroke stroke{times.back() - times.front(), {}};
  for (std::size_t i = 0; i + 1 < times.size(); ++i)
    stroke.legs.push_back(straight_leg(times[i] - times.front(), times[i + 1] - times.front(),
                                       samples[i],
                                       i + 2 == times.size() ? samples.front() : samples[i + 1]));
  return stroke;
}

/// The stroke whose arm k is centre_k + semi_axes_k cos(2 pi t/period + phases_k) at the time t.
/// The three lists have a number for each arm, at least one: centre and semi_axes [L], phases
/// [rad].
Stroke elliptic_stroke(const Eigen::VectorXd& centre, const Eigen::VectorXd& semi_axes,
                       const Eigen::VectorXd& phases, double period) {
  const double pi = std::numbers::pi, frequency = 2 * pi / period;
  const auto state = [=](double time) {
    const Eigen::ArrayXd angle = frequency * time + phases.array();
    return ArmState{centre.array() + semi_axes.array() * angle.cos(),
                    -frequency * semi_axes.array() * angle.sin()};
  };
  // The legs meet where the first arm turns back. If all arms turn back there, the square root of
  // the power has a kink, and the integral of this root over a leg must not cross the kink.
  const double first_turn = -phases[0] / pi - std::floor(-phases[0] / pi);
  Stroke stroke{period, {}};
  double start = 0;
  for (const double half_periods : {first_turn, first_turn + 1, 2.0})
    if (const double end = std::min(half_periods, 2.0) * period / 2; end > start) {
      stroke.legs.push_back({start, end, state});
      start = end;
    }
  return stroke;
}

/// The points, which rise, and the weights [1] of the quadrature of Gauss and Legendre with `count`
/// points on [0, 1].
GaussRule gauss_rule(int count) {
  Eigen::VectorXd off_diagonal(count - 1);
  for (Eigen::Index k = 1; k < count; ++k) {
    const auto number = static_cast<double>(k);
    off_diagonal[k - 1] = number / std::sqrt(4 * number * number - 1);
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
  eigen.computeFromTridiagonal(Eigen::VectorXd::Zero(count), off_diagonal);
  return {(eigen.eigenvalues().array() + 1) / 2,
          eigen.eigenvectors().row(0).transpose().array().square()};
}

}  // namespace viscontact::swimmer
