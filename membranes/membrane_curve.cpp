// Trigonometric interpolation of closed curves, with exact derivatives for Newton's method.
#include "viscontact/membranes/membrane_curve.hpp"

#include <array>
#include <cassert>
#include <cmath>

#include "viscontact/common/matrices/decompositions.hpp"
#include "viscontact/membranes/membrane_shape.hpp"

namespace viscontact::particles {
namespace {

/// Free choices of restore_lengths_and_area() and of measure().
struct MembraneCurveTuning {
  // The limit only ends a search that fails.
  static constexpr int kMostRounds = 50;
  // Bounds of the relative errors of lengths and area. kExact is near rounding errors. Newton's
  // method is quadratic: one more step after kNearlyExact also leaves only rounding errors.
  static constexpr double kExact = 1e-13, kNearlyExact = 1e3 * kExact;
  // Way of the beads over the perimeter in a difference for the rate of the inclination. Its
  // truncation and rounding errors are then below 1e-9 of the rate.
  static constexpr double kOfPerimeter = 1e-6;
};

/// The energy density e = c^2 q^(-5/2) (squared curvature times |dx/ds|) at one bead [1/L], where c
/// = x' y'' - y' x'' and q = x'^2 + y'^2, and its derivatives with respect to (x', y', x'', y'').
/// Primes are derivatives with respect to the parameter s [1].
struct Density {
  double value = 0;
  Eigen::Vector4d gradient;
  Eigen::Matrix4d hessian;
};

/// The density for (x', y', x'', y'') = (ax, ay, bx, by) [L]; not finite if ax and ay are 0.
Density density_at(double ax, double ay, double bx, double by) {
  const double c = ax * by - ay * bx, q = ax * ax + ay * ay;
  const double q5 = std::pow(q, -2.5), q7 = q5 / q, q9 = q7 / q;
  const Eigen::Vector4d of_c(by, -bx, -ay, ax), of_q(2 * ax, 2 * ay, 0, 0);
  Eigen::Matrix4d second_c = Eigen::Matrix4d::Zero(), second_q = Eigen::Matrix4d::Zero();
  second_c(0, 3) = second_c(3, 0) = 1;
  second_c(1, 2) = second_c(2, 1) = -1;
  second_q(0, 0) = second_q(1, 1) = 2;
  Density density;
  density.value = c * c * q5;
  density.gradient = 2 * c * q5 * of_c - 2.5 * c * c * q7 * of_q;
  density.hessian = 2 * q5 * of_c * of_c.transpose() + 2 * c * q5 * second_c -
                    5 * c * q7 * (of_c * of_q.transpose() + of_q * of_c.transpose()) +
                    8.75 * c * c * q9 * of_q * of_q.transpose() - 2.5 * c * c * q7 * second_q;
  return density;
}

}  // namespace

double cardinal(int beads, double theta, int derivative) {
  assert(beads > 0 && derivative >= 0 && derivative <= 2);
  const double n = beads;
  double sum = derivative == 0 ? 1 : 0;
  const auto add = [&](double m, double weight) {
    if (derivative == 0) sum += weight * std::cos(m * theta);
    if (derivative == 1) sum -= weight * m * std::sin(m * theta);
    if (derivative == 2) sum -= weight * m * m * std::cos(m * theta);
  };
  for (int m = 1; 2 * m < beads; ++m) add(m, 2);
  if (beads % 2 == 0) add(n / 2, 1);
  return sum / n;
}

MembraneCurve::MembraneCurve(int beads)
    : n_(beads), first_(beads, beads), second_(beads, beads), first_halfway_(beads, beads) {
  assert(n_ >= 3);
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) {
      const double theta = kTwoPi * (i - j) / n_;
      first_(i, j) = cardinal(n_, theta, 1);
      second_(i, j) = cardinal(n_, theta, 2);
      first_halfway_(i, j) = cardinal(n_, theta + kTwoPi / (2 * n_), 1);
    }
}

Eigen::VectorXd MembraneCurve::speeds(const Eigen::VectorXd& positions) const {
  assert(positions.size() == 2 * n_);
  const Eigen::ArrayXd dx = first_halfway_ * positions.head(n_),
                       dy = first_halfway_ * positions.tail(n_);
  return (dx.square() + dy.square()).sqrt();
}

Eigen::MatrixXd MembraneCurve::speed_rows(const Eigen::VectorXd& positions) const {
  assert(positions.size() == 2 * n_);
  const Eigen::VectorXd dx = first_halfway_ * positions.head(n_),
                        dy = first_halfway_ * positions.tail(n_);
  const Eigen::VectorXd speed = (dx.array().square() + dy.array().square()).sqrt();
  Eigen::MatrixXd rows(n_, 2 * n_);
  rows.leftCols(n_) = (dx.array() / speed.array()).matrix().asDiagonal() * first_halfway_;
  rows.rightCols(n_) = (dy.array() / speed.array()).matrix().asDiagonal() * first_halfway_;
  return rows;
}

Eigen::MatrixXd MembraneCurve::speeds_hessian(const Eigen::VectorXd& positions,
                                              const Eigen::VectorXd& factors) const {
  assert(positions.size() == 2 * n_ && factors.size() == n_);
  const Eigen::ArrayXd dx = first_halfway_ * positions.head(n_),
                       dy = first_halfway_ * positions.tail(n_);
  // The second derivatives of |d| with respect to d = (dx, dy) are (I - d d^T/|d|^2)/|d|.
  const Eigen::ArrayXd scaled = factors.array() * (dx.square() + dy.square()).pow(-1.5);
  const auto block = [&](const Eigen::ArrayXd& values) -> Eigen::MatrixXd {
    return first_halfway_.transpose() * ((scaled * values).matrix().asDiagonal() * first_halfway_);
  };
  Eigen::MatrixXd hessian(2 * n_, 2 * n_);
  hessian.topLeftCorner(n_, n_) = block(dy.square());
  hessian.bottomRightCorner(n_, n_) = block(dx.square());
  hessian.topRightCorner(n_, n_) = block(-dx * dy);
  hessian.bottomLeftCorner(n_, n_) = hessian.topRightCorner(n_, n_).transpose();
  return hessian;
}

double MembraneCurve::perimeter(const Eigen::VectorXd& positions) const {
  return kTwoPi / n_ * speeds(positions).sum();
}

double MembraneCurve::area(const Eigen::VectorXd& positions) const {
  return 0.5 * positions.dot(area_row(positions));
}

Eigen::VectorXd MembraneCurve::area_row(const Eigen::VectorXd& positions) const {
  assert(positions.size() == 2 * n_);
  Eigen::VectorXd row(2 * n_);
  row.head(n_) = kTwoPi / n_ * (first_ * positions.tail(n_));
  row.tail(n_) = -kTwoPi / n_ * (first_ * positions.head(n_));
  return row;
}

Eigen::MatrixXd MembraneCurve::area_hessian() const {
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(2 * n_, 2 * n_);
  hessian.topRightCorner(n_, n_) = kTwoPi / n_ * first_;
  hessian.bottomLeftCorner(n_, n_) = -kTwoPi / n_ * first_;
  return hessian;
}

Eigen::MatrixXd MembraneCurve::tangents(const Eigen::VectorXd& positions) const {
  assert(positions.size() == 2 * n_);
  Eigen::MatrixXd tangents(n_, 2);
  tangents.col(0) = first_ * positions.head(n_);
  tangents.col(1) = first_ * positions.tail(n_);
  return tangents;
}

double MembraneCurve::bending_energy(const Eigen::VectorXd& positions) const {
  const Eigen::MatrixXd a = tangents(positions);
  const Eigen::VectorXd bx = second_ * positions.head(n_), by = second_ * positions.tail(n_);
  double sum = 0;
  for (int i = 0; i < n_; ++i) sum += density_at(a(i, 0), a(i, 1), bx(i), by(i)).value;
  return 0.5 * kTwoPi / n_ * sum;
}

Eigen::VectorXd MembraneCurve::bending_gradient(const Eigen::VectorXd& positions) const {
  const Eigen::MatrixXd a = tangents(positions);
  const Eigen::VectorXd bx = second_ * positions.head(n_), by = second_ * positions.tail(n_);
  Eigen::MatrixXd of_z(n_, 4);
  for (int i = 0; i < n_; ++i)
    of_z.row(i) = density_at(a(i, 0), a(i, 1), bx(i), by(i)).gradient.transpose();
  Eigen::VectorXd gradient(2 * n_);
  gradient.head(n_) = first_.transpose() * of_z.col(0) + second_.transpose() * of_z.col(2);
  gradient.tail(n_) = first_.transpose() * of_z.col(1) + second_.transpose() * of_z.col(3);
  return 0.5 * kTwoPi / n_ * gradient;
}

Eigen::MatrixXd MembraneCurve::bending_hessian(const Eigen::VectorXd& positions) const {
  const Eigen::MatrixXd a = tangents(positions);
  const Eigen::VectorXd bx = second_ * positions.head(n_), by = second_ * positions.tail(n_);
  // Entry (z, w) of the Hessian of the energy density, at all beads.
  std::array<std::array<Eigen::VectorXd, 4>, 4> of_zw;
  for (auto& row : of_zw) row.fill(Eigen::VectorXd(n_));
  for (int i = 0; i < n_; ++i) {
    const auto hessian = density_at(a(i, 0), a(i, 1), bx(i), by(i)).hessian;
    for (int z = 0; z < 4; ++z)
      for (int w = 0; w < 4; ++w)
        of_zw[static_cast<std::size_t>(z)][static_cast<std::size_t>(w)](i) = hessian(z, w);
  }
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(2 * n_, 2 * n_);
  for (std::size_t z = 0; z < 4; ++z)
    for (std::size_t w = 0; w < 4; ++w) {
      const auto& left = z < 2 ? first_ : second_;
      const auto& right = w < 2 ? first_ : second_;
      hessian.block(static_cast<Eigen::Index>(z % 2) * n_, static_cast<Eigen::Index>(w % 2) * n_,
                    n_, n_) += left.transpose() * (of_zw[z][w].asDiagonal() * right);
    }
  return 0.5 * kTwoPi / n_ * hessian;
}

bool restore_lengths_and_area(const MembraneCurve& curve, double perimeter, double area,
                              Eigen::VectorXd& positions) {
  assert(perimeter > 0);
  const int n = curve.beads();
  const double speed = perimeter / kTwoPi;
  for (int round = 0; round < MembraneCurveTuning::kMostRounds; ++round) {
    // Residuals and rows are divided by powers of `speed`, so that all entries are near 1.
    Eigen::VectorXd missing(n + 1);
    missing.head(n) = Eigen::VectorXd::Constant(n, 1) - curve.speeds(positions) / speed;
    missing(n) = (area - curve.area(positions)) / (speed * speed);
    if (!missing.allFinite()) return false;
    if (missing.lpNorm<Eigen::Infinity>() < MembraneCurveTuning::kExact) return true;
    Eigen::MatrixXd rows(n + 1, 2 * n);
    rows.topRows(n) = curve.speed_rows(positions);
    rows.row(n) = curve.area_row(positions).transpose() / speed;
    const Eigen::MatrixXd products = rows * rows.transpose();
    const Eigen::VectorXd change = rows.transpose() * products.ldlt().solve(missing);
    if (!change.allFinite()) return false;
    positions += speed * change;
    if (missing.lpNorm<Eigen::Infinity>() < MembraneCurveTuning::kNearlyExact) return true;
  }
  return false;
}

namespace {

AreaMoments moments_of(const MembraneCurve& curve, const Eigen::VectorXd& positions) {
  const int n = curve.beads();
  const Eigen::MatrixXd tangents = curve.tangents(positions);
  // By Green's theorem, integrals over the area (about the mean of the beads) are line integrals.
  const double mean_x = positions.head(n).mean(), mean_y = positions.tail(n).mean();
  double mx = 0, my = 0;
  AreaMoments moments{mean_x, mean_y};
  for (int i = 0; i < n; ++i) {
    const double x = positions(i) - mean_x, y = positions(n + i) - mean_y;
    const double dx = kTwoPi / n * tangents(i, 0), dy = kTwoPi / n * tangents(i, 1);
    mx += x * x / 2 * dy;
    my -= y * y / 2 * dx;
    moments.xx += x * x * x / 3 * dy;
    moments.yy -= y * y * y / 3 * dx;
    moments.xy += (x * x * y * dy - x * y * y * dx) / 4;
  }
  moments.move_to_centre(curve.area(positions), mx, my);
  return moments;
}

}  // namespace

double AreaMoments::inclination() const { return 0.5 * std::atan2(2 * xy, xx - yy); }

void AreaMoments::move_to_centre(double area, double mx, double my) {
  const double cx = mx / area, cy = my / area;
  x += cx;
  y += cy;
  xx -= area * cx * cx;
  yy -= area * cy * cy;
  xy -= area * cx * cy;
}

MembraneMeasures measure(const MembraneCurve& curve, const Eigen::VectorXd& positions,
                         const Eigen::VectorXd& velocities) {
  const Eigen::MatrixXd tangents = curve.tangents(positions);
  return measure(
      {.area = curve.area(positions),
       .perimeter = curve.perimeter(positions),
       .moments = [&](const Eigen::VectorXd& at) { return moments_of(curve, at); },
       .circulation =
           [&](const Eigen::VectorXd& moving) {
             const int n = curve.beads();
             return kTwoPi / n *
                    (moving.head(n).dot(tangents.col(0)) + moving.tail(n).dot(tangents.col(1)));
           }},
      positions, velocities);
}

MembraneMeasures measure(const MeasuredLine& line, const Eigen::VectorXd& positions,
                         const Eigen::VectorXd& velocities) {
  assert(velocities.size() == 0 || velocities.size() == positions.size());
  const auto n = positions.size() / 2;
  const auto moments = line.moments(positions);
  MembraneMeasures measures;
  measures.x = moments.x;
  measures.y = moments.y;
  measures.inclination = moments.inclination();
  measures.area = line.area;
  measures.perimeter = line.perimeter;
  if (velocities.size() == 0) return measures;
  Eigen::VectorXd relative = velocities;
  relative.head(n).array() -= velocities.head(n).mean();
  relative.tail(n).array() -= velocities.tail(n).mean();
  for (Eigen::Index i = 0; i < n; ++i)
    measures.membrane_speed += std::hypot(relative(i), relative(n + i)) / static_cast<double>(n);
  if (measures.membrane_speed == 0) return measures;
  // The rate of the inclination is a central difference.
  const double time =
      MembraneCurveTuning::kOfPerimeter * measures.perimeter / measures.membrane_speed;
  const double turn = line.moments(positions + time * velocities).inclination() -
                      line.moments(positions - time * velocities).inclination();
  const double rate = std::remainder(turn, std::numbers::pi) / (2 * time);
  // The circulation of a rigid rotation with this rate, 2 rate area, is subtracted.
  measures.tank_treading_frequency = (line.circulation(relative) - 2 * rate * measures.area) /
                                     (measures.perimeter * measures.perimeter);
  return measures;
}

}  // namespace viscontact::particles
