#include "tests/oracles/cylinder/sphere_in_cylinder.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "tests/oracles/bispherical/bispherical_basis.hpp"
#include "tests/oracles/cylinder/floor_fields.hpp"
#include "tests/oracles/gauss_legendre.hpp"

namespace viscontact {
namespace {

using Real = long double;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using RowVector = Eigen::Matrix<Real, 1, Eigen::Dynamic>;

/// Stream functions of flows that decay, with no slip on the floor xi = 0 and given values on the
/// sphere xi = alpha of radius 1: column 0 those of the sphere that moves at 1, column j + 1 those
/// that cancel field j. With D = cosh xi - cos eta, V_n = P_{n-1} - P_{n+1} and the functions of
/// bispherical_basis.hpp
///
///     psi = D^(-3/2) sum_{n>=1} [p_n S(xi) + q_n H(xi)] exp(-m alpha) V_n(cos eta),
///     drag factor = sqrt(2)/(3 sinh alpha) sum (2n+1) q_n exp(-m alpha).
class SphereFlows {
 public:
  SphereFlows(Real epsilon, const FloorFields& fields);

  const RowVector& drag_factors() const { return drag_factors_; }
  /// Derivatives by rho and z.
  std::pair<RowVector, RowVector> gradients(Real rho, Real z) const;

 private:
  Real alpha_, c_;  ///< c: half the distance of the poles
  Matrix p_, q_;    ///< a row for each n
  RowVector drag_factors_;
};

SphereFlows::SphereFlows(Real epsilon, const FloorFields& fields)
    : alpha_(2 * std::asinh(std::sqrt(epsilon / 2))), c_(std::sinh(alpha_)) {
  // p_n and q_n fall as exp(-n alpha), the flows' parts on the walls as exp(-2 n alpha), and so do
  // the errors of the quadrature.
  const int terms = std::max(20, static_cast<int>(12 / alpha_) + 8);
  const auto nodes = gauss_legendre(terms + 4);
  const Eigen::Index columns = fields.count() + 1, rows = static_cast<Eigen::Index>(nodes.size());

  // psi D^(3/2) and its derivative by xi on the sphere, and the projection on the series:
  // the coefficient of V_n is the integral of P_n'/2 over mu = cos eta.
  Matrix value(rows, columns), derivative(rows, columns), projection(terms, rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto [mu, weight] = nodes[static_cast<std::size_t>(i)];
    const Real d = epsilon + (1 - mu), root = std::sqrt(d);
    const Real rho = c_ * std::sqrt(1 - mu * mu) / d, z = c_ * c_ / d;
    const Real rho_xi = -rho * c_ / d, z_xi = c_ * (1 - mu * (1 + epsilon)) / (d * d);
    const auto set = [&](Eigen::Index column, const StreamFunction& psi) {
      value(i, column) = -d * root * psi.value;
      derivative(i, column) =
          -1.5L * c_ * root * psi.value - d * root * (psi.d_rho * rho_xi + psi.d_z * z_xi);
    };
    set(0, {rho * rho / 2, rho, 0});
    Eigen::Index column = 0;
    for (const StreamFunction& psi : fields.at(rho, z)) set(++column, psi);
    Legendre legendre(mu);
    for (Eigen::Index n = 0; n < terms; ++n, legendre.advance())
      projection(n, i) = weight / 2 * legendre.derivative;
  }
  const Matrix f = projection * value, df = projection * derivative;

  p_.resize(terms, columns);
  q_.resize(terms, columns);
  drag_factors_ = RowVector::Zero(columns);
  for (int n = 1; n <= terms; ++n) {
    const Real m = n + 0.5L;
    const BisphericalBasis at(m, alpha_);
    p_.row(n - 1) = ((m * m - 1) * at.s * f.row(n - 1) - at.h * df.row(n - 1)) / at.no_slip;
    q_.row(n - 1) = (at.s * df.row(n - 1) - at.k * f.row(n - 1)) / at.no_slip;
    drag_factors_ += (2 * n + 1) * std::exp(-m * alpha_) * q_.row(n - 1);
  }
  drag_factors_ *= std::sqrt(Real(2)) / (3 * c_);
}

std::pair<RowVector, RowVector> SphereFlows::gradients(Real rho, Real z) const {
  const Real r2 = rho * rho + z * z;
  const Real xi = std::atanh(2 * c_ * z / (r2 + c_ * c_));
  const Real eta = std::atan2(2 * c_ * rho, r2 - c_ * c_);
  const Real mu = std::cos(eta), sin_eta = std::sin(eta), sinh_xi = std::sinh(xi);
  // Far from the poles xi and eta are small: D = (cosh xi - 1) + (1 - cos eta).
  const Real a = 2 * std::pow(std::sinh(xi / 2), Real(2));
  const Real b = 2 * std::pow(std::sin(eta / 2), Real(2));
  const Real d = a + b;

  // The series, and its derivatives by xi and eta.
  RowVector u = RowVector::Zero(p_.cols()), u_xi = u, u_eta = u;
  Legendre legendre(mu);
  for (Eigen::Index i = 0; i < p_.rows(); ++i, legendre.advance()) {
    const Real n = legendre.n, m = n + 0.5L;
    const BisphericalBasis at(m, xi);
    const Real scale = std::exp(-m * (alpha_ - xi)) * (2 * n + 1) * sin_eta;
    const Real v = scale * sin_eta * legendre.derivative / (n * (n + 1));  // V_n
    const Real v_eta = scale * legendre.p;
    u += v * at.s * p_.row(i) + v * at.h * q_.row(i);
    u_xi += v * at.k * p_.row(i) + v * (m * m - 1) * at.s * q_.row(i);
    u_eta += v_eta * at.s * p_.row(i) + v_eta * at.h * q_.row(i);
  }
  const Real power = 1 / (d * std::sqrt(d));
  const RowVector psi_xi = power * (u_xi - 1.5L * sinh_xi / d * u);
  const RowVector psi_eta = power * (u_eta - 1.5L * sin_eta / d * u);
  // The coordinates are conformal: grad xi = (rho_xi, z_xi)/h^2, grad eta = (-z_xi, rho_xi)/h^2,
  // h = c/D.
  const Real rho_xi = -sinh_xi * sin_eta / c_, z_xi = (b - mu * a) / c_;  // both over h^2
  return {rho_xi * psi_xi - z_xi * psi_eta, z_xi * psi_xi + rho_xi * psi_eta};
}

}  // namespace

double sphere_in_cylinder_drag_factor(double epsilon, double radius_ratio, double height_ratio) {
  const FloorFields fields(radius_ratio, height_ratio);
  const SphereFlows sphere(epsilon, fields);

  // Both components of the velocity at the nodes of two quadratures, each with the square root of
  // its weight: column 0 the moving sphere's, the others those to cancel it with.
  const auto nodes = gauss_legendre(60);  // twice as many equations as unknowns
  const Eigen::Index columns = fields.count() + 1;
  Matrix velocities(4 * nodes.size(), columns);
  Eigen::Index row = 0;
  const auto append = [&](Real rho, Real z, Real weight) {
    auto [d_rho, d_z] = sphere.gradients(rho, z);
    Eigen::Index column = 0;
    for (const StreamFunction& psi : fields.at(rho, z)) {
      d_rho(++column) += psi.d_rho;
      d_z(column) += psi.d_z;
    }
    velocities.row(row++) = std::sqrt(weight * rho) / rho * d_rho;
    velocities.row(row++) = std::sqrt(weight * rho) / rho * d_z;
  };
  const Real radius = radius_ratio, height = height_ratio;
  for (const auto& [x, weight] : nodes) {
    append(radius, (1 + x) / 2 * height, weight * height);
    append((1 + x) / 2 * radius, height, weight * radius);
  }

  // The fields are nearly dependent, and a sum with large coefficients would lose the digits of the
  // drag near contact. Therefore the sum of squares gets the squares of all coefficients, of
  // columns scaled to length 1, with the weight 1e-11 squared. With 1e-14 to 1e-10 the drag changes
  // by less than 1e-8 of itself.
  const Eigen::Index unknowns = columns - 1;
  const Vector scale = velocities.rightCols(unknowns).colwise().norm().cwiseInverse();
  Matrix system = Matrix::Zero(row + unknowns, unknowns);
  system.topRows(row) = velocities.rightCols(unknowns) * scale.asDiagonal();
  system.bottomRows(unknowns).diagonal().setConstant(1e-11L);
  Vector target = Vector::Zero(row + unknowns);
  target.head(row) = -velocities.col(0);
  const Vector x = scale.asDiagonal() * Vector(system.householderQr().solve(target));
  return static_cast<double>(sphere.drag_factors()(0) +
                             sphere.drag_factors().rightCols(unknowns).dot(x));
}

}  // namespace viscontact
