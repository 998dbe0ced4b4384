// Every machine must compute the same bits: only + - * / sqrt, floor, frexp and ldexp are used, as
// exp and log differ between C libraries, and nothing is fused (-ffp-contract=off).
#include "viscontact/arrangement/species.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {
namespace {

constexpr double kLog2 = 0.6931471805599453;

/// Natural logarithm of a finite x > 0, with an error of a few units in the last place.
double portable_log(double x) {
  assert(x > 0);
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);  // from 0.5 to 1
  if (mantissa < 0.7071067811865476) {         // sqrt(1/2)
    mantissa *= 2;
    --exponent;
  }
  // log(mantissa) = 2 artanh s = 2 (s + s^3/3 + ...), with |s| <= 0.172. The terms after that of
  // s^23 are together less than 1e-19.
  const double s = (mantissa - 1) / (mantissa + 1), square = s * s;
  double sum = 0;
  for (int n = 23; n >= 1; n -= 2) sum = sum * square + 1.0 / n;
  return exponent * kLog2 + 2 * s * sum;
}

/// exp x. The relative error is at most a few 1e-16 plus 1.5e-16 |x|, because log 2 and its product
/// with the number `doublings` are rounded. Here x is the logarithm of a radius over the median, at
/// most 12 in magnitude because sigma is at most 1, so that the error is at most 2e-15. Splitting
/// log 2 in two parts (Cody & Waite 1980) would be more accurate, but would change the radii of
/// seeds.
double portable_exp(double x) {
  assert(std::abs(x) < 700);
  const double doublings = std::floor(x / kLog2 + 0.5);
  const double rest = x - doublings * kLog2;  // at most 0.347 in magnitude
  double sum = 1;
  for (int n = 16; n >= 1; --n) sum = 1 + rest / n * sum;  // the next term is less than 1e-22
  return std::ldexp(sum, static_cast<int>(doublings));
}

/// A number of the normal distribution with mean 0 and variance 1 (Marsaglia's polar method).
double normal(SplitMix64& random) {
  for (;;) {
    const double x = random.between(-1, 1), y = random.between(-1, 1), square = x * x + y * y;
    if (square > 0 && square < 1) return x * std::sqrt(-2 * portable_log(square) / square);
  }
}

/// The radius [L] of particle `number` (from 0) of its species.
double radius_of(const RadiusDistribution& radius, std::size_t number, SplitMix64& random) {
  switch (radius.kind) {
    case RadiusDistribution::Kind::kList:
      assert(!radius.list.empty());
      return radius.list[number % radius.list.size()];
    case RadiusDistribution::Kind::kUniform:
      return random.between(radius.from, radius.to);
    case RadiusDistribution::Kind::kLognormal:
      return radius.median * portable_exp(radius.sigma * normal(random));
  }
  return 0;
}

}  // namespace

DrawnSpecies::DrawnSpecies(std::vector<Species> species, int dimension, std::uint64_t seed)
    // arrangement.cpp draws the places from the sequence of `seed` itself. The radii come from
    // another sequence, so that they do not depend on the places. Its constant is arbitrary.
    : species_(std::move(species)),
      counts_(species_.size()),
      dimension_(dimension),
      random_(splitmix_hash(seed) ^ 0x7370656369657321ULL) {}

DrawnParticle DrawnSpecies::next() {
  assert(!species_.empty());
  // For m species, Tijdeman's rule ("The chairman assignment problem", Discrete Mathematics 32,
  // 1980) keeps the number of particles of each species within 1 - 1/(2m - 2) (`farthest`) of its
  // share of the total. A species may come next if its number would then exceed its share by at
  // most this bound. Among these species, the next one is that which would otherwise be the first
  // to fall behind its share by this bound (`deadline`: the total at which it does).
  double shares = 0, total = 1;
  for (std::size_t s = 0; s < species_.size(); ++s) {
    shares += species_[s].share;
    total += static_cast<double>(counts_[s]);
  }
  // Above rounding errors; a change may alter draws.
  constexpr double kRounding = 1e-9;
  const double farthest =
      1 - 0.5 / static_cast<double>(std::max<std::size_t>(species_.size(), 2) - 1);
  std::size_t next = 0;
  double first_deadline = std::numeric_limits<double>::infinity(), largest_lag = 0;
  for (std::size_t s = 0; s < species_.size(); ++s) {
    const double share = species_[s].share / shares, count = static_cast<double>(counts_[s]);
    const double lag = share * total - count, deadline = (count + farthest) / share;
    if (lag < 1 - farthest - kRounding) continue;
    // If two species have the same deadline within rounding errors, the larger lag decides.
    if (deadline < first_deadline * (1 - kRounding) ||
        (deadline <= first_deadline * (1 + kRounding) && lag > largest_lag)) {
      next = s;
      first_deadline = deadline;
      largest_lag = lag;
    }
  }
  const auto& species = species_[next];
  const double radius = radius_of(species.radius, counts_[next]++, random_);
  return {radius, species.density > 0 ? species.density * round_shape(dimension_, radius).measure()
                                      : species.mass};
}

std::vector<DrawnParticle> drawn(DrawnSpecies species, std::size_t count) {
  std::vector<DrawnParticle> particles;
  while (particles.size() < count) particles.push_back(species.next());
  return particles;
}

std::vector<DrawnParticle> drawn_to_size(DrawnSpecies species, int dimension, double size,
                                         std::size_t largest_count) {
  assert(largest_count >= 1);
  std::vector<DrawnParticle> particles;
  double sum = 0;
  while (particles.size() < largest_count) {
    const auto next = species.next();
    const double more = round_shape(dimension, next.radius).measure();
    // A particle is taken only if it brings the sum nearer to `size`.
    if (!particles.empty() && sum + more / 2 > size) break;
    particles.push_back(next);
    sum += more;
  }
  return particles;
}

std::uint64_t hash_of(const std::vector<Species>& species) {
  std::uint64_t hash = species.size();
  const auto add = [&](double number) {
    hash = splitmix_hash(hash ^ std::bit_cast<std::uint64_t>(number));
  };
  for (const auto& [radius, share, mass, density] : species) {
    add(static_cast<double>(radius.kind));
    add(static_cast<double>(radius.list.size()));
    for (const double number : radius.list) add(number);
    for (const double number :
         {radius.from, radius.to, radius.median, radius.sigma, share, mass, density})
      add(number);
  }
  return hash;
}

}  // namespace viscontact::particles
