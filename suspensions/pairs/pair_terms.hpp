// The resistance of a pair of spheres in the coordinates in which it is short, (9.4) to (9.8).
#pragma once

#include <array>

#include "viscontact/lubrication/pairs/pair_resistances.hpp"
#include "viscontact/particles/setting/pair_lubrication.hpp"

namespace viscontact::suspensions {

/// With the unit normal n from sphere 1 to sphere 2, v and w the velocities and angular velocities
/// relative to the flow, d = v_2 - v_1, and W = n x d/arm the rotation of the pair, loads of the
/// spheres on the fluid follow from the power
///
///     squeeze (n.d)^2 + sum of turn_ij (w_i - W).(w_j - W) across n + spin (n.(w_2 - w_1))^2
///     + 2 strain_squeeze (n.d) nEn + 2 sum of strain_turn_i (w_i - W).(n x En)
///     + stress_axial (nEn)^2 + stress_transverse |En across n|^2 + stress_twofold E_t:E_t,
///
/// where E_t is the part of E across n without trace. No rigid motion of the pair has a load if the
/// arm is the distance of the centres.
struct BalancedTerms {
  double arm = 0;                                                      ///< [L]
  double squeeze = 0;                                                  ///< [M/T]
  double turn_first = 0, turn_mixed = 0, turn_second = 0, spin = 0;    ///< [M L^2/T]
  double strain_squeeze = 0;                                           ///< [M L/T]
  double strain_turn_first = 0, strain_turn_second = 0;                ///< [M L^2/T]
  double stress_axial = 0, stress_transverse = 0, stress_twofold = 0;  ///< [M L^2/T]
};

/// What a pair resists to its own rigid motions: the sum of the squares of the modes
///
///     axial_1 n.v_1 + axial_2 n.v_2 + axial_strain nEn
///     sum of move_i v_i + turn_i n x w_i, across n, + transverse_strain (En across n), two of them
///     spin_1 n.w_1 + spin_2 n.w_2.
struct PairDrag {
  std::array<double, 2> axial{};  ///< [(M/T)^(1/2)]
  double axial_strain = 0;
  struct Mode {
    std::array<double, 2> move{}, turn{};
    double strain = 0;
  };
  std::array<Mode, 2> transverse{};
  std::array<double, 2> spin{};
};

struct TableTerms {
  BalancedTerms balanced;
  PairDrag drag;
};

/// The terms 1/q and ln(1/q), where q > 0 is the gap in mean radii and `regularisation`. Where q > 1
/// the logarithm counts as 0. `gap` and radii are in [L].
BalancedTerms near_contact_terms(double viscosity, double radius1, double radius2, double gap,
                                 double regularisation);

/// Those of the exact pair, or of `fits`, whose gap in mean radii is increased by `regularisation`.
/// The stresses are less those of the two spheres alone.
TableTerms table_terms(double viscosity, double radius1, double radius2, double gap,
                       double regularisation, const lubrication::PairResistances* fits);

/// Those of a sphere beside a plane, the second body, which is at rest relative to the flow. Beside
/// a plane (9.4) has every resistance that is symmetric about n, because the sphere's motion alone
/// counts, so that there is no PairDrag; the loads of the sphere alone are subtracted. Here q is in
/// radii of the sphere.
BalancedTerms near_contact_plane_terms(double viscosity, double radius, double gap,
                                       double regularisation);
BalancedTerms table_plane_terms(double viscosity, double radius, double gap, double regularisation,
                                const lubrication::PairResistances* fits);

}  // namespace viscontact::suspensions
