// Solves the projection (5.3) of one step on the contacts and particles that take part in it:
// chooses them, sets their tolerances, and checks the solution by scales that do not depend on
// units. Lengths, masses and times are in the units of the case. simulation.cpp uses it; what is
// not solved is reported, not thrown. The results must not depend on the number of threads.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/constraints/constraint_system.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/dual_problem/contact_system.hpp"
#include "viscontact/particles/impacts/impacts.hpp"
#include "viscontact/particles/neighbours/pairs_of_particles.hpp"
#include "viscontact/particles/setting.hpp"
#include "viscontact/particles/state.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

/// Scales of one contact.
struct ResidualScale {
  double w = 0;         ///< h (1/m_i + 1/m_j) [T/M]
  double impulse = 0;   ///< impulses at work in the contact [M L/T]
  double rounding = 0;  ///< rounding errors of the gap after the step [L], > 0
  /// Allowed residual [L]: at most `length` [L], and at most the residual that stands for
  /// `fraction` of the impulses at work. The second limit is never below the rounding errors.
  double allowed(double length, double fraction) const {
    return std::min(length, std::max(fraction * impulse * w, rounding));
  }
};

/// Computes the ResidualScale of each contact of a step.
template <int D>
class ResidualScales {
 public:
  /// Measures the impulses at work for the present impulses of `system` and the displacements h v
  /// of all particles. `mobilities` are h/m of all particles. The arguments must outlive this
  /// object.
  ResidualScales(const State& state, double h, std::span<const double> displacements,
                 std::span<const double> mobilities, ContactSystem<D>& system);

  /// Scales of a contact or link between `particles`, of which negative numbers are obstacles, and
  /// which need not take part. `w` is the change of its gap per impulse [T/M], `length` the size of
  /// the numbers that the gap is the difference of [L]. Of the impulses at work on the particles
  /// the smallest counts, because an impulse that is small for a heavy particle may be all that
  /// moves a light one. The rounding errors are those of the gap, of the displacements of its
  /// particles, and of a solution for all impulses of its island.
  ResidualScale of(std::span<const std::int32_t> particles, double w, double length);
  /// Those of a contact.
  ResidualScale of(const Contact<D>& contact) {
    return of(std::array{contact.first, contact.second}, contact.w, std::abs(contact.gap));
  }

 private:
  /// Contribution of a particle to the scales of its contacts.
  struct ParticleScale {
    double impulse = 0;  ///< impulse at work on the particle [M L/T]
    /// Sum over the components d of h |u_d|, u the velocity before the step [L].
    double moved = 0;
  };
  ParticleScale of_particle(std::int32_t particle, const double* moves) const;

  const State& state_;
  double h_;
  std::span<const double> displacements_, mobilities_;
  ContactSystem<D>& system_;
  std::vector<ParticleScale> body_scales_;
  std::vector<double> island_impulses_;  // largest sqrt(w) p of each island, at its root
};

/// A link that is off by more than this part of the mean radius after all iterations is taken to
/// contradict others. Smaller residuals may be slow convergence; they are reported.
inline constexpr double kBroken = 1e-3;

/// Result of the projection of a step.
struct ProjectionResult {
  int iterations = 0;       ///< number of iterations of all solutions, >= 0
  StepResiduals residuals;  ///< those of the last solution; impulse_errors as `pairs`
  /// Number of contacts that exert an impulse or are glued, and turn by more than kLargestTurn.
  std::size_t unresolved = 0;
  double link_residual = 0;  ///< largest residual of a link [L]
  /// If a link or gap is off by more than kBroken mean radii: the names of the hinges and arms that
  /// contradict each other; empty if the residuals of all links are allowed.
  std::vector<std::string> unsolved_links;
  bool contact_contradicts = false;  ///< whether a contact has a part in that
  std::vector<Pair*> pairs;          ///< pairs in the projection, which solve() leaves as they are
  std::vector<double> impulses;      ///< of `pairs` [M L/T]
  std::vector<PairMemory> memories;  ///< of `pairs`, with the friction; empty without constraints
  std::vector<std::int32_t> bodies;  ///< particles whose displacements the projection changed
};

/// Chooses the pairs that are glued (gamma < 0), had an impulse in the last step, or whose gap the
/// free displacements h u* would close, and solves the dual problem (5.4) for them and their
/// particles. If the solution closes further gaps, their pairs are added and the problem is
/// solved again, until no gap is closed. A rough solution comes first, because it finds most of
/// these pairs with little work.
///
/// The step has converged if the residual |min(D + h G v, w (p - gamma))| of each contact, with D
/// without the tolerated overlap, is at most half of `tolerance` mean radii, and if the residual
/// divided by w is at most `impulse_tolerance` of the impulses at work in the contact.
template <int D>
class StepProjection {
 public:
  /// All arguments must outlive this object. `displacements` are h u* before solve() and h v after
  /// it [L]; `mobilities` are h/m [T/M].
  StepProjection(State& state, double h, std::span<const PlanePosition> planes,
                 std::span<double> displacements, std::span<const double> mobilities,
                 ThreadPool& pool);
  /// Solves with friction, rigid bodies and links. Call it before solve(). `step` must outlive this
  /// object, which keeps a pointer to it.
  void add_constraints(const ConstraintStep& step);
  /// Solves a step in which blows have changed the displacements. A contact is then linearised at
  /// the places where the blows leave its particles. Linearised at the beginning of the step, it
  /// would stop particles that only pass each other. `impacts` must outlive this object.
  void follow(const Impacts<D>& impacts) { impacts_ = &impacts; }
  /// Solves the projection and sets the displacements h v, but changes neither pairs nor memories.
  /// `mean_radius` [L], > 0, is the length
  /// that the tolerances of `settings` refer to.
  ProjectionResult solve(const SolverSettings& settings, double mean_radius);

 private:
  // Pairs are numbered as in state.pairs; those of state.walls follow after them.
  Pair& pair(std::size_t k) {
    return k < state_.pairs.size() ? state_.pairs[k] : state_.walls[k - state_.pairs.size()];
  }
  std::size_t pair_count() const { return state_.pairs.size() + state_.walls.size(); }
  // Contact of pair k, which meets a curved obstacle at its tangent.
  Contact<D> contact_at_start(std::size_t k) {
    const auto& p = state_.particles;
    if (!tangents_.empty() && pair(k).first < 0)
      return contact_of<D>(p, pair(k), tangents_[k - state_.pairs.size()]);
    if (impacts_ != nullptr && pair(k).first >= 0) return contact_at_end(k);
    return contact_of<D>(p, pair(k), planes_);
  }
  Contact<D> contact_at_end(std::size_t k);
  Contact<D> contact(std::size_t k) {
    auto contact = resolved(contact_at_start(k), state_.particles, pair(k), planes_, tolerated_);
    contact.w = w(contact.first, contact.second);
    return contact;
  }
  // Contact::w for two particles, or for an obstacle (< 0) and a particle.
  double w(std::int32_t first, std::int32_t second) const {
    return (first < 0 ? 0.0 : mobilities_[index_of(first)]) + mobilities_[index_of(second)];
  }
  ResidualScales<D> residual_scales() { return {state_, h_, displacements_, mobilities_, system_}; }
  bool takes_part(std::int32_t particle) const {
    return particle >= 0 && system_.body_of(particle) >= 0;
  }
  bool gap_would_close(std::size_t k, double margin);
  // Whether pair k is not chosen yet, but the solution may have closed its gap.
  bool may_have_closed(std::size_t k) {
    return is_chosen_[k] == 0 && (takes_part(pair(k).second) || takes_part(pair(k).first));
  }
  bool has_film(std::size_t k);
  std::vector<std::size_t> nearly_closed(bool are_films_only);
  std::vector<std::size_t> closed_by_free_motion();
  void choose(const std::vector<std::size_t>& pairs);
  SolverResult solve_contacts(bool is_rough, double length, int max_iterations);
  std::vector<std::size_t> with_connected_pairs(const std::vector<std::size_t>& pairs, int round);
  void allow(double length, double fraction);
  std::vector<std::size_t> examine(const SolverSettings& settings, double mean_radius,
                                   bool is_final, ProjectionResult& result);
  ResidualScale scale_of_link(const LinkEquations& link, ResidualScales<D>& scales) const;
  void examine_links(const SolverSettings& settings, double mean_radius, ProjectionResult& result);
  void name_contradictions(const std::vector<std::size_t>& beyond, double mean_radius,
                           ProjectionResult& result);

  State& state_;
  double h_;
  std::span<const PlanePosition> planes_;
  std::span<double> displacements_;
  std::span<const double> mobilities_;
  ThreadPool& pool_;
  // The tangent of each pair in state.walls where the free motion ends; empty if no obstacle is
  // curved. The particle cannot leave a circle in the step, because the circle is convex.
  std::vector<PlanePosition> tangents_;
  double tolerated_ = 0;             // overlap that is left as it is [L]
  double margin_ = 0;                // gap below which a pair is nearly closed [L]
  std::vector<std::size_t> chosen_;  // pair of each contact of system_
  std::vector<char> is_chosen_;      // of each pair in the list
  ContactSystem<D> system_;
  const Links* links_ = nullptr;
  const ConstraintStep* step_ = nullptr;  // of add_constraints(); null without constraints
  std::optional<ConstraintSystem<D>> constraints_;
  std::optional<PairsOfParticles> pairs_of_particles_;
  const Impacts<D>* impacts_ = nullptr;
};

}  // namespace viscontact::particles
