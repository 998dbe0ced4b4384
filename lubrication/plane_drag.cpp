// Three expansions of the drag factor K of a plane: near contact, far away, and in between. The
// constants are computed from Brenner's exact series and depend on each other.
#include "viscontact/lubrication/plane_drag.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace viscontact::lubrication {
namespace {

// All functions are computed from R = K - 1/eps. With x = ln eps and S(eps) = int_0^eps R,
//
//     K = 1/eps + R,   d K/dx = -1/eps + dR/dx,
//     int_1^eps K = x + S(eps) - S(1).
//
// K and dK/dx are sums of terms of equal sign (R > 0 > dR/dx) and lose no digits. R, dR/dx and the
// mean M = S/eps of R vary slowly with x, so that polynomials represent them well.

/// The coefficients of the powers 1, t, t^2, ...
template <std::size_t count>
using Polynomial = std::array<double, count>;

/// Estrin's scheme is a tree of products, which the processor computes in parallel. In Horner's
/// rule each product needs the one before it.
template <std::size_t count>
double value(const Polynomial<count>& polynomial, double t) {
  if constexpr (count == 1) {
    return polynomial[0];
  } else {
    Polynomial<(count + 1) / 2> halved;
    for (std::size_t k = 0; k < count / 2; ++k)
      halved[k] = polynomial[2 * k] + t * polynomial[2 * k + 1];
    if constexpr (count % 2 == 1) halved.back() = polynomial.back();
    return value(halved, t * t);
  }
}

// Near contact, for x < kNear, R is the sum over k = 0..4 of eps^k (constant_k + logarithm_k x),
// with the coefficients kConstants and kLogarithms. The term k = 5 would be 1.2e-16 at x = kNear.
constexpr double kNear = -6;
// The expansion is that of Cox & Brenner 1967 and Cooley & O'Neill 1969. The digits are those of
// data/reference/near_contact_expansion.csv.
constexpr Polynomial<5> kConstants = {0.9712799310357215124, 0.1670170048120648131,
                                      -0.0148746313563976885, 0.0026239942748169500,
                                      -0.0006614852909697309};
constexpr Polynomial<5> kLogarithms = {-1.0 / 5, -1.0 / 21, 8.0 / 1125, -15416.0 / 9095625,
                                       910732.0 / 1773646875};

// In the range between, for kNear <= x < kFar, M is a polynomial in t on each of 8 pieces of length
// 1 in x, on which t goes from -1 to 1. M is analytic for |Im x| < pi, so its Chebyshev
// coefficients of degree n fall at least like 12^-n.
constexpr double kFar = 2;
constexpr int kPieces = 8;
// Coefficients of M in powers of t, computed with mpmath in 45 digits in these steps: Brenner's
// series gives R at 30 Chebyshev nodes on each piece, and so a Chebyshev series of R. Its integral,
// from the value of S at x = -8 by the expansion near contact, divided by eps is M. The terms of
// the Chebyshev series above T_19 are left out before it is written in powers; their coefficients
// are below 2e-21.
// clang-format off
constexpr std::array<Polynomial<20>, kPieces> kMean = {{
    {2.272204722152662, -0.099586393365349857, 9.1175197429165688e-05, 1.3149216755474393e-05,
     1.3858050743829492e-06, 1.124351216675335e-07, 7.137858234159033e-09, 3.4391111711599e-10,
     1.0440064513062e-11, -9.4974728555e-14, -4.3025778715e-14, -3.960370368e-15, -2.57849364e-16,
     -1.3179902e-17, -4.89513e-19, -5.32e-21, 1.21e-21, 1.52e-22, 1.2e-23, 7.6e-25},
    {2.0735281041650442, -0.099009026661685054, 0.00021428646778282314, 3.0085046338468619e-05,
     3.0452492760337683e-06, 2.3096858947717718e-07, 1.2836443165461746e-08, 4.26865162386319e-10,
     -6.918680420404e-12, -2.461323784737e-12, -2.35555124538e-13, -1.5445416895e-14,
     -7.12111719e-16, -1.2859014e-17, 1.737258e-18, 2.62679e-19, 2.2779e-20, 1.44e-21, 5.9e-23,
     -1.8e-25},
    {1.8766648649306923, -0.09767229309136663, 0.00048970087749592339, 6.5948676558633715e-05,
     6.2230605209316953e-06, 4.1037118193691959e-07, 1.5321143739898034e-08, -3.64047437132764e-10,
     -1.19534217893487e-10, -1.1731758085374e-11, -7.23869775228e-13, -2.122843089e-14,
     1.543810112e-15, 3.13446951e-16, 2.9666387e-17, 1.790321e-18, 3.8928e-20, -6.714e-21,
     -1.166e-21, -1.04e-22},
    {1.6839202690889949, -0.094687512584965272, 0.0010707314835310456, 0.00013410652506839723,
     1.0952647289776317e-05, 4.8027316659711921e-07, -1.360556517806835e-08, -4.68344234210108e-09,
     -4.5673704688082e-10, -2.2127303323677e-11, 5.65574996174e-13, 2.32142452165e-13,
     2.463428701e-14, 1.278313843e-15, -3.8282882e-17, -1.5862465e-17, -1.762847e-18, -9.2962e-20,
     4.479e-21, 1.431e-21},
    {1.5000900358257268, -0.088411624739368103, 0.0021693378678535099, 0.00023522315784333306,
     1.3047816948010328e-05, -3.1139184989388813e-07, -1.3821415094853564e-07,
     -1.2698656325650323e-08, -2.25957887582488e-10, 8.7828469577647e-11, 1.1969087194793e-11,
     5.00947958806e-13, -6.4602107221e-14, -1.2512255406e-14, -4.72573788e-16, 2.1416515e-16,
     3.6826806e-17, -2.0872084e-17, -1.07057e-17, -1.117297e-18},
    {1.334014252513646, -0.076551167078622737, 0.0038273534900283199, 0.00029818555556870808,
     -1.6447028338838868e-06, -2.8606867108913385e-06, -2.41705637207726e-07, 7.14450235961889e-09,
     3.006826489044359e-09, 1.54150225850158e-10, -1.1347549165943e-11, 6.14686304447e-12,
     3.376377756573e-12, 2.20923131169e-13, -2.78060881041e-13, -8.384212864e-14, 7.763660593e-15,
     7.686990685e-15, 2.05964991e-16, -3.92806016e-16},
    {1.1984752642169794, -0.05798471993499725, 0.0053012021775651905, 0.0001424141405603219,
     -3.8499045029814064e-05, -3.3349940107863777e-06, 3.6153343871396371e-07,
     8.4933547193810041e-08, 1.017163876696449e-09, -2.310609088917523e-09, -3.28111431532305e-10,
     7.0724185523164e-11, 2.0549919936562e-11, -2.763380713543e-12, -1.046613349866e-12,
     1.43366132628e-13, 4.6380194552e-14, -8.258570501e-15, -1.527744841e-15, 3.71598396e-16},
    {1.1041601883456045, -0.036467124728121823, 0.0050988691668942057, -0.00020512499206699387,
     -3.4898642804978527e-05, 4.0914933244012383e-06, 3.6394033445118518e-07,
     -9.5256139569748735e-08, -2.283223372313075e-09, 2.450179633126372e-09, -1.31026932748531e-10,
     -5.7111469767158e-11, 9.507154745987e-12, 6.93409791602e-13, -3.72656681943e-13,
     2.4349891797e-14, 8.501907947e-15, -1.866358073e-15, -3.9165067e-17, 5.4212009e-17},
}};
// clang-format on

// Far away, for x >= kFar, R is the sum over k of b_k h^k with h = 1/(1 + eps) < 0.12; kFarRegular
// has the b_k. Because 1/eps = h + h^2 + ..., the coefficients of K are 1 + b_k for k > 0: 9/8,
// 81/64, 473/512, 4113/4096, ... They are computed in rational arithmetic from the expansion of
// Brenner's series in exp(-alpha), with cosh(alpha) = 1/h, and all are fractions whose denominator
// is a power of 2.
// clang-format off
constexpr Polynomial<18> kFarRegular = {
    1, 0.125, 0.265625, -0.076171875, 0.004150390625, 0.215118408203125,
    -0.070064544677734375, -0.032443523406982422, 0.15412050485610962, -0.081113986670970917,
    0.039968878962099552, 0.095062631298787892,
    -0.088984817950404249, 0.07118790284039278, 0.0211582797930987, -0.036068701833045225,
    0.061473599154115988, -0.0055992376740436889};
// clang-format on
// The limit of S - eps - ln(1 + eps)/8 for large eps, from S at x = 4, computed as kMean.
constexpr double kFarConstant = 0.30139129923623441053;
// S(1), computed in the same way as kMean.
constexpr double kRegularIntegralToOne = 1.26158388768896730636;

/// The coefficients of a function of eps in the three ranges: near contact `constants` and
/// `logarithms`, in between `pieces`, far away `far`.
struct Expansion {
  Polynomial<5> constants, logarithms;
  std::array<Polynomial<20>, kPieces> pieces;
  Polynomial<18> far;
};

/// The coefficients of df/dx in powers of t on a piece, where dt/dx = 2.
consteval Polynomial<20> log_slope(const Polynomial<20>& f) {
  Polynomial<20> slope = {};
  for (std::size_t k = 0; k + 1 < f.size(); ++k)
    slope[k] = 2 * static_cast<double>(k + 1) * f[k + 1];
  return slope;
}

/// The coefficients of R. On the pieces, S = eps M gives R = M + dM/dx.
consteval Expansion regular_expansion() {
  Expansion regular = {kConstants, kLogarithms, kMean, kFarRegular};
  for (auto& piece : regular.pieces) {
    const auto slope = log_slope(piece);
    for (std::size_t k = 0; k < piece.size(); ++k) piece[k] += slope[k];
  }
  return regular;
}

/// The coefficients of dR/dx = eps dR/d eps. Far away dh/dx = -h (1 - h).
consteval Expansion slope_expansion() {
  Expansion slope = regular_expansion();
  for (std::size_t k = 0; k < kConstants.size(); ++k) {
    const auto power = static_cast<double>(k);
    slope.constants[k] = power * kConstants[k] + kLogarithms[k];
    slope.logarithms[k] = power * kLogarithms[k];
  }
  for (auto& piece : slope.pieces) piece = log_slope(piece);
  for (std::size_t k = 1; k < kFarRegular.size(); ++k) {
    const auto power = static_cast<double>(k);
    slope.far[k] = (power - 1) * kFarRegular[k - 1] - power * kFarRegular[k];
  }
  slope.far[0] = 0;
  return slope;
}

/// The coefficients of M near contact and in the range between; far away those of S - eps - x/8
/// instead, which follows from R = 1 + h/8 + ..., int h^(k+1) d eps = -h^k/k and ln(1 + eps) - x =
/// sum h^k/k.
consteval Expansion mean_expansion() {
  Expansion mean = {kConstants, kLogarithms, kMean, {}};
  for (std::size_t k = 0; k < kConstants.size(); ++k) {
    const auto power = static_cast<double>(k + 1);
    mean.logarithms[k] = kLogarithms[k] / power;
    mean.constants[k] = (kConstants[k] - mean.logarithms[k]) / power;
  }
  mean.far[0] = kFarConstant;
  for (std::size_t k = 1; k + 1 < kFarRegular.size(); ++k)
    mean.far[k] = (kFarRegular[1] - kFarRegular[k + 1]) / static_cast<double>(k);
  return mean;
}

constexpr Expansion kRegular = regular_expansion();
constexpr Expansion kSlope = slope_expansion();
constexpr Expansion kMeanRegular = mean_expansion();

/// f at eps, with x = ln eps. If eps < 0, x and the result of the last line are NaN.
double value(const Expansion& f, double eps, double x) {
  if (x >= kFar) return value(f.far, 1 / (1 + eps));
  if (x >= kNear) {
    const double pieces = x - kNear;
    // `pieces` can be rounded up to 8, although there are only the pieces 0..7.
    const int piece = std::min(static_cast<int>(pieces), kPieces - 1);
    return value(f.pieces[static_cast<std::size_t>(piece)], 2 * (pieces - piece) - 1);
  }
  return value(f.constants, eps) + x * value(f.logarithms, eps);
}

/// S(eps) = int_0^eps R.
double regular_integral(double eps, double x) {
  const double mean = value(kMeanRegular, eps, x);
  return x >= kFar ? eps + (x / 8 + mean) : eps * mean;
}

}  // namespace

double plane_drag_factor(double eps) { return 1 / eps + plane_drag_factor_regular(eps); }

double plane_drag_factor_log_slope(double eps) {
  return value(kSlope, eps, std::log(eps)) - 1 / eps;
}

double plane_drag_factor_regular(double eps) { return value(kRegular, eps, std::log(eps)); }

double plane_drag_integral(double eps) {
  const double x = std::log(eps);
  return x + (regular_integral(eps, x) - kRegularIntegralToOne);
}

double plane_drag_regular_integral(double eps) { return regular_integral(eps, std::log(eps)); }

}  // namespace viscontact::lubrication
