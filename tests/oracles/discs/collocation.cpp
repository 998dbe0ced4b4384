// Discs in plane Stokes flow by collocation with the functions of Goursat.
#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include "tests/oracles/discs/discs_in_stokes_flow.hpp"
#include "tests/oracles/gauss_legendre.hpp"

namespace viscontact {
namespace {

// Velocities are w = u + i v = phi(z) - z conj(phi'(z)) + conj(psi(z)) with analytic phi and psi
// (Goursat). The force that the stress exerts along an arc, with the normal to the right of dz, is
// the difference of -2 i (phi + z conj(phi') - conj(psi)) between its ends.

using Complex = std::complex<double>;
using std::conj;
using std::numbers::pi;
constexpr Complex kI(0, 1);
/// Gauss' nodes across a channel, where the velocity is as smooth as that between two images.
constexpr int kNodes = 80;

/// Values of an analytic function and of its derivative.
struct Jet {
  Complex value, slope;
};

/// 1/zeta^n for n = 1 to `count` + 1, in a channel summed over the periodic images.
std::vector<Complex> inverse_powers(Complex zeta, int count, double period) {
  std::vector<Complex> powers(static_cast<std::size_t>(count) + 2);
  powers[1] = 1.0 / zeta;
  for (int n = 2; n <= count + 1; ++n) powers[n] = powers[n - 1] / zeta;
  if (period == 0) return powers;
  // Derivatives of the cotangent are polynomials of it, since cot' = -(1 + cot^2). At the power 12
  // the images beyond the second are left out: in a period of 10 radii or more they change
  // 1/zeta^12 on the disc by (1/29)^12 = 3e-18. In shorter ones more powers need the polynomial.
  constexpr int kByPolynomial = 12;
  const double scale = pi / period;
  const Complex cot = 1.0 / std::tan(scale * zeta);
  std::vector<double> polynomial = {0, 1};
  double factor = scale;
  for (int n = 1; n <= count + 1; ++n) {
    if (n < kByPolynomial) {
      Complex sum = 0;
      for (std::size_t k = polynomial.size(); k-- > 0;) sum = sum * cot + polynomial[k];
      powers[n] = factor * sum;
      std::vector<double> next(polynomial.size() + 1, 0.0);
      for (std::size_t k = 1; k < polynomial.size(); ++k) {
        next[k - 1] += polynomial[k] * static_cast<double>(k);
        next[k + 1] += polynomial[k] * static_cast<double>(k);
      }
      polynomial = next;  // minus the derivative, as 1/zeta^(n+1) = -(1/zeta^n)'/n
      factor *= scale / n;
    } else {
      for (const int image : {-2, -1, 1, 2}) powers[n] += std::pow(zeta + image * period, -n);
    }
  }
  return powers;
}

/// Least squares of complex equations (rows) that are linear in real unknowns (columns).
class Equations {
 public:
  Equations(Eigen::Index rows, Eigen::Index columns)
      : matrix_(Eigen::MatrixXd::Zero(2 * rows, columns)),
        right_(Eigen::VectorXd::Zero(2 * rows)) {}
  void add(Eigen::Index row, Eigen::Index column, Complex value) {
    matrix_(2 * row, column) += value.real();
    matrix_(2 * row + 1, column) += value.imag();
  }
  void set_right(Eigen::Index row, Complex value) {
    right_(2 * row) = value.real();
    right_(2 * row + 1) = value.imag();
  }
  /// The unknowns; `residual` is the largest of an equation.
  Eigen::VectorXd solve(double& residual) const {
    Eigen::VectorXd scale = matrix_.colwise().norm();
    for (double& s : scale) s = s > 0 ? 1 / s : 1;
    const Eigen::MatrixXd scaled = matrix_ * scale.asDiagonal();
    const Eigen::VectorXd x = scale.asDiagonal() * scaled.householderQr().solve(right_).eval();
    residual = (matrix_ * x - right_).cwiseAbs().maxCoeff();
    return x;
  }

 private:
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_;
};

/// What a pair of functions phi and psi contributes to the velocity at a point, and to the force
/// along an arc that ends there.
struct Contribution {
  Complex velocity, force;
};
Contribution contribution(Complex arm, Jet phi, Complex psi) {
  // `arm` is z, or z - conj(z) where that is periodic and z is not: psi differs by z phi' then.
  return {phi.value - arm * conj(phi.slope) + conj(psi),
          -2.0 * kI * (phi.value + arm * conj(phi.slope) - conj(psi))};
}

class Collocation {
 public:
  Collocation(const DiscProblem& problem, int poles, int regular)
      : problem_(problem), poles_(poles), regular_(regular) {
    per_disc_ = 4 * poles_ + 1;  // coefficients without that of a source; velocity and spin
    discs_ = static_cast<Eigen::Index>(problem.discs.size());
    first_regular_ = discs_ * per_disc_;
    switch (problem.domain) {
      case DiscDomain2d::kRoundContainer:
        columns_ = first_regular_ + 4 * regular_ + 1;
        break;
      case DiscDomain2d::kChannel:
        columns_ = first_regular_ + 8 * regular_ + 4;
        break;
      case DiscDomain2d::kSquareCell:
        columns_ = first_regular_ + 4 * regular_ + 1 + 4;
        break;
    }
  }

  Eigen::Index columns() const { return columns_; }

  /// Calls f(column, contribution) for every unknown but the motions of the discs, and f(-1, ...)
  /// for the given forces and torques. On the left side of a cell the logarithm has its cut
  /// elsewhere.
  template <class F>
  void at(Complex z, F&& f, bool left = false) const {
    const bool channel = problem_.domain == DiscDomain2d::kChannel;
    const double period = channel ? problem_.length : 0;
    for (Eigen::Index k = 0; k < discs_; ++k) {
      const auto& disc = problem_.discs[static_cast<std::size_t>(k)];
      const Complex zeta = z - disc.centre;
      const Complex arm = channel ? zeta - conj(zeta) : zeta;
      const auto inverse = inverse_powers(zeta, poles_, period);
      Eigen::Index column = k * per_disc_;
      double unit = 1;
      for (int n = 1; n <= poles_; ++n) {
        unit *= disc.radius;
        for (const Complex a : {Complex(unit), unit * kI}) {
          const Complex psi = channel ? a * inverse[n] * static_cast<double>(n) : 0;
          const Jet phi = {a * inverse[n], -static_cast<double>(n) * a * inverse[n + 1]};
          f(column++, contribution(arm, phi, psi));
          if (n > 1) f(column++, contribution(arm, {}, a * inverse[n]));
        }
      }
      // Given: the force with its logarithm, and the torque.
      const Complex a = -disc.force / (8 * pi);
      const Complex log = channel ? std::log(2.0 * std::sin(pi * zeta / period))
                          : left  ? std::log(-zeta)
                                  : std::log(zeta);
      const Complex branch = left ? kI * pi : 0;
      const Complex torque = -kI * disc.torque / (4 * pi) * inverse[1];
      auto given = contribution(arm, {a * (log + branch), a * inverse[1]},
                                conj(a) * (log + branch) + torque);
      f(-1, given);
    }
    Eigen::Index column = first_regular_;
    if (channel) {
      const double half = problem_.size / 2;
      for (int m = 1; m <= regular_; ++m)
        for (const double sign : {1.0, -1.0}) {
          const Complex wave = sign * 2 * pi * m / period * kI;
          const Complex e = std::exp(wave * z - std::abs(wave) * half);
          for (const Complex a : {Complex(1), kI}) {
            f(column++, contribution(z - conj(z), {a * e, a * wave * e}, 0));
            f(column++, contribution(z - conj(z), {}, a * e));
          }
        }
      const double y = z.imag() / half;
      for (const Complex flow : {Complex(1), kI, Complex(y), Complex(y * y)})
        f(column++, Contribution{flow, 0});
      return;
    }
    const double radius = problem_.size * (problem_.domain == DiscDomain2d::kSquareCell ? 0.7 : 1);
    Complex power = 1, below = 0;  // (z/radius)^m and its derivative over m
    for (int m = 0; m <= regular_; ++m) {
      for (const Complex a : {Complex(1), kI}) {
        // Without a uniform pressure; a constant psi is a constant phi.
        if (m != 1 || a == kI)
          f(column++, contribution(z, {a * power, a * below * static_cast<double>(m)}, 0));
        if (m > 0) f(column++, contribution(z, {}, a * power));
      }
      below = power / radius;
      power *= z / radius;
    }
  }

  /// Velocity on the surface of each disc.
  void add_discs(Equations& equations, Eigen::Index& row, int points) const {
    for (Eigen::Index k = 0; k < discs_; ++k)
      for (int i = 0; i < points; ++i, ++row) {
        const auto& disc = problem_.discs[static_cast<std::size_t>(k)];
        const Complex zeta = disc.radius * std::exp(2 * pi * (i + 0.5) / points * kI);
        const Eigen::Index motion = (k + 1) * per_disc_ - 3;
        Complex given = 0;
        at(disc.centre + zeta, [&](Eigen::Index column, const Contribution& c) {
          if (column < 0)
            given += c.velocity;
          else
            equations.add(row, column, c.velocity);
        });
        equations.add(row, motion, -1);
        equations.add(row, motion + 1, -kI);
        equations.add(row, motion + 2, -kI * zeta);
        equations.set_right(row, -given);
      }
  }
  Complex linear_flow(Complex z) const {
    return problem_.strain * conj(z) + kI * problem_.rotation * z;
  }
  void add_wall(Equations& equations, Eigen::Index& row, Complex z) const {
    Complex given = 0;
    at(z, [&](Eigen::Index column, const Contribution& c) {
      if (column < 0)
        given += c.velocity;
      else
        equations.add(row, column, c.velocity);
    });
    equations.set_right(row++, linear_flow(z) - given);
  }
  /// No mean flow through the channel, halfway between two images.
  void add_no_flux(Equations& equations, Eigen::Index row) const {
    Complex given = 0;
    for (const auto& node : gauss_legendre(kNodes)) {
      const double weight = static_cast<double>(node.weight) / 2;
      const double y = problem_.size / 2 * static_cast<double>(node.x);
      at({problem_.length / 2, y}, [&](Eigen::Index column, const Contribution& c) {
        if (column < 0)
          given += weight * c.velocity.real();
        else
          equations.add(row, column, weight * c.velocity.real());
      });
    }
    equations.set_right(row, -given);
  }
  /// Periodicity of velocity and force between opposite sides of a square cell, and no mean
  /// velocity.
  void add_cell(Equations& equations, Eigen::Index& row, int points) const {
    const double half = problem_.size / 2;
    const Complex force = problem_.discs[0].force;
    const Eigen::Index constants = columns_ - 4;
    Complex given_flux = 0;
    const Eigen::Index flux = row++;
    for (const bool vertical : {true, false})
      for (const auto& node : gauss_legendre(points)) {
        const double s = half * static_cast<double>(node.x);
        const double weight = static_cast<double>(node.weight) / 4;  // of the mean of both sides
        const Complex plus = vertical ? Complex(half, s) : Complex(s, half);
        const Complex minus = vertical ? Complex(-half, s) : Complex(s, -half);
        Complex velocity = linear_flow(plus) - linear_flow(minus);
        // The pressure falls by force/size between opposite sides, which balances the force. The
        // force along each pair of sides is known but for a constant.
        Complex traction = vertical ? -force.real() * s / problem_.size * Complex(1)
                                    : kI * force.imag() * s / problem_.size;
        const Eigen::Index v = row++, t = row++;
        for (const double sign : {1.0, -1.0})
          at(
              sign > 0 ? plus : minus,
              [&](Eigen::Index column, const Contribution& c) {
                const Complex through =
                    vertical ? Complex(c.velocity.real()) : kI * c.velocity.imag();
                if (column < 0) {
                  velocity -= sign * c.velocity;
                  traction -= sign * c.force;
                  given_flux += weight * through;
                } else {
                  equations.add(v, column, sign * c.velocity);
                  equations.add(t, column, sign * c.force);
                  equations.add(flux, column, weight * through);
                }
              },
              vertical && sign < 0);
        equations.add(t, constants + (vertical ? 0 : 2), 1);
        equations.add(t, constants + (vertical ? 1 : 3), kI);
        equations.set_right(v, velocity);
        equations.set_right(t, traction);
      }
    equations.set_right(flux, -given_flux);
  }

  DiscAnswer answer(const Eigen::VectorXd& x, double residual, double area) const {
    DiscAnswer answer;
    answer.residual = residual;
    Complex stresslets = 0;
    for (Eigen::Index k = 0; k < discs_; ++k) {
      const Eigen::Index motion = (k + 1) * per_disc_ - 3;
      answer.velocities.emplace_back(x(motion), x(motion + 1));
      answer.spins.push_back(x(motion + 2));
      // The first two unknowns of a disc are the coefficient of 1/zeta in phi.
      stresslets += problem_.discs[static_cast<std::size_t>(k)].radius *
                    Complex(x(k * per_disc_), x(k * per_disc_ + 1));
    }
    // By the reciprocal theorem with the linear flow; the fluid alone dissipates 4 |strain|^2 area.
    if (std::abs(problem_.strain) > 0)
      answer.added_dissipation = -2 * pi * (conj(problem_.strain) * stresslets).real() /
                                 (std::norm(problem_.strain) * area);
    return answer;
  }

 private:
  const DiscProblem& problem_;
  int poles_, regular_;
  Eigen::Index per_disc_ = 0, discs_ = 0, first_regular_ = 0, columns_ = 0;
};

}  // namespace

DiscAnswer discs_by_collocation(const DiscProblem& problem, int poles, int regular) {
  const Collocation method(problem, poles, regular);
  const int disc_points = 3 * poles, wall_points = 5 * regular;
  const Eigen::Index rows =
      static_cast<Eigen::Index>(problem.discs.size()) * disc_points + 4 * wall_points + 1;
  Equations equations(rows, method.columns());
  Eigen::Index row = 0;
  method.add_discs(equations, row, disc_points);
  double area = problem.size * problem.size;
  switch (problem.domain) {
    case DiscDomain2d::kRoundContainer:
      area *= pi;
      for (int i = 0; i < wall_points; ++i)
        method.add_wall(equations, row,
                        problem.size * std::exp(2 * pi * (i + 0.5) / wall_points * kI));
      break;
    case DiscDomain2d::kChannel:
      area = problem.size * problem.length;
      for (int i = 0; i < wall_points; ++i)
        for (const double side : {-1.0, 1.0})
          method.add_wall(
              equations, row,
              {problem.length * ((i + 0.5) / wall_points - 0.5), side * problem.size / 2});
      method.add_no_flux(equations, row++);
      break;
    case DiscDomain2d::kSquareCell:
      method.add_cell(equations, row, wall_points);
      break;
  }
  double residual = 0;
  const Eigen::VectorXd x = equations.solve(residual);
  return method.answer(x, residual, area);
}

}  // namespace viscontact
