// Jeffrey & Onishi 1984 and Jeffrey 1992 near contact, in the form (9.5).
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "viscontact/suspensions/pair_terms.hpp"

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

}  // namespace viscontact::suspensions
