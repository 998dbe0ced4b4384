// Computes with points of the second-order cone, the set of points x = (x_0, x_1, x_2) with (x_1^2
// + x_2^2)^(1/2) <= x_0; in two dimensions x_2 is 0 and the cone is |x_1| <= x_0. The operations
// are those that the method of interior points needs: products, the distance to the boundary, and
// the scaling of Nesterov & Todd between a point of the cone and a dual point (Alizadeh & Goldfarb
// 2003, "Second-order cone programming"; Vandenberghe 2010, "The CVXOPT linear and quadratic cone
// program solvers").
//
// All components of a point have the same unit, which the caller chooses: the root of [M L^2/T] in
// interior_points.hpp, [M L/T] in constraint_solver.cpp. Only these two use this header. Nothing is
// checked or thrown: operations that need a point inside the cone give NaN, infinity or numbers
// without meaning for other points. A change must keep the accuracy near the boundary, where
// solutions are.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

namespace viscontact::particles {

/// A point or direction in two or three dimensions; a component beyond the dimension is 0.
using ConePoint = std::array<double, 3>;

/// The inner product of two points, in the product of their units.
inline double inner(const ConePoint& x, const ConePoint& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/// The distance of a point from the axis of the cone, (x_1^2 + x_2^2)^(1/2).
inline double beside_axis(const ConePoint& x) { return std::hypot(x[1], x[2]); }

/// The determinant x_0^2 - x_1^2 - x_2^2 of a point. If x_0 > 0, it is positive inside the cone and
/// 0 on its boundary. It is computed as the product of two factors, which has fewer rounding errors
/// than the difference of squares.
inline double determinant(const ConePoint& x) {
  const double beside = beside_axis(x);
  return (x[0] - beside) * (x[0] + beside);
}

/// The product of the cone's Jordan algebra: (inner(x, y), x_0 y_1 + y_0 x_1, x_0 y_2 + y_0 x_2).
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
  ConePoint x{};  ///< the point, in the coordinates of SecondOrderCone or LinearCones
  /// In a SecondOrderCone this is x_0 - (x_1^2 + x_2^2)^(1/2), > 0, with a small relative error,
  /// which the difference computed from `x` does not have near the boundary. LinearCones does not
  /// use it.
  double inside = 0;
};

/// The largest t > 0 [1] for which u + t d is in the second-order cone, with a point `u` inside it
/// and any direction `d`; infinity if u + t d is in the cone for all t > 0.
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

/// The scaling of Nesterov & Todd between a point u and a dual point r, both inside a cone. It is
/// the symmetric matrix W with W^-1 u = W r that maps the cone onto itself. `Frame` describes a
/// point by three numbers, in which W is diagonal, in place of its coordinates. In the first two
/// numbers W differs most from a multiple of the identity: near a solution one of these numbers is
/// small in u and the other one in r, with a small relative error. A `Frame` is made from u and r.
/// Its function numbers() gives the numbers of a point or of an InnerPoint, and point() is the
/// inverse of numbers(). Both keep inner products.
template <class Frame>
class NesterovToddScaling {
 public:
  NesterovToddScaling() = default;  ///< W is the identity
  /// W of a point `u` and a dual point `r`, both inside the cone.
  NesterovToddScaling(const InnerPoint& u, const InnerPoint& r) : frame_(u, r) {
    const auto of_u = frame_.numbers(u), of_r = frame_.numbers(r);
    for (std::size_t k = 0; k < 2; ++k) square_[k] = of_u[k] / of_r[k];
    square_[2] = std::sqrt(square_[0] * square_[1]);
    for (std::size_t k = 0; k < 3; ++k) scaled_[k] = std::sqrt(square_[k]) * of_r[k];
  }

  /// The numbers of the point with the coordinates `x`.
  ConePoint numbers(const ConePoint& x) const { return frame_.numbers(x); }
  /// The coordinates of the point with the numbers `y`.
  ConePoint point(const ConePoint& y) const { return frame_.point(y); }
  /// The numbers of u.
  ConePoint numbers_of_u() const { return multiplied(scaled_); }
  /// The coordinates of W r = W^-1 u.
  ConePoint scaled() const { return point(scaled_); }
  /// The inner product u.r of the two points of the constructor.
  double product_of_points() const { return inner(scaled_, scaled_); }
  /// The numbers of W x, for the coordinates `x`.
  ConePoint times(const ConePoint& x) const { return multiplied(numbers(x)); }
  /// The coordinates of W^-1 x, for the coordinates `x`.
  ConePoint divide(const ConePoint& x) const {
    auto y = numbers(x);
    for (std::size_t k = 0; k < 3; ++k) y[k] /= std::sqrt(square_[k]);
    return point(y);
  }
  /// The coordinates of (W^2 + shift I)^-1 times the point with the numbers `y`, with the identity
  /// I and `shift` >= 0.
  ConePoint solve(double shift, const ConePoint& y) const {
    return point(
        {y[0] / (square_[0] + shift), y[1] / (square_[1] + shift), y[2] / (square_[2] + shift)});
  }
  /// The coordinates of the point z whose component z_0 is 0 and which solves the equation (W^2 +
  /// shift I) z = (the point with the numbers `y`), without its row of component 0; `shift` >= 0.
  ConePoint solve_beside(double shift, const ConePoint& y) const {
    const double along = (y[0] - y[1]) / (square_[0] + square_[1] + 2 * shift);
    return point({along, -along, y[2] / (square_[2] + shift)});
  }
  /// Completes a change of u whose other components are known: returns the component 0 with which
  /// the second number of W^2 dr + du is goal[1]. `goal` has numbers of a point, `dr` has
  /// coordinates, and `du` has the coordinates of the change of u with 0 in place of the unknown
  /// component.
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

/// The Frame of NesterovToddScaling for a second-order cone. It has a unit vector d in the plane of
/// x_1 and x_2, and the unit vector d' at right angles to d in this plane. The numbers of a point x
/// are (x_0 + d.x)/2^0.5, (x_0 - d.x)/2^0.5 and d'.x.
class DirectionOfScaling {
 public:
  DirectionOfScaling() = default;  ///< d = (1, 0)
  /// The direction d for which W of the points `u` and `r`, both inside the cone, is diagonal.
  DirectionOfScaling(const InnerPoint& u, const InnerPoint& r) {
    const double of_u = std::sqrt(u.inside * (u.x[0] + beside_axis(u.x)));
    const double of_r = std::sqrt(r.inside * (r.x[0] + beside_axis(r.x)));
    const ConePoint along{0, u.x[1] / of_u - r.x[1] / of_r, u.x[2] / of_u - r.x[2] / of_r};
    const double length = beside_axis(along);
    if (length > 0) direction_ = {along[1] / length, along[2] / length};
  }
  /// The numbers of a point.
  ConePoint numbers(const ConePoint& x) const {
    const double along = along_direction(x);
    return {(x[0] + along) * kHalfRoot, (x[0] - along) * kHalfRoot,
            direction_[0] * x[2] - direction_[1] * x[1]};
  }
  /// The numbers of a point inside the cone. With the distance b of the point from the axis, the
  /// smaller one of x_0 + d.x and x_0 - d.x is InnerPoint::inside plus b - |d.x|, and this
  /// difference is computed as (d'.x)^2/(b + |d.x|), without loss of digits.
  ConePoint numbers(const InnerPoint& of) const {
    auto y = numbers(of.x);
    const double beside = beside_axis(of.x), along = along_direction(of.x);
    const double left = beside > 0 ? y[2] * y[2] / (beside + std::abs(along)) : 0;
    y[along < 0 ? 0 : 1] = (of.inside + left) * kHalfRoot;
    return y;
  }
  /// The point with the numbers `y`.
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
  using Scaling = NesterovToddScaling<DirectionOfScaling>;  ///< the scaling of two points
  /// The product of the cone, jordan_product().
  static ConePoint product(const ConePoint& x, const ConePoint& y) { return jordan_product(x, y); }
  /// The point y for which product(x, y) = z, with x inside the cone; jordan_quotient().
  static ConePoint quotient(const ConePoint& z, const ConePoint& x) {
    return jordan_quotient(z, x);
  }
  /// The largest t > 0 [1] for which u + t d is in the cone; infinity if it is so for all t > 0.
  static double length_to_boundary(const InnerPoint& u, const ConePoint& d) {
    return particles::length_to_boundary(u, d);
  }
  /// Adds t d to the point `u`, without loss of digits of InnerPoint::inside. The point must stay
  /// inside the cone, which is not checked.
  static void move(InnerPoint& u, double t, const ConePoint& d) {
    const double before = beside_axis(u.x);
    const double twice = 2 * (u.x[1] * d[1] + u.x[2] * d[2]) + t * (d[1] * d[1] + d[2] * d[2]);
    for (std::size_t k = 0; k < 3; ++k) u.x[k] += t * d[k];
    const double sum = before + beside_axis(u.x);
    u.inside += t * (d[0] - (sum > 0 ? twice / sum : 0));
  }
  /// The neutral element of the product: product(kUnit, x) = x.
  static constexpr ConePoint kUnit{1, 0, 0};
  /// An estimate of the dual point at the solution, where the inner product of point and dual point
  /// is 0, from a point u and a dual point r near the solution. It is 0 if the distance of u from
  /// the boundary, u_0 - (u_1^2 + u_2^2)^(1/2), is larger than r_0 + (r_1^2 + r_2^2)^(1/2);
  /// otherwise it is r.
  static ConePoint without_open_part(const ConePoint& u, const ConePoint& r) {
    return u[0] - beside_axis(u) > r[0] + beside_axis(r) ? ConePoint{} : r;
  }
  /// The coordinates in which the other functions of this struct take points. Here they are the
  /// components `x` themselves.
  static ConePoint coordinates(const ConePoint& x) { return x; }
};

/// The operations of SecondOrderCone for the cone of two dimensions |x_1| <= x_0 (contacts of
/// discs), which is two linear conditions. Points have the coordinates (x_0 + x_1)/2^0.5, (x_0 -
/// x_1)/2^0.5 and 0. The first two are > 0 inside the cone, and have small relative errors also
/// near the boundary.
struct LinearCones {
  /// The Frame of NesterovToddScaling: the numbers of a point are its coordinates.
  struct Coordinates {
    Coordinates() = default;
    /// The Frame does not depend on the points.
    Coordinates(const InnerPoint&, const InnerPoint&) {}
    /// The numbers of a point.
    static ConePoint numbers(const ConePoint& x) { return x; }
    /// The numbers of a point inside the cone.
    static ConePoint numbers(const InnerPoint& of) { return of.x; }
    /// The point with the numbers `y`.
    static ConePoint point(const ConePoint& y) { return y; }
  };
  using Scaling = NesterovToddScaling<Coordinates>;  ///< the scaling of two points
  /// The products of the coordinates, one by one.
  static ConePoint product(const ConePoint& x, const ConePoint& y) {
    return {x[0] * y[0], x[1] * y[1], x[2] * y[2]};
  }
  /// The point y for which product(x, y) = z, with x inside the cone.
  static ConePoint quotient(const ConePoint& z, const ConePoint& x) {
    return {z[0] / x[0], z[1] / x[1], 0};
  }
  /// The largest t > 0 [1] for which u + t d is in the cone; infinity if it is so for all t > 0.
  static double length_to_boundary(const InnerPoint& u, const ConePoint& d) {
    double length = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 2; ++k)
      if (d[k] < 0) length = std::min(length, -u.x[k] / d[k]);
    return length;
  }
  /// Adds t d to the point `u`, which must stay inside the cone (not checked).
  static void move(InnerPoint& u, double t, const ConePoint& d) {
    for (std::size_t k = 0; k < 3; ++k) u.x[k] += t * d[k];
  }
  /// The neutral element of the product: both coordinates are 1.
  static constexpr ConePoint kUnit{1, 1, 0};
  /// An estimate of the dual point at the solution, where in each coordinate the point or the dual
  /// point is 0, from a point u and a dual point r near the solution: each coordinate of r that is
  /// smaller than that of u is replaced by 0.
  static ConePoint without_open_part(const ConePoint& u, const ConePoint& r) {
    ConePoint left{};
    for (std::size_t k = 0; k < 3; ++k) left[k] = u[k] > r[k] ? 0 : r[k];
    return left;
  }
  /// The coordinates of a point with the components `x`. The same function computes components from
  /// coordinates, because it is its own inverse.
  static ConePoint coordinates(const ConePoint& x) {
    const double half = std::numbers::sqrt2 / 2;
    return {half * (x[0] + x[1]), half * (x[0] - x[1]), 0};
  }
};

}  // namespace viscontact::particles
