// Hits in the order of their times, docs/physics.md (5.16).
#include "viscontact/contact_dynamics/impacts/impacts.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>

#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {
namespace {

struct HitTuning {
  // Times of hits that differ by less than this share of the step count as equal, so that the hits
  // of a symmetric impact are decided together in spite of rounding errors.
  static constexpr double kSameTime = 1e-9;
  // This number of secants only guards against an endless loop.
  static constexpr int kMostSecants = 200;
  // Steps of Newton's method, far more than it needs.
  static constexpr int kMostNewtonSteps = 20;
  // An approach that would cause a bounce that lasts less than this fraction of the step counts as
  // at rest.
  static constexpr double kShortestFlight = 0.05;
  // An approach is not seen if it moves the particles by less than a thousandth of
  // ImpactStep::touching in the step, or is a rounding error, relative to the speeds.
  static constexpr double kUnseen = 1e-3, kRounding = 1e-12;
  // The slowest hit of a pair at rest over the velocity that forces give the pair in a step.
  // Slower hits would keep a packing shaking.
  static constexpr double kPulled = 5;
  // A pair that has been hit so often in a step, or so often with a load, is not hit again,
  // because impacts under load can follow each other without end.
  static constexpr int kMostHits = 1000, kMostUnderLoad = 30;
  // Each search moves on by at least this part of the step, which is above rounding errors.
  static constexpr double kBeyondRounding = 1e-12;
};

/// A root of a continuous function that is > 0 at `from` and <= 0 at `until`, by the Illinois
/// method (a bracketing secant method): the upper end of the last bracket.
template <class Function>
double root_of_falling(const Function& f, double from, double until) {
  double low = from, high = until, at_low = f(low), at_high = f(high);
  int side = 0;
  for (int n = 0; n < HitTuning::kMostSecants && at_high != 0; ++n) {
    double t = (low * at_high - high * at_low) / (at_high - at_low);
    // If one end is the root but for rounding errors, the secant ends there, and bisection moves
    // the other end.
    if (!(t > low && t < high)) t = low + (high - low) / 2;
    if (!(t > low && t < high)) break;
    const double here = f(t);
    if (here > 0) {
      low = t;
      at_low = here;
      if (side == 1) at_high /= 2;
      side = 1;
    } else {
      high = t;
      at_high = here;
      if (side == -1) at_low /= 2;
      side = -1;
    }
    if (high - low <= 4 * std::numeric_limits<double>::epsilon() * high) break;
  }
  return high;
}

}  // namespace

template <int D>
Impacts<D>::Impacts(State& state, const ImpactStep& step)
    : state_(state), step_(step), free_bodies_(step.bodies.begin(), step.bodies.end()) {
  assert(step.h > 0 && step.impulse_time > 0 && step.end >= step.begin && step.touching > 0);
  assert(step.displacements.size() == step.mobilities.size() * static_cast<std::size_t>(D));
  assert(step.turns.empty() == step.turn_mobilities.empty());
  assert(step.bodies.size() == state.particles.bodies.count());
}

template <int D>
typename Impacts<D>::Flight& Impacts<D>::flight(std::int32_t k) {
  if (flight_of_.empty()) flight_of_.assign(state_.particles.count(), -1);
  auto& number = flight_of_[index_of(k)];
  if (number < 0) {
    number = static_cast<std::int32_t>(flights_.size());
    flights_.emplace_back();
    touched_.push_back(k);
  }
  return flights_[index_of(number)];
}

template <int D>
const typename Impacts<D>::Flight& Impacts<D>::flight_or_none(std::int32_t k) const {
  static const Flight kNone{};
  return is_touched(k) ? flights_[index_of(flight_of_[index_of(k)])] : kNone;
}

template <int D>
Vector Impacts<D>::free_velocity(std::int32_t k) const {
  if (k < 0) return {};
  return (1 / step_.h) * point_of(step_.displacements.data(), index_of(k), D);
}

template <int D>
Vector Impacts<D>::acceleration(std::int32_t k) const {
  if (is_given(k)) return {};
  return (1 / step_.impulse_time) * (free_velocity(k) - state_.particles.velocity(index_of(k)));
}

template <int D>
Vector Impacts<D>::free_spin(std::int32_t k) const {
  if (k < 0 || step_.turns.empty()) return {};
  const auto r = static_cast<std::size_t>(kTurns<D>);
  Vector turn{};
  for (std::size_t i = 0; i < r; ++i) turn[3 - r + i] = step_.turns[index_of(k) * r + i];
  return (1 / step_.h) * turn;
}

template <int D>
Vector Impacts<D>::centre_velocity(std::int32_t k) const {
  const auto body = k < 0 ? -1 : state_.particles.bodies.body_of(k);
  return body < 0 ? free_velocity(k) : (1 / step_.h) * free_bodies_[index_of(body)].displacement;
}

template <int D>
Vector Impacts<D>::centre_acceleration(std::int32_t k) const {
  const auto body = k < 0 ? -1 : state_.particles.bodies.body_of(k);
  if (body < 0) return acceleration(k);
  const Vector before = state_.particles.bodies.bodies[index_of(body)].velocity;
  return (1 / step_.impulse_time) * (centre_velocity(k) - before);
}

template <int D>
typename Impacts<D>::Arm Impacts<D>::arm_of(std::int32_t k) const {
  const auto body = k < 0 ? -1 : state_.particles.bodies.body_of(k);
  if (body < 0) return {};
  const Vector before = state_.particles.bodies.bodies[index_of(body)].angular_velocity;
  return {offset_in_body(state_.particles, k), spin(k), flight_or_none(k).turn_lag,
          free_spin(k) - before};
}

template <int D>
RigidBody Impacts<D>::body_at(std::int32_t k, double t) const {
  const auto number = index_of(state_.particles.bodies.body_of(k));
  const auto& before = state_.particles.bodies.bodies[number];
  RigidBody body{before, {}, {}, {}, before.mass, before.inertia};
  if (D == 3) body.orientation = turned(body.orientation, t * spin(k) - flight_or_none(k).turn_lag);
  body.angular_momentum = step_.bodies[number].angular_momentum;
  update_angular_velocity(body, D);
  return body;
}

template <int D>
Vector Impacts<D>::spin_at(std::int32_t k, double t) const {
  return precesses(k) ? body_at(k, t).angular_velocity : spin(k);
}

template <int D>
typename Impacts<D>::Approach Impacts<D>::approach_of(std::size_t k) {
  const auto& p = state_.particles;
  const auto& of = pair(k);
  const auto second = index_of(of.second);
  const double half = step_.h / 2;
  const auto& flies = flight_or_none(of.second);
  const Vector pull = centre_acceleration(of.second);
  Approach approach;
  approach.a = centre_velocity(of.second) - half * pull + flies.change;
  approach.b = 0.5 * pull;
  approach.second = arm_of(of.second);
  approach.before = p.velocity(second);
  approach.pull = acceleration(of.second) - acceleration(of.first);
  if (of.first < 0) {
    approach.obstacle = &step_.obstacles[of.plane()];
    approach.sum = p.radii[second];
    approach.c = p.position(second) - flies.lag;
    return approach;
  }
  const auto& other = flight_or_none(of.first);
  const Vector other_pull = centre_acceleration(of.first);
  const auto apart = separation<D>(p, of.first, of.second, of.image);
  for (std::size_t d = 0; d < D; ++d) approach.c[d] = apart[d];
  approach.c = approach.c - (flies.lag - other.lag);
  approach.a = approach.a - (centre_velocity(of.first) - half * other_pull + other.change);
  approach.b = approach.b - 0.5 * other_pull;
  approach.first = arm_of(of.first);
  approach.before = approach.before - p.velocity(index_of(of.first));
  approach.sum = p.radii[index_of(of.first)] + p.radii[second];
  return approach;
}

template <int D>
Vector Impacts<D>::normal_of(const Approach& approach, double t) const {
  const Vector x = approach.place(t);
  if (approach.obstacle != nullptr) return normal_at(approach.obstacle->at(step_.begin + t), x);
  const double distance = norm(x);
  return distance > 0 ? (1 / distance) * x : Vector{1, 0, 0};
}

template <int D>
double Impacts<D>::gap_of(const Approach& approach, double t) const {
  const Vector x = approach.place(t);
  return approach.obstacle != nullptr
             ? particles::gap(approach.obstacle->at(step_.begin + t), x, approach.sum)
             : norm(x) - approach.sum;
}

template <int D>
Vector Impacts<D>::surface_of(const Approach& approach, double t) const {
  if (approach.obstacle == nullptr) return {};
  const Vector foot =
      approach.place(t) - (approach.sum + gap_of(approach, t)) * normal_of(approach, t);
  return approach.obstacle->surface_velocity(foot, step_.begin + t);
}

template <int D>
Vector Impacts<D>::velocity_of(const Approach& approach, double t) const {
  return approach.velocity(t) - surface_of(approach, t);
}

template <int D>
double Impacts<D>::acceleration_of_gap(const Approach& approach, double t) const {
  const Vector n = normal_of(approach, t);
  const double acceleration = dot(n, approach.pull);
  if (approach.obstacle == nullptr) return acceleration;
  const auto& obstacle = *approach.obstacle;
  const Vector x = approach.place(t);
  const Vector u = approach.velocity(t) - obstacle.surface_velocity(x, step_.begin + t);
  const Vector along = u - dot(n, u) * n;
  if (obstacle.start.is_curved()) {
    const double curvature = 1 / (obstacle.start.radius - approach.sum);
    return acceleration - curvature * dot(along, along);
  }
  const Vector turns = cross(obstacle.angular_velocity, n);
  const Vector arm = x - obstacle.pivot - obstacle.velocity.integral(step_.begin + t);
  return acceleration + dot(turns, 2.0 * u + cross(obstacle.angular_velocity, arm));
}

template <int D>
std::optional<double> Impacts<D>::time_of_meeting(const Approach& approach, double from,
                                                  double until) const {
  assert(from <= until);
  const auto* obstacle = approach.obstacle;
  // After an impact the gap is 0 but for rounding errors, of either sign. A gap that opens at
  // `from` therefore closes when it falls to 0, or, if it is < 0 at `from`, to its value there.
  const double closed = std::min(gap_of(approach, from), 0.0);
  const auto gap_at = [&](double t) { return gap_of(approach, t) - closed; };
  const auto rate_at = [&](double t) {
    return dot(normal_of(approach, t), velocity_of(approach, t));
  };
  const double gap = gap_at(from), rate = rate_at(from);
  const Vector n = normal_of(approach, from), v = velocity_of(approach, from);
  if (gap == 0 && rate < 0) return from;
  // This search misses a gap that closes and opens again before `until`. Only for particles without
  // relative acceleration and at planes that do not turn, the formulas below always find it.
  const auto search = [&]() -> std::optional<double> {
    if (gap_at(until) > 0) return std::nullopt;
    // A gap that opens is largest at `top`, and closes after it.
    const double top =
        rate > 0 && rate_at(until) < 0 ? root_of_falling(rate_at, from, until) : from;
    if (!(gap_at(top) > 0)) return std::nullopt;
    return root_of_falling(gap_at, top, until);
  };
  if (obstacle != nullptr && (obstacle->start.is_curved() || norm(obstacle->angular_velocity) > 0))
    return search();
  if (obstacle == nullptr && !approach.turns() && approach.b == Vector{}) {
    const Vector c = approach.place(from);
    const double square = dot(v, v), along = dot(c, v);
    const double root = along * along - square * gap * (norm(c) + approach.sum);
    if (!(along < 0) || root < 0) return std::nullopt;
    const double t = from + gap * (norm(c) + approach.sum) / (-along + std::sqrt(root));
    return t <= until ? std::optional(t) : std::nullopt;
  }
  // With the normal n at `from`, the gap at from + s is gap + rate s + curvature s^2. Two particles
  // that leave each other turn around each other, which adds the second part of curvature.
  double curvature = dot(n, approach.acceleration(from)) / 2;
  if (obstacle == nullptr && rate > 0)
    curvature += (dot(v, v) - rate * rate) / (2 * (approach.sum + gap + closed));
  const double root = rate * rate - 4 * curvature * gap;
  // The curvature changes on the way, so that a gap that opens may close again.
  if (root < 0 || (rate >= 0 && curvature >= 0)) return search();
  // The time at which the gap falls to 0, by a formula for each sign of the rate in which terms do
  // not cancel each other.
  double t = from + (rate < 0 ? 2 * gap / (-rate + std::sqrt(root))
                              : (rate + std::sqrt(root)) / (-2 * curvature));
  if (obstacle != nullptr && !approach.turns()) return t <= until ? std::optional(t) : std::nullopt;
  // The normal of two particles and the arm of a body change on the way, so that Newton's method
  // improves the guess t.
  for (int i = 0; i < HitTuning::kMostNewtonSteps; ++i) {
    const double falls = rate_at(t);
    if (!(falls < 0)) return search();
    const double change = -gap_at(t) / falls;
    // Rounding errors of the gap are larger than those of times.
    t = std::max(t + change, from);
    if (std::abs(change) <= 4 * std::numeric_limits<double>::epsilon() * t) break;
  }
  return t <= until ? std::optional(t) : search();
}

template <int D>
std::optional<typename Impacts<D>::Hit> Impacts<D>::hit_at(std::size_t k, double time) {
  const auto approach = approach_of(k);
  if (gap_of(approach, time) > 2 * step_.touching) return std::nullopt;
  const auto& of = pair(k);
  const Vector normal = normal_of(approach, time);
  auto at_start = approach;
  at_start.c = at_start.c + flight_or_none(of.second).lag;
  if (of.first >= 0) at_start.c = at_start.c - flight_or_none(of.first).lag;
  at_start.first.lag = at_start.second.lag = {};
  using Tuning = HitTuning;
  // An approach slower than `ended` [L/T] would cause too short a bounce. Both limits of rest, this
  // one and `pulled`, tend to 0 with h (docs/physics.md (5.16)).
  const double pull = acceleration_of_gap(approach, time);
  const double ended = std::max(
      Tuning::kShortestFlight * -step_.h * pull / (2 * step_.laws.restitution.coefficient), 0.0);
  // An approach slower than `unseen` [L/T] moves the particles too little, or is a rounding error.
  const double speeds = norm(free_velocity(of.first)) + norm(free_velocity(of.second)) +
                        norm(flight_or_none(of.first).change) +
                        norm(flight_or_none(of.second).change);
  const double unseen =
      std::max(Tuning::kUnseen * step_.touching / step_.h, Tuning::kRounding * speeds);
  // `pulled` [L/T] is kPulled times the velocity that forces give the pair in a step. `rests` is
  // true if the pair touched at the beginning of the step and neither approached nor opened faster
  // than `unseen`, or, if it bore a load, approached no faster than `pulled`. Such a pair is hit
  // only if it approaches faster than `pulled`, because slower hits would keep a packing shaking. A
  // pair without load that opens still flies after an impact, also if its gap is below `touching`.
  const double pulled = Tuning::kPulled * step_.h *
                        std::max({std::abs(dot(normal, acceleration(of.second))),
                                  std::abs(dot(normal, acceleration(of.first))), std::abs(pull)});
  const bool bore_load = of.impulse != 0 || of.gamma < 0;
  const Vector surface = surface_of(approach, time);
  const double closing = -dot(normal, approach.before - surface);
  const bool rests = gap_of(at_start, 0) <= step_.touching &&
                     (bore_load ? closing <= pulled : std::abs(closing) <= unseen);
  // The velocity of a point by the true turning of its body, minus that by spin(), which
  // velocity_of() already contains.
  const auto turning_of = [&](std::int32_t particle, const Arm& arm) {
    if (!precesses(particle)) return Vector{};
    return cross(spin_at(particle, time) - spin(particle), arm.at(time));
  };
  const Vector turning =
      turning_of(of.second, approach.second) - turning_of(of.first, approach.first);
  const Vector flies = velocity_of(approach, time) + turning;
  const double rate =
      dot(normal, rests ? approach.velocity_without_forces(time, step_.impulse_time, step_.h) -
                              surface + turning
                        : flies);
  if (!(-rate > std::max({ended, unseen, rests ? pulled : 0.0}))) return std::nullopt;
  return Hit{k, normal, rate, flies, approach.sum};
}

template <int D>
void Impacts<D>::expect(std::size_t k, double from) {
  const auto& of = pair(k);
  if (is_given(of.first) && is_given(of.second)) return;
  const std::array versions = {version(of.first), version(of.second)};
  using Tuning = HitTuning;
  if (!hits_of_.empty() &&
      hits_of_[k] >= (of.impulse == 0 ? Tuning::kMostHits : Tuning::kMostUnderLoad))
    return;
  const auto approach = approach_of(k);
  // Each pass searches from `begin` to the next jump of the obstacle's velocity or the step's end.
  for (double begin = from, end = 0; begin < step_.h; begin = end) {
    // A hit at the end of the step counts although rounding errors make it later.
    end = (1 + Tuning::kSameTime) * step_.h;
    if (approach.obstacle != nullptr)
      end = std::min(end, approach.obstacle->velocity.next_end(step_.begin + begin) - step_.begin);
    end = std::max(end, begin + Tuning::kBeyondRounding * step_.h);
    const auto at = time_of_meeting(approach, begin, end);
    if (!at || !hit_at(k, std::min(*at, step_.h))) continue;
    expected_.push({std::min(*at, step_.h), k, versions});
    return;
  }
}

template <int D>
void Impacts<D>::run() {
  const auto& p = state_.particles;
  for (std::size_t k = 0; k < pair_count(); ++k)
    if (pair(k).first < 0 || !cannot_close<D>(p, pair(k), step_.displacements)) expect(k, 0);
  while (!expected_.empty()) {
    const double time = expected_.top().time;
    std::vector<Hit> hits;
    while (!expected_.empty() && expected_.top().time <= time + HitTuning::kSameTime * step_.h) {
      const auto next = expected_.top();
      expected_.pop();
      const auto& of = pair(next.pair);
      if (next.versions != std::array{version(of.first), version(of.second)}) continue;
      if (auto hit = hit_at(next.pair, time)) hits.push_back(*hit);
    }
    if (hits.empty()) continue;
    if (!pairs_of_) {
      pairs_of_.emplace(state_, true);
      hits_of_.resize(pair_count());
    }
    // Hits that share a particle or a rigid body are one impact. The key of a particle k without a
    // body is k, that of the rigid body b is -1 - b.
    std::map<std::int32_t, std::size_t> group_of;
    std::vector<std::vector<Hit>> groups;
    const auto unit = [&](std::int32_t k) {
      const auto body = p.bodies.body_of(k);
      return body < 0 ? k : -1 - body;
    };
    for (const auto& hit : hits) {
      std::size_t group = groups.size();
      groups.push_back({hit});
      for (const auto k : {pair(hit.pair).first, pair(hit.pair).second}) {
        if (k < 0) continue;
        const auto [at, is_new] = group_of.try_emplace(unit(k), group);
        if (is_new || at->second == group) continue;
        const auto joined = at->second;
        groups[group].insert(groups[group].begin(), groups[joined].begin(), groups[joined].end());
        groups[joined].clear();
        for (auto& [key, number] : group_of)
          if (number == joined) number = group;
      }
    }
    for (const auto& group : groups)
      if (!group.empty()) apply_impacts(group, time);
  }
  finish();
}

template <int D>
void Impacts<D>::finish() {
  const auto& p = state_.particles;
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  for (const auto particle : touched_) {
    const auto k = index_of(particle);
    auto& of = flight(particle);
    Vector moves = step_.h * of.change - of.lag, turns = step_.h * of.turn_change - of.turn_lag;
    if (const auto body = p.bodies.body_of(particle); body >= 0) {
      const auto& step = step_.bodies[index_of(body)];
      const Vector moved =
          displacement_at(step.displacement, step.turn, offset_in_body(p, particle), D);
      moves = moved - point_of(step_.displacements.data(), k, D);
    }
    for (std::size_t i = 0; i < d; ++i) step_.displacements[k * d + i] += moves[i];
    if (!step_.turns.empty())
      for (std::size_t i = 0; i < r; ++i) step_.turns[k * r + i] += turns[3 - r + i];
    of.displacement = point_of(step_.displacements.data(), k, D);
  }
}

template <int D>
void Impacts<D>::undo() {
  for (auto before = before_.rbegin(); before != before_.rend(); ++before) {
    auto& of = pair(before->number);
    of = before->pair;
    if (of.memory != PairMemories::kNone) state_.memories.make(of.memory) = before->memory;
  }
  before_.clear();
}

template <int D>
Vector Impacts<D>::displacement(std::int32_t k) const {
  return flight_or_none(k).displacement;
}

template <int D>
void Impacts<D>::add_lags(Particles& particles) const {
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  for (const auto particle : touched_) {
    const auto k = index_of(particle);
    const auto& of = flight_or_none(particle);
    for (std::size_t i = 0; i < d; ++i) particles.velocities[k * d + i] += of.lag[i] / step_.h;
    if (!step_.turns.empty())
      for (std::size_t i = 0; i < r; ++i)
        particles.angular_velocities[k * r + i] += of.turn_lag[3 - r + i] / step_.h;
  }
}

template class Impacts<2>;
template class Impacts<3>;

}  // namespace viscontact::particles
