// Where the resistances of pairs come from, if not from pair_resistance().
#pragma once

#include "viscontact/lubrication/pairs/pair_resistance.hpp"

namespace viscontact::lubrication {

class PairResistances {
 public:
  virtual ~PairResistances() = default;
  /// As pair_resistance(), of the complete form.
  virtual PairMatrix resistance(double radius1, double radius2, double gap,
                                double viscosity) const = 0;
};

}  // namespace viscontact::lubrication
