// Jeffrey & Onishi 1984 and Jeffrey 1992 near contact, in the form (9.5).
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "viscontact/suspensions/pairs/pair_terms.hpp"

namespace viscontact::suspensions {

BalancedTerms near_contact_terms(double viscosity, double radius1, double radius2, double gap,
                                 double regularisation) {
  using std::numbers::pi;
  const double sum = radius1 + radius2, reduced = radius1 * radius2 / sum;
  const double q = 2 * gap / sum + regularisation;
  assert(q > 0);
  const double log = std::max(-std::log(q), 0.0);
  BalancedTerms terms;
  terms.arm = sum;
  terms.squeeze = 12 * pi * viscosity * reduced * reduced / (sum * q);
  const double turn = pi * viscosity * reduced * log;
  terms.turn_first = 16.0 / 5 * radius1 * radius1 * turn;
  terms.turn_mixed = 4.0 / 5 * radius1 * radius2 * turn;
  terms.turn_second = 16.0 / 5 * radius2 * radius2 * turn;
  // The strain moves the surfaces at contact, d + sum E.n, so that W becomes W + n x E.n.
  terms.strain_squeeze = sum * terms.squeeze;
  terms.strain_turn_first = -(terms.turn_first + terms.turn_mixed);
  terms.strain_turn_second = -(terms.turn_mixed + terms.turn_second);
  terms.stress_axial = sum * sum * terms.squeeze;
  terms.stress_transverse = terms.turn_first + 2 * terms.turn_mixed + terms.turn_second;
  return terms;
}

BalancedTerms near_contact_plane_terms(double viscosity, double radius, double gap,
                                       double regularisation) {
  using std::numbers::pi;
  const double q = gap / radius + regularisation;
  assert(q > 0);
  const double log = std::max(-std::log(q), 0.0);
  BalancedTerms terms;
  terms.arm = radius;
  terms.squeeze = 6 * pi * viscosity * radius / q;
  // The limit of a large second sphere: its surface moves with -W a against the plane, and the
  // terms of w.w, w.W and W.W are 16/5, -4/5 and 16/5.
  const double turn = 4.0 / 5 * pi * viscosity * radius * radius * radius * log;
  terms.turn_first = 4 * turn;
  terms.turn_mixed = -3 * turn;
  terms.turn_second = 6 * turn;
  // The sphere turns by n x E.n and moves by twice this times the arm in a shear along the plane.
  terms.strain_squeeze = radius * terms.squeeze;
  terms.strain_turn_first = -(terms.turn_first + 2 * terms.turn_mixed);
  terms.strain_turn_second = -(terms.turn_mixed + 2 * terms.turn_second);
  terms.stress_axial = radius * radius * terms.squeeze;
  terms.stress_transverse = terms.turn_first + 4 * terms.turn_mixed + 4 * terms.turn_second;
  return terms;
}

}  // namespace viscontact::suspensions
