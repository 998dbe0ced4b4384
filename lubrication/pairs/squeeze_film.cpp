// The table of spheres, and quadrature for discs.
#include "viscontact/lubrication/pairs/squeeze_film.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "viscontact/common/root_finding.hpp"
#include "viscontact/lubrication/pairs/squeeze_rest.hpp"
#include "viscontact/lubrication/plane_drag.hpp"

namespace viscontact::lubrication {
namespace {

using std::numbers::pi;

/// False if there is no gap, because a round wall is not wider than the body.
bool has_gap(double radius, double neighbour) { return neighbour > 0 || radius < -neighbour; }

/// In a round wall the gap is at most that in its middle.
double possible_gap(double radius, double neighbour, double gap) {
  return neighbour > 0 ? gap : std::min(gap, -neighbour - radius);
}

/// Sum of Chebyshev polynomials at x in [-1, 1] (Clenshaw).
template <std::size_t count>
double chebyshev_sum(const std::array<double, count>& coefficients, double x) {
  double sum = 0, before = 0;
  for (std::size_t k = count; k-- > 1;) {
    const double next = 2 * x * sum - before + coefficients[k];
    before = sum;
    sum = next;
  }
  return x * sum - before + coefficients[0];
}

/// The mean of R/(6 pi mu r_eff) - 1/eps between contact and the gap, by the table.
class SqueezeMean {
 public:
  explicit SqueezeMean(double ratio) : film_(ratio) {
    const auto& table = ratio < 0 ? kSqueezeInWall : kSqueezeOfPair;
    for (std::size_t j = 0; j < kSqueezeGapTerms; ++j)
      rest_[j] = chebyshev_sum(table[j], 2 * std::abs(ratio) - 1);
  }

  /// At the gap `width` of SqueezeTerms. Beyond the table R is that of two points far away.
  double integral(double width) const {
    const double last = film_.largest_width(), in_table = std::min(width, last);
    const double x = 2 * film_.coordinate(in_table) / film_.coordinate(last) - 1;
    const double inner = in_table * (chebyshev_sum(rest_, x) + film_.mean_of_terms(in_table));
    if (width <= last) return inner;
    // R/(6 pi mu r_eff) = 1 + 3 r_eff/d at the distance d of the centres.
    const double touching = film_.touching_distance();
    return inner + (width - last) + 3 * std::log((width + touching) / (last + touching));
  }

 private:
  SqueezeTerms film_;
  std::array<double, kSqueezeGapTerms> rest_{};
};

/// Gauss-Legendre quadrature on [-1, 1], symmetric: nodes > 0 and their weights.
constexpr std::array<std::array<double, 2>, 8> kGauss = {{
    {0.09501250983763744, 0.1894506104550685},
    {0.2816035507792589, 0.1826034150449236},
    {0.45801677765722737, 0.16915651939500254},
    {0.6178762444026438, 0.14959598881657674},
    {0.755404408355003, 0.12462897125553387},
    {0.8656312023878318, 0.09515851168249279},
    {0.9445750230732326, 0.062253523938647894},
    {0.9894009349916499, 0.027152459411754096},
}};

/// y^(3/2)/(s - tanh s) with y = cosh s - 1 >= 0; 3/(2 sqrt(2)) at 0.
double film_of_discs(double y) {
  // s - tanh s = s^3 times this sum in s^2; its next term is below 1e-16 for y < 0.03.
  constexpr std::array kSeries = {
      1.0 / 3,         -2.0 / 15,          17.0 / 315,           -62.0 / 2835,
      1382.0 / 155925, -21844.0 / 6081075, 929569.0 / 638512875, -6404582.0 / 10854718875};
  constexpr double kSmall = 0.01;
  const double s = std::log1p(y + std::sqrt(y * (2 + y)));
  if (y >= kSmall) return y * std::sqrt(y) / (s - std::tanh(s));
  if (y == 0) return 3 / (2 * std::numbers::sqrt2);
  double sum = 0;
  for (std::size_t k = kSeries.size(); k-- > 0;) sum = sum * s * s + kSeries[k];
  const double ratio = y / (s * s);
  return ratio * std::sqrt(ratio) / sum;
}

}  // namespace

double sphere_squeeze_integral(double radius, double neighbour, double from, double to) {
  assert(radius > 0 && from > 0 && to > 0 && !std::isnan(neighbour) && neighbour != 0);
  if (!has_gap(radius, neighbour)) return std::numeric_limits<double>::infinity();
  from = possible_gap(radius, neighbour, from);
  to = possible_gap(radius, neighbour, to);
  const double r_eff = effective_radius(radius, neighbour), unit = 6 * pi * r_eff * r_eff;
  if (std::isinf(neighbour))
    return unit * (plane_drag_integral(to / r_eff) - plane_drag_integral(from / r_eff));
  const double ratio = std::abs(neighbour) > radius ? radius / neighbour : neighbour / radius;
  const SqueezeMean film(ratio);
  // In a narrow round wall the gap is measured in units in which its range is bounded.
  const double scale = ratio < 0 ? (1 + ratio) * (1 + ratio) : 1, width = r_eff * scale;
  return unit * (std::log(to / from) + film.integral(to / width) - film.integral(from / width));
}

double disc_squeeze_integral(double radius, double neighbour, double from, double to) {
  assert(radius > 0 && from > 0 && to > 0 && !std::isnan(neighbour) && neighbour != 0);
  if (!has_gap(radius, neighbour)) return std::numeric_limits<double>::infinity();
  if (to < from) return -disc_squeeze_integral(radius, neighbour, to, from);
  const double r_eff = effective_radius(radius, neighbour);
  const double curvature = r_eff / radius * (r_eff / neighbour);
  // R is 4 pi mu eps^(-3/2) times this function of eps = gap/r_eff, which is smooth.
  const auto smooth = [&](double eps) {
    const double factor = 1 + curvature * eps / 2;
    return film_of_discs(eps * factor) / (factor * std::sqrt(factor));
  };
  const double at_contact = smooth(0);
  // With eps = x^2 the integral of eps^(-3/2) (smooth(eps) - smooth(0)) has the integrand
  // 2 (smooth(x^2) - smooth(0))/x^2, whose poles are at least at sqrt(2) times the
  // largest x from x = 0 in a narrow round wall, and at 1 elsewhere.
  const double first = std::sqrt(possible_gap(radius, neighbour, from) / r_eff),
               last = std::sqrt(possible_gap(radius, neighbour, to) / r_eff);
  double sum = at_contact * 2 * (1 / first - 1 / last);
  for (double begin = first; begin < last;) {
    const double end = std::min(last, std::max(1.0, 2 * begin));
    const double middle = (begin + end) / 2, half = (end - begin) / 2;
    double part = 0;
    for (const auto& [node, weight] : kGauss)
      for (const double x : {middle - half * node, middle + half * node})
        part += weight * (smooth(x * x) - at_contact) / (x * x);
    sum += 2 * half * part;
    begin = end;
  }
  return 4 * pi * r_eff * sum;
}

double gap_of_squeeze(SqueezeIntegral integral, double radius, double neighbour, double from,
                      double value) {
  assert(value >= 0);
  from = possible_gap(radius, neighbour, from);
  if (value == 0) return from;
  // The logarithm of the gap; the integral falls with it.
  const double top = std::log(from);
  const auto is_thick = [&](double log_gap) {
    return integral(radius, neighbour, std::exp(log_gap), from) <= value;
  };
  double below = 1;
  while (top - below > -700 && is_thick(top - below)) below *= 2;
  return std::exp(bisect_first_true(std::max(top - below, -700.0), top, is_thick));
}

}  // namespace viscontact::lubrication
