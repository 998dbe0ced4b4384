// The second-order cone (x_1^2 + x_2^2)^(1/2) <= x_0 of up to three dimensions, with the operations
// that the method of interior points needs: products, the distance to the boundary, and the scaling
// of Nesterov & Todd between a point of the cone and a dual point (Alizadeh & Goldfarb 2003,
// "Second-order cone programming"; Vandenberghe 2010, "The CVXOPT linear and quadratic cone program
// solvers"). In one dimension the cone is x_0 >= 0, in two |x_1| <= x_0.
//
// All components of a point have the same unit, which the caller chooses: the root of [M L^2/T] in
// interior_points.hpp, [M L/T] in constraint_solver.cpp. Only these two use this header. Nothing is
// checked or thrown: operations that need a point inside the cone give NaN or infinity for another
// one. A change must keep the accuracy near the boundary, where solutions are.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

namespace viscontact::particles {

/// A point of a cone of up to three dimensions; components beyond the dimension are 0.
using ConePoint = std::array<double, 3>;

/// Sum of the products of the components, in the product of both units.
inline double inner(const ConePoint& x, const ConePoint& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/// The distance of a point from the axis of the cone, (x_1^2 + x_2^2)^(1/2).
inline double beside_axis(const ConePoint& x) { return std::hypot(x[1], x[2]); }

/// x_0^2 - x_1^2 - x_2^2, for x_0 > 0 positive inside the cone and 0 on its boundary. The product
/// of two factors has fewer rounding errors than the difference of squares.
inline double determinant(const ConePoint& x) {
  const double beside = beside_axis(x);
  return (x[0] - beside) * (x[0] + beside);
}

/// The product of the cone's Jordan algebra: (inner(x, y), x_0 y_1 + y_0 x_1, x_0 y_2 + y_0 x_2).
inline ConePoint jordan_product(const ConePoint& x, const ConePoint& y) {
  return {inner(x, y), x[0] * y[1] + y[0] * x[1], x[0] * y[2] + y[0] * x[2]};
}

/// The y with jordan_product(x, y) = z, for an x inside the cone.
inline ConePoint jordan_quotient(const ConePoint& z, const ConePoint& x) {
  const double y = (x[0] * z[0] - x[1] * z[1] - x[2] * z[2]) / determinant(x);
  return {y, (z[1] - y * x[1]) / x[0], (z[2] - y * x[2]) / x[0]};
}

/// A point inside a cone.
struct InnerPoint {
  ConePoint x{};  ///< the point, in the coordinates of SecondOrderCone or LinearCones
  /// In a SecondOrderCone x_0 - (x_1^2 + x_2^2)^(1/2), > 0, with a small relative error, which the
  /// difference computed from `x` does not have near the boundary. Not used by LinearCones.
  double inside = 0;
};

/// The largest t > 0 [1] with u + t d in the second-order cone; infinity if all of them are in it.
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

/// The scaling of a point u and a dual point r, both inside the second-order cone: the symmetric
/// matrix W with W^-1 u = W r that maps the cone onto itself. W is diagonal in the following
/// numbers: with a unit vector d in the plane of x_1 and x_2, and the vector d' at right angles to
/// d in this plane, the numbers of a point x are x_0 + d.x, x_0 - d.x and d'.x. Near a solution one
/// number of u and one of r are much smaller than the components. They are computed from
/// InnerPoint::inside, so that they have a small relative error.
class ConeScaling {
 public:
  ConeScaling() = default;  ///< W = I
  /// W of a point `u` and a dual point `r`, both inside the cone.
  ConeScaling(const InnerPoint& u, const InnerPoint& r) {
    const double of_u = std::sqrt(u.inside * (u.x[0] + beside_axis(u.x)));
    const double of_r = std::sqrt(r.inside * (r.x[0] + beside_axis(r.x)));
    const ConePoint along{0, u.x[1] / of_u - r.x[1] / of_r, u.x[2] / of_u - r.x[2] / of_r};
    const double length = beside_axis(along);
    if (length > 0) direction_ = {0, along[1] / length, along[2] / length};
    const auto of_point = numbers(u), of_dual = numbers(r);
    for (std::size_t k = 0; k < 2; ++k) square_[k] = of_point[k] / of_dual[k];
    square_[2] = std::sqrt(square_[0] * square_[1]);
    for (std::size_t k = 0; k < 3; ++k) scaled_[k] = std::sqrt(square_[k]) * of_dual[k];
  }

  /// The numbers of the point with the components `x`.
  ConePoint numbers(const ConePoint& x) const {
    const double along = direction_[1] * x[1] + direction_[2] * x[2];
    return {x[0] + along, x[0] - along, direction_[1] * x[2] - direction_[2] * x[1]};
  }
  /// The components of the point with the numbers `y`.
  ConePoint point(const ConePoint& y) const {
    const double along = (y[0] - y[1]) / 2;
    return {(y[0] + y[1]) / 2, along * direction_[1] - y[2] * direction_[2],
            along * direction_[2] + y[2] * direction_[1]};
  }
  /// The numbers of u, with all digits.
  ConePoint numbers_of_u() const {
    auto y = scaled_;
    for (std::size_t k = 0; k < 3; ++k) y[k] *= std::sqrt(square_[k]);
    return y;
  }
  /// W r = W^-1 u, as components.
  ConePoint scaled() const { return point(scaled_); }
  /// The inner product u.r of the two points of the constructor.
  double product_of_points() const { return inner(scaled(), scaled()); }
  /// The numbers of W x, for the components `x`.
  ConePoint times(const ConePoint& x) const {
    auto y = numbers(x);
    for (std::size_t k = 0; k < 3; ++k) y[k] *= std::sqrt(square_[k]);
    return y;
  }
  /// The components of W^-1 x, for the components `x`.
  ConePoint divide(const ConePoint& x) const {
    auto y = numbers(x);
    for (std::size_t k = 0; k < 3; ++k) y[k] /= std::sqrt(square_[k]);
    return point(y);
  }

  /// The components of (W^2 + shift I)^-1 times the point with the numbers `y`, shift >= 0.
  ConePoint solve(double shift, const ConePoint& y) const {
    return point(
        {y[0] / (square_[0] + shift), y[1] / (square_[1] + shift), y[2] / (square_[2] + shift)});
  }
  /// (W^2 + shift I)^-1 for components, row by row, shift >= 0.
  std::array<ConePoint, 3> inverse_square(double shift) const {
    const double along = 1 / (square_[0] + shift), against = 1 / (square_[1] + shift);
    auto inverse = beside((along + against) / 2, 1 / (square_[2] + shift));
    inverse[0][0] = (along + against) / 2;
    for (std::size_t k = 1; k < 3; ++k)
      inverse[0][k] = inverse[k][0] = (along - against) / 2 * direction_[k];
    return inverse;
  }
  /// The components of the solution z, with z_0 = 0, of rows 1 and 2 of (W^2 + shift I) z = the
  /// point with the numbers `y`, shift >= 0.
  ConePoint solve_beside(double shift, const ConePoint& y) const {
    const double along = (y[0] - y[1]) / (square_[0] + square_[1] + 2 * shift);
    return point({along, -along, y[2] / (square_[2] + shift)});
  }
  /// The matrix of solve_beside() for components: rows and columns 1 and 2 are the inverse of these
  /// rows and columns of W^2 + shift I; row and column 0 are 0.
  std::array<ConePoint, 3> inverse_square_beside(double shift) const {
    return beside(2 / (square_[0] + square_[1] + 2 * shift), 1 / (square_[2] + shift));
  }
  /// The du_0 with which the second number of W^2 dr + du is goal[1]; `goal` are numbers.
  double first_change(const ConePoint& goal, const ConePoint& dr, const ConePoint& du) const {
    return goal[1] - square_[1] * numbers(dr)[1] - numbers(ConePoint{0, du[1], du[2]})[1];
  }

 private:
  // The numbers of a point. The smaller one of x_0 + d.x and x_0 - d.x is InnerPoint::inside plus
  // (d'.x)^2/(b + |d.x|) = b - |d.x|, with the distance b from the axis.
  ConePoint numbers(const InnerPoint& of) const {
    auto y = numbers(of.x);
    const double beside = beside_axis(of.x);
    const double along = direction_[1] * of.x[1] + direction_[2] * of.x[2];
    y[along < 0 ? 0 : 1] = of.inside + (beside > 0 ? y[2] * y[2] / (beside + std::abs(along)) : 0);
    return y;
  }
  // The matrix whose rows and columns 1 and 2 have the eigenvalue `along` for the vector d, and
  // `across` for d'; row and column 0 are 0.
  std::array<ConePoint, 3> beside(double along, double across) const {
    std::array<ConePoint, 3> matrix{};
    for (std::size_t k = 1; k < 3; ++k)
      for (std::size_t l = 1; l < 3; ++l)
        matrix[k][l] = (along - across) * direction_[k] * direction_[l] + (k == l ? across : 0);
    return matrix;
  }

  ConePoint direction_{0, 1, 0};  // d
  ConePoint square_{1, 1, 1};     // squares of the factors by which W multiplies the numbers
  ConePoint scaled_{1, 1, 0};     // numbers of W r
};

/// The operations of interior_points.hpp on a cone of three dimensions (contacts of spheres).
struct SecondOrderCone {
  using Scaling = ConeScaling;  ///< scaling of Nesterov & Todd
  /// The product of the cone, jordan_product().
  static ConePoint product(const ConePoint& x, const ConePoint& y) { return jordan_product(x, y); }
  /// The y with product(x, y) = z, jordan_quotient().
  static ConePoint quotient(const ConePoint& z, const ConePoint& x) {
    return jordan_quotient(z, x);
  }
  /// The largest t > 0 with u + t d in the cone. The last argument is for LinearCones only.
  static double length_to_boundary(const InnerPoint& u, const ConePoint& d, std::size_t) {
    return particles::length_to_boundary(u, d);
  }
  /// Adds t d to a point, which must stay inside the cone, without loss of digits of `inside`.
  static void move(InnerPoint& u, double t, const ConePoint& d) {
    const double before = beside_axis(u.x);
    const double twice = 2 * (u.x[1] * d[1] + u.x[2] * d[2]) + t * (d[1] * d[1] + d[2] * d[2]);
    for (std::size_t k = 0; k < 3; ++k) u.x[k] += t * d[k];
    const double sum = before + beside_axis(u.x);
    u.inside += t * (d[0] - (sum > 0 ? twice / sum : 0));
  }
  /// The unit of the product, product(unit, x) = x. The argument is for LinearCones only.
  static ConePoint unit(std::size_t) { return {1, 0, 0}; }
  /// An estimate of the dual point at the solution, where u.r = 0, from points u and r near it. It
  /// is 0 if u is farther from the boundary than r is large; otherwise it is r.
  static ConePoint without_open_part(const ConePoint& u, const ConePoint& r) {
    return u[0] - beside_axis(u) > r[0] + beside_axis(r) ? ConePoint{} : r;
  }
  /// The coordinates in which the other functions take points: here the components `x`.
  static ConePoint coordinates(const ConePoint& x) { return x; }
};

/// The operations of SecondOrderCone for cones of one and two dimensions (contacts of discs). In
/// two dimensions, |x_1| <= x_0, points have the coordinates (x_0 + x_1)/2^0.5 and (x_0 -
/// x_1)/2^0.5. Both are > 0 inside the cone, and have small relative errors also near the boundary.
/// In one dimension the coordinate is x_0. Other coordinates are 0.
struct LinearCones {
  /// The functions of ConeScaling for points given by coordinates, which are also their numbers. W
  /// is diagonal in them: the squares of its entries are the ratios of the coordinates of u and r.
  class Scaling {
   public:
    Scaling() = default;  ///< W = I
    /// W of a point `u` and a dual point `r`, both inside the cone.
    Scaling(const InnerPoint& u, const InnerPoint& r) {
      for (std::size_t k = 0; k < 3; ++k) {
        square_[k] = r.x[k] > 0 ? u.x[k] / r.x[k] : 1;
        scaled_[k] = std::sqrt(u.x[k] * r.x[k]);
      }
    }
    /// The numbers of the point with the coordinates `x`: the same.
    static ConePoint numbers(const ConePoint& x) { return x; }
    /// The coordinates of the point with the numbers `y`: the same.
    static ConePoint point(const ConePoint& y) { return y; }
    /// The numbers of u.
    ConePoint numbers_of_u() const { return times(scaled_); }
    /// W r = W^-1 u.
    ConePoint scaled() const { return scaled_; }
    /// The inner product u.r of the two points of the constructor.
    double product_of_points() const { return inner(scaled_, scaled_); }
    /// W x.
    ConePoint times(const ConePoint& x) const {
      ConePoint y;
      for (std::size_t k = 0; k < 3; ++k) y[k] = std::sqrt(square_[k]) * x[k];
      return y;
    }
    /// W^-1 x.
    ConePoint divide(const ConePoint& x) const {
      ConePoint y;
      for (std::size_t k = 0; k < 3; ++k) y[k] = x[k] / std::sqrt(square_[k]);
      return y;
    }
    /// (W^2 + shift I)^-1 x, shift >= 0.
    ConePoint solve(double shift, const ConePoint& x) const {
      return {x[0] / (square_[0] + shift), x[1] / (square_[1] + shift),
              x[2] / (square_[2] + shift)};
    }
    /// (W^2 + shift I)^-1 for coordinates, row by row, shift >= 0.
    std::array<ConePoint, 3> inverse_square(double shift) const {
      std::array<ConePoint, 3> inverse{};
      for (std::size_t k = 0; k < 3; ++k) inverse[k][k] = 1 / (square_[k] + shift);
      return inverse;
    }
    /// As ConeScaling::solve_beside(), with coordinates in place of components and numbers.
    ConePoint solve_beside(double shift, const ConePoint& x) const {
      const double along = (x[0] - x[1]) / (square_[0] + square_[1] + 2 * shift);
      return {along, -along, 0};
    }
    /// As ConeScaling::inverse_square_beside(): a matrix for components, not for coordinates.
    std::array<ConePoint, 3> inverse_square_beside(double shift) const {
      std::array<ConePoint, 3> inverse{};
      inverse[1][1] = 2 / (square_[0] + square_[1] + 2 * shift);
      return inverse;
    }
    /// As ConeScaling::first_change(), but `goal` and `dr` are coordinates.
    double first_change(const ConePoint& goal, const ConePoint& dr, const ConePoint& du) const {
      return std::numbers::sqrt2 * (goal[1] - square_[1] * dr[1]) + du[1];
    }

   private:
    ConePoint square_{1, 1, 1}, scaled_{};  // the diagonal of W^2; W r
  };
  /// The products of the coordinates, one by one.
  static ConePoint product(const ConePoint& x, const ConePoint& y) {
    return {x[0] * y[0], x[1] * y[1], x[2] * y[2]};
  }
  /// The y with product(x, y) = z; 0 for coordinates that the cone does not have.
  static ConePoint quotient(const ConePoint& z, const ConePoint& x) {
    ConePoint y{};
    for (std::size_t k = 0; k < 3; ++k)
      if (x[k] != 0) y[k] = z[k] / x[k];
    return y;
  }
  /// The largest t > 0 with u + t d in the cone of 1 or 2 coordinates, `rows`; or infinity.
  static double length_to_boundary(const InnerPoint& u, const ConePoint& d, std::size_t rows) {
    double length = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < rows; ++k)
      if (d[k] < 0) length = std::min(length, -u.x[k] / d[k]);
    return length;
  }
  /// Adds t d to a point, which must stay inside the cone.
  static void move(InnerPoint& u, double t, const ConePoint& d) {
    for (std::size_t k = 0; k < 3; ++k) u.x[k] += t * d[k];
  }
  /// The unit of the product in a cone with `rows` coordinates: each of them is 1.
  static ConePoint unit(std::size_t rows) { return {1, rows > 1 ? 1.0 : 0.0, 0}; }
  /// An estimate of the dual point at the solution, where in each coordinate u or r is 0, from
  /// points u and r near it: each coordinate of r that is smaller than that of u is set to 0.
  static ConePoint without_open_part(const ConePoint& u, const ConePoint& r) {
    ConePoint left{};
    for (std::size_t k = 0; k < 3; ++k) left[k] = u[k] > r[k] ? 0 : r[k];
    return left;
  }
  /// The coordinates of a point with these components in two dimensions. The same function computes
  /// components from coordinates, because it is its own inverse.
  static ConePoint coordinates(const ConePoint& x) {
    const double half = std::numbers::sqrt2 / 2;
    return {half * (x[0] + x[1]), half * (x[0] - x[1]), 0};
  }
};

}  // namespace viscontact::particles
