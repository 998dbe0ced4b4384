// What a stroke does: displacement, energy, positions, forces and power, and how exact they are.
// Lengths, masses and times are in the units of the fit and of the stroke. The commands `swimmer`
// and `sweep` use it. A change may alter sums by rounding errors only.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "viscontact/swimmer/shape_mechanics.hpp"
#include "viscontact/swimmer/stroke.hpp"

namespace viscontact::swimmer {

/// The swimmer at one time.
struct SwimRow {
  double time = 0;         ///< [T]
  Eigen::VectorXd arms;    ///< x [L]
  double position = 0;     ///< of the middle sphere [L], 0 at the beginning
  Eigen::VectorXd forces;  ///< of each sphere on the fluid [M L/T^2], towards the last sphere
  double power = 0;        ///< of the swimmer [M L^2/T^3], >= 0
};

/// The sums over one period.
struct SwimSums {
  double displacement = 0;  ///< [L], > 0 towards the last sphere
  double energy = 0;        ///< [M L^2/T^2]: the integral of the power
  /// The least energy of any time law with this loop and period [M L^2/T^2]; that law has constant
  /// power.
  double energy_at_constant_power = 0;
  /// Lighthill's efficiency [1]: power to tow the rigid swimmer at its mean velocity, with the mean
  /// drag of its shapes, over the mean power (Lighthill 1952, Commun. Pure Appl. Math. 5, 109).
  double efficiency = 0;
};

/// Integrates one period of a stroke by Gauss-Legendre quadrature on each leg; the number of points
/// is doubled until the sums change by less than 1e-12 of themselves (the displacement: of the
/// length of the path of the arms). Throws Error(kBadInput) if the stroke leaves the table, and
/// Error(kNotConverged) if the sums do not converge.
SwimSums swim_sums(const Swimmer& swimmer, const Stroke& stroke);

/// The swimmer at about `intervals` + 1 times, or more: each leg has times at its beginning, at its
/// end, and at equal distances between. Throws Error(kBadInput) if the stroke leaves the table.
std::vector<SwimRow> swim_rows(const Swimmer& swimmer, const Stroke& stroke, int intervals);

/// Estimates of the errors of SwimSums, >= 0.
struct SwimErrors {
  double displacement = 0;  ///< [L]
  double energy = 0;        ///< [M L^2/T^2]
};

/// The errors of the sums of a stroke: for each fit of lower degree the change of the sums, plus
/// twice the root mean square of their changes by the errors of the table (fit/fit_resistance.hpp
/// makes both kinds of fits). For the optimal stroke, `multiplier` is OptimalStroke::multiplier
/// over the period, and the error of the energy is that of an optimum that has the asked
/// displacement in the changed fit; for any other stroke `multiplier` is 0.
SwimErrors swim_errors(const SwimSums& sums, const Stroke& stroke,
                       const std::vector<ResistanceFit>& lower_degrees,
                       const std::vector<ResistanceFit>& table_errors, double multiplier = 0);

}  // namespace viscontact::swimmer
