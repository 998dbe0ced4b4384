// Exact resistance of two spheres, or of a sphere in a round wall, that approach each other.
#pragma once

namespace viscontact {

/// R/(6 pi mu r_eff) at the gap `width` r_eff; `ratio` is the smaller radius over the larger one,
/// and the spheres have opposite forces. If `ratio` is negative, it is minus the sphere's radius
/// over that of the wall around it; then the gap is width (1 + ratio)^2 r_eff, and the result (1 +
/// ratio)^2 R/(6 pi mu r_eff). From the factors of bispherical.hpp, with their ranges.
double exact_squeeze(double ratio, double width);

}  // namespace viscontact
