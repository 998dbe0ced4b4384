// The phases of an impact, compression and restitution, docs/physics.md (5.15).
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "viscontact/contact_dynamics/impacts/impacts.hpp"
#include "viscontact/contact_solver/constraint_solver.hpp"
#include "viscontact/contact_solver/problem/constraint_problem.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {
namespace {

struct ImpactSolutionTuning {
  // Residuals over the fastest approach [1]: what the solver tries to reach, near the rounding
  // errors of a double, and what counts as solved.
  static constexpr double kExact = 1e-13, kSolved = 1e-8;
  // Iterations with kLeastImpulses, as many as one proximal step may take, so that a failure costs
  // little, and with kSweeps, far above the 3000 without progress after which solve_constraints()
  // gives up.
  static constexpr int kMostWithLeast = 200, kMostWithSweeps = 10000;
  // Bisections of a share in [0, 1], nearly to the rounding errors of a double.
  static constexpr int kHalvings = 50;
};

}  // namespace

template <int D>
ConstraintProblem<D> Impacts<D>::problem_of(const std::vector<Hit>& hits, double time,
                                            std::vector<std::int32_t>& unit_of) {
  const auto& p = state_.particles;
  ConstraintProblem<D> problem;
  std::map<std::int32_t, std::int32_t> numbers;
  // The unit of a particle, and the vector [L] from the centre of the unit to it.
  const auto side_of = [&](std::int32_t k) -> ContactSide {
    if (is_given(k)) return {};
    const auto body = p.bodies.body_of(k);
    const auto [at, is_new] =
        numbers.try_emplace(body < 0 ? k : -1 - body, static_cast<std::int32_t>(unit_of.size()));
    if (is_new) {
      unit_of.push_back(k);
      if (body < 0) {
        const std::array<double, 3> still{};
        // If particles do not turn, the moments on them are 0 but for rounding errors, and yet the
        // problem needs a mobility for turning. The value moves/r^2 has the right dimension, and
        // the turns that follow from it are small in every system of units.
        const double r = p.radii[index_of(k)], moves = step_.mobilities[index_of(k)];
        const double turns =
            step_.turns.empty() ? moves / (r * r) : step_.turn_mobilities[index_of(k)];
        problem.units.push_back(
            unit_of_particle<D>(step_.mobilities[index_of(k)], turns, still.data(), still.data()));
      } else {
        auto still = step_.bodies[index_of(body)];
        still.displacement = still.turn = {};
        const auto inertia = present_inertia(body_at(k, time), D);
        still.inverse_turn_mobility = scaled(1 / step_.h, inertia);
        if (D == 3)
          still.turn_mobility = scaled(step_.h, inverse_of(inertia));
        else
          still.turn_mobility[8] = step_.h / inertia[8];
        problem.units.push_back(unit_of_body<D>(still));
      }
    }
    return {at->second, arm_of(k).at(time)};
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
        // `slip` is the velocity at which the surfaces slip before the impact [L/T].
        const Vector slip = hit.relative +
                            cross(spin_at(of.second, time), -tangents.second_arm * hit.normal) -
                            cross(spin_at(contact.first, time), tangents.first_arm * hit.normal);
        row.offset = step_.h * dot(tangents.directions[k - 1], slip);
      }
    }
    problem.blocks.push_back(block);
  }
  return problem;
}

template <int D>
void Impacts<D>::move_unit(std::int32_t particle, const Motion<D>& change, double time) {
  const auto& p = state_.particles;
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  Vector velocity{}, turn{};
  for (std::size_t i = 0; i < d; ++i) velocity[i] = change[i] / step_.h;
  for (std::size_t i = 0; i < r; ++i) turn[3 - r + i] = change[d + i] / step_.h;
  const auto add = [&](std::int32_t k) {
    auto& of = flight(k);
    of.change = of.change + velocity;
    of.lag = of.lag + time * velocity;
    of.turn_change = of.turn_change + turn;
    of.turn_lag = of.turn_lag + time * turn;
    ++of.version;
  };
  const auto body = p.bodies.body_of(particle);
  if (body < 0) {
    add(particle);
    return;
  }
  for (const auto member : p.bodies.bodies[index_of(body)].members) add(member);
  auto& step = step_.bodies[index_of(body)];
  const double rest = step_.h - time;
  step.displacement = step.displacement + rest * velocity;
  step.velocity_excess = step.velocity_excess + (time / step_.h) * velocity;
  step.turn = step.turn + rest * turn;
  // In space, constrain() (rigid_bodies.hpp) adds the effect of the remaining contacts to this
  // angular momentum. In the plane, constrain() computes the angular momentum as I turn/h +
  // momentum_excess, and turn/h lacks the part time/h of the change.
  const Vector momentum = present_inertia(body_at(particle, time), D) * turn;
  step.angular_momentum = step.angular_momentum + momentum;
  step.momentum_excess = step.momentum_excess + (time / step_.h) * momentum;
}

template <int D>
void Impacts<D>::apply_impacts(const std::vector<Hit>& hits, double time) {
  assert(!hits.empty() && time >= 0 && time <= step_.h);
  using Tuning = ImpactSolutionTuning;
  const auto& laws = step_.laws;
  std::vector<std::int32_t> unit_of;
  auto problem = problem_of(hits, time, unit_of);
  double fastest = 0, fastest_slip = 0;
  for (const auto& hit : hits) {
    fastest = std::max(fastest, -hit.approach);
    fastest_slip = std::max({fastest_slip, -hit.approach, norm(hit.relative)});
  }
  // The problem of the compression has no friction; that of the whole impact below has it.
  auto compression = problem;
  for (auto& block : compression.blocks) {
    block.rows = 1;
    block.allowed = Tuning::kExact * step_.h * fastest;
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
  // Where contacts share a body, only sums of their impulses are determined. With kLeastImpulses
  // what solids give back does not depend on the order of the contacts. With friction between
  // spheres it may not converge, and kSweeps follow.
  const auto solve = [&](ConstraintProblem<D>& of) {
    const auto guess = of.impulses;
    const auto is_solved = [&](ConstraintStart start, int most_iterations) {
      const auto result = solve_constraints(of, most_iterations, start).result;
      iterations_ += result.iterations;
      stages_ += result.stages;
      return result.residual * Tuning::kExact <= Tuning::kSolved;
    };
    if (hits.size() > 1 && is_solved(ConstraintStart::kLeastImpulses, Tuning::kMostWithLeast))
      return;
    of.impulses = guess;
    converged_ = is_solved(ConstraintStart::kSweeps, Tuning::kMostWithSweeps) && converged_;
  };
  solve(compression);
  // What the film can absorb, gamma - gamma_min; the impulse of the compression and the part that
  // the solids take of it; gamma after it; and the lower bound in the restitution [M L/T].
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
  // Nothing rebounds, and the projection decides.
  if (!solids_touch) return;
  // The problem of the whole impact has the impulses of compression and restitution together.
  const double e = laws.restitution.coefficient;
  for (std::size_t c = 0; c < hits.size(); ++c) {
    auto& block = problem.blocks[c];
    const auto& phase = phases[c];
    block.lowest = phase.compressed + phase.lowest;
    block.allowed = Tuning::kExact * step_.h * fastest;
    block.allowed_slip = Tuning::kExact * step_.h * fastest_slip;
    const bool rubs = laws.friction && phase.solid > 0;
    block.friction = rubs ? laws.friction->coefficient : 0;
    // Friction is bounded by the coefficient of friction times the impulse beyond `capacity`, which
    // with this capacity is (1 + e) times the impulse of the solids in the compression, if the
    // restitution adds its lower bound and this bound is >= 0.
    block.capacity = phase.compressed + std::max(phase.lowest, 0.0) - (1 + e) * phase.solid;
    problem.impulses[block.row] = block.lowest;
  }
  if (!laws.friction) {
    keep_normal_rows(problem);
    for (auto& block : problem.blocks) block.rows = 1;
    for (std::size_t c = 0; c < hits.size(); ++c) problem.impulses[c] = problem.blocks[c].lowest;
  }
  solve(problem);
  auto changes = motions<D>(problem, problem.impulses);
  // The work of the impulses is their product with the mean of the velocities before and after the
  // impact. In an impact of several contacts, friction and films could make it positive. The
  // impulses are then moved towards those of the compression, whose work is negative, until it is
  // 0; 50 halvings are exact.
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
    for (int n = 0; n < Tuning::kHalvings; ++n) {
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
    before_.push_back({hits[c].pair, of, state_.memories.of(of.memory)});
    // remember() subtracts of.impulse from gamma. For this call of.impulse is therefore minus the
    // change of gamma. Then the impulse of the last step is restored, from which hit_at() sees a
    // load.
    const double gamma = laws.restitution.gamma_after(block.lowest, problem.impulses[block.row],
                                                      of.gamma - phase.capacity, of.gamma);
    const double impulse = std::exchange(of.impulse, of.gamma - gamma);
    laws.remember(of, state_.memories, radii_of(of, state_.particles, step_.obstacles), 0, 0);
    of.impulse = impulse;
    const double after =
        (problem.rows[block.row].offset + problem.product(block.row, changes)) / step_.h;
    // A particle whose motion is given has no part, and the first part is that of its partner.
    const double sign = is_given(of.second) ? -1 : 1;
    Vector push{};
    for (std::size_t r = block.row; r < block.row + block.rows; ++r) {
      // The coefficients of the first part are the direction in which the second particle is
      // pushed.
      const auto& direction = problem.parts[problem.rows[r].first_part].coefficients;
      for (std::size_t d = 0; d < D; ++d) push[d] += sign * problem.impulses[r] * direction[d];
    }
    const auto add_to_given = [&](std::int32_t k, const Vector& arm, const Vector& by) {
      if (k >= 0 && is_given(k)) on_given_.push_back({k, by, cross(arm, by)});
    };
    add_to_given(of.second, -state_.particles.radii[index_of(of.second)] * hits[c].normal, push);
    if (of.first >= 0)
      add_to_given(of.first, state_.particles.radii[index_of(of.first)] * hits[c].normal,
                   -1.0 * push);
    impulses_.push_back({of.first, push, hits[c].sum * hits[c].normal});
    if (phase.solid > 0)
      rebounds_.push_back({step_.begin + time, of.first, of.second, hits[c].approach, phase.solid,
                           std::abs(after) <= Tuning::kExact * fastest ? 0 : after});
    ++hits_of_[hits[c].pair];
  }
  std::vector<std::int32_t> changed;
  for (const auto k : unit_of) {
    const auto body = state_.particles.bodies.body_of(k);
    if (body < 0)
      changed.push_back(k);
    else
      for (const auto member : state_.particles.bodies.bodies[index_of(body)].members)
        changed.push_back(member);
  }
  std::set<std::size_t> pairs;
  for (const auto k : changed)
    for (const auto of : pairs_of_->of(k)) pairs.insert(of);
  for (const auto of : pairs) expect(of, time);
}

template void Impacts<2>::apply_impacts(const std::vector<Hit>&, double);
template void Impacts<3>::apply_impacts(const std::vector<Hit>&, double);

}  // namespace viscontact::particles
