// The entries of a pair's matrix that are not 0 by symmetry, and their terms near contact.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace viscontact::lubrication {

/// A component of a sphere whose flow has one azimuthal mode: the velocity along z or x, the angular
/// velocity about z or y, or a strain.
enum class PairComponent { kMove, kTurn, kStrain };

/// An entry in a block of the matrix. The blocks are those of the components U_z, E_1 (axial), U_x,
/// W_y, E_2 (transverse), E_4 (twofold) and W_z (spin) of both spheres (pair_resistance.hpp).
struct PairEntryTerms {
  PairComponent row, column;
  int row_sphere, column_sphere;  ///< 0 or 1
  /// Coefficients of 1/xi, ln xi and xi ln xi for viscosity 1, radii 1 and b and xi = 2 q/(1 + b):
  /// the polynomial in b with these coefficients, times pi/(denominator (1 + b)^3). Strains are the
  /// unit tensors zz - 1/3, xz + zx and xx - yy here, and loads are E:S. Jeffrey & Onishi 1984;
  /// Jeffrey 1992. Fits of exact solutions with 33 digits at nine ratios give these integers, too.
  struct Term {
    int denominator;
    std::array<int, 7> numerator;
  };
  std::array<Term, 3> terms;
};

inline constexpr std::size_t kPairEntries = 37;

inline constexpr auto kMove = PairComponent::kMove, kTurn = PairComponent::kTurn,
                      kStrain = PairComponent::kStrain;

/// The upper triangles of the blocks, row by row: axial (4 rows), transverse (6), twofold (2), spin
/// (2).
// clang-format off
inline constexpr std::array<PairEntryTerms, kPairEntries> kPairEntryTerms = {{
    {kMove, kMove, 0, 0, {{{1, {{0, 0, 12}}}, {5, {{0, -6, -42, -6}}}, {35, {{-5, -90, 145, -90, -5}}}}}},  // axial, U1 U1
    {kMove, kStrain, 0, 0, {{{1, {{0, 0, -8}}}, {5, {{0, 4, 48, -16}}}, {105, {{10, 362, -906, 1132, -130}}}}}},  // axial, U1 E1
    {kMove, kMove, 0, 1, {{{1, {{0, 0, -12}}}, {5, {{0, 6, 42, 6}}}, {35, {{5, 90, -145, 90, 5}}}}}},  // axial, U1 U2
    {kMove, kStrain, 0, 1, {{{1, {{0, 0, 0, -8}}}, {5, {{0, 0, -16, 48, 4}}}, {105, {{0, -130, 1132, -906, 362, 10}}}}}},  // axial, U1 E2
    {kStrain, kStrain, 0, 0, {{{3, {{0, 0, 16}}}, {15, {{0, -8, -136, 72}}}, {315, {{-20, -1088, 3324, -5288, 1660}}}}}},  // axial, E1 E1
    {kStrain, kMove, 0, 1, {{{1, {{0, 0, 8}}}, {5, {{0, -4, -48, 16}}}, {105, {{-10, -362, 906, -1132, 130}}}}}},  // axial, E1 U2
    {kStrain, kStrain, 0, 1, {{{3, {{0, 0, 0, 16}}}, {15, {{0, 0, 32, -136, 32}}}, {315, {{0, 260, -3328, 4164, -3328, 260}}}}}},  // axial, E1 E2
    {kMove, kMove, 1, 1, {{{1, {{0, 0, 12}}}, {5, {{0, -6, -42, -6}}}, {35, {{-5, -90, 145, -90, -5}}}}}},  // axial, U2 U2
    {kMove, kStrain, 1, 1, {{{1, {{0, 0, 0, 8}}}, {5, {{0, 0, 16, -48, -4}}}, {105, {{0, 130, -1132, 906, -362, -10}}}}}},  // axial, U2 E2
    {kStrain, kStrain, 1, 1, {{{3, {{0, 0, 0, 0, 16}}}, {15, {{0, 0, 0, 72, -136, -8}}}, {315, {{0, 0, 1660, -5288, 3324, -1088, -20}}}}}},  // axial, E2 E2
    {kMove, kMove, 0, 0, {{{1, {{0}}}, {5, {{0, -16, -8, -16}}}, {125, {{-64, 180, -232, 180, -64}}}}}},  // transverse, U1 U1
    {kMove, kTurn, 0, 0, {{{1, {{0}}}, {5, {{0, -16, -20, -4}}}, {125, {{-64, 2, -100, -252, -86}}}}}},  // transverse, U1 W1
    {kMove, kStrain, 0, 0, {{{1, {{0}}}, {5, {{0, 16, -4, 28}}}, {125, {{64, -358, 1064, -712, 442}}}}}},  // transverse, U1 E1
    {kMove, kMove, 0, 1, {{{1, {{0}}}, {5, {{0, 16, 8, 16}}}, {125, {{64, -180, 232, -180, 64}}}}}},  // transverse, U1 U2
    {kMove, kTurn, 0, 1, {{{1, {{0}}}, {5, {{0, 0, -4, -20, -16}}}, {125, {{0, -86, -252, -100, 2, -64}}}}}},  // transverse, U1 W2
    {kMove, kStrain, 0, 1, {{{1, {{0}}}, {5, {{0, 0, 28, -4, 16}}}, {125, {{0, 442, -712, 1064, -358, 64}}}}}},  // transverse, U1 E2
    {kTurn, kTurn, 0, 0, {{{1, {{0}}}, {5, {{0, -16, -32, -16}}}, {125, {{-64, -176, -424, -576, -264}}}}}},  // transverse, W1 W1
    {kTurn, kStrain, 0, 0, {{{1, {{0}}}, {5, {{0, 16, 8, -8}}}, {125, {{64, -180, 476, 728, 8}}}}}},  // transverse, W1 E1
    {kTurn, kMove, 0, 1, {{{1, {{0}}}, {5, {{0, 16, 20, 4}}}, {125, {{64, -2, 100, 252, 86}}}}}},  // transverse, W1 U2
    {kTurn, kTurn, 0, 1, {{{1, {{0}}}, {5, {{0, 0, -4, -8, -4}}}, {125, {{0, -86, -124, -76, -124, -86}}}}}},  // transverse, W1 W2
    {kTurn, kStrain, 0, 1, {{{1, {{0}}}, {5, {{0, 0, 28, 32, 4}}}, {125, {{0, 442, 72, -76, 380, 86}}}}}},  // transverse, W1 E2
    {kStrain, kStrain, 0, 0, {{{1, {{0}}}, {5, {{0, -16, 16, -64}}}, {125, {{-64, 536, -2352, 3152, -1576}}}}}},  // transverse, E1 E1
    {kStrain, kMove, 0, 1, {{{1, {{0}}}, {5, {{0, -16, 4, -28}}}, {125, {{-64, 358, -1064, 712, -442}}}}}},  // transverse, E1 U2
    {kStrain, kTurn, 0, 1, {{{1, {{0}}}, {5, {{0, 0, 4, 32, 28}}}, {125, {{0, 86, 380, -76, 72, 442}}}}}},  // transverse, E1 W2
    {kStrain, kStrain, 0, 1, {{{1, {{0}}}, {5, {{0, 0, -28, 40, -28}}}, {125, {{0, -442, 1496, -3804, 1496, -442}}}}}},  // transverse, E1 E2
    {kMove, kMove, 1, 1, {{{1, {{0}}}, {5, {{0, -16, -8, -16}}}, {125, {{-64, 180, -232, 180, -64}}}}}},  // transverse, U2 U2
    {kMove, kTurn, 1, 1, {{{1, {{0}}}, {5, {{0, 0, 4, 20, 16}}}, {125, {{0, 86, 252, 100, -2, 64}}}}}},  // transverse, U2 W2
    {kMove, kStrain, 1, 1, {{{1, {{0}}}, {5, {{0, 0, -28, 4, -16}}}, {125, {{0, -442, 712, -1064, 358, -64}}}}}},  // transverse, U2 E2
    {kTurn, kTurn, 1, 1, {{{1, {{0}}}, {5, {{0, 0, 0, -16, -32, -16}}}, {125, {{0, 0, -264, -576, -424, -176, -64}}}}}},  // transverse, W2 W2
    {kTurn, kStrain, 1, 1, {{{1, {{0}}}, {5, {{0, 0, 0, -8, 8, 16}}}, {125, {{0, 0, 8, 728, 476, -180, 64}}}}}},  // transverse, W2 E2
    {kStrain, kStrain, 1, 1, {{{1, {{0}}}, {5, {{0, 0, 0, -64, 16, -16}}}, {125, {{0, 0, -1576, 3152, -2352, 536, -64}}}}}},  // transverse, E2 E2
    {kStrain, kStrain, 0, 0, {{{1, {{0}}}, {1, {{0}}}, {1, {{0, 0, 4, 0, 4}}}}}},  // twofold, E1 E1
    {kStrain, kStrain, 0, 1, {{{1, {{0}}}, {1, {{0}}}, {1, {{0, 0, -4, 0, -4}}}}}},  // twofold, E1 E2
    {kStrain, kStrain, 1, 1, {{{1, {{0}}}, {1, {{0}}}, {1, {{0, 0, 4, 0, 4}}}}}},  // twofold, E2 E2
    {kTurn, kTurn, 0, 0, {{{1, {{0}}}, {1, {{0}}}, {1, {{0, 0, 2, 4, 2}}}}}},  // spin, W1 W1
    {kTurn, kTurn, 0, 1, {{{1, {{0}}}, {1, {{0}}}, {1, {{0, 0, -2, -4, -2}}}}}},  // spin, W1 W2
    {kTurn, kTurn, 1, 1, {{{1, {{0}}}, {1, {{0}}}, {1, {{0, 0, 2, 4, 2}}}}}},  // spin, W2 W2
}};
// clang-format on

/// The variables in which the rest of the entries is interpolated, for the radii 1 and b >= 1 and
/// the gap q > 0. With u = sqrt(b), at most 10, and x = 1/(1 + q/(2 u)), which is 1 at contact and 0
/// far away, the rest has terms like (1 - x)^2 ln(1 - x). In 1 - sqrt(1 - x) it is smoother: twelve
/// polynomials have the accuracy 1e-5 there, and sixteen have 1e-3 in x.
struct PairCoordinates {
  static constexpr double kNearRatio = 10, kFarRatio = 100;

  /// ln b in a decade and 1 - sqrt(1 - x), each mapped to [-1, 1].
  double ratio = 0, gap = 0;

  PairCoordinates(double b, double q) : b_(b) {
    assert(b >= 1 && q > 0);
    const double decade = std::log(b) / std::numbers::ln10 - (b > kNearRatio ? 1 : 0);
    ratio = std::min(2 * decade - 1, 1.0);
    const double u = std::sqrt(std::min(b, kFarRatio)), to_contact = q / (2 * u + q);  // 1 - x
    gap = 1 - 2 * std::sqrt(to_contact);
    width_ = to_contact * (2 - to_contact);  // 1 - x^2 = q/u + ...
    scale_ = u / ((1 + b) / 2);              // xi u/q
  }

  /// The gap at a place of the variable.
  static double gap_at(double b, double place) {
    const double root = (1 - place) / 2, to_contact = root * root;
    return 2 * std::sqrt(std::min(b, kFarRatio)) * to_contact / (1 - to_contact);
  }

  /// Times the numerators over denominators of PairEntryTerms, the terms near contact.
  std::array<double, 3> contact_weights() const {
    const double factor = std::numbers::pi / ((1 + b_) * (1 + b_) * (1 + b_));
    const double log = std::log(width_);
    return {factor / (scale_ * width_), factor * log, factor * scale_ * width_ * log};
  }

 private:
  double b_, width_ = 0, scale_ = 0;
};

}  // namespace viscontact::lubrication
