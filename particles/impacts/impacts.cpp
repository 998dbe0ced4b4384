// Finds the blows of a step and solves each in its two phases (impacts.hpp). Units are those of the
// case.
#include "viscontact/particles/impacts/impacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "viscontact/particles/constraints/constraint_solver.hpp"
#include "viscontact/particles/constraints/contact_rows.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/rotation.hpp"

namespace viscontact::particles {
namespace {

// Times of a step that differ by less than this share of it are one. Symmetric blows are then decided
// together although their times differ by rounding errors.
constexpr double kSameTime = 1e-9;

/// The first time t in (0, `until`] at which |c + a t + b t^2| = `sum` while it falls, for a vector
/// that is longer than `sum` at t = 0. With `sum` = 0 all three are along one direction.
std::optional<double> time_of_meeting(const Vector& c, const Vector& a, const Vector& b, double sum,
                                      double until) {
  const double distance = norm(c);
  const double gap = distance - sum;
  double t = 0;
  if (b == Vector{}) {
    const double square = dot(a, a), along = dot(c, a);
    if (sum == 0) {  // at an obstacle the root below is 0 but for rounding errors
      if (!(along < 0)) return std::nullopt;
      t = -along / square;
      return t <= until ? std::optional(t) : std::nullopt;
    }
    const double root = along * along - square * gap * (distance + sum);
    if (!(along < 0) || root < 0) return std::nullopt;
    t = gap * (distance + sum) / (-along + std::sqrt(root));
    return t <= until ? std::optional(t) : std::nullopt;
  }
  // Of the gap along the present direction, which is exact if the motion is along it; then Newton's
  // method.
  const double rate = dot(c, a) / distance, curvature = dot(c, b) / distance;
  const double root = rate * rate - 4 * curvature * gap;
  if (root < 0) return std::nullopt;
  const double denominator = -rate + std::sqrt(root);
  if (!(denominator > 0)) return std::nullopt;
  t = 2 * gap / denominator;
  if (sum == 0) return t <= until ? std::optional(t) : std::nullopt;  // at an obstacle
  constexpr int kMostSteps = 20;
  for (int n = 0; n < kMostSteps; ++n) {
    const Vector x = c + t * a + (t * t) * b;
    const double falls = dot(x, a + (2 * t) * b) / norm(x);
    if (!(falls < 0)) return std::nullopt;
    const double change = (sum - norm(x)) / falls;
    t += change;
    if (std::abs(change) <= 4 * std::numeric_limits<double>::epsilon() * t) break;
  }
  return t > 0 && t <= until ? std::optional(t) : std::nullopt;
}

}  // namespace

template <int D>
Impacts<D>::Impacts(State& state, const ImpactStep& step) : state_(state), step_(step) {
  for (const auto& obstacle : step.obstacles) places_.push_back(obstacle.at(step.begin));
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

/// u* of a particle; 0 of an obstacle.
template <int D>
Vector Impacts<D>::free_velocity(std::int32_t k) const {
  if (k < 0) return {};
  return (1 / step_.h) * point_of(step_.displacements.data(), index_of(k), D);
}

/// The mean acceleration of a particle by its forces.
template <int D>
Vector Impacts<D>::acceleration(std::int32_t k) const {
  if (k < 0) return {};
  return (1 / step_.kick) * (free_velocity(k) - state_.particles.velocity(index_of(k)));
}

/// Angular velocity at `time`, of discs about the third axis.
template <int D>
Vector Impacts<D>::spin(std::int32_t k, double /*time*/) const {
  if (k < 0 || step_.turns.empty()) return {};
  const auto r = static_cast<std::size_t>(kTurns<D>);
  Vector turn{};
  for (std::size_t i = 0; i < r; ++i) turn[3 - r + i] = step_.turns[index_of(k) * r + i];
  return (1 / step_.h) * turn + flight_or_none(k).turn_change;
}

template <int D>
typename Impacts<D>::Approach Impacts<D>::approach_of(std::size_t k) {
  const auto& p = state_.particles;
  const auto& of = pair(k);
  const auto second = index_of(of.second);
  const double half = step_.h / 2;
  const auto& flies = flight_or_none(of.second);
  const Vector pull = acceleration(of.second);
  Approach approach;
  approach.a = free_velocity(of.second) - half * pull + flies.change;
  approach.b = 0.5 * pull;
  approach.at_rest = p.velocity(second) + flies.change;
  if (of.first < 0) {
    // At an obstacle only the motion along its normal counts, which moves evenly in the step.
    const auto& obstacle = step_.obstacles[of.plane()];
    const auto& place = places_[of.plane()];
    const Vector n = place.is_curved()
                         ? normal_at(place, p.position(second) + step_.h * free_velocity(of.second))
                         : obstacle.at(step_.end).normal;
    const double gap = particles::gap(place, p.position(second), p.radii[second]);
    const Vector foot = p.position(second) - (p.radii[second] + gap) * n;
    const Vector moves = (1 / step_.h) * obstacle.displacement(foot, step_.begin, step_.end);
    approach.normal = n;
    approach.c = (gap - dot(n, flies.late)) * n;
    approach.a = dot(n, approach.a - moves) * n;
    approach.b = dot(n, approach.b) * n;
    approach.before = p.velocity(second) - moves;
    approach.at_rest = approach.at_rest - moves;
    return approach;
  }
  const auto& other = flight_or_none(of.first);
  const Vector other_pull = acceleration(of.first);
  const auto apart = separation<D>(p, of.first, of.second, of.image);
  for (std::size_t d = 0; d < D; ++d) approach.c[d] = apart[d];
  approach.c = approach.c - (flies.late - other.late);
  approach.a = approach.a - (free_velocity(of.first) - half * other_pull + other.change);
  approach.b = approach.b - 0.5 * other_pull;
  approach.before = p.velocity(second) - p.velocity(index_of(of.first));
  approach.at_rest = approach.at_rest - p.velocity(index_of(of.first)) - other.change;
  approach.sum = p.radii[index_of(of.first)] + p.radii[second];
  return approach;
}

/// The contact of pair `k` at `time`, if it is hit there: its gap is closed, and it approaches.
template <int D>
std::optional<typename Impacts<D>::Hit> Impacts<D>::hit_at(std::size_t k, double time) {
  const auto approach = approach_of(k);
  const Vector x = approach.c + time * approach.a + (time * time) * approach.b;
  const double distance = norm(x);
  Vector normal = approach.normal.value_or(Vector{1, 0, 0});
  if (!approach.normal && distance > 0) normal = (1 / distance) * x;
  const double gap = approach.normal ? dot(normal, x) : distance - approach.sum;
  if (gap > 2 * step_.touching) return std::nullopt;
  auto at_start = approach.c + flight_or_none(pair(k).second).late;
  if (!approach.normal) at_start = at_start - flight_or_none(pair(k).first).late;
  const double gap_at_start =
      approach.normal ? particles::gap(places_[pair(k).plane()],
                                       state_.particles.position(index_of(pair(k).second)),
                                       state_.particles.radii[index_of(pair(k).second)])
                      : norm(at_start) - approach.sum;
  // A bounce whose flight would be shorter than a part of the step has ended: the rest is load.
  constexpr double kShortestFlight = 0.05;  // of the step
  const double load = -2 * step_.h * dot(normal, approach.b);
  const double ended =
      std::max(kShortestFlight * load / (2 * step_.laws.restitution.coefficient), 0.0);
  // A pair that bore a load, or hardly approached, before the step rests. Blows alone can hit it, if they
  // are more than five times the velocity that forces give its particles in the step: what is less would
  // shake a packing without end.
  // Slower approaches are not seen in a step, or are rounding errors of the velocities.
  constexpr double kUnseen = 1e-3, kRounding = 1e-12;
  const double speeds = norm(free_velocity(pair(k).first)) + norm(free_velocity(pair(k).second)) +
                        norm(flight_or_none(pair(k).first).change) +
                        norm(flight_or_none(pair(k).second).change);
  const double unseen = std::max(kUnseen * step_.touching / step_.h, kRounding * speeds);
  const double pulled = 5 * step_.h *
                        std::max(std::abs(dot(normal, acceleration(pair(k).second))),
                                 std::abs(dot(normal, acceleration(pair(k).first))));
  const bool bore_load = pair(k).impulse != 0 || pair(k).gamma < 0;
  const bool rests = gap_at_start <= step_.touching &&
                     -dot(normal, approach.before) <= (bore_load ? pulled : unseen);
  const Vector velocity = rests ? approach.at_rest : approach.a + (2 * time) * approach.b;
  const double rate = dot(normal, velocity);
  if (!(-rate > std::max({ended, unseen, rests ? pulled : 0.0}))) return std::nullopt;
  return Hit{k, normal, rate};
}

/// Expects the next blow of pair `k` after the time `from`, if there is one in the step.
template <int D>
void Impacts<D>::expect(std::size_t k, double from) {
  const auto& of = pair(k);
  const std::array versions = {version(of.first), version(of.second)};
  if (!hits_of_.empty()) {
    // Blows that go to and fro without end between pairs under load are left to the projection.
    constexpr int kMostHits = 1000, kMostUnderLoad = 30;
    if (hits_of_[k] >= (of.impulse == 0 ? kMostHits : kMostUnderLoad)) return;
  }
  const auto approach = approach_of(k);
  const Vector x = approach.c + from * approach.a + (from * from) * approach.b;
  const double gap = approach.normal ? dot(*approach.normal, x) : norm(x) - approach.sum;
  const auto after = gap > 0 ? time_of_meeting(x, approach.a + (2 * from) * approach.b, approach.b,
                                               approach.sum, step_.h - from)
                             : std::nullopt;
  if (after && hit_at(k, from + *after))
    expected_.push({from + *after, k, versions});
  else if (gap <= step_.touching && hit_at(k, from))
    expected_.push({from, k, versions});
}

template <int D>
void Impacts<D>::list_pairs_of_particles() {
  const auto for_particles = [&](const auto& visit) {
    for (std::size_t k = 0; k < pair_count(); ++k)
      for (const auto particle : {pair(k).first, pair(k).second})
        if (particle >= 0) visit(index_of(particle), k);
  };
  offsets_.assign(state_.particles.count() + 1, 0);
  for_particles([&](std::size_t particle, std::size_t) { ++offsets_[particle + 1]; });
  for (std::size_t i = 0; i + 1 < offsets_.size(); ++i) offsets_[i + 1] += offsets_[i];
  pairs_of_.resize(offsets_.back());
  auto next = offsets_;
  for_particles([&](std::size_t particle, std::size_t k) { pairs_of_[next[particle]++] = k; });
  hits_of_.resize(pair_count());
}

template <int D>
void Impacts<D>::run() {
  const auto& p = state_.particles;
  for (std::size_t k = 0; k < pair_count(); ++k)
    if (pair(k).first < 0 || !cannot_close<D>(p, pair(k), step_.displacements)) expect(k, 0);
  while (!expected_.empty()) {
    const double time = expected_.top().time;
    std::vector<Hit> hits;
    while (!expected_.empty() && expected_.top().time <= time + kSameTime * step_.h) {
      const auto next = expected_.top();
      expected_.pop();
      const auto& of = pair(next.pair);
      if (next.versions != std::array{version(of.first), version(of.second)}) continue;
      if (auto hit = hit_at(next.pair, time)) hits.push_back(*hit);
    }
    if (hits.empty()) continue;
    if (offsets_.empty()) list_pairs_of_particles();
    // Hits that share a particle or body are one blow.
    std::map<std::int32_t, std::size_t> group_of;  // by unit: body -1 - b, or a particle
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
      if (!group.empty()) strike(group, time);
  }
  finish();
}

/// The contacts of a blow as constraints on the changes of h times the velocities. `unit_of` becomes a
/// particle of each unit.
template <int D>
ConstraintProblem<D> Impacts<D>::problem_of(const std::vector<Hit>& hits, double time,
                                            std::vector<std::int32_t>& unit_of) {
  const auto& p = state_.particles;
  ConstraintProblem<D> problem;
  std::map<std::int32_t, std::int32_t> numbers;
  const auto side_of = [&](std::int32_t k) -> ContactSide {
    if (k < 0) return {};
    const auto body = p.bodies.body_of(k);
    const auto [at, is_new] =
        numbers.try_emplace(body < 0 ? k : -1 - body, static_cast<std::int32_t>(unit_of.size()));
    if (is_new) {
      unit_of.push_back(k);
      if (body < 0) {
        const std::array<double, 3> still{};
        // Particles that do not turn have no moments but rounding errors, which this mobility leaves
        // small in every unit.
        const double r = p.radii[index_of(k)], moves = step_.mobilities[index_of(k)];
        const double turns =
            step_.turns.empty() ? moves / (r * r) : step_.turn_mobilities[index_of(k)];
        problem.units.push_back(
            unit_of_particle<D>(step_.mobilities[index_of(k)], turns, still.data(), still.data()));
      } else {
        auto still = step_.bodies[index_of(body)];
        still.displacement = still.turn = {};
        problem.units.push_back(unit_of_body<D>(still));
      }
    }
    Vector offset{};
    if (body >= 0) {
      const auto& members = p.bodies.bodies[index_of(body)].members;
      const auto m = std::ranges::find(members, k) - members.begin();
      offset = present_offset(p.bodies.bodies[index_of(body)], static_cast<std::size_t>(m), D);
    }
    return {at->second, offset};
  };
  for (const auto& hit : hits) {
    const auto& of = pair(hit.pair);
    Contact<D> contact{of.first < 0 ? -1 : of.first, of.second, {}, 0, of.gamma};
    std::copy_n(hit.normal.begin(), D, contact.normal.begin());
    contact.obstacle = of.first < 0 ? -1 - of.first : 0;
    const auto tangents = tangents_of(contact, p, step_.obstacles, step_.begin, step_.end);
    const auto first = side_of(contact.first), second = side_of(contact.second);
    ConstraintBlock block;
    block.row = problem.rows.size();
    block.rows = static_cast<std::size_t>(D);
    for (std::size_t k = 0; k < block.rows; ++k) {
      add_contact_row(contact, tangents, first, second, k, 0, problem);
      auto& row = problem.rows.back();
      row.offset = step_.h * hit.approach;
      if (k > 0) {
        // The slip of the surfaces before the blow.
        const Vector direction = tangents.directions[k - 1];
        const auto slip_of = [&](std::int32_t particle, const Vector& arm) {
          if (particle < 0) return dot(direction, (1 / step_.h) * tangents.surface);
          const Vector v = free_velocity(particle) + (time - step_.h / 2) * acceleration(particle) +
                           flight_or_none(particle).change;
          return dot(direction, v + cross(spin(particle, time), arm));
        };
        row.offset = step_.h * (slip_of(of.second, -tangents.second_arm * hit.normal) -
                                slip_of(contact.first, tangents.first_arm * hit.normal));
      }
    }
    problem.blocks.push_back(block);
  }
  return problem;
}

/// Adds the change of h times the motion of the unit of `particle` at `time`.
template <int D>
void Impacts<D>::move_unit(std::int32_t particle, const Motion<D>& change, double time) {
  const auto& p = state_.particles;
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  Vector velocity{}, turn{};
  for (std::size_t i = 0; i < d; ++i) velocity[i] = change[i] / step_.h;
  for (std::size_t i = 0; i < r; ++i) turn[3 - r + i] = change[d + i] / step_.h;
  const auto add = [&](std::int32_t k, const Vector& offset) {
    auto& of = flight(k);
    const Vector by = velocity + cross(turn, offset);
    of.change = of.change + by;
    of.late = of.late + time * by;
    of.turn_change = of.turn_change + turn;
    of.late_turn = of.late_turn + time * turn;
    ++of.version;
  };
  const auto body = p.bodies.body_of(particle);
  if (body < 0) {
    add(particle, {});
    return;
  }
  const auto& rigid = p.bodies.bodies[index_of(body)];
  for (std::size_t m = 0; m < rigid.members.size(); ++m)
    add(rigid.members[m], present_offset(rigid, m, D));
  auto& step = step_.bodies[index_of(body)];
  const double rest = step_.h - time;
  step.displacement = step.displacement + rest * velocity;
  step.late_velocity = step.late_velocity + (time / step_.h) * velocity;
  step.turn = step.turn + rest * turn;
  // I (time/h) turn is what the angular momentum has beyond I turn/h in the plane; in space the step
  // holds the whole of it.
  const Vector momentum = step_.h * (step.inverse_turn_mobility * turn);
  step.angular_momentum = step.angular_momentum + momentum;
  step.late_momentum = step.late_momentum + (time / step_.h) * momentum;
}

/// The two phases of a blow, (5.15), and what follows from it.
template <int D>
void Impacts<D>::strike(const std::vector<Hit>& hits, double time) {
  constexpr int kMostIterations = 10000;
  constexpr double kExact = 1e-13;
  const auto& laws = step_.laws;
  std::vector<std::int32_t> unit_of;
  auto problem = problem_of(hits, time, unit_of);
  double fastest = 0;
  for (const auto& hit : hits) fastest = std::max(fastest, -hit.approach);
  // Compression. Friction acts in the whole blow and is decided at its end.
  auto compression = problem;
  for (auto& block : compression.blocks) {
    block.rows = 1;
    block.allowed = kExact * step_.h * fastest;
  }
  const auto keep_normal_rows = [&](ConstraintProblem<D>& of) {
    std::vector<ConstraintRow> rows;
    for (auto& block : of.blocks) {
      rows.push_back(of.rows[block.row]);
      block.row = rows.size() - 1;
    }
    of.rows = std::move(rows);
    of.impulses.assign(of.blocks.size(), 0.0);
  };
  keep_normal_rows(compression);
  (void)solve_constraints(compression, kMostIterations);
  // The film takes what it can, the solids the rest.
  struct Phases {
    double capacity, compressed, solid, gamma, lowest;
  };
  std::vector<Phases> phases;
  bool solids_touch = false;
  for (std::size_t c = 0; c < hits.size(); ++c) {
    const auto& of = pair(hits[c].pair);
    const double lowest_gamma = laws.lowest_gamma(of, state_.memories.of(of.memory),
                                                  radii_of(of, state_.particles, step_.obstacles));
    Phases phase{of.gamma - lowest_gamma, compression.impulses[c], 0, 0, 0};
    phase.solid = RestitutionLaw::solid_impulse(phase.compressed, phase.capacity);
    phase.gamma = std::max(of.gamma - phase.compressed, lowest_gamma);
    phase.lowest = laws.restitution.lowest_in_restitution(phase.gamma, phase.solid);
    solids_touch = solids_touch || phase.solid > 0;
    phases.push_back(phase);
  }
  // A film that takes the whole blow is left to the projection.
  if (!solids_touch) return;
  // The whole blow: compression and restitution together.
  const double e = laws.restitution.coefficient;
  for (std::size_t c = 0; c < hits.size(); ++c) {
    auto& block = problem.blocks[c];
    const auto& phase = phases[c];
    block.lowest = phase.compressed + phase.lowest;
    block.allowed = block.allowed_slip = kExact * step_.h * fastest;
    const bool rubs = laws.friction && phase.solid > 0;
    block.friction = rubs ? laws.friction->coefficient : 0;
    // The impulse beyond which friction grows: the solids carry (1 + e_d) s of the expected one.
    block.capacity = phase.compressed + std::max(phase.lowest, 0.0) - (1 + e) * phase.solid;
    problem.impulses[block.row] = block.lowest;
  }
  if (!laws.friction) {
    keep_normal_rows(problem);
    for (auto& block : problem.blocks) block.rows = 1;
    for (std::size_t c = 0; c < hits.size(); ++c) problem.impulses[c] = problem.blocks[c].lowest;
  }
  (void)solve_constraints(problem, kMostIterations);
  auto changes = motions<D>(problem, problem.impulses);
  // Work of the impulses at the mean of the velocities before and after. Friction and films in blows of
  // several contacts could make it positive; then all impulses go back towards those of the
  // compression, whose work is negative, until it is not.
  const auto work = [&](const std::vector<double>& impulses) {
    const auto y = motions<D>(problem, impulses);
    double sum = 0;
    for (std::size_t r = 0; r < problem.rows.size(); ++r)
      sum += impulses[r] * (problem.rows[r].offset + problem.product(r, y) / 2);
    return sum;
  };
  if (work(problem.impulses) > 0) {
    auto plain = problem.impulses;
    std::ranges::fill(plain, 0.0);
    for (std::size_t c = 0; c < hits.size(); ++c)
      plain[problem.blocks[c].row] = compression.impulses[c];
    const auto between = [&](double share) {
      auto impulses = plain;
      for (std::size_t r = 0; r < impulses.size(); ++r)
        impulses[r] += share * (problem.impulses[r] - plain[r]);
      return impulses;
    };
    double low = 0, high = 1;
    constexpr int kHalvings = 50;
    for (int n = 0; n < kHalvings; ++n) {
      const double middle = (low + high) / 2;
      (work(between(middle)) > 0 ? high : low) = middle;
    }
    problem.impulses = between(low);
    changes = motions<D>(problem, problem.impulses);
  }
  for (std::size_t u = 0; u < unit_of.size(); ++u) move_unit(unit_of[u], changes[u], time);
  for (std::size_t c = 0; c < hits.size(); ++c) {
    auto& of = pair(hits[c].pair);
    const auto& phase = phases[c];
    const auto& block = problem.blocks[c];
    before_.emplace_back(hits[c].pair, of);
    // gamma_c + e_d s - p', and 0 where the film has given back all within rounding errors.
    const double left = block.lowest - problem.impulses[block.row];
    const double rounding =
        8 * std::numeric_limits<double>::epsilon() * (std::abs(of.gamma) + std::abs(block.lowest));
    of.gamma = left >= -rounding ? 0 : std::max(left, of.gamma - phase.capacity);
    of.gamma_error = of.gamma == 0 ? 0 : of.gamma_error + rounding;
    const double after =
        (problem.rows[block.row].offset + problem.product(block.row, changes)) / step_.h;
    if (phase.solid > 0)
      rebounds_.push_back({step_.begin + time, of.first, of.second, hits[c].approach, phase.solid,
                           std::abs(after) <= kExact * fastest ? 0 : after});
    ++hits_of_[hits[c].pair];
  }
  // All that the changed particles may meet is expected anew.
  std::vector<std::int32_t> changed;
  for (const auto k : unit_of) {
    const auto body = state_.particles.bodies.body_of(k);
    if (body < 0)
      changed.push_back(k);
    else
      for (const auto member : state_.particles.bodies.bodies[index_of(body)].members)
        changed.push_back(member);
  }
  for (const auto k : changed)
    for (auto n = offsets_[index_of(k)]; n < offsets_[index_of(k) + 1]; ++n)
      expect(pairs_of_[n], time);
}

/// Moves the particles by what all blows changed.
template <int D>
void Impacts<D>::finish() {
  const auto& p = state_.particles;
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  for (const auto particle : touched_) {
    const auto k = index_of(particle);
    auto& of = flight(particle);
    Vector moves = step_.h * of.change - of.late, turns = step_.h * of.turn_change - of.late_turn;
    if (const auto body = p.bodies.body_of(particle); body >= 0) {
      const auto& step = step_.bodies[index_of(body)];
      const auto& rigid = p.bodies.bodies[index_of(body)];
      const auto m = std::ranges::find(rigid.members, particle) - rigid.members.begin();
      const Vector moved = displacement_at(
          step.displacement, step.turn, present_offset(rigid, static_cast<std::size_t>(m), D), D);
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
  for (auto before = before_.rbegin(); before != before_.rend(); ++before)
    pair(before->first) = before->second;
  before_.clear();
}

template <int D>
Vector Impacts<D>::displacement(std::int32_t k) const {
  return flight_or_none(k).displacement;
}

template <int D>
void Impacts<D>::add_late_changes(Particles& particles) const {
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  for (const auto particle : touched_) {
    const auto k = index_of(particle);
    const auto& of = flight_or_none(particle);
    for (std::size_t i = 0; i < d; ++i) particles.velocities[k * d + i] += of.late[i] / step_.h;
    if (!step_.turns.empty())
      for (std::size_t i = 0; i < r; ++i)
        particles.angular_velocities[k * r + i] += of.late_turn[3 - r + i] / step_.h;
  }
}

template class Impacts<2>;
template class Impacts<3>;

}  // namespace viscontact::particles
