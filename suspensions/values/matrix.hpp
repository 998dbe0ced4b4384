// The 3 x 3 matrix of suspensions.
#pragma once

#include "viscontact/particles/setting/pair_lubrication.hpp"

namespace viscontact::suspensions {

using particles::Vector;
using Matrix = particles::Gradient;  ///< of rows

}  // namespace viscontact::suspensions
