// Sums multipoles about the centres of the spheres and fits their coefficients to the velocities of
// the surfaces (collinear_spheres.hpp). Lengths are in one unit; the viscosity is 1.
#include "tests/oracles/collinear_spheres.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscontact {
namespace {

using Eigen::Index;

/// The velocities (u_rho, u_z) at a point of the multipoles n = 2, ..., modes + 1 about a centre:
/// for each n that of r^(1-n) and that of r^(3-n). `rho` and `z` are relative to the centre, over
/// the radius of the sphere. With zeta the cosine of the polar angle, psi = f(r) I_n(zeta) gives
/// u_r = -f P_{n-1}(zeta) / r^2 and u_theta = f' I_n / (r sin theta).
void multipoles(double rho, double z, Index modes, Eigen::Ref<Eigen::MatrixXd> velocities) {
  const double r = std::hypot(rho, z), zeta = z / r, sine = rho / r;
  double p_before = 1, p = zeta;  // P_{n-2} and P_{n-1} of n = 2
  for (Index m = 0; m < modes; ++m) {
    const auto n = static_cast<double>(m + 2);
    const double p_next = ((2 * n - 1) * zeta * p - (n - 1) * p_before) / n;
    const double gegenbauer_over_sine = (p_before - p_next) / ((2 * n - 1) * sine);
    for (int kind = 0; kind < 2; ++kind) {
      const double power = kind == 0 ? 1 - n : 3 - n;
      const double radial = -std::pow(r, power - 2) * p;
      const double polar = power * std::pow(r, power - 2) * gegenbauer_over_sine;
      velocities(2 * m + kind, 0) = radial * sine + polar * zeta;
      velocities(2 * m + kind, 1) = radial * zeta - polar * sine;
    }
    p_before = p;
    p = p_next;
  }
}

}  // namespace

Eigen::MatrixXd exact_resistance(const std::vector<double>& radii,
                                 const std::vector<double>& gaps) {
  const auto spheres = static_cast<Index>(radii.size());
  std::vector<double> centres = {0};
  double narrowest = 1;
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    centres.push_back(centres.back() + radii[k] + gaps[k] + radii[k + 1]);
    narrowest = std::min(narrowest, gaps[k] / std::max(radii[k], radii[k + 1]));
  }
  // Multipoles of order n decay across a gap like exp(-2 n sqrt(gap)).
  const Index modes =
      std::clamp(static_cast<Index>(26 / std::sqrt(narrowest)), Index{28}, Index{200});
  const Index points = 2 * modes;
  Eigen::MatrixXd matrix(2 * points * spheres, 2 * modes * spheres);
  Eigen::MatrixXd velocities = Eigen::MatrixXd::Zero(matrix.rows(), spheres);
  Eigen::MatrixXd local(2 * modes, 2);
  for (Index i = 0; i < spheres; ++i)
    for (Index q = 0; q < points; ++q) {
      const double radius = radii[static_cast<std::size_t>(i)];
      const double angle =
          (static_cast<double>(q) + 0.5) * std::numbers::pi / static_cast<double>(points);
      const double rho = radius * std::sin(angle);
      const double z = centres[static_cast<std::size_t>(i)] + radius * std::cos(angle);
      const Index row = 2 * (i * points + q);
      velocities(row + 1, i) = 1;
      for (Index j = 0; j < spheres; ++j) {
        const double unit = radii[static_cast<std::size_t>(j)];
        multipoles(rho / unit, (z - centres[static_cast<std::size_t>(j)]) / unit, modes, local);
        matrix.block(row, 2 * modes * j, 2, 2 * modes) = local.transpose();
      }
    }
  const Eigen::VectorXd scale = matrix.colwise().norm().cwiseInverse();
  const Eigen::MatrixXd scaled = matrix * scale.asDiagonal();
  const Eigen::MatrixXd coefficients =
      scale.asDiagonal() * scaled.householderQr().solve(velocities);
  Eigen::MatrixXd resistance(spheres, spheres);
  // The multipole r of n = 2 alone has a force: a single sphere at velocity 1 has the coefficient
  // -3/2, and the force 6 pi.
  for (Index i = 0; i < spheres; ++i)
    resistance.row(i) = -4 * std::numbers::pi * radii[static_cast<std::size_t>(i)] *
                        coefficients.row(2 * modes * i + 1);
  return resistance;
}

}  // namespace viscontact
