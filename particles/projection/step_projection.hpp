// Computes the projection of a time step, which is the problem for the impulses of contacts that
// keeps gaps open, docs/physics.md (5.3) and (5.4). The code chooses the contacts of the problem,
// sets their tolerances, solves the problem, and measures the residuals of the solution by scales
// that do not depend on units. h [T] is the length of the step. u* are the velocities [L/T] at its
// end without contacts and links, and v the velocities with them. Units are any consistent ones.
// Nothing is checked or thrown: ProjectionResult tells whether the step is solved. simulation.cpp
// uses this file. Results must not depend on the number of threads, and a change of a scale alters
// which steps count as solved.
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
#include "viscontact/particles/contact/film_tension.hpp"
#include "viscontact/particles/dual_problem/contact_system.hpp"
#include "viscontact/particles/impacts/impacts.hpp"
#include "viscontact/particles/neighbours/pairs_of_particles.hpp"
#include "viscontact/particles/setting.hpp"
#include "viscontact/particles/state.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

/// Scales with which the residual [L] of a contact or link is compared, that is, the distance of a
/// gap or length from the value that its condition demands.
struct ResidualScale {
  /// Change of the gap per impulse [T/M], > 0. For a contact of particles with the masses m_i and
  /// m_j it is h (1/m_i + 1/m_j).
  double w = 0;
  /// Impulse at work [M L/T], >= 0: the magnitude of the impulses that move the particles of the
  /// contact or press on them in the step. A small fraction of it is an allowed error.
  double impulse = 0;
  double rounding = 0;  ///< rounding errors of the gap after the step [L], > 0
  /// Allowed residual [L], > 0. It is the smaller of `length` > 0 [L] and of the change of the gap
  /// by the fraction `fraction` > 0 of the impulse at work; if this change is less than `rounding`,
  /// `rounding` takes its place.
  double allowed(double length, double fraction) const {
    return std::min(length, std::max(fraction * impulse * w, rounding));
  }
  /// Allowed residual of a gap [L]. SolverSettings::tolerance is in units of `mean_radius` > 0 [L].
  double allowed_gap(const SolverSettings& settings, double mean_radius) const {
    return allowed(settings.tolerance * mean_radius / 2, settings.impulse_tolerance);
  }
};

/// The fraction of the impulse at work [1], > 0, that ResidualScale::allowed() gets for slips, the
/// tangential displacements of contacts with friction. It keeps friction to its law in short steps,
/// in which the slips are smaller than the tolerance of gaps. The fraction is larger than that of
/// gaps, because redundant impulses in a packing must grow until the slips are allowed. With the
/// default tolerance it is 1e-4, about what the tolerance of gaps allows in the steps of
/// bench/box2d.cpp. With 1e-6, 1000 settled discs without films take twice as many iterations. The
/// factor 100 is a free choice.
inline double fraction_of_slips(const SolverSettings& settings) {
  constexpr double kOfTolerance = 100;
  return std::max(settings.impulse_tolerance, kOfTolerance * settings.tolerance);
}

/// Computes the ResidualScale of contacts and links of a step.
template <int D>
class ResidualScales {
 public:
  /// Measures the impulses at work at the present impulses of `system` and the displacements h v
  /// [L], D numbers for each particle. `mobilities` are h/m of all particles of the mass m [T/M], >
  /// 0. `h` must be > 0 [T]. `constraints` is null in a step without friction, bodies and links.
  /// The arguments must outlive this object.
  ResidualScales(const State& state, double h, std::span<const double> displacements,
                 std::span<const double> mobilities, ContactSystem<D>& system,
                 const ConstraintSystem<D>* constraints);

  /// Scales of a contact or link between the particles with the numbers `particles`; negative
  /// numbers are obstacles. The particles need not be in `system`. `w` > 0 is the change of the gap
  /// per impulse [T/M]. `length` >= 0 [L] is the size of the numbers from which the gap is computed
  /// as a difference.
  ///
  /// The impulse at work is the smallest of those of the particles, because an impulse that is
  /// small for a heavy particle may be all that moves a light one. The rounding errors are those of
  /// the gap, of the displacements of the particles, and of a solution for all connected contacts.
  ResidualScale of(std::span<const std::int32_t> particles, double w, double length);
  /// Scales of a contact, from its own particles, w and gap. In a step with friction, bodies or
  /// links, rounding errors are at least the last place of the radii, because smaller displacements
  /// of particles at rest are errors of the solutions. Particles that contacts or links join form
  /// an island. In an island with a rigid body or link (ContactSystem::is_held()) the rounding
  /// errors are larger, because finite turns move points of the surface; there they also grow with
  /// the distance of the particles from the origin.
  ResidualScale of(const Contact<D>& contact);
  /// Largest change of the displacement of a particle by its impulse at work [L], >= 0.
  double largest_change(std::span<const std::int32_t> particles) const;

 private:
  /// Contribution of a particle to the scales of its contacts.
  struct ParticleScale {
    double impulse = 0;  ///< impulse at work on the particle [M L/T]
    /// Sum of h |u_d| over the components d of the velocity u before the step [L].
    double moved = 0;
  };
  ParticleScale of_particle(std::int32_t particle, const double* moves) const;
  ParticleScale of_particle(std::int32_t particle) const;

  const State& state_;
  double h_;
  std::span<const double> displacements_, mobilities_;
  ContactSystem<D>& system_;
  bool has_constraints_;
  std::vector<ParticleScale> body_scales_;  // of all bodies of system_
  // Largest w^(1/2) p of the contacts of each island, where p is the impulse of a contact [L
  // (M/T)^(1/2)], at the place ContactSystem::island().
  std::vector<double> island_impulses_;
};

/// If a residual of a link or an overlap exceeds this fraction of the mean radius after all
/// iterations, the links contradict each other, and simulation.cpp throws an error. The number is a
/// free choice far above tolerances.
inline constexpr double kBroken = 1e-3;

/// Result of the projection of a step.
struct ProjectionResult {
  /// Number of iterations of all solutions, >= 0. With constraints each island is solved by itself,
  /// and this is the number of iterations of the island that needs most.
  int iterations = 0;
  /// Residuals of the last solution; StepResiduals::converged tells whether the step is solved, and
  /// impulse_errors [M L/T] are in the order of `pairs`.
  StepResiduals residuals;
  /// Number of contacts with an impulse or a film (gamma < 0) whose particles move around each
  /// other by more than kLargestTurn (contact.hpp), so that linearised gaps are wrong.
  std::size_t unresolved = 0;
  /// True if given loads bound the friction in place of the loads of this step. The reason is that
  /// the problem with the loads of this step was not solved, or that its corrections for finite
  /// turns diverged (ConstraintSystem::has_given_up()).
  bool has_given_loads = false;
  bool lacks_springs = false;  ///< StepReport::lacks_springs of this part
  double buckling = 0;         ///< StepReport::buckling of this part
  double link_residual = 0;    ///< largest residual of a link [L], >= 0
  /// Names of the hinges and arms that contradict each other, for messages. Empty if the residuals
  /// of all links are allowed, or no residual or overlap is more than kBroken mean radii.
  std::vector<std::string> unsolved_links;
  /// True if some motion satisfies the linear equations of links and contacts, but none was found
  /// with finite turns: they contradict each other, or turn too far in the step.
  bool turns_too_far = false;
  bool contact_contradicts = false;  ///< true: contacts may contradict these links
  std::vector<Pair*> pairs;          ///< the pairs in the projection, which solve() does not change
  /// Normal impulse of each of `pairs` [M L/T], >= gamma of the pair before the step.
  std::vector<double> impulses;
  std::vector<PairMemory> memories;  ///< new memories of `pairs`; empty without add_constraints()
  /// Numbers of the particles whose displacements solve() has changed.
  /// Entries of planes under a load in the array of displacements may be among them.
  std::vector<std::int32_t> bodies;
  /// The impulses [M L/T] and moments [M L^2/T] of the contacts on particles whose motion is given,
  /// one for each such particle of a contact.
  std::vector<GivenParticleLoad> on_given{};
};

/// Chooses pairs and solves the problem (5.4) for them and their particles. A pair is chosen if a
/// film holds it (gamma < 0, minus the impulse that the film has absorbed [M L/T]), if it had an
/// impulse in the last step, or if the motion without contacts, but with links, would close its
/// gap. If the solution closes further gaps, their pairs are added and the problem is solved again,
/// until no gap is closed. A rough solution comes first, because it finds most of these pairs with
/// little work.
///
/// The step has converged if each contact meets two conditions. Let d be its gap after the step
/// (ContactSystem::gap()), p its impulse and w the change of the gap per impulse. The residual
/// |min(d, w (p - gamma))|, without the tolerated overlap, must be at most half of
/// SolverSettings::tolerance mean radii. The error of the impulse must be at most the fraction
/// SolverSettings::impulse_tolerance of the impulse at work, or within rounding errors. It is the
/// estimate of a Refinement, or, where there is none, the residual divided by w, times the ratio of
/// the masses of a contact's set if this is a contact. Links must meet
/// the same two conditions with their own residuals.
template <int D>
class StepProjection {
 public:
  /// All arguments must outlive this object. `h` must be > 0 [T]. `planes_before` and `planes` are
  /// all obstacles at the beginning and at the end of the step. `displacements` has D numbers for
  /// each particle and then for each plane under a load [L]: h u* before solve(), and h v after it.
  /// `mobilities` are h/m of each particle or plane of the mass m [T/M], > 0, or 0 for a particle
  /// whose motion is given. `loaded` has for each obstacle its entry in these arrays, or -1 for one
  /// without a load; it is empty if no plane has a load. `planes` must not contain the motion of
  /// these planes along their normals in the step.
  StepProjection(State& state, double h, std::span<const PlanePosition> planes_before,
                 std::span<const PlanePosition> planes, std::span<double> displacements,
                 std::span<const double> mobilities, ThreadPool& pool,
                 std::span<const std::int32_t> loaded = {});
  /// Makes solve() treat friction, rigid bodies and links, too. `step` must outlive this object.
  void add_constraints(const ConstraintStep& step);
  /// Makes solve() linearise contacts at the places where blows (collisions of solids, impacts/)
  /// have left their particles, because contacts that are linearised elsewhere could stop particles
  /// that pass each other. Gaps are then always linearised and never computed as distances, because
  /// with distances the projection after blows would add energy. `impacts` must outlive this
  /// object.
  void follow(const Impacts<D>& impacts) {
    impacts_ = &impacts;
    kappas_of_films_ = kappas_of_films(
        state_.particles, mobilities_,
        state_.pairs.size(), [&](std::size_t k) -> auto& { return state_.pairs[k]; },
        [&](std::size_t k) { return state_.pairs[k].impulse; });
    system_.forbid_distances();
  }
  /// Solves the projection and sets the displacements h v, but changes neither pairs nor memories
  /// of the state. SolverSettings::tolerance is in units of `mean_radius` > 0 [L]. The function may
  /// be called only once for an object (not checked).
  ProjectionResult solve(const SolverSettings& settings, double mean_radius);

 private:
  // Pairs are numbered as in state.pairs; those of state.walls follow after them.
  Pair& pair(std::size_t k) {
    return k < state_.pairs.size() ? state_.pairs[k] : state_.walls[k - state_.pairs.size()];
  }
  std::size_t pair_count() const { return state_.pairs.size() + state_.walls.size(); }
  // Contact of pair k with its true gap. A curved obstacle is replaced by its tangent.
  Contact<D> contact_at_start(std::size_t k) {
    const auto& p = state_.particles;
    if (impacts_ != nullptr && pair(k).first >= 0 && !is_stretched(k)) return contact_at_end(k);
    auto contact = !tangents_.empty() && pair(k).first < 0
                       ? contact_of<D>(p, pair(k), tangents_[k - state_.pairs.size()])
                       : contact_of<D>(p, pair(k), planes_);
    contact.loaded_plane = loaded_plane(k);
    return contact;
  }
  // True if a film holds pair k of particles under so strong a tension that the normal of the end
  // of the step would be unstable.
  bool is_stretched(std::size_t k) {
    if (kappas_of_films_.empty() || !(pair(k).gamma < 0) || impacts_->is_hit(k)) return false;
    return std::max(kappas_of_films_[index_of(pair(k).first)],
                    kappas_of_films_[index_of(pair(k).second)]) > kLargestWithEndNormals;
  }
  // Contact::loaded_plane of pair k.
  std::int32_t loaded_plane(std::size_t k) {
    return loaded_.empty() || pair(k).first >= 0 ? -1 : loaded_[pair(k).plane()];
  }
  Contact<D> contact_at_end(std::size_t k);
  Contact<D> contact(std::size_t k) {
    auto contact = with_gap_to_close(contact_at_start(k), k);
    contact.w = w(contact.first_entry(), contact.second);
    return contact;
  }
  // The contact `here` of pair k after resolved(). An overlap with an obstacle is tolerated only as
  // far as it is there at the beginning of the step, without the motion of the obstacle in it.
  Contact<D> with_gap_to_close(const Contact<D>& here, std::size_t k) {
    const auto& p = state_.particles;
    double tolerated = tolerated_;
    if (here.first < 0) {
      const auto j = index_of(here.second);
      const double overlap = -gap(planes_before_[pair(k).plane()], p.position(j), p.radii[j]);
      tolerated = std::clamp(overlap, 0.0, tolerated);
    }
    return resolved(here, p, pair(k), planes_, tolerated);
  }
  // Contact::w for two entries, or for an obstacle (< 0) and a particle; 0 if both motions are
  // given.
  double w(std::int32_t first, std::int32_t second) const {
    return (first < 0 ? 0.0 : mobilities_[index_of(first)]) + mobilities_[index_of(second)];
  }
  ResidualScales<D> residual_scales() {
    return {state_,      h_,      displacements_,
            mobilities_, system_, constraints_ ? &*constraints_ : nullptr};
  }
  // True if the number is that of a particle in system_.
  bool takes_part(std::int32_t particle) const {
    return particle >= 0 && system_.body_of(particle) >= 0;
  }
  bool gap_would_close(std::size_t k, double margin);
  // True if pair k is not chosen yet, but has a particle that the solution has moved.
  bool may_have_closed(std::size_t k) {
    return is_chosen_[k] == 0 &&
           (takes_part(pair(k).second) || takes_part(pair(k).first) || takes_part(loaded_plane(k)));
  }
  // True if an impulse of pair k moves at least one of its bodies.
  bool can_bear(std::size_t k) {
    const auto first = pair(k).first < 0 ? loaded_plane(k) : pair(k).first;
    return w(first, pair(k).second) > 0;
  }
  void take_given(std::size_t c, const PairMemory& memory, ProjectionResult& result);
  bool has_film(std::size_t k);
  std::vector<std::size_t> nearly_closed(bool are_films_only);
  std::vector<std::size_t> closed_by_free_motion();
  void leave_touching(std::vector<std::size_t>& pairs, const SolverSettings& settings,
                      double mean_radius);
  void choose(const std::vector<std::size_t>& pairs);
  void refine();
  struct Understated {
    /// The mobility of the lighter particle of a contact over the least one of its island.
    double by_masses = 1;
    /// The square of the number of contacts across the island.
    double by_chains = 1;
  };
  std::vector<Understated> understated();
  bool is_worth_refining(const std::vector<std::size_t>& island);
  ImpulseError error_of_contact(std::size_t c) const;
  int solve_contacts(bool is_rough, double length, int iterations, int max_iterations);
  std::vector<std::size_t> with_connected_pairs(const std::vector<std::size_t>& pairs, int round);
  void allow(double length, double fraction, double of_slips);
  std::vector<std::size_t> examine(const SolverSettings& settings, double mean_radius,
                                   bool is_final, ProjectionResult& result);
  void find_tangents();
  ResidualScale scale_of_link(const LinkEquations& link, ResidualScales<D>& scales) const;
  void examine_links(const SolverSettings& settings, double mean_radius, ProjectionResult& result);
  void name_contradictions(const std::vector<std::size_t>& beyond, double mean_radius,
                           ProjectionResult& result);

  State& state_;
  double h_;
  std::span<const PlanePosition> planes_before_, planes_;
  std::span<double> displacements_;
  std::span<const double> mobilities_;
  ThreadPool& pool_;
  std::span<const std::int32_t> loaded_;
  // For each pair in state.walls the tangent of the obstacle at the place where the motion without
  // contacts ends; empty if no obstacle is curved. An impulse of this contact moves the particle
  // along the normal of the tangent, and thus exactly back onto a circle. If other contacts move it
  // along the tangent, an error of second order remains.
  std::vector<PlanePosition> tangents_;
  double tolerated_ = 0;             // largest overlap that is left as it is [L]
  double margin_ = 0;                // gap below which a pair is nearly closed [L]
  std::vector<std::size_t> chosen_;  // pair of each contact of system_
  std::vector<char> is_chosen_;      // 1 for each chosen pair, else 0; in the order of pair()
  ContactSystem<D> system_;
  const Links* links_ = nullptr;
  const ConstraintStep* step_ = nullptr;  // of add_constraints(); null without constraints
  std::optional<ConstraintSystem<D>> constraints_;
  std::optional<PairsOfParticles> pairs_of_particles_;
  const Impacts<D>* impacts_ = nullptr;
  std::vector<double> kappas_of_films_;  // at the impulses of the step before; see follow()
  std::vector<ImpulseError> errors_;     // of the contacts of system_, without constraints
  std::vector<double> rounding_;  // rounding errors of the gaps of the contacts of system_ [L]
};

}  // namespace viscontact::particles
