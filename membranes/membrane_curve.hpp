// The closed curve through the beads of a membrane in a fluid, docs/physics.md (8.2) and (8.3).
// Users' programs compile without Eigen, so that no public header may include this one.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <numbers>

#include "viscontact/membranes/membrane_shape.hpp"

namespace viscontact::particles {

inline constexpr double kTwoPi = 2 * std::numbers::pi;

/// The value [1] at the angle `theta` [rad] of the trigonometric polynomial of least degree that is
/// 1 at the angle 0 and 0 at the other angles 2 pi k/beads; or of its derivative of the order
/// `derivative`, 0 to 2. The interpolation of values f_k at the angles 2 pi k/beads is the sum of
/// f_k cardinal(beads, theta - 2 pi k/beads, 0).
double cardinal(int beads, double theta, int derivative);

/// Curves through N >= 3 beads. The parameter of a curve is s in [0, 2 pi), and bead k (from 0) is
/// at s = 2 pi k/N. An array of positions has x of all beads and then y of all: 2 N numbers [L].
/// Derivatives of a curve with a speed of 0 are NaN or infinite.
class MembraneCurve {
 public:
  explicit MembraneCurve(int beads);

  int beads() const { return n_; }  ///< N

  /// The speeds |dx/ds| at the parameters halfway between beads: N numbers [L], of which number k
  /// is the speed after bead k. A curve of the perimeter P whose speeds stay P/(2 pi) does not
  /// stretch. Speeds are not taken at the beads, because a displacement that changes its sign from
  /// bead to bead has the derivative 0 there.
  Eigen::VectorXd speeds(const Eigen::VectorXd& positions) const;
  /// Derivatives of the speeds with respect to the positions [1]: N rows, 2 N columns.
  Eigen::MatrixXd speed_rows(const Eigen::VectorXd& positions) const;
  /// Second derivatives of the sum of factor k times speed k over all k, a symmetric matrix with 2
  /// N rows [1/L, times the unit of `factors`].
  Eigen::MatrixXd speeds_hessian(const Eigen::VectorXd& positions,
                                 const Eigen::VectorXd& factors) const;
  /// The mean of the speeds times 2 pi [L].
  double perimeter(const Eigen::VectorXd& positions) const;

  /// Area inside [L^2], > 0 if the beads go around counter-clockwise.
  double area(const Eigen::VectorXd& positions) const;
  /// Derivatives of the area with respect to the positions, 2 N numbers [L].
  Eigen::VectorXd area_row(const Eigen::VectorXd& positions) const;

  /// Second derivatives of the area [1], a symmetric matrix with 2 N rows.
  Eigen::MatrixXd area_hessian() const;

  /// Integral of curvature^2/2 along the curve [1/L], computed from the values at the beads.
  double bending_energy(const Eigen::VectorXd& positions) const;
  /// Derivatives of bending_energy(), 2 N numbers [1/L^2].
  Eigen::VectorXd bending_gradient(const Eigen::VectorXd& positions) const;
  /// Second derivatives of bending_energy(), a symmetric matrix with 2 N rows [1/L^3].
  Eigen::MatrixXd bending_hessian(const Eigen::VectorXd& positions) const;

  /// First derivatives of x and y with respect to s at the beads [L]: N rows, 2 columns.
  Eigen::MatrixXd tangents(const Eigen::VectorXd& positions) const;

 private:
  int n_;
  // N x N matrices that give derivatives with respect to s from values at the beads: of first and
  // second order at the beads, and of first order halfway between them.
  Eigen::MatrixXd first_, second_, first_halfway_;
};

/// Moves the positions as little as possible until all speeds are `perimeter`/(2 pi) [L] and the
/// area is `area` [L^2], to rounding errors. Returns false if Newton's method finds no such
/// positions in 50 rounds; `positions` are then undefined.
bool restore_lengths_and_area(const MembraneCurve& curve, double perimeter, double area,
                              Eigen::VectorXd& positions);

/// The centre of the area inside a line [L], and the second moments about it [L^4].
struct AreaMoments {
  double x = 0,   ///< of the centre [L]
      y = 0;      ///< of the centre [L]
  double xx = 0,  ///< integral of x^2 over the area, with x measured from the centre [L^4]
      yy = 0,     ///< of y^2
      xy = 0;     ///< of x y
  /// The angle from the direction of x to the long axis, in (-pi/2, pi/2] [rad].
  double inclination() const;
  /// Changes moments about another point (x, y) to those about the centre. `area` [L^2], not 0, is
  /// the area inside; mx and my are its first moments about the point [L^3].
  void move_to_centre(double area, double mx, double my);
};

/// What measure() must know of a closed line, which is a MembraneCurve or the polygon of
/// necklace.hpp.
struct MeasuredLine {
  double area = 0;       ///< area inside [L^2]
  double perimeter = 0;  ///< length of the line [L]
  /// Moments of the area inside if the beads are at the given positions.
  std::function<AreaMoments(const Eigen::VectorXd&)> moments;
  /// Line integral of the tangential velocity for velocities of the beads [L^2/T].
  std::function<double(const Eigen::VectorXd&)> circulation;
};

/// `positions` [L] and `velocities` [L/T] of the beads have 2 N numbers, x of all beads and then y;
/// if `velocities` is empty or uniform, membrane_speed and tank_treading_frequency of the result
/// are 0.
MembraneMeasures measure(const MeasuredLine& line, const Eigen::VectorXd& positions,
                         const Eigen::VectorXd& velocities);
MembraneMeasures measure(const MembraneCurve& curve, const Eigen::VectorXd& positions,
                         const Eigen::VectorXd& velocities);

}  // namespace viscontact::particles
