// The second-order cone x_0 >= (x_1^2 + x_2^2)^(1/2) (Alizadeh & Goldfarb 2003; Vandenberghe 2010,
// "The CVXOPT linear and quadratic cone program solvers").
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

namespace viscontact::contact_solver {

/// A point or direction in two or three dimensions; a component beyond the dimension is 0. All
/// components have the same unit. Operations that need a point inside the cone give NaN, infinity
/// or numbers without meaning for other points.
using ConePoint = std::array<double, 3>;

inline double inner(const ConePoint& x, const ConePoint& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/// The distance of a point from the axis of the cone.
inline double beside_axis(const ConePoint& x) { return std::hypot(x[1], x[2]); }

/// The determinant x_0^2 - x_1^2 - x_2^2, as a product, which has fewer rounding errors than the
/// difference of squares. For x_0 > 0 it is positive inside the cone and 0 on its boundary.
inline double determinant(const ConePoint& x) {
  const double beside = beside_axis(x);
  return (x[0] - beside) * (x[0] + beside);
}

/// The product of the cone's Jordan algebra.
inline ConePoint jordan_product(const ConePoint& x, const ConePoint& y) {
  return {inner(x, y), x[0] * y[1] + y[0] * x[1], x[0] * y[2] + y[0] * x[2]};
}

/// The point y for which jordan_product(x, y) = z, for an x inside the cone.
inline ConePoint jordan_quotient(const ConePoint& z, const ConePoint& x) {
  const double y = (x[0] * z[0] - x[1] * z[1] - x[2] * z[2]) / determinant(x);
  return {y, (z[1] - y * x[1]) / x[0], (z[2] - y * x[2]) / x[0]};
}

/// A point inside a cone.
struct InnerPoint {
  ConePoint x{};  ///< in the coordinates of SecondOrderCone or LinearCones
  /// In a SecondOrderCone x_0 - (x_1^2 + x_2^2)^(1/2) > 0, with a small relative error also near
  /// the boundary.
  double inside = 0;
};

/// The largest t > 0 [1] for which u + t d is in the cone; infinite if all are.
inline double length_to_boundary(const InnerPoint& u, const ConePoint& d) {
  const auto& x = u.x;
  double length = std::numeric_limits<double>::infinity();
  if (d[0] < 0) length = -x[0] / d[0];
  // The determinant of x + t d is a t^2 + 2 b t + c, and 0 on the boundary. Both roots follow from
  // `sum`, whose two terms have the same sign, so that no digits cancel.
  const double a = determinant(d), b = x[0] * d[0] - x[1] * d[1] - x[2] * d[2],
               c = u.inside * (x[0] + beside_axis(x));
  const double square = b * b - a * c;
  if (!(square >= 0)) return length;
  const double sum = -(b + std::copysign(std::sqrt(square), b));
  for (const double root : {sum / a, c / sum})
    if (root > 0 && root < length) length = root;
  return length;
}

/// The scaling of Nesterov & Todd between a point u and a dual point r inside a cone: the symmetric
/// matrix W with W^-1 u = W r that maps the cone onto itself. A `Frame` of u and r describes a
/// point by three numbers, in which W is diagonal: numbers() and, its inverse, point() keep inner
/// products. Near a solution one of the first two numbers is small in u and the other one in r,
/// with a small relative error.
template <class Frame>
class NesterovToddScaling {
 public:
  NesterovToddScaling() = default;  ///< W is the identity
  NesterovToddScaling(const InnerPoint& u, const InnerPoint& r) : frame_(u, r) {
    const auto of_u = frame_.numbers(u), of_r = frame_.numbers(r);
    for (std::size_t k = 0; k < 2; ++k) square_[k] = of_u[k] / of_r[k];
    square_[2] = std::sqrt(square_[0] * square_[1]);
    for (std::size_t k = 0; k < 3; ++k) scaled_[k] = std::sqrt(square_[k]) * of_r[k];
  }

  ConePoint numbers(const ConePoint& x) const { return frame_.numbers(x); }
  ConePoint point(const ConePoint& y) const { return frame_.point(y); }
  ConePoint numbers_of_u() const { return multiplied(scaled_); }
  /// The coordinates of W r = W^-1 u.
  ConePoint scaled() const { return point(scaled_); }
  /// The inner product u.r.
  double product_of_points() const { return inner(scaled_, scaled_); }
  /// The numbers of W x, for the coordinates `x`.
  ConePoint times(const ConePoint& x) const { return multiplied(numbers(x)); }
  /// The coordinates of W^-1 x, for the coordinates `x`.
  ConePoint divide(const ConePoint& x) const {
    auto y = numbers(x);
    for (std::size_t k = 0; k < 3; ++k) y[k] /= std::sqrt(square_[k]);
    return point(y);
  }
  /// The coordinates of (W^2 + shift I)^-1 times the point with the numbers `y`; `shift` >= 0.
  ConePoint solve(double shift, const ConePoint& y) const {
    return point(
        {y[0] / (square_[0] + shift), y[1] / (square_[1] + shift), y[2] / (square_[2] + shift)});
  }
  /// The coordinates of the point z with z_0 = 0 that solves the equation (W^2 + shift I) z = (the
  /// point with the numbers `y`) without its row of component 0; `shift` >= 0.
  ConePoint solve_beside(double shift, const ConePoint& y) const {
    const double along = (y[0] - y[1]) / (square_[0] + square_[1] + 2 * shift);
    return point({along, -along, y[2] / (square_[2] + shift)});
  }
  /// Component 0 of the change of u with which the second number of W^2 dr + du is goal[1]. `goal`
  /// has numbers of a point, `dr` and `du` have coordinates, with 0 as component 0 of du.
  double first_change(const ConePoint& goal, const ConePoint& dr, const ConePoint& du) const {
    return std::numbers::sqrt2 * (goal[1] - square_[1] * numbers(dr)[1] - numbers(du)[1]);
  }

 private:
  ConePoint multiplied(ConePoint y) const {
    for (std::size_t k = 0; k < 3; ++k) y[k] *= std::sqrt(square_[k]);
    return y;
  }

  Frame frame_;
  ConePoint square_{1, 1, 1};  // squares of the factors by which W multiplies the numbers
  ConePoint scaled_{};         // numbers of W r
};

/// The Frame for a second-order cone. With a unit vector d in the plane of x_1 and x_2 and the unit
/// vector d' at right angles to d, the numbers of a point x are (x_0 + d.x)/2^0.5, (x_0 -
/// d.x)/2^0.5 and d'.x.
class DirectionOfScaling {
 public:
  DirectionOfScaling() = default;  ///< d = (1, 0)
  /// The direction d in which W of `u` and `r` is diagonal.
  DirectionOfScaling(const InnerPoint& u, const InnerPoint& r) {
    const double of_u = std::sqrt(u.inside * (u.x[0] + beside_axis(u.x)));
    const double of_r = std::sqrt(r.inside * (r.x[0] + beside_axis(r.x)));
    const ConePoint along{0, u.x[1] / of_u - r.x[1] / of_r, u.x[2] / of_u - r.x[2] / of_r};
    const double length = beside_axis(along);
    if (length > 0) direction_ = {along[1] / length, along[2] / length};
  }
  ConePoint numbers(const ConePoint& x) const {
    const double along = along_direction(x);
    return {(x[0] + along) * kHalfRoot, (x[0] - along) * kHalfRoot,
            direction_[0] * x[2] - direction_[1] * x[1]};
  }
  /// The smaller one of x_0 + d.x and x_0 - d.x is InnerPoint::inside plus b - |d.x|, with the
  /// distance b from the axis, and is computed as (d'.x)^2/(b + |d.x|), without loss of digits.
  ConePoint numbers(const InnerPoint& of) const {
    auto y = numbers(of.x);
    const double beside = beside_axis(of.x), along = along_direction(of.x);
    const double left = beside > 0 ? y[2] * y[2] / (beside + std::abs(along)) : 0;
    y[along < 0 ? 0 : 1] = (of.inside + left) * kHalfRoot;
    return y;
  }
  ConePoint point(const ConePoint& y) const {
    const double along = (y[0] - y[1]) * kHalfRoot;
    return {(y[0] + y[1]) * kHalfRoot, along * direction_[0] - y[2] * direction_[1],
            along * direction_[1] + y[2] * direction_[0]};
  }

 private:
  static constexpr double kHalfRoot = std::numbers::sqrt2 / 2;
  double along_direction(const ConePoint& x) const {
    return direction_[0] * x[1] + direction_[1] * x[2];
  }
  std::array<double, 2> direction_{1, 0};  // d
};

/// The operations of interior_points.hpp on a cone of three dimensions (contacts of spheres).
struct SecondOrderCone {
  using Scaling = NesterovToddScaling<DirectionOfScaling>;
  static ConePoint product(const ConePoint& x, const ConePoint& y) { return jordan_product(x, y); }
  static ConePoint quotient(const ConePoint& z, const ConePoint& x) {
    return jordan_quotient(z, x);
  }
  static double length_to_boundary(const InnerPoint& u, const ConePoint& d) {
    return contact_solver::length_to_boundary(u, d);
  }
  /// Adds t d to `u`, which must stay inside the cone, without loss of digits of
  /// InnerPoint::inside.
  static void move(InnerPoint& u, double t, const ConePoint& d) {
    const double before = beside_axis(u.x);
    const double twice = 2 * (u.x[1] * d[1] + u.x[2] * d[2]) + t * (d[1] * d[1] + d[2] * d[2]);
    for (std::size_t k = 0; k < 3; ++k) u.x[k] += t * d[k];
    const double sum = before + beside_axis(u.x);
    u.inside += t * (d[0] - (sum > 0 ? twice / sum : 0));
  }
  /// The neutral element of the product: product(kUnit, x) = x.
  static constexpr ConePoint kUnit{1, 0, 0};
  /// An estimate of the dual point at the solution from points u and r near it: 0 if the distance
  /// of u from the boundary is larger than r_0 + (r_1^2 + r_2^2)^(1/2), otherwise r.
  static ConePoint without_open_part(const ConePoint& u, const ConePoint& r) {
    return u[0] - beside_axis(u) > r[0] + beside_axis(r) ? ConePoint{} : r;
  }
  /// The coordinates in which the other functions take points: the components themselves.
  static ConePoint coordinates(const ConePoint& x) { return x; }
};

/// The cone |x_1| <= x_0 of discs. Points have the coordinates (x_0 + x_1)/2^0.5, (x_0 - x_1)/2^0.5
/// and 0, which are > 0 inside the cone, with small relative errors also near the boundary.
struct LinearCones {
  /// The Frame of NesterovToddScaling: the numbers of a point are its coordinates.
  struct Coordinates {
    Coordinates() = default;
    Coordinates(const InnerPoint&, const InnerPoint&) {}
    static ConePoint numbers(const ConePoint& x) { return x; }
    static ConePoint numbers(const InnerPoint& of) { return of.x; }
    static ConePoint point(const ConePoint& y) { return y; }
  };
  using Scaling = NesterovToddScaling<Coordinates>;
  static ConePoint product(const ConePoint& x, const ConePoint& y) {
    return {x[0] * y[0], x[1] * y[1], x[2] * y[2]};
  }
  static ConePoint quotient(const ConePoint& z, const ConePoint& x) {
    return {z[0] / x[0], z[1] / x[1], 0};
  }
  static double length_to_boundary(const InnerPoint& u, const ConePoint& d) {
    double length = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 2; ++k)
      if (d[k] < 0) length = std::min(length, -u.x[k] / d[k]);
    return length;
  }
  static void move(InnerPoint& u, double t, const ConePoint& d) {
    for (std::size_t k = 0; k < 3; ++k) u.x[k] += t * d[k];
  }
  static constexpr ConePoint kUnit{1, 1, 0};
  /// In each coordinate the point or the dual point is 0 at the solution.
  static ConePoint without_open_part(const ConePoint& u, const ConePoint& r) {
    ConePoint left{};
    for (std::size_t k = 0; k < 3; ++k) left[k] = u[k] > r[k] ? 0 : r[k];
    return left;
  }
  /// The coordinates of a point with the components `x`, and the reverse.
  static ConePoint coordinates(const ConePoint& x) {
    const double half = std::numbers::sqrt2 / 2;
    return {half * (x[0] + x[1]), half * (x[0] - x[1]), 0};
  }
};

}  // namespace viscontact::contact_solver
