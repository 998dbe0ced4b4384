// Strokes, which are closed paths of a swimmer's arms as functions of time, and a quadrature.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace viscontact::swimmer {

struct ArmState {
  Eigen::VectorXd arms;   ///< x [L], in the order of the spheres
  Eigen::VectorXd rates;  ///< dx/dt [L/T]
};

/// A part of a stroke on which the arms are a smooth function of time [T].
struct StrokeLeg {
  double start = 0, end = 0;
  std::function<ArmState(double time)> state;  ///< the arms at a time from start to end
};

/// A closed stroke: the legs follow each other without a pause from time 0 to the period, and the
/// last one ends at the shape with which the first one starts.
struct Stroke {
  double period = 0;            ///< [T], > 0
  std::vector<StrokeLeg> legs;  ///< in order of time, at least one
};

/// Straight legs from corner to corner [L] and back to the first corner in `period` [T]. Each leg
/// takes the same time, at constant velocity. There must be at least two corners.
Stroke polygon_stroke(const std::vector<Eigen::VectorXd>& corners, double period);

/// Straight legs between samples of the arms [L] at rising times [T]; the velocity is constant on
/// each leg. The stroke begins at the first sample, whose time becomes 0, and the last sample
/// closes the loop. Throws Error(kBadInput) if an arm of the last sample differs from that of the
/// first sample by more than 1e-9 of the largest arm.
Stroke sampled_stroke(const std::vector<double>& times,
                      const std::vector<Eigen::VectorXd>& samples);

/// The arms x_k = centre_k + semi_axes_k cos(2 pi t/period + phase_k) at the time t, with centre
/// and semi-axes in [L] and phases in radians: an ellipse if there are two arms.
Stroke elliptic_stroke(const Eigen::VectorXd& centre, const Eigen::VectorXd& semi_axes,
                       const Eigen::VectorXd& phases, double period);

/// Points and weights of a Gauss-Legendre quadrature on [0, 1].
struct GaussRule {
  Eigen::VectorXd points,  ///< in (0, 1)
      weights;             ///< > 0, with the sum 1
};

/// The rule with `count` points, which rise. It is exact for polynomials of degree 2 count - 1.
GaussRule gauss_rule(int count);

}  // namespace viscontact::swimmer
