// Solves the three-term recursions of the bispherical coefficients by blocks.
#include "tests/oracles/bispherical/pair_loads.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace viscontact {
namespace {

// The flow is u = x p/2 + v with harmonic p and v, whose divergence is 0. With the angle phi,
//
//   p = P cos(m phi)/c,   v_z = W cos(m phi),   v_rho + v_phi, v_rho - v_phi as S, D cos(m phi), sin(m phi).
//
// P and W are harmonics of order m, S of order m + 1, D of order m - 1 (m = 0: S = D = v_rho). Each is
//
//   g^(1/2) sum_n (a_n e^((n + 1/2)(xi - xi1)) + b_n e^((n + 1/2)(xi2 - xi))) P_n^k(t),
//
// t = cos eta, g = cosh xi - t, without the phase (-1)^k in P_n^k. Sphere 1 is xi = xi1 > 0, the
// second surface xi = xi2 <= 0. Derivatives of f_n^k = g^(1/2) e^(s (n + 1/2) xi) P_n^k, s = +-1, are
//
//   c d_z f_n^k = s [(n + 1/2) f_n - (n - k + 1)/2 f_(n+1) - (n + k)/2 f_(n-1)],
//   c (d_rho - k/rho) f_n^k = f_n^(k+1) - f_(n+1)^(k+1)/2 - f_(n-1)^(k+1)/2,
//   c (d_rho + k/rho) f_n^k = -(n + k)(n - k + 1) f_n^(k-1) + (n - k + 1)(n - k + 2)/2 f_(n+1)^(k-1)
//                             + (n + k)(n + k - 1)/2 f_(n-1)^(k-1),
//   r d_r f_n^k = -f_n/2 - (n - k + 1)/2 f_(n+1) + (n + k)/2 f_(n-1),
//
// so that div u = 0 and the conditions on both surfaces, multiplied by g^(1/2), connect n - 1, n
// and n + 1. The loads are sums over the multipoles of p and v_z at the poles z = +-c.

using Real = long double;
constexpr Real kPi = std::numbers::pi_v<Real>, kRoot2 = std::numbers::sqrt2_v<Real>;
constexpr int kUnknowns = 8;
// The first unknown of each function; the second one has s = -1. Equations have the same numbers:
// no slip of W, S and D on both surfaces, and div u = 0 for both s.
constexpr int kP = 0, kW = 2, kS = 4, kD = 6;

using Block = Eigen::Matrix<Real, kUnknowns, kUnknowns>;
using Columns = Eigen::Matrix<Real, kUnknowns, Eigen::Dynamic>;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// before x_(n-1) + here x_n + after x_(n+1) = right.
struct Recursion {
  Block before = Block::Zero(), here = Block::Zero(), after = Block::Zero();
  Columns right;
};

/// Gaussian elimination by blocks; the solution replaces `right`.
void solve(std::vector<Recursion>& rows) {
  for (std::size_t n = 0; n < rows.size(); ++n) {
    auto& row = rows[n];
    if (n > 0) {
      row.here -= row.before * rows[n - 1].after;
      row.right -= row.before * rows[n - 1].right;
    }
    const Eigen::PartialPivLU<Block> lu(row.here);
    row.after = lu.solve(row.after).eval();
    row.right = lu.solve(row.right).eval();
  }
  for (std::size_t n = rows.size() - 1; n-- > 0;)
    rows[n].right -= rows[n].after * rows[n + 1].right;
}

class Pair {
 public:
  Pair(Real radius1, Real radius2, Real gap) : spheres_(2) {
    const Real d = radius1 + radius2 + gap;
    c_ = std::sqrt(gap * (2 * (radius1 + radius2) + gap) * (gap + 2 * radius1) *
                   (gap + 2 * radius2)) /
         (2 * d);
    xi_ = {std::asinh(c_ / radius1), -std::asinh(c_ / radius2)};
    centre_ = {std::hypot(radius1, c_), -std::hypot(radius2, c_)};
    set_last(std::min(xi_[0], -xi_[1]));
  }
  /// Above a plane.
  Pair(Real radius, Real gap) : spheres_(1), c_(std::sqrt(gap * (2 * radius + gap))) {
    xi_ = {std::asinh(c_ / radius), 0};
    centre_ = {radius + gap, 0};
    set_last(xi_[0]);
  }

  PairLoads loads() const {
    PairLoads loads;
    Matrix trace;
    loads.axial = loads_of(0, &trace).cast<double>();
    loads.trace = trace.cast<double>();
    loads.transverse = loads_of(1).cast<double>();
    loads.twofold = loads_of(2).cast<double>();
    loads.spin = spin().cast<double>();
    return loads;
  }

 private:
  /// Coefficients fall as exp(-(n + 1/2) xi): by 20 digits and more than the powers of n in the sums.
  void set_last(Real smallest_xi) { last_ = static_cast<int>(50 / smallest_xi) + 12; }

  static int motions_of(int m) { return m == 0 ? 2 : m == 1 ? 3 : 1; }
  static int first_of(int m) { return std::max(m - 1, 0); }

  /// The factor of a_n (s = 0) or b_n (s = 1) on surface b, without g^(1/2) P_n.
  Real on_surface(int b, int s, int n) const {
    return b == s ? 1 : std::exp(-(n + 0.5L) * (xi_[0] - xi_[1]));
  }

  /// Coefficient of P_n in g^(-1/2) on surface b.
  Real generating(int b, int n) const {
    return n < 0 ? 0 : kRoot2 * std::exp(-(n + 0.5L) * std::abs(xi_[b]));
  }

  /// The velocity of surface b for each motion and strain of sphere b, times g^(1/2).
  void set_velocities(int m, int b, int n, Columns& right) const {
    const Real x = xi_[b];
    const Real one =
        std::cosh(x) * generating(b, n) - (n > 0 ? n / (2 * n - 1.0L) * generating(b, n - 1) : 0) -
        (n + 1) / (2 * n + 3.0L) * generating(b, n + 1);  // coefficient of P_n in g^(1/2)
    const Real height = c_ * std::sinh(x) * generating(b, n) - centre_[b] * one;
    const Real rho =
        n == 0
            ? 0  // of P_n^1
            : c_ * (generating(b, n - 1) / (2 * n - 1.0L) - generating(b, n + 1) / (2 * n + 3.0L));
    const int j = motions_of(m) * b;
    if (m == 0) {
      right(kW + b, j) = one;
      right(kW + b, j + 1) = -2 * height / 3;
      right(kS + b, j + 1) = rho / 3;
    } else if (m == 1) {
      right(kD + b, j) = 2 * one;
      right(kD + b, j + 1) = 2 * height;
      right(kW + b, j + 1) = -rho;
      right(kD + b, j + 2) = -2 * height;
      right(kW + b, j + 2) = -rho;
    } else {
      right(kD + b, j) = -2 * rho;
    }
  }

  /// No slip of s = u_rho + u_phi, of u_rho - u_phi and of u_z on surface b.
  void add_no_slip(int m, int b, int n, Recursion& row) const {
    const Real less = 2 * n - 1, more = 2 * n + 3, cosh_x = std::cosh(xi_[b]);
    for (int s = 0; s < 2; ++s) {
      const Real own = on_surface(b, s, n);
      const Real lower = n > 0 ? on_surface(b, s, n - 1) : 0, upper = on_surface(b, s, n + 1);
      if (n > m) {
        const int k = kS + b;
        row.here(k, kS + s) = cosh_x * own;
        row.before(k, kS + s) = -(n - 1 - m) / less * lower;
        row.after(k, kS + s) = -(n + m + 2) / more * upper;
        row.before(k, kP + s) = lower / (2 * less);
        row.after(k, kP + s) = -upper / (2 * more);
      }
      if (m > 0) {
        const int k = kD + b;
        row.here(k, kD + s) = cosh_x * own;
        row.before(k, kD + s) = -(n - m + 1) / less * lower;
        row.after(k, kD + s) = -(n + m) / more * upper;
        row.before(k, kP + s) = -(n - m) * (n - m + 1) / (2 * less) * lower;
        row.after(k, kP + s) = (n + 1 + m) * (n + m) / (2 * more) * upper;
      }
      if (n >= m) {
        const int k = kW + b;
        row.here(k, kW + s) = cosh_x * own;
        row.before(k, kW + s) = -(n - m) / less * lower;
        row.after(k, kW + s) = -(n + 1 + m) / more * upper;
        row.here(k, kP + s) = std::sinh(xi_[b]) / 2 * own;
      }
    }
  }

  /// div u = 0, for n >= m.
  void add_continuity(int m, int n, Recursion& row) const {
    for (int s = 0; s < 2; ++s) {
      const int k = kP + s;
      const Real sign = s == 0 ? 1 : -1;
      // a_n and b_n are scaled by exponentials, whose ratios these are.
      const Real lower = std::exp(std::abs(xi_[s])), upper = 1 / lower;
      row.here(k, kP + s) = 1.25L;
      row.before(k, kP + s) = -0.25L * (n - m) * lower;
      row.after(k, kP + s) = 0.25L * (n + 1 + m) * upper;
      const Real share = m == 0 ? 1 : 0.5L;
      row.here(k, kS + s) = -share * (n + m + 1) * (n - m);
      row.before(k, kS + s) = share * (n - 1 - m) * (n - m) / 2 * lower;
      row.after(k, kS + s) = share * (n + m + 2) * (n + m + 1) / 2 * upper;
      if (m > 0) {
        row.here(k, kD + s) = 0.5L;
        row.before(k, kD + s) = -0.25L * lower;
        row.after(k, kD + s) = -0.25L * upper;
      }
      row.here(k, kW + s) = sign * (n + 0.5L);
      row.before(k, kW + s) = -sign * (n - m) / 2 * lower;
      row.after(k, kW + s) = -sign * (n + 1 + m) / 2 * upper;
    }
  }

  std::vector<Recursion> coefficients(int m) const {
    std::vector<Recursion> rows(static_cast<std::size_t>(last_ - first_of(m) + 1));
    for (int n = first_of(m); n <= last_; ++n) {
      auto& row = rows[static_cast<std::size_t>(n - first_of(m))];
      row.right = Columns::Zero(kUnknowns, motions_of(m) * spheres_);
      for (int b = 0; b < 2; ++b) {
        add_no_slip(m, b, n, row);
        if (b < spheres_) set_velocities(m, b, n, row.right);
      }
      if (n >= m) add_continuity(m, n, row);
      // Functions that do not exist are 0: P_n^k needs n >= k, and m = 0 has no D.
      const auto leave_out = [&](int k) {
        row.here.block<2, 2>(k, k).setIdentity();
        row.right.middleRows<2>(k).setZero();
      };
      if (n < m) leave_out(kP), leave_out(kW);
      if (n <= m) leave_out(kS);
      if (m == 0) leave_out(kD);
      if (n == last_) row.after.setZero();
    }
    solve(rows);
    return rows;
  }

  Matrix loads_of(int m, Matrix* trace = nullptr) const {
    const auto rows = coefficients(m);
    const int count = motions_of(m), columns = count * spheres_;
    // P_n (W_n) of the part of the flow whose poles are in sphere b.
    const auto of = [&](int function, int b, int n, int j) {
      return rows[static_cast<std::size_t>(n - first_of(m))].right(function + b, j) *
             std::exp(-(n + 0.5L) * std::abs(xi_[b]));
    };
    Matrix loads(columns, columns);
    if (trace != nullptr) trace->resize(spheres_, columns);
    for (int j = 0; j < columns; ++j)
      for (int b = 0; b < spheres_; ++b) {
        const Real sign = b == 0 ? 1 : -1;
        Real force = 0, dipole = 0, torque = 0;
        for (int n = std::max(m, 1); n <= last_; ++n) {
          const Real x = n, p = of(kP, b, n, j);
          force += (m == 0 ? 2 : x + 1) * x * p;
          dipole += (m == 0 ? 2 : x + 1) * (m == 2 ? x + 2 : 1) * x * (x - 1) * p;
          if (m == 1) torque += x * (x + 1) * (of(kW, b, n, j) + sign * p / 2);
        }
        const Real arm = centre_[b] - sign * c_;
        if (m < 2) force *= 4 * kPi * kRoot2 * c_ * (m == 0 ? sign : 1);
        dipole *= kPi * kRoot2 * c_ * c_ * (m == 2 ? 2 : 4) / 3 * (m == 1 ? sign : 1);
        if (m == 0) {
          loads(2 * b, j) = -force;
          loads(2 * b + 1, j) = -(dipole - 2 * force * arm / 3);
        } else if (m == 1) {
          loads(3 * b, j) = -force;
          loads(3 * b + 1, j) = 8 * kPi * kRoot2 * c_ * c_ * torque + arm * force;
          loads(3 * b + 2, j) = -(dipole - force * arm / 2);
        } else {
          loads(b, j) = -dipole;
        }
        if (trace == nullptr) continue;
        // On a sphere the mean of p is that of the part whose poles are outside, at the centre.
        const Real x = std::abs(xi_[b]), radius = c_ / std::sinh(x);
        Real pressure = 0;
        for (int n = 0; n <= last_; ++n)
          pressure += of(kP, 1 - b, n, j) * std::exp(-(2 * n + 1) * x);
        (*trace)(b, j) =
            -4 * kPi * radius * radius * radius * kRoot2 * std::sinh(x) * pressure / c_;
      }
    return loads;
  }

  /// u_phi is a harmonic of order 1, and its coefficients do not depend on each other.
  Matrix spin() const {
    Matrix loads = Matrix::Zero(spheres_, spheres_);
    for (int n = 1; n <= last_; ++n) {
      const Real other = on_surface(0, 1, n);
      for (int b = 0; b < spheres_; ++b)
        for (int j = 0; j < spheres_; ++j)
          loads(b, j) -= 16 * kPi * kRoot2 * c_ * c_ * c_ * n * (n + 1) * generating(j, n) *
                         (b == j ? 1 : -other) / (1 - other * other) *
                         std::exp(-(n + 0.5L) * std::abs(xi_[b]));
    }
    return loads;
  }

  int spheres_, last_ = 0;
  Real c_ = 0;  // the poles are at z = +-c
  std::array<Real, 2> xi_{}, centre_{};
};

}  // namespace

PairLoads exact_pair_loads(double radius1, double radius2, double gap) {
  return Pair(radius1, radius2, gap).loads();
}

PairLoads exact_loads_above_plane(double radius, double gap) { return Pair(radius, gap).loads(); }

}  // namespace viscontact
