// The second-order cone (x_1^2 + x_2^2)^(1/2) <= x_0 of up to three dimensions, with the operations
// that the method of interior points needs: products, the distance to the boundary, and the scaling
// of Nesterov & Todd between a point of the cone and a dual one (Alizadeh & Goldfarb 2003,
// "Second-order cone programming"; Vandenberghe 2010, "The CVXOPT linear and quadratic cone program
// solvers"). In one dimension the cone is x_0 >= 0, and in two dimensions |x_1| <= x_0, which are
// two linear conditions.
//
// The three numbers of a point have the same unit, the square root of that of an energy in
// interior_points.hpp, which uses this header. Nothing is checked or thrown: operations that need a
// point inside the cone give NaN or infinity for another one. A change must keep the accuracy of
// points near the boundary, which are those near a solution.
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

/// Sum of the products of the components.
inline double inner(const ConePoint& x, const ConePoint& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/// The distance of a point from the axis of the cone.
inline double beside_axis(const ConePoint& x) { return std::hypot(x[1], x[2]); }

/// x_0^2 - x_1^2 - x_2^2, which is > 0 inside the cone and 0 on its boundary. The product of two
/// factors has fewer rounding errors than the difference of squares.
inline double determinant(const ConePoint& x) {
  const double beside = beside_axis(x);
  return (x[0] - beside) * (x[0] + beside);
}

/// The product of the Jordan algebra of the cone: (x.y, x_0 y_1 + y_0 x_1, x_0 y_2 + y_0 x_2).
inline ConePoint jordan_product(const ConePoint& x, const ConePoint& y) {
  return {inner(x, y), x[0] * y[1] + y[0] * x[1], x[0] * y[2] + y[0] * x[2]};
}

/// The y with jordan_product(x, y) = z, for an x inside the cone.
inline ConePoint jordan_quotient(const ConePoint& z, const ConePoint& x) {
  const double y = (x[0] * z[0] - x[1] * z[1] - x[2] * z[2]) / determinant(x);
  return {y, (z[1] - y * x[1]) / x[0], (z[2] - y * x[2]) / x[0]};
}

/// The largest t with x + t d in the cone, for an x inside it; infinity if there is none.
inline double length_to_boundary(const ConePoint& x, const ConePoint& d) {
  double length = std::numeric_limits<double>::infinity();
  if (d[0] < 0) length = -x[0] / d[0];
  // The boundary is at a root of a t^2 + 2 b t + c, the determinant of x + t d. The formula avoids
  // the difference of nearly equal numbers.
  const double a = determinant(d), b = x[0] * d[0] - x[1] * d[1] - x[2] * d[2], c = determinant(x);
  const double square = b * b - a * c;
  if (!(square >= 0)) return length;
  const double sum = -(b + std::copysign(std::sqrt(square), b));
  for (const double root : {sum / a, c / sum})
    if (root > 0 && root < length) length = root;
  return length;
}

/// The scaling of a point u and a dual point r, both inside the cone: the symmetric matrix W with
/// W^-1 u = W r that maps the cone onto itself. W is size_ times a matrix that depends on point_.
class ConeScaling {
 public:
  ConeScaling() = default;
  /// For points inside the cone.
  ConeScaling(const ConePoint& u, const ConePoint& r) {
    const double of_u = std::sqrt(determinant(u)), of_r = std::sqrt(determinant(r));
    size_ = std::sqrt(of_u / of_r);
    const double length = std::sqrt(2 * (1 + inner(u, r) / (of_u * of_r)));
    for (std::size_t k = 0; k < 3; ++k)
      point_[k] = (u[k] / of_u + (k == 0 ? 1 : -1) * r[k] / of_r) / length;
  }

  /// W x.
  ConePoint times(const ConePoint& x) const { return product(x, size_, 1); }
  /// W^-1 x.
  ConePoint divide(const ConePoint& x) const { return product(x, 1 / size_, -1); }

  /// (W^2 + shift I)^-1, row by row, for a number shift >= 0. It is computed from the eigenvalues
  /// of W^2, so that points near the boundary of the cone lose no digits.
  std::array<ConePoint, 3> inverse_square(double shift) const {
    const auto [along, against, across, direction] = eigenvalues(shift);
    std::array<ConePoint, 3> inverse =
        beside(1 / along / 2 + 1 / against / 2, 1 / across, direction);
    inverse[0][0] = (1 / along + 1 / against) / 2;
    for (std::size_t k = 1; k < 3; ++k)
      inverse[0][k] = inverse[k][0] = (1 / along - 1 / against) / 2 * direction[k];
    return inverse;
  }
  /// The inverse of the matrix that remains of W^2 + shift I without its first row and column. Its
  /// entries are in rows and columns 1 and 2 of the result; row and column 0 are 0.
  std::array<ConePoint, 3> inverse_square_beside(double shift) const {
    const auto [along, against, across, direction] = eigenvalues(shift);
    return beside(2 / (along + against), 1 / across, direction);
  }
  /// (W^2)_01 x_1 + (W^2)_02 x_2.
  double square_along(const ConePoint& x) const {
    const auto [along, against, across, direction] = eigenvalues(0);
    return (along - against) / 2 * (direction[1] * x[1] + direction[2] * x[2]);
  }

 private:
  // Eigenvalues of W^2 + shift I: `along` of the vector (1, direction), `against` of (1,
  // -direction), and `across` of the vector at right angles to both.
  struct Eigenvalues {
    double along, against, across;
    ConePoint direction;
  };
  Eigenvalues eigenvalues(double shift) const {
    const double length = beside_axis(point_), grown = point_[0] + length, square = size_ * size_;
    const ConePoint direction =
        length > 0 ? ConePoint{0, point_[1] / length, point_[2] / length} : ConePoint{0, 1, 0};
    return {square * grown * grown + shift, square / (grown * grown) + shift, square + shift,
            direction};
  }
  // The matrix in rows and columns 1 and 2 that has the eigenvalue `along` for the vector
  // `direction`, and `across` for the vector at right angles to it.
  static std::array<ConePoint, 3> beside(double along, double across, const ConePoint& direction) {
    std::array<ConePoint, 3> matrix{};
    for (std::size_t k = 1; k < 3; ++k)
      for (std::size_t l = 1; l < 3; ++l)
        matrix[k][l] = (along - across) * direction[k] * direction[l] + (k == l ? across : 0);
    return matrix;
  }
  ConePoint product(const ConePoint& x, double factor, double sign) const {
    const double beside = point_[1] * x[1] + point_[2] * x[2];
    const double along = sign * x[0] + beside / (1 + point_[0]);
    return {factor * (point_[0] * x[0] + sign * beside), factor * (x[1] + point_[1] * along),
            factor * (x[2] + point_[2] * along)};
  }

  double size_ = 1;
  ConePoint point_{1, 0, 0};  // of determinant 1
};

/// The operations that interior points need on a cone, for a second-order cone.
struct SecondOrderCone {
  using Scaling = ConeScaling;  ///< of Nesterov & Todd
  /// jordan_product().
  static ConePoint product(const ConePoint& x, const ConePoint& y) { return jordan_product(x, y); }
  /// jordan_quotient().
  static ConePoint quotient(const ConePoint& z, const ConePoint& x) {
    return jordan_quotient(z, x);
  }
  /// particles::length_to_boundary(); the number of rows, which LinearCones needs, is not used.
  static double length_to_boundary(const ConePoint& x, const ConePoint& d, std::size_t) {
    return particles::length_to_boundary(x, d);
  }
  /// The unit of the product: product(unit, x) = x.
  static ConePoint unit(std::size_t) { return {1, 0, 0}; }
  /// An estimate of r at the solution, where u.r = 0, for points u and r near it: 0 if u is inside
  /// the cone there, that is if its distance from the boundary exceeds the size of r; else r.
  static ConePoint without_open_part(const ConePoint& u, const ConePoint& r) {
    return u[0] - beside_axis(u) > r[0] + beside_axis(r) ? ConePoint{} : r;
  }
  /// The coordinates in which the other functions take points. Here they are the components; the
  /// same function computes components from coordinates.
  static ConePoint coordinates(const ConePoint& x) { return x; }
};

/// The operations of SecondOrderCone for cones of one and two dimensions. In two dimensions, |x_1|
/// <= x_0, points have the coordinates (x_0 + x_1)/2^0.5 and (x_0 - x_1)/2^0.5. Both are positive
/// inside the cone, and points near the boundary lose no digits in them. In one dimension the only
/// coordinate is x_0. Coordinates that a cone does not have are 0.
struct LinearCones {
  /// The scaling W of a point u and a dual point r. It is diagonal: the roots of the ratios of
  /// their coordinates.
  class Scaling {
   public:
    Scaling() = default;
    /// For points inside the cone.
    Scaling(const ConePoint& u, const ConePoint& r) {
      for (std::size_t k = 0; k < 3; ++k) square_[k] = r[k] > 0 ? u[k] / r[k] : 1;
    }
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
    /// (W^2 + shift I)^-1 in coordinates, row by row.
    std::array<ConePoint, 3> inverse_square(double shift) const {
      std::array<ConePoint, 3> inverse{};
      for (std::size_t k = 0; k < 3; ++k) inverse[k][k] = 1 / (square_[k] + shift);
      return inverse;
    }
    /// The function of ConeScaling, which takes and gives components, not coordinates.
    std::array<ConePoint, 3> inverse_square_beside(double shift) const {
      std::array<ConePoint, 3> inverse{};
      inverse[1][1] = 2 / (square_[0] + square_[1] + 2 * shift);
      return inverse;
    }
    /// The function of ConeScaling, of components, not coordinates.
    double square_along(const ConePoint& x) const { return (square_[0] - square_[1]) / 2 * x[1]; }

   private:
    ConePoint square_{1, 1, 1};
  };
  /// Products of the coordinates.
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
  /// The largest t with x + t d in the cone, for an x inside it that has `rows` coordinates.
  static double length_to_boundary(const ConePoint& x, const ConePoint& d, std::size_t rows) {
    double length = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < rows; ++k)
      if (d[k] < 0) length = std::min(length, -x[k] / d[k]);
    return length;
  }
  /// The unit of the product in a cone with `rows` coordinates: 1 for each of them.
  static ConePoint unit(std::size_t rows) { return {1, rows > 1 ? 1.0 : 0.0, 0}; }
  /// An estimate of r at the solution, where the product of u and r is 0, for points u and r near
  /// it: each coordinate of r that is smaller than that of u is set to 0.
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
