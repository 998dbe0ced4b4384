// Only + - * / and sqrt are used, and nothing is fused (-ffp-contract=off in CMakeLists.txt), so
// that every machine computes the same bits.
#include "viscontact/arrangement/arrangement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>
#include <variant>

#include "viscontact/arrangement/arrangement_tuning.hpp"
#include "viscontact/arrangement/placed_particles.hpp"
#include "viscontact/arrangement/places.hpp"
#include "viscontact/arrangement/relaxation.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/root_finding.hpp"
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
  const auto n = static_cast<double>(count);
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

/// Particles that are to be placed, the largest first.
struct Asked {
  const Domain& domain;
  std::span<const PlanePosition> planes;
  std::vector<double> radii;
  double gap;
  std::vector<FixedParticle> fixed;

  /// The regions for particles that are smaller by `scale`, with smaller gaps, or one for all if
  /// their radii are equal.
  std::vector<Places> places(double scale = 1) const {
    std::vector<Places> all;
    for (std::size_t k = 0; k < (radii.front() == radii.back() ? 1 : radii.size()); ++k)
      all.emplace_back(domain, planes, scale * (radii[k] + gap));
    return all;
  }
};

/// Puts all particles at random places where their gaps are large enough or, after `tries` tries,
/// at any random place.
void put_at_random(PlacedParticles& placed, int tries, SplitMix64& random) {
  for (std::size_t k = 0; k < placed.count(); ++k) {
    Vector x = placed.places(k).random(random);
    for (int i = 1; i < tries && !placed.is_free(x, k); ++i) x = placed.places(k).random(random);
    placed.add(x);
  }
}

/// Area [L^2] or volume [L^3] of the particles with half of the gap around them.
double covered(std::span<const double> radii, double gap, int dimension) {
  assert(dimension == 2 || dimension == 3);
  double sum = 0;
  for (const double radius : radii) sum += round_shape(dimension, radius + gap / 2).measure();
  return sum;
}

/// The factor by which all particles and their gaps must be smaller so that these particles, which
/// are jammed with such a mean overlap, get gaps that are large enough; 0 if none is found.
double reached_scale(const Asked& asked, const PlacedParticles& jammed, double overlap) {
  auto centres = jammed.centres();
  double scale = 1;
  const auto steps = static_cast<int>(
      std::min<std::size_t>(ArrangementTuning::kMostSteps,
                            ArrangementTuning::kMostStepsOfAll / (4 * centres.size()) + 1));
  for (int i = 0; i < ArrangementTuning::kShrinkings; ++i) {
    scale *= 1 - std::min(0.5, overlap + ArrangementTuning::kShrinkFurther);
    const auto places = asked.places(scale);
    auto radii = asked.radii;
    for (double& radius : radii) radius *= scale;
    PlacedParticles smaller(places, std::move(radii), scale * asked.gap, asked.fixed);
    for (std::size_t k = 0; k < centres.size(); ++k)
      smaller.add(smaller.places(k).nearest(centres[k]));
    const auto result = relax(smaller, steps);
    if (result.is_free) return scale;
    centres = smaller.centres();
    overlap = result.overlap;
  }
  return 0;
}

/// The indices of the radii in falling order. Equal radii keep their order.
std::vector<std::size_t> largest_first(const std::vector<double>& radii) {
  std::vector<std::size_t> order(radii.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](auto i, auto j) { return radii[i] > radii[j]; });
  return order;
}

/// Fraction that cannot be exceeded. Equal particles, enlarged by half of the gap, do not overlap,
/// and cover at most what the densest lattice (triangular, face-centred cubic) covers.
double densest_fraction(std::span<const double> radii, int dimension) {
  const auto [smallest, largest] = std::ranges::minmax(radii);
  if (smallest < largest) return 1;
  return dimension == 2 ? 0.9068996821171089   // pi/sqrt(12)
                        : 0.7404804896930610;  // pi/sqrt(18)
}

/// Throws the error that these particles do not fit into a domain of this size.
void throw_unfit(const Arrangement& asked, int dimension, double size, bool has_planes,
                 const std::string& why) {
  const auto [smallest, largest] = std::ranges::minmax(asked.radii);
  const auto radii = smallest == largest ? fmt::format("radius {}", largest)
                                         : fmt::format("radii {:.6g} to {:.6g}", smallest, largest);
  throw Error(ErrorKind::kBadInput,
              "{} {} of {} with gaps of at least {} do not fit; they take {:.4g} of the {} "
              "of the {} ({}); use fewer or smaller ones, or a smaller gap",
              asked.radii.size(), dimension == 2 ? "discs" : "spheres", radii, asked.smallest_gap,
              size_of(asked, dimension) / size, dimension == 2 ? "area" : "volume",
              has_planes ? "domain that the planes leave free" : "domain", why);
}

}  // namespace

double size_of(const Arrangement& asked, int dimension) {
  return covered(asked.radii, 0, dimension);
}

double default_gap(std::span<const double> radii, int dimension, double size) {
  assert(size > 0);
  const double packed =
      size * (dimension == 2 ? ArrangementTuning::kPackedArea : ArrangementTuning::kPackedVolume);
  const double alone = covered(radii, 0, dimension), most = (alone + packed) / 2;
  if (alone >= packed) return 0;
  return bisect_first_true(0, ArrangementTuning::kGapOfRadius * std::ranges::min(radii),
                           [&](double gap) { return covered(radii, gap, dimension) > most; });
}

std::vector<double> arrange(const Arrangement& asked, const Domain& domain,
                            const Particles& present, std::span<const PlanePosition> planes) {
  assert(!asked.radii.empty() && asked.smallest_gap >= 0);
  const auto& radii = asked.radii;
  const double gap = asked.smallest_gap, size = measure(domain, planes);
  const auto* box = std::get_if<BoxDomain>(&domain);
  const int dimension = box == nullptr ? 2 : static_cast<int>(box->dimension());
  const auto refuse = [&](const std::string& why) {
    throw_unfit(asked, dimension, size, !planes.empty(), why);
  };
  // The largest particles are placed first.
  const auto order = largest_first(radii);
  Asked falling{.domain = domain, .planes = planes, .radii = {}, .gap = gap, .fixed = {}};
  for (const auto k : order) falling.radii.push_back(radii[k]);
  for (std::size_t k = 0; k < present.count(); ++k)
    falling.fixed.push_back({present.position(k), present.radii[k]});
  const auto places = falling.places();
  if (places.front().are_empty()) refuse("the domain is narrower than one of them with its gaps");
  for (std::size_t d = 0; d < places.front().dimension(); ++d)
    if (places.front().period(d) > 0 && places.front().period(d) < 2 * falling.radii.front() + gap)
      refuse("a period is shorter than one of them with its gap");
  if (covered(radii, gap, dimension) > densest_fraction(radii, dimension) * size)
    refuse("the densest lattice has no room for them");

  SplitMix64 random(asked.seed);
  std::optional<PlacedParticles> placed;
  const auto begin = [&](int tries) {
    placed.emplace(places, falling.radii, gap, falling.fixed);
    put_at_random(*placed, tries, random);
  };
  bool is_free = false;
  // Pushes can fail although an arrangement exists. All particles then get new random places.
  auto rounds = static_cast<int>(ArrangementTuning::kMostPushes / radii.size());
  for (int i = 0; i < ArrangementTuning::kBeginnings && rounds > 0 && !is_free; ++i) {
    begin(ArrangementTuning::kTries);
    is_free = push_apart(*placed, std::min(rounds, ArrangementTuning::kRounds));
    rounds -= ArrangementTuning::kRounds;
  }
  auto steps = static_cast<int>(std::min<std::size_t>(
      ArrangementTuning::kMostStepsOfAll / radii.size(),
      std::size_t{ArrangementTuning::kPackings} * ArrangementTuning::kMostSteps));
  Relaxation packing{};
  for (int i = 0; i < ArrangementTuning::kPackings && steps > 0 && !is_free; ++i) {
    begin(ArrangementTuning::kTriesBeforeRepulsion);
    packing = relax(*placed, std::min(steps, ArrangementTuning::kMostSteps));
    is_free = packing.is_free;
    steps -= packing.steps;
  }
  if (!is_free) {
    const double scale = reached_scale(falling, *placed, packing.overlap);
    const double fraction =
        size_of(asked, dimension) / size * scale * scale * (dimension == 2 ? 1 : scale);
    refuse(fmt::format("random packings of them jam{}",
                       scale > 0 ? fmt::format(" above {:.4g} of it", fraction) : ""));
  }
  shuffle(*placed, size, random);
  const auto axes = static_cast<std::size_t>(dimension);
  std::vector<double> positions(axes * radii.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t d = 0; d < axes; ++d) positions[axes * order[i] + d] = placed->centres()[i][d];
  return positions;
}

}  // namespace viscontact::particles
