// Only + - * / and sqrt are used, and nothing is fused (-ffp-contract=off in CMakeLists.txt), so
// that every machine computes the same bits.
#include "viscontact/arrangement/arrangement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>
#include <variant>

#include "viscontact/arrangement/arrangement_tuning.hpp"
#include "viscontact/arrangement/placed_particles.hpp"
#include "viscontact/arrangement/places.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/splitmix.hpp"
#include "viscontact/particles/domain/region.hpp"

namespace viscontact::particles {
namespace {

double length_of(const Vector& x) { return std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]); }

bool is_too_close(const CloseParticle& particle) {
  const auto& x = particle.apart;
  return x[0] * x[0] + x[1] * x[1] + x[2] * x[2] < particle.distance * particle.distance;
}

/// Moves particles that are too close apart, in up to `rounds` rounds over all of them. Returns
/// true as soon as none is too close after a round.
bool push_apart(PlacedParticles& placed, int rounds) {
  constexpr double kFurther = ArrangementTuning::kFurther;
  std::vector<CloseParticle> close;
  for (int round = 0; round < rounds; ++round) {
    bool all_free = true;
    for (std::size_t k = 0; k < placed.count(); ++k) {
      const Vector x = placed.centres()[k];
      placed.close_to(k, kFurther, close);
      all_free = all_free && (!placed.places(k).has_planes() || placed.places(k).contain(x)) &&
                 std::ranges::none_of(close, is_too_close);
      // Each of two particles that are too close moves by half of the missing distance. A particle
      // that is too close to a fixed one moves by all of it.
      Vector push{};
      for (const auto& [apart, distance, is_fixed, key] : close) {
        const double length = length_of(apart);
        const double missing = (is_fixed ? 1.0 : 0.5) * (kFurther * distance - length);
        // Two particles with the same centre are separated along the first axis.
        const Vector away = length > 0
                                ? Vector{apart[0] / length, apart[1] / length, apart[2] / length}
                                : Vector{1, 0, 0};
        for (std::size_t d = 0; d < placed.dimension(); ++d) push[d] -= missing * away[d];
      }
      if (push != Vector{})
        placed.move(k, placed.places(k).nearest({x[0] + push[0], x[1] + push[1], x[2] + push[2]}));
    }
    // A late push of the round may have moved a particle too close to one that was pushed earlier.
    if (all_free && placed.are_all_free()) return true;
  }
  return false;
}

/// Moves particles at random and keeps the moves that leave all gaps large enough. `size` is the
/// area or volume of the domain [L^2, L^3].
void shuffle(PlacedParticles& placed, double size, SplitMix64& random) {
  const auto count = placed.count();
  const auto dimension = placed.dimension();
  // If the same number of particles formed the densest lattice (triangular or face-centred cubic)
  // in the domain, the distance of neighbours would be `lattice`.
  const double n = static_cast<double>(count);
  const double lattice = edge_of(
      dimension == 2 ? 2 * size / (std::sqrt(3.0) * n) : std::sqrt(2.0) * size / n, dimension);
  double span = lattice;
  for (std::size_t d = 0; d < dimension; ++d)
    span = std::min(span, 0.5 * placed.widest_places().length(d));
  const double step =
      std::min(span, std::max(ArrangementTuning::kOfLatticeGap * (lattice - placed.distance()),
                              ArrangementTuning::kOfDistance * placed.distance()));
  const std::size_t moves =
      count * std::clamp(ArrangementTuning::kMoves / count, ArrangementTuning::kFewestMoves,
                         ArrangementTuning::kMostMoves);
  for (std::size_t move = 0; move < moves; ++move) {
    const std::size_t k = random.below(count);
    Vector x = placed.centres()[k];
    for (std::size_t d = 0; d < dimension; ++d) x[d] += random.between(-step, step);
    const auto& places = placed.places(k);
    x = places.wrapped(x);
    if (places.contain(x) && placed.is_free(x, k)) placed.move(k, x);
  }
}

}  // namespace

double size_of(const Arrangement& asked, int dimension) {
  assert(dimension == 2 || dimension == 3);
  double sum = 0;
  for (const double radius : asked.radii) sum += round_shape(dimension, radius).measure();
  return sum;
}

std::vector<double> arrange(const Arrangement& asked, const Domain& domain,
                            const Particles& present, std::span<const PlanePosition> planes) {
  assert(!asked.radii.empty() && asked.smallest_gap >= 0);
  const auto& radii = asked.radii;
  const double gap = asked.smallest_gap, size = measure(domain, planes);
  const auto [smallest, largest] = std::ranges::minmax(radii);
  const bool are_equal = smallest == largest;
  const auto* box = std::get_if<BoxDomain>(&domain);
  const int dimension = box == nullptr ? 2 : static_cast<int>(box->dimension());
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorKind::kBadInput,
                "{} {} of {} with gaps of at least {} do not fit ({}); they take {:.4g} of the {} "
                "of the {}; use fewer or smaller ones, or a smaller gap",
                radii.size(), dimension == 2 ? "discs" : "spheres",
                are_equal ? fmt::format("radius {}", largest)
                          : fmt::format("radii {:.6g} to {:.6g}", smallest, largest),
                gap, why, size_of(asked, dimension) / size, dimension == 2 ? "area" : "volume",
                planes.empty() ? "domain" : "domain that the planes leave free");
  };
  // The largest particles are placed first. Particles of equal radius keep their order.
  std::vector<std::size_t> order(radii.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](auto i, auto j) { return radii[i] > radii[j]; });
  std::vector<double> falling;
  for (const auto k : order) falling.push_back(radii[k]);
  std::vector<Places> places;  // only one entry if all radii are equal
  for (std::size_t k = 0; k < (are_equal ? 1 : radii.size()); ++k)
    places.emplace_back(domain, planes, falling[k] + gap);
  if (places.front().are_empty()) refuse("the domain is narrower than one of them with its gaps");
  for (std::size_t d = 0; d < places.front().dimension(); ++d)
    if (places.front().period(d) > 0 && places.front().period(d) < 2 * largest + gap)
      refuse("a period is shorter than one of them with its gap");
  // Equal particles, enlarged by half of the gap, do not overlap. They therefore cover at most the
  // fraction that the densest lattice (triangular, face-centred cubic) covers.
  const double densest = !are_equal       ? 1
                         : dimension == 2 ? 0.9068996821171089   // pi/sqrt(12)
                                          : 0.7404804896930610;  // pi/sqrt(18)
  double covered = 0;
  for (const double radius : radii) covered += round_shape(dimension, radius + gap / 2).measure();
  if (covered > densest * size) refuse("the densest lattice has no room for them");

  std::vector<FixedParticle> fixed;
  for (std::size_t k = 0; k < present.count(); ++k)
    fixed.push_back({present.position(k), present.radii[k]});
  SplitMix64 random(asked.seed);
  // push_apart() can fail although an arrangement exists. All particles then get new random places.
  for (int beginning = 0; beginning < ArrangementTuning::kBeginnings; ++beginning) {
    PlacedParticles placed(places, falling, gap, fixed);
    for (std::size_t k = 0; k < radii.size(); ++k) {
      Vector x = placed.places(k).random(random);
      for (int i = 1; i < ArrangementTuning::kTries && !placed.is_free(x, k); ++i)
        x = placed.places(k).random(random);
      placed.add(x);
    }
    if (!push_apart(placed, ArrangementTuning::kRounds)) continue;
    shuffle(placed, size, random);
    const auto axes = static_cast<std::size_t>(dimension);
    std::vector<double> positions(axes * radii.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t d = 0; d < axes; ++d)
        positions[axes * order[i] + d] = placed.centres()[i][d];
    return positions;
  }
  refuse(fmt::format("{} random beginnings did not lead to an arrangement",
                     ArrangementTuning::kBeginnings));
  return {};
}

}  // namespace viscontact::particles
