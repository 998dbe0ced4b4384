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

#include "viscontact/common/error.hpp"
#include "viscontact/common/splitmix.hpp"
#include "viscontact/particles/domain/region.hpp"

namespace viscontact::particles {
namespace {

/// Free choices of random arrangements. Other values change the arrangements of seeds.
struct ArrangementTuning {
  // Least share of the region for centres in the domain; below it, random places would be found too
  // slowly.
  static constexpr double kLeastFraction = 1e-6;
  // Rounds over the planes in which a point is moved into the region.
  static constexpr int kProjections = 20;
  // Slightly beyond a plane, so that rounding errors do not leave the point behind it.
  static constexpr double kBeyond = 1 + 1e-6;
  // Slightly inside a disc: 1e-12 of the radius exceeds the rounding errors.
  static constexpr double kInside = 1 - 1e-12;
  // Aim of a push over the distance that two particles must have, because pushes approach their aim
  // without reaching it.
  static constexpr double kFurther = 1 + 1e-3;
  // Largest random move along an axis: half of the gap in the densest lattice, of which about half
  // of the moves are kept, and at least 0.01 of the least distance, so that a dense arrangement can
  // move too.
  static constexpr double kOfLatticeGap = 0.5, kOfDistance = 0.01;
  // 500 moves of each particle, on average, are taken as enough to forget the first places. To
  // bound the time, more than 40 000 particles make 20 million moves in all, but at least 20 each.
  static constexpr std::size_t kMoves = 20000000, kMostMoves = 500, kFewestMoves = 20;
  // Random beginnings, tries for a free place of each particle, and rounds of pushes. Larger
  // numbers find more of the dense arrangements.
  static constexpr int kBeginnings = 10, kTries = 1000, kRounds = 2000;
};

/// The region for the centre of a particle: a disc or a box, on the free side of all planes.
class Places {
 public:
  /// `from_wall` is the least distance of the centre from a wall or plane [L].
  Places(const Domain& domain, std::span<const PlanePosition> planes, double from_wall) {
    set_domain(domain, from_wall);
    for (auto plane : planes) {
      plane.point = plane.point + from_wall * plane.normal;
      planes_.push_back(plane);
      // Planes across an axis of a box make the box from which random places are taken smaller.
      for (std::size_t d = 0; d < dimension_ && !round_; ++d) {
        if (periods_[d] > 0) continue;
        if (plane.normal[d] == 1) from_[d] = std::max(from_[d], plane.point[d]);
        if (plane.normal[d] == -1) to_[d] = std::min(to_[d], plane.point[d]);
      }
    }
  }

 private:
  void set_domain(const Domain& domain, double from_wall) {
    if (const auto* disc = std::get_if<DiscDomain>(&domain)) {
      radius_ = disc->radius - from_wall;
      centre_ = {disc->centre[0], disc->centre[1]};
      for (const std::size_t d : {0U, 1U}) {
        from_[d] = centre_[d] - radius_;
        to_[d] = centre_[d] + radius_;
      }
      round_ = true;
      return;
    }
    const auto& box = std::get<BoxDomain>(domain);
    dimension_ = box.dimension();
    periods_ = periods_of(domain);
    for (std::size_t d = 0; d < dimension_; ++d) {
      from_[d] = box.from[d] + (box.periodic[d] ? 0 : from_wall);
      to_[d] = box.to[d] - (box.periodic[d] ? 0 : from_wall);
    }
  }

 public:
  std::size_t dimension() const { return dimension_; }
  bool are_empty() const {
    double size = 1;
    for (std::size_t d = 0; d < dimension_; ++d) {
      if (!(from_[d] <= to_[d])) return true;
      size *= to_[d] - from_[d];
    }
    if (planes_.empty() || size == 0) return false;
    Domain whole = DiscDomain{centre_, radius_};
    if (!round_) whole = BoxDomain{from_, to_, {}};
    return measure(whole, planes_) < ArrangementTuning::kLeastFraction * size;
  }
  /// Period along axis `d` [L]; 0 if there is none.
  double period(std::size_t d) const { return periods_[d]; }
  /// Lowest coordinate along axis `d` [L].
  double from(std::size_t d) const { return from_[d]; }
  /// Width along axis `d` [L].
  double length(std::size_t d) const { return to_[d] - from_[d]; }

  bool contain(const Vector& x) const {
    for (const auto& plane : planes_)
      if (!(dot(plane.normal, x - plane.point) >= 0)) return false;
    return is_in_domain(x);
  }
  bool has_planes() const { return !planes_.empty(); }

  bool is_in_domain(const Vector& x) const {
    if (!round_) {
      for (std::size_t d = 0; d < dimension_; ++d)
        if (!(from_[d] <= x[d] && x[d] <= to_[d])) return false;
      return true;
    }
    const double dx = x[0] - centre_[0], dy = x[1] - centre_[1];
    return dx * dx + dy * dy <= radius_ * radius_;
  }

  /// The periodic image of `x` in the box. `x` may be outside by less than one period.
  Vector wrapped(Vector x) const {
    for (std::size_t d = 0; d < dimension_; ++d) {
      if (periods_[d] == 0) continue;
      if (x[d] < from_[d]) x[d] += periods_[d];
      if (x[d] >= to_[d]) x[d] -= periods_[d];
      // Rounding may leave a coordinate at the upper side or just below the lower one.
      if (x[d] < from_[d] || x[d] >= to_[d]) x[d] = from_[d];
    }
    return x;
  }

  /// The point of the region that is nearest to `x` [L]; in a disc slightly inside its edge. With
  /// planes, a point near that one, which may be outside the region in a corner.
  Vector nearest(Vector x) const {
    x = nearest_in_domain(x);
    for (int round = 0; round < ArrangementTuning::kProjections && !contain(x); ++round) {
      for (const auto& plane : planes_) {
        const double height = dot(plane.normal, x - plane.point);
        if (height < 0) x = x - ArrangementTuning::kBeyond * height * plane.normal;
      }
      x = nearest_in_domain(x);
    }
    return x;
  }

  Vector nearest_in_domain(Vector x) const {
    if (!round_) {
      x = wrapped(x);
      for (std::size_t d = 0; d < dimension_; ++d)
        if (periods_[d] == 0) x[d] = std::clamp(x[d], from_[d], to_[d]);
      return x;
    }
    if (is_in_domain(x)) return x;
    const double dx = x[0] - centre_[0], dy = x[1] - centre_[1];
    const double factor = radius_ * ArrangementTuning::kInside / std::sqrt(dx * dx + dy * dy);
    return {centre_[0] + factor * dx, centre_[1] + factor * dy};
  }

  /// A random point, uniformly distributed, of the region, which is not empty.
  Vector random(SplitMix64& random) const {
    for (;;) {
      Vector x{};
      for (std::size_t d = 0; d < dimension_; ++d) x[d] = random.between(from_[d], to_[d]);
      if (contain(x)) return wrapped(x);
    }
  }

  /// The shortest vector from `a` to an image of `b`, for two points of the region.
  Vector difference(const Vector& a, const Vector& b) const {
    Vector apart = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    for (std::size_t d = 0; d < dimension_; ++d) {
      if (periods_[d] == 0) continue;
      if (apart[d] > periods_[d] / 2) apart[d] -= periods_[d];
      if (apart[d] < -periods_[d] / 2) apart[d] += periods_[d];
    }
    return apart;
  }

 private:
  // round_: the region is a disc. from_, to_: lowest and highest coordinates of the region [L];
  // periods_ [L]: 0 along an axis without a period.
  bool round_ = false;
  std::size_t dimension_ = 2;
  double radius_ = 0;
  Vector centre_{}, from_{}, to_{}, periods_{};
  std::vector<PlanePosition> planes_;  // moved by the least distance of the centre
};

double length_of(const Vector& x) { return std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]); }

/// The square root (dimension 2) or cube root (dimension 3). The cube root is computed by Newton's
/// method, because that of the C library differs between machines.
double edge_of(double size, std::size_t dimension) {
  assert(size > 0);
  if (dimension == 2) return std::sqrt(size);
  double root = size < 1 ? 1 : size;  // at least the cube root, so that the iterates fall to it
  for (double next = 0;; root = next) {
    next = root - (root - size / (root * root)) / 3;
    if (!(next < root)) return root;
  }
}

/// A particle that is in the domain before the new ones are placed.
struct FixedParticle {
  Vector centre;
  double radius;
};

/// The particles that are placed so far, in the order of falling radii, sorted into a grid of
/// cells. Each cell is at least as wide as the least distance of the centres of the two largest
/// particles, so that only particles in one cell or in neighbouring cells can be too close.
class PlacedParticles {
 public:
  /// `places` has the regions of the particles, or one if all radii are equal, and must outlive the
  /// object. `gap` [L] is the least gap of two particles.
  PlacedParticles(const std::vector<Places>& places, std::vector<double> radii, double gap,
                  std::vector<FixedParticle> fixed)
      : places_(places), radii_(std::move(radii)), gap_(gap), fixed_(std::move(fixed)) {
    assert(std::ranges::is_sorted(radii_, std::greater<>()));
    assert(places_.size() == 1 || places_.size() == radii_.size());
    // More cells than particles would cost memory without saving time.
    const double side = edge_of(static_cast<double>(radii_.size()), dimension()) + 1;
    const double widest = 2 * radii_.front() + gap_;
    for (std::size_t d = 0; d < dimension(); ++d) {
      const double fit = std::min(widest_places().length(d) / widest, side);
      cells_[d] = std::max<std::size_t>(1, static_cast<std::size_t>(fit));
    }
    numbers_.resize(cells_[0] * cells_[1] * cells_[2]);
  }

  std::size_t dimension() const { return widest_places().dimension(); }
  std::size_t count() const { return radii_.size(); }
  const std::vector<Vector>& centres() const { return centres_; }
  const Places& places(std::size_t k) const { return places_[places_.size() == 1 ? 0 : k]; }
  /// The region of the smallest particle, which contains the regions of all others.
  const Places& widest_places() const { return places_.back(); }
  /// Least distance of the centres of two particles of the mean radius [L].
  double distance() const {
    double sum = 0;
    for (const double radius : radii_) sum += radius;
    const double mean =
        radii_.front() == radii_.back() ? radii_.front() : sum / static_cast<double>(radii_.size());
    return 2 * mean + gap_;
  }

  /// Adds the next particle, in the order of the radii, with its centre at `x`.
  void add(const Vector& x) {
    assert(centres_.size() < radii_.size());
    numbers_[cell_of(x)].push_back(centres_.size());
    centres_.push_back(x);
  }

  void move(std::size_t k, const Vector& x) {
    const std::size_t before = cell_of(centres_[k]), now = cell_of(x);
    centres_[k] = x;
    if (before == now) return;
    auto& left = numbers_[before];
    // The other particles of the cell keep their order, because it decides the order of the sums of
    // push_apart() and so the bits of the result.
    left.erase(std::find(left.begin(), left.end(), k));
    numbers_[now].push_back(k);
  }

  /// Calls visit(apart, distance, number) for each particle but `self`, also for each fixed one,
  /// whose centre is closer to `x` than factor * distance. `distance` [L] is the least distance
  /// that its centre must have from that of `self`, `apart` [L] the vector from `x` to its centre,
  /// and `number` its number, which a fixed one does not have. Stops and returns true as soon as
  /// `visit` returns true.
  template <class Visit>
  bool any_close(const Vector& x, std::size_t self, double factor, const Visit& visit) const {
    const double radius = radii_[self];
    const auto look = [&](const Vector& other, double other_radius,
                          std::optional<std::size_t> number) {
      const Vector apart = widest_places().difference(x, other);
      const double distance = other_radius + radius + gap_, least = factor * distance;
      return apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2] < least * least &&
             visit(apart, distance, number);
    };
    for (const auto& fixed : fixed_)
      if (look(fixed.centre, fixed.radius, {})) return true;
    const auto home = place_of(x);
    std::array<std::array<std::size_t, 3>, 3> near{};
    std::array<std::size_t, 3> count{};
    for (const std::size_t d : {0U, 1U, 2U}) count[d] = neighbours(home[d], d, near[d]);
    for (std::size_t i = 0; i < count[0]; ++i)
      for (std::size_t j = 0; j < count[1]; ++j)
        for (std::size_t l = 0; l < count[2]; ++l)
          for (const std::size_t k : numbers_[number_of({near[0][i], near[1][j], near[2][l]})])
            if (k != self && look(centres_[k], radii_[k], k)) return true;
    return false;
  }

  /// True if particle `self` may have its centre at `x`.
  bool is_free(const Vector& x, std::size_t self) const {
    if (places(self).has_planes() && !places(self).contain(x)) return false;
    return !any_close(x, self, 1, [](const auto&...) { return true; });
  }

 private:
  std::size_t number_of(const std::array<std::size_t, 3>& place) const {
    return (place[0] * cells_[1] + place[1]) * cells_[2] + place[2];
  }
  /// The place, from 0 along each axis, of the cell with the point `x` [L].
  std::array<std::size_t, 3> place_of(const Vector& x) const {
    std::array<std::size_t, 3> place{};
    for (std::size_t d = 0; d < dimension(); ++d) {
      const double share = (x[d] - widest_places().from(d)) / widest_places().length(d);
      const double at = share > 0 ? share * static_cast<double>(cells_[d]) : 0;
      place[d] = std::min(cells_[d] - 1, static_cast<std::size_t>(at));
    }
    return place;
  }
  std::size_t cell_of(const Vector& x) const { return number_of(place_of(x)); }
  /// Sets `near` to cell `at` and the cells beside it along axis d, each once, also across a
  /// periodic side. Returns how many they are, 1 to 3.
  std::size_t neighbours(std::size_t at, std::size_t d, std::array<std::size_t, 3>& near) const {
    const std::size_t n = cells_[d];
    std::size_t count = 0;
    near[count++] = at;
    const bool is_ring = widest_places().period(d) > 0 && n > 2;
    if (at > 0 || is_ring) near[count++] = at > 0 ? at - 1 : n - 1;
    if (at + 1 < n || is_ring) near[count++] = at + 1 < n ? at + 1 : 0;
    return count;
  }

  const std::vector<Places>& places_;
  std::vector<double> radii_;
  double gap_;
  std::vector<FixedParticle> fixed_;
  std::array<std::size_t, 3> cells_{1, 1, 1};      // number of cells along each axis
  std::vector<std::vector<std::size_t>> numbers_;  // of the particles in each cell
  std::vector<Vector> centres_;                    // of the particles that are placed [L]
};

/// Moves particles that are too close apart, in up to `rounds` rounds over all of them. Returns
/// true as soon as none is too close after a round.
bool push_apart(PlacedParticles& placed, int rounds) {
  constexpr double kFurther = ArrangementTuning::kFurther;
  const auto is_free = [&](std::size_t k) { return placed.is_free(placed.centres()[k], k); };
  for (int round = 0; round < rounds; ++round) {
    bool all_free = true;
    for (std::size_t k = 0; k < placed.count(); ++k) {
      all_free = all_free && is_free(k);
      // Each of two particles that are too close moves by half of the missing distance. A particle
      // that is too close to a fixed one moves by all of it.
      Vector push{};
      const Vector x = placed.centres()[k];
      placed.any_close(x, k, kFurther, [&](const Vector& apart, double distance, auto number) {
        const double length = length_of(apart);
        const double missing = (number ? 0.5 : 1.0) * (kFurther * distance - length);
        // Two particles with the same centre are separated along the first axis.
        const Vector away = length > 0
                                ? Vector{apart[0] / length, apart[1] / length, apart[2] / length}
                                : Vector{1, 0, 0};
        for (std::size_t d = 0; d < placed.dimension(); ++d) push[d] -= missing * away[d];
        return false;
      });
      if (push != Vector{})
        placed.move(k, placed.places(k).nearest({x[0] + push[0], x[1] + push[1], x[2] + push[2]}));
    }
    // A late push of the round may have moved a particle too close to one that was pushed earlier.
    for (std::size_t k = 0; all_free && k < placed.count(); ++k) all_free = is_free(k);
    if (all_free) return true;
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
