// Displacement, energy, forces and power of a stroke of a swimmer, and error estimates.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "viscontact/swimmer/shape_mechanics.hpp"
#include "viscontact/swimmer/stroke.hpp"

namespace viscontact::swimmer {

struct SwimRow {
  double time = 0;       ///< [T], from 0 to the period
  Eigen::VectorXd arms;  ///< x [L]
  double position = 0;   ///< position of the middle sphere [L], 0 at the beginning
  /// Force of each sphere on the fluid [M L/T^2], > 0 towards the last sphere; their sum is 0.
  Eigen::VectorXd forces;
  double power = 0;  ///< power that the swimmer needs [M L^2/T^3]
};

/// The sums over one period, in the units of the fit, which must be those of the stroke.
struct SwimSums {
  double displacement = 0;  ///< [L], > 0 towards the last sphere
  double energy = 0;        ///< the integral of the power [M L^2/T^2]
  /// The least energy [M L^2/T^2] with which the swimmer can run through this loop in this period:
  /// that at constant power.
  double energy_at_constant_power = 0;
  /// Lighthill's efficiency [1]: the power to tow the rigid swimmer at its mean velocity, with the
  /// mean drag of its shapes, divided by the mean power (Lighthill 1952, Commun. Pure Appl. Math.
  /// 5, 109). It is 0 if the energy is 0.
  double efficiency = 0;
};

/// Integrates one period of a stroke by Gauss-Legendre quadrature on each leg; the number of points
/// is doubled until energies change by a relative 1e-12 at most, and the displacement by less than
/// 1e-13 of the length of the path of the arms. Throws Error(kBadInput) if the stroke leaves the
/// table, and Error(kNotConverged) if the sums of a leg do not converge with 512 points.
SwimSums swim_sums(const Swimmer& swimmer, const Stroke& stroke);

/// The state of the swimmer at about `intervals` + 1 times or more, in order of time. Each leg has
/// rows at its beginning, at its end, and at equal distances between, at most period/intervals
/// apart. Therefore two rows have the same time where two legs meet. Throws Error(kBadInput) if the
/// stroke leaves the table.
std::vector<SwimRow> swim_rows(const Swimmer& swimmer, const Stroke& stroke, int intervals);

/// Estimates of the errors of SwimSums.
struct SwimErrors {
  double displacement = 0;  ///< [L]
  double energy = 0;        ///< [M L^2/T^2]
};

/// Estimates the errors of `sums`, which are swim_sums() of `stroke`, with other fits
/// (fit/fit_resistance.hpp). The error of a sum has two parts, which are added: the absolute
/// changes of the sum with all fits `lower_degrees`, and twice the root mean square of its changes
/// with the fits `table_errors`. A part whose list is empty is 0. Throws the errors of swim_sums().
///
/// For a stroke of least energy, `multiplier` is OptimalStroke::multiplier divided by the period [M
/// L/T^2]; for any other stroke it is 0. With another fit the displacement of the stroke changes,
/// too, whereas that of the optimum is prescribed; the multiplier corrects the energy for this.
SwimErrors swim_errors(const SwimSums& sums, const Stroke& stroke,
                       const std::vector<ResistanceFit>& lower_degrees,
                       const std::vector<ResistanceFit>& table_errors, double multiplier = 0);

}  // namespace viscontact::swimmer
