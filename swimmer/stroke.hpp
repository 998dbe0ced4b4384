// Strokes, which are closed paths of a swimmer's arms as functions of time, and the quadrature for
// integrals along strokes. A swimmer is a line of spheres, and an arm is the distance between the
// centres of neighbours. Lengths and times are in the units of the case. swimmer_case.cpp makes
// strokes, and swim.hpp and polynomial_loop.hpp integrate them. Samples that are no closed loop
// throw Error(kBadInput); nothing else is checked. A change must keep that legs follow each other
// without a pause, and the points of the quadrature, on which the last digits of results depend.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace viscontact::swimmer {

/// The arms and their velocities at one time.
struct ArmState {
  Eigen::VectorXd arms;   ///< x [L], a number for each arm in the order of the spheres
  Eigen::VectorXd rates;  ///< dx/dt [L/T], a number for each arm
};

/// A part of a stroke on which the arms are a smooth function of time.
struct StrokeLeg {
  double start = 0,                            ///< time at which the leg begins [T], < end
      end = 0;                                 ///< time at which it ends [T]
  std::function<ArmState(double time)> state;  ///< the arms at a time [T] from start to end
};

/// A closed stroke: the legs follow each other from time 0 to the period, and the last one ends at
/// the shape with which the first one starts.
struct Stroke {
  double period = 0;            ///< [T], > 0
  std::vector<StrokeLeg> legs;  ///< in order of time, at least one
};

/// Straight legs from corner to corner [L] and back to the first corner in `period` [T] > 0. Each
/// leg takes the same time, at constant velocity. There must be at least two corners, all with the
/// same number of arms (not checked).
Stroke polygon_stroke(const std::vector<Eigen::VectorXd>& corners, double period);

/// Straight legs between samples of the arms [L] at rising times [T]; the velocity is constant on
/// each leg. There must be at least two samples, a time for each sample, and the same number of
/// arms in each (not checked). The stroke begins at the first sample, whose time becomes 0, and the
/// last sample closes the loop. Throws Error(kBadInput) if an arm of the last sample differs from
/// that of the first sample by more than 1e-9 of the largest arm.
Stroke sampled_stroke(const std::vector<double>& times,
                      const std::vector<Eigen::VectorXd>& samples);

/// The arms x_k = centre_k + semi_axes_k cos(2 pi t/period + phase_k) at the time t, with centre
/// and semi-axes in [L], phases in radians and `period` [T] > 0: an ellipse if there are two arms.
/// The three vectors have a number for each arm, at least one (not checked).
Stroke elliptic_stroke(const Eigen::VectorXd& centre, const Eigen::VectorXd& semi_axes,
                       const Eigen::VectorXd& phases, double period);

/// Points and weights of a Gauss-Legendre quadrature on [0, 1], without dimension.
struct GaussRule {
  Eigen::VectorXd points,  ///< in (0, 1)
      weights;             ///< > 0, with the sum 1
};

/// The rule with `count` > 0 points (not checked), which rise. It is exact for polynomials of
/// degree 2 count - 1.
GaussRule gauss_rule(int count);

}  // namespace viscontact::swimmer
