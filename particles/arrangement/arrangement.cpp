// Places discs at random (arrangement.hpp). Lengths are in the unit of the case. Discs that do not
// fit are an Error(kBadInput). Each seed must keep its arrangement. The compiler must not contract
// products and sums (-ffp-contract=off in CMakeLists.txt), and only + - * / and sqrt may be used,
// because these give the same bits on every machine.
#include "viscontact/particles/arrangement/arrangement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <variant>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/splitmix.hpp"
#include "viscontact/particles/domain/domain.hpp"

namespace viscontact::particles {
namespace {

/// x and y of a centre, or of a vector between centres [L].
using Point = std::array<double, 2>;

/// The places that a centre may take: a disc, or a rectangle that may be periodic.
class Places {
 public:
  /// `from_wall` is the least distance of a centre from a wall [L].
  Places(const Domain& domain, double from_wall) {
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
    periods_ = periods_of(domain);
    for (const std::size_t d : {0U, 1U}) {
      from_[d] = box.from[d] + (box.periodic[d] ? 0 : from_wall);
      to_[d] = box.to[d] - (box.periodic[d] ? 0 : from_wall);
    }
  }

  /// True if there is no place for a centre.
  bool are_empty() const { return !(from_[0] <= to_[0] && from_[1] <= to_[1]); }
  /// Period in direction `d` [L]; 0 if the domain is not periodic in it. `d` is 0 for x, 1 for y.
  double period(std::size_t d) const { return periods_[d]; }
  /// Smallest coordinate of a place in direction `d` [L].
  double from(std::size_t d) const { return from_[d]; }
  /// Largest less smallest coordinate of a place in direction `d` [L].
  double length(std::size_t d) const { return to_[d] - from_[d]; }

  /// True if a centre may be at `x`.
  bool contain(const Point& x) const {
    if (!round_) return from_[0] <= x[0] && x[0] <= to_[0] && from_[1] <= x[1] && x[1] <= to_[1];
    const double dx = x[0] - centre_[0], dy = x[1] - centre_[1];
    return dx * dx + dy * dy <= radius_ * radius_;
  }

  /// The image of `x` that is in the box, for an `x` less than a period outside.
  Point wrapped(Point x) const {
    for (const std::size_t d : {0U, 1U}) {
      if (periods_[d] == 0) continue;
      if (x[d] < from_[d]) x[d] += periods_[d];
      if (x[d] >= to_[d]) x[d] -= periods_[d];
      // Rounding may leave a coordinate at the upper side or just below the lower one.
      if (x[d] < from_[d] || x[d] >= to_[d]) x[d] = from_[d];
    }
    return x;
  }

  /// The nearest place to `x` that is allowed, slightly inside.
  Point nearest(Point x) const {
    if (!round_) {
      x = wrapped(x);
      for (const std::size_t d : {0U, 1U})
        if (periods_[d] == 0) x[d] = std::clamp(x[d], from_[d], to_[d]);
      return x;
    }
    if (contain(x)) return x;
    const double dx = x[0] - centre_[0], dy = x[1] - centre_[1];
    // The centre moves inside by more than the rounding error, so that contain() holds.
    constexpr double kInside = 1 - 1e-12;
    const double factor = radius_ * kInside / std::sqrt(dx * dx + dy * dy);
    return {centre_[0] + factor * dx, centre_[1] + factor * dy};
  }

  /// A random place, uniformly distributed.
  Point random(SplitMix64& random) const {
    for (;;) {
      Point x{};
      for (const std::size_t d : {0U, 1U}) x[d] = random.between(from_[d], to_[d]);
      if (contain(x)) return wrapped(x);
    }
  }

  /// The shortest vector from `a` to `b`, across periodic sides too.
  Point difference(const Point& a, const Point& b) const {
    Point apart = {b[0] - a[0], b[1] - a[1]};
    for (const std::size_t d : {0U, 1U}) {
      if (periods_[d] == 0) continue;
      if (apart[d] > periods_[d] / 2) apart[d] -= periods_[d];
      if (apart[d] < -periods_[d] / 2) apart[d] += periods_[d];
    }
    return apart;
  }

 private:
  bool round_ = false;
  double radius_ = 0;
  Point centre_{}, from_{}, to_{};
  std::array<double, 2> periods_{};
};

/// A particle that is in the domain before the new discs are placed, and the least distance of
/// their centres from it [L].
struct Obstacle {
  Point centre;
  double distance;
};

/// The discs that are placed so far, sorted into cells that are at least as wide as the least
/// distance of two centres, so that only discs in neighbouring cells can be too close.
class Discs {
 public:
  Discs(const Places& places, double distance, std::size_t most, std::vector<Obstacle> obstacles)
      : places_(places), distance_(distance), obstacles_(std::move(obstacles)) {
    // More cells than discs would cost memory without saving time.
    const double side = std::sqrt(static_cast<double>(most)) + 1;
    for (const std::size_t d : {0U, 1U}) {
      const double fit = std::min(places.length(d) / distance_, side);
      cells_[d] = std::max<std::size_t>(1, static_cast<std::size_t>(fit));
    }
    numbers_.resize(cells_[0] * cells_[1]);
  }

  const std::vector<Point>& centres() const { return centres_; }
  double distance() const { return distance_; }

  void add(const Point& x) {
    numbers_[cell_of(x)].push_back(centres_.size());
    centres_.push_back(x);
  }

  void move(std::size_t k, const Point& x) {
    const std::size_t before = cell_of(centres_[k]), now = cell_of(x);
    centres_[k] = x;
    if (before == now) return;
    auto& left = numbers_[before];
    // The order in a cell decides the order of pushes, so it must not depend on the library.
    left.erase(std::find(left.begin(), left.end(), k));
    numbers_[now].push_back(k);
  }

  /// Calls `visit` for each disc except disc `self`, and for each obstacle, that is closer to `x`
  /// than `factor` times its least distance: with the vector from `x` to it [L], its least distance
  /// [L] and its number (obstacles have none). Ends early and returns true if `visit` returns true.
  template <class Visit>
  bool any_close(const Point& x, std::optional<std::size_t> self, double factor,
                 const Visit& visit) const {
    const auto look = [&](const Point& other, double distance, std::optional<std::size_t> number) {
      const Point apart = places_.difference(x, other);
      const double least = factor * distance;
      return apart[0] * apart[0] + apart[1] * apart[1] < least * least &&
             visit(apart, distance, number);
    };
    for (const auto& obstacle : obstacles_)
      if (look(obstacle.centre, obstacle.distance, {})) return true;
    const auto home = place_of(x);
    std::array<std::array<std::size_t, 3>, 2> near{};
    std::array<std::size_t, 2> count{};
    for (const std::size_t d : {0U, 1U}) count[d] = neighbours(home[d], d, near[d]);
    for (std::size_t i = 0; i < count[0]; ++i)
      for (std::size_t j = 0; j < count[1]; ++j)
        for (const std::size_t k : numbers_[near[0][i] * cells_[1] + near[1][j]])
          if (k != self && look(centres_[k], distance_, k)) return true;
    return false;
  }

  bool is_free(const Point& x, std::optional<std::size_t> self) const {
    return !any_close(x, self, 1, [](const auto&...) { return true; });
  }

 private:
  std::array<std::size_t, 2> place_of(const Point& x) const {
    std::array<std::size_t, 2> place{};
    for (const std::size_t d : {0U, 1U}) {
      const double share = (x[d] - places_.from(d)) / places_.length(d);
      const double at = share > 0 ? share * static_cast<double>(cells_[d]) : 0;
      place[d] = std::min(cells_[d] - 1, static_cast<std::size_t>(at));
    }
    return place;
  }
  std::size_t cell_of(const Point& x) const {
    const auto place = place_of(x);
    return place[0] * cells_[1] + place[1];
  }
  /// The cells beside cell `at` along axis d, and this cell, each once. Returns their number.
  std::size_t neighbours(std::size_t at, std::size_t d, std::array<std::size_t, 3>& near) const {
    const std::size_t n = cells_[d];
    std::size_t count = 0;
    near[count++] = at;
    if (at > 0 || (places_.period(d) > 0 && n > 2)) near[count++] = at > 0 ? at - 1 : n - 1;
    if (at + 1 < n || (places_.period(d) > 0 && n > 2)) near[count++] = at + 1 < n ? at + 1 : 0;
    return count;
  }

  const Places& places_;
  double distance_;
  std::vector<Obstacle> obstacles_;
  std::array<std::size_t, 2> cells_{};
  std::vector<std::vector<std::size_t>> numbers_;
  std::vector<Point> centres_;
};

/// Pushes discs apart that are too close, in up to `rounds` rounds over all discs. True if all gaps
/// are large enough then.
bool push_apart(Discs& discs, const Places& places, int rounds) {
  // Discs are pushed to 1.001 times the distance that they must have, because the pushes approach
  // the distance that they aim at without reaching it.
  constexpr double kFurther = 1 + 1e-3;
  for (int round = 0; round < rounds; ++round) {
    bool all_free = true;
    for (std::size_t k = 0; k < discs.centres().size(); ++k) {
      all_free = all_free && discs.is_free(discs.centres()[k], k);
      // Each of two close discs moves by half of the missing distance. Beside an obstacle, which
      // does not move, the disc moves by all of it.
      Point push{};
      const Point x = discs.centres()[k];
      discs.any_close(x, k, kFurther, [&](const Point& apart, double distance, auto number) {
        const double length = std::sqrt(apart[0] * apart[0] + apart[1] * apart[1]);
        const double missing = (number ? 0.5 : 1.0) * (kFurther * distance - length);
        // Two discs at one place are separated along x.
        const Point away = length > 0 ? Point{apart[0] / length, apart[1] / length} : Point{1, 0};
        for (const std::size_t d : {0U, 1U}) push[d] -= missing * away[d];
        return false;
      });
      if (push != Point{}) discs.move(k, places.nearest({x[0] + push[0], x[1] + push[1]}));
    }
    if (all_free) return true;
  }
  return false;
}

/// Moves discs at random and keeps the moves that leave all gaps large enough.
void shuffle(Discs& discs, const Places& places, double area, SplitMix64& random) {
  const auto count = discs.centres().size();
  // About half of the moves are kept if they go half as far as the gaps in a triangular lattice of
  // the same density. The bounds keep moves possible near the densest lattice and in empty domains.
  const double lattice = std::sqrt(2 * area / (std::sqrt(3.0) * static_cast<double>(count)));
  const double span = std::min({0.5 * places.length(0), 0.5 * places.length(1), lattice});
  const double step =
      std::min(span, std::max(0.5 * (lattice - discs.distance()), 0.01 * discs.distance()));
  // After 500 moves of each disc the arrangement no longer depends on the start. At most 20 million
  // moves are made in all, which bounds the time, but at least 20 of each disc.
  constexpr std::size_t kMoves = 20000000, kMost = 500, kLeast = 20;
  const std::size_t moves = count * std::clamp(kMoves / count, kLeast, kMost);
  for (std::size_t move = 0; move < moves; ++move) {
    const std::size_t k = random.below(count);
    Point x = discs.centres()[k];
    for (double& coordinate : x) coordinate += random.between(-step, step);
    x = places.wrapped(x);
    if (places.contain(x) && discs.is_free(x, k)) discs.move(k, x);
  }
}

}  // namespace

double area_of(const Domain& domain) {
  if (const auto* disc = std::get_if<DiscDomain>(&domain))
    return std::numbers::pi * disc->radius * disc->radius;
  if (const auto* box = std::get_if<BoxDomain>(&domain))
    return (box->to[0] - box->from[0]) * (box->to[1] - box->from[1]);
  return 0;
}

std::size_t count_of(double fraction, double radius, const Domain& domain) {
  const double count = fraction * area_of(domain) / (std::numbers::pi * radius * radius);
  constexpr double kMost = 1e9;
  return static_cast<std::size_t>(std::clamp(std::floor(count + 0.5), 1.0, kMost));
}

std::vector<double> arrange(const Arrangement& asked, const Domain& domain,
                            const Particles& present) {
  const double disc_area = std::numbers::pi * asked.radius * asked.radius;
  const double area = area_of(domain);
  const auto refuse = [&](const std::string& why) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{} discs of radius {} with gaps of at least {} do not fit ({}); they take "
                    "{:.4g} of the area of the domain; use fewer or smaller discs, or a smaller "
                    "gap",
                    asked.count, asked.radius, asked.smallest_gap, why,
                    static_cast<double>(asked.count) * disc_area / area));
  };
  const Places places(domain, asked.radius + asked.smallest_gap);
  const double distance = 2 * asked.radius + asked.smallest_gap;
  if (places.are_empty()) refuse("the domain is narrower than one disc with its gaps");
  for (const std::size_t d : {0U, 1U})
    if (places.period(d) > 0 && places.period(d) < distance)
      refuse("a period is shorter than one disc with its gap");
  // Discs of radius distance/2 (with half of the gap around each) that do not overlap cover at most
  // the fraction pi/sqrt(12) of the area, which the triangular lattice covers.
  constexpr double kDensest = 0.9068996821171089;  // pi/sqrt(12)
  if (static_cast<double>(asked.count) * std::numbers::pi * distance * distance / 4 >
      kDensest * area)
    refuse("the densest lattice has no room for them");

  std::vector<Obstacle> obstacles;
  for (std::size_t k = 0; k < present.count(); ++k) {
    const Vector x = present.position(k);
    obstacles.push_back({{x[0], x[1]}, present.radii[k] + asked.radius + asked.smallest_gap});
  }
  SplitMix64 random(asked.seed);
  // Pushing can fail although there is an arrangement. Then it begins again from other places.
  constexpr int kBeginnings = 10, kTries = 1000, kRounds = 2000;
  for (int beginning = 0; beginning < kBeginnings; ++beginning) {
    Discs discs(places, distance, asked.count, obstacles);
    for (std::size_t k = 0; k < asked.count; ++k) {
      Point x = places.random(random);
      for (int i = 1; i < kTries && !discs.is_free(x, {}); ++i) x = places.random(random);
      discs.add(x);
    }
    if (!push_apart(discs, places, kRounds)) continue;
    shuffle(discs, places, area, random);
    std::vector<double> positions;
    for (const auto& x : discs.centres()) positions.insert(positions.end(), x.begin(), x.end());
    return positions;
  }
  refuse(fmt::format("{} random beginnings did not lead to an arrangement", kBeginnings));
  return {};
}

}  // namespace viscontact::particles
