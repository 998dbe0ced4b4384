// Legs meet where forces jump, so that the integrands of a leg are smooth.
#include "viscontact/swimmer/stroke.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "viscontact/common/error.hpp"
#include "viscontact/common/matrices/decompositions.hpp"

namespace viscontact::swimmer {
namespace {

StrokeLeg straight_leg(double start, double end, const Eigen::VectorXd& from,
                       const Eigen::VectorXd& to) {
  return {start, end, [=](double time) {
            const double share = (time - start) / (end - start);
            return ArmState{from + share * (to - from), (to - from) / (end - start)};
          }};
}

}  // namespace

Stroke polygon_stroke(const std::vector<Eigen::VectorXd>& corners, double period) {
  assert(corners.size() >= 2 && period > 0);
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

Stroke sampled_stroke(const std::vector<double>& times,
                      const std::vector<Eigen::VectorXd>& samples) {
  assert(samples.size() >= 2 && times.size() == samples.size());
  // Largest relative difference of the first and the last sample; samples that were written with
  // ten digits close the loop.
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

Stroke elliptic_stroke(const Eigen::VectorXd& centre, const Eigen::VectorXd& semi_axes,
                       const Eigen::VectorXd& phases, double period) {
  assert(centre.size() > 0 && semi_axes.size() == centre.size() && phases.size() == centre.size());
  assert(period > 0);
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

GaussRule gauss_rule(int count) {
  assert(count > 0);
  // The points are eigenvalues of the Jacobi matrix (Golub & Welsch 1969, Math. Comp. 23, 221).
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
