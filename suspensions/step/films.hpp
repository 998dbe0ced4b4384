// The film of a pair in a step, (9.12).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "viscontact/suspensions/step/step_parts.hpp"

namespace viscontact::suspensions {

/// Force f = [alpha ln(w'/w)/h + constant] n on the fluid by the second sphere, > 0 where gaps
/// open, linearised at the width `at`. The width w of a film is q + delta. Without a film alpha is
/// 0. A film has what each linear problem reads, and is as long as a line of the caches.
struct Film {
  double alpha = 0;     // [M L/T]
  double start = 0;     // w [L]
  double constant = 0;  // [M L/T^2]
  double width = 0;     // w' by the present motions [L]
  double base = 0;      // the linear width without motions: w' is this + h opening [L]
  double at = 0;        // [L]
  double load = 0;      // linearised force without motions, with that of the contact
  std::int32_t contact = -1;

  double force(double h) const { return alpha * std::log(at / start) / h + constant; }
  // The same at a width, which may be far below the last one; linear below the width `solid`.
  double force_at(double to, double solid, double h) const {
    const double bounded = std::max(to, least(solid));
    return alpha * (std::log(bounded / start) + (to - bounded) / bounded) / h + constant;
  }
  // The least width at which it is linearised next.
  double least(double solid) const { return std::max(StepTuning::kLeastPart * at, solid); }
};

/// What a film adds to the strain.
struct FilmStrain {
  double arm = 0;     // the strain's share in the motion of the surfaces [L]
  double excess = 0;  // Film::constant over the strain along the normal [M L/T]
  double axial = 0;   // the stress beside that of the force, over the strain [M L^2/T]
};

}  // namespace viscontact::suspensions
