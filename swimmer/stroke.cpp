// Makes strokes from corners, samples and ellipses, and the points of a quadrature by the
// eigenvalues of the Jacobi matrix (Golub & Welsch 1969, Math. Comp. 23, 221). Arms [L], times [T],
// which rise, and periods [T], > 0, are in the units of the case; the quadrature is that on [0, 1]
// with at least one point. This is not checked; only samples that do not close the loop are an
// Error(kBadInput). Used by swimmer_case.cpp (strokes), swim.cpp and polynomial_loop.cpp
// (quadrature). A change must keep the times at which legs, the parts of a stroke, meet, because
// forces jump there.
#include "viscontact/swimmer/stroke.hpp"

#include <algorithm>
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
  constexpr double kRounding = 1e-9;  // relative; samples written with ten digits close the loop
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
  const double pi = std::numbers::pi, frequency = 2 * pi / period;
  const auto state = [=](double time) {
    const Eigen::ArrayXd angle = frequency * time + phases.array();
    return ArmState{centre.array() + semi_axes.array() * angle.cos(),
                    -frequency * semi_axes.array() * angle.sin()};
  };
  // The legs meet where the first arm turns back. If all arms turn there, the square root of the
  // power, which is integrated, has a kink.
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
