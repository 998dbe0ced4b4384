// The projection of a time step, docs/physics.md (5.3) and (5.4): its contacts, tolerances and
// residuals.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/constraint_rows/selection.hpp"
#include "viscontact/contact_dynamics/constraints/constraint_system.hpp"
#include "viscontact/contact_dynamics/constraints/contact_system.hpp"
#include "viscontact/contact_dynamics/impacts/impacts.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/contact/contact_laws.hpp"
#include "viscontact/particles/contact/film_tension.hpp"
#include "viscontact/particles/contact/shaped_contacts.hpp"
#include "viscontact/particles/neighbours/pairs_of_particles.hpp"
#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/state/state.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

/// Scales for the residual [L] of a contact or link: the distance of a gap or length from the value
/// that its condition demands.
struct ResidualScale {
  /// Change of the gap per impulse [T/M], > 0: h (1/m_i + 1/m_j) for particles with these masses,
  /// with the length h of the step.
  double w = 0;
  /// Impulse at work [M L/T]: the magnitude of the impulses that move the particles or press on
  /// them in the step. A small fraction of it is an allowed error.
  double impulse = 0;
  double rounding = 0;  ///< of the gap after the step [L], > 0
  /// Allowed residual [L]: the smaller of `length` > 0 [L] and of the change of the gap by
  /// `fraction` > 0 of the impulse at work, which is at least `rounding`.
  double allowed(double length, double fraction) const {
    return std::min(length, std::max(fraction * impulse * w, rounding));
  }
  /// SolverSettings::tolerance is in units of `mean_radius` > 0 [L].
  double allowed_gap(const SolverSettings& settings, double mean_radius) const {
    return allowed(settings.tolerance * mean_radius / 2, settings.impulse_tolerance);
  }
};

/// The fraction of the impulse at work [1] for slips, the tangential displacements. It keeps
/// friction to its law in short steps, and is larger than that of gaps, because redundant impulses
/// in a packing must grow until the slips are allowed. With the default tolerance it is 1e-4, about
/// what the tolerance of gaps allows in the steps of bench/box2d.cpp. With 1e-6, 1000 settled discs
/// without films take twice as many iterations.
inline double fraction_of_slips(const SolverSettings& settings) {
  constexpr double kOfTolerance = 100;
  return std::max(settings.impulse_tolerance, kOfTolerance * settings.tolerance);
}

template <int D>
class ResidualScales {
 public:
  /// Measures the impulses at work at the present impulses of `system` and the displacements h v
  /// [L]. `mobilities` are h/m [T/M]. `constraints` is null in a step without friction, bodies and
  /// links. The arguments must outlive this object.
  ResidualScales(const State& state, double h, std::span<const double> displacements,
                 std::span<const double> mobilities, ContactSystem<D>& system,
                 const ConstraintSystem<D>* constraints, bool counts_mean_load);

  /// Scales of a contact or link between `particles`, which need not be in `system`; negative
  /// numbers are obstacles. `w` > 0 is the change of the gap per impulse [T/M], and `length` >= 0
  /// [L] the size of the numbers whose difference is the gap.
  ///
  /// The impulse at work is the smallest of those of the particles, because an impulse that is
  /// small for a heavy particle may be all that moves a light one. The rounding errors are those of
  /// the gap, of the displacements, and of a solution for all connected contacts.
  ResidualScale of(std::span<const std::int32_t> particles, double w, double length);
  /// In a step with friction, bodies or links, rounding errors are at least the last place of the
  /// radii, because smaller displacements of particles at rest are errors of the solutions. In an
  /// island with a rigid body or link (ContactSystem::has_finite_turns()) they are larger, because
  /// finite turns move points of the surface; there they also grow with the distance of the
  /// particles from the origin.
  ResidualScale of(const Contact<D>& contact);
  /// Largest displacement of a particle by its impulse at work [L].
  double largest_change(std::span<const std::int32_t> particles) const;

 private:
  struct ParticleScale {
    double impulse = 0;  ///< impulse at work: of forces, or the change of momentum [M L/T]
    /// Sum of h |u_d| over the components d of the velocity u before the step [L].
    double moved = 0;
  };
  void take_mean_loads();
  // Takes no contacts into account; `moves` is the displacement without contacts and links.
  ParticleScale of_particle(std::int32_t particle, const double* moves) const;
  // Takes the contacts of a body of system_ into account.
  ParticleScale of_particle(std::int32_t particle) const;

  const State& state_;
  double h_;
  std::span<const double> displacements_, mobilities_;
  ContactSystem<D>& system_;
  bool has_constraints_;
  std::vector<ParticleScale> body_scales_;  // of all bodies of system_
  // Largest w^(1/2) p of the contacts of each island, with the impulse p [L (M/T)^(1/2)], at its
  // root.
  std::vector<double> island_impulses_;
  // The mean normal impulse of the loaded contacts of each island [M L/T], at its root; empty if it
  // does not count.
  std::vector<double> mean_loads_;
};

/// If a residual of a link or an overlap exceeds this fraction of the mean radius after all
/// iterations, the links contradict each other, an error. It is far above tolerances.
inline constexpr double kBroken = 1e-3;

struct ProjectionResult {
  /// Iterations of all solutions; with constraints those of the island that needs most.
  int iterations = 0;
  StagesRun stages;  ///< the methods that ran, summed over all islands and solutions
  /// StepResiduals::converged tells whether the step is solved; impulse_errors [M L/T] are in the
  /// order of `pairs`.
  StepResiduals residuals;
  /// Number of contacts with an impulse or a film whose particles move around each other by more
  /// than kLargestTurn (contact.hpp), so that linearised gaps are wrong.
  std::size_t unresolved = 0;
  /// True if given loads bound the friction, because the problem with the loads of this step was
  /// not solved, or its corrections for finite turns diverged (ConstraintSystem::has_given_up()).
  bool has_given_loads = false;
  /// True if Coulomb's law was not solved and the step can be divided. Then the solution and all
  /// residuals are rough.
  bool needs_shorter_step = false;
  bool lacks_springs = false;  ///< StepReport::lacks_springs of this part
  double buckling = 0;         ///< StepReport::buckling of this part
  double link_residual = 0;    ///< largest [L]
  /// Names of the hinges and arms that contradict each other. Empty if the residuals of all links
  /// are allowed, or no residual or overlap is more than kBroken mean radii.
  std::vector<std::string> unsolved_links;
  /// True if some motion satisfies the linear equations, but none was found with finite turns:
  /// links and contacts contradict each other, or turn too far in the step. Also true of a step
  /// that is not solved while particles that are not round turn in it.
  bool turns_too_far = false;
  bool contact_contradicts = false;  ///< true: contacts may contradict these links
  std::vector<Pair*> pairs;
  /// Normal impulse of each of `pairs` [M L/T].
  std::vector<double> impulses;
  std::vector<PairMemory> memories;  ///< of `pairs`; empty without add_constraints()
  /// For the laws of `pairs`, at the beginning of the step; empty if all particles are round.
  std::vector<PairRadii> radii;
  /// Particles whose displacements solve() has changed, and entries of planes under a load.
  std::vector<std::int32_t> bodies;
  /// The impulses [M L/T] and moments [M L^2/T] of the contacts on particles whose motion is given.
  std::vector<GivenParticleLoad> on_given{};
};

/// Chooses pairs and solves the problem (5.4) for them. A pair is chosen if a film holds it (gamma
/// < 0, minus the impulse that the film has absorbed [M L/T]), if it had an impulse in the last
/// step, or if the motion without contacts, but with links, would close its gap. If the solution
/// closes further gaps, their pairs are added and the problem is solved again. A rough solution
/// comes first, because it finds most of these pairs with little work. With
/// SolverSettings::suits_sweeps() there is none; nearby pairs are optional contacts, which take part
/// as soon as their gaps close.
///
/// The step has converged if each contact, with the gap d after the step (ContactSystem::gap()) and
/// the impulse p, meets two conditions. The residual |min(d, w (p - gamma))|, without the tolerated
/// overlap, is at most half of SolverSettings::tolerance mean radii. The error of the impulse is at
/// most SolverSettings::impulse_tolerance of the impulse at work, or within rounding errors. This
/// error is the estimate of a Refinement, or, where there is none, the residual over w, times the
/// ratio of the masses of a contact's set if this is a contact. Links must meet the same
/// conditions.
template <int D>
class StepProjection {
 public:
  /// All arguments must outlive this object. `planes_before` and `planes` are all obstacles at the
  /// beginning and at the end of the step of the length `h` > 0 [T]; `planes` must not contain the
  /// motion of planes under a load along their normals. `displacements` has D numbers for each
  /// particle and then for each plane under a load [L]: those without contacts and links, after
  /// solve() those with them. `mobilities` are h/m of the same [T/M], or 0 for a particle whose
  /// motion is given. `loaded` has for each obstacle its entry in these arrays, or -1; it is empty
  /// if no plane has a load.
  StepProjection(State& state, double h, std::span<const PlanePosition> planes_before,
                 std::span<const PlanePosition> planes, std::span<double> displacements,
                 std::span<const double> mobilities, ThreadPool& pool,
                 std::span<const std::int32_t> loaded = {});
  /// Makes solve() treat friction, rigid bodies and links, too. `step` must outlive this object.
  void add_constraints(const ConstraintStep& step);
  /// Makes solve() linearise contacts at the places where impacts (collisions of solids) have left
  /// their particles, because contacts that are linearised elsewhere could stop particles that pass
  /// each other. Gaps are then never distances, with which the projection would add energy.
  /// `impacts` must outlive this object.
  void follow(const Impacts<D>& impacts) {
    impacts_ = &impacts;
    kappas_of_films_ = kappas_of_films(
        state_.particles, mobilities_,
        state_.pairs.size(), [&](std::size_t k) -> auto& { return state_.pairs[k]; },
        [&](std::size_t k) { return state_.pairs[k].impulse; });
    system_.forbid_distances();
  }
  /// Solves the projection and sets the displacements, but changes neither pairs nor memories of
  /// the state. SolverSettings::tolerance is in units of `mean_radius` > 0 [L]. May be called once.
  /// If the step is not solved, the result is the last solution. If `can_be_divided`, sweeps that
  /// do not solve Coulomb's law end at once with ProjectionResult::needs_shorter_step.
  ProjectionResult solve(const SolverSettings& settings, double mean_radius,
                         bool can_be_divided = false);

 private:
  // Pairs are numbered as in state.pairs; those of state.walls follow after them.
  Pair& pair(std::size_t k) {
    return k < state_.pairs.size() ? state_.pairs[k] : state_.walls[k - state_.pairs.size()];
  }
  std::size_t pair_count() const { return state_.pairs.size() + state_.walls.size(); }
  // Null if both surfaces are round. Threads may call it at the same time for different pairs.
  const ShapedContact* shaped(std::size_t k);
  PairRadii radii_of_pair(std::size_t k) {
    assert(step_ != nullptr);
    if (const auto* surfaces = shaped(k)) return surfaces->radii();
    return radii_of(pair(k), state_.particles, step_->obstacles);
  }
  // The gap is the true one. A curved obstacle is replaced by its tangent for a round particle.
  Contact<D> contact_at_start(std::size_t k) {
    const auto& p = state_.particles;
    if constexpr (D == 2)
      if (const auto* surfaces = shaped(k)) {
        auto contact = contact_of(pair(k), *surfaces);
        contact.loaded_plane = loaded_plane(k);
        return contact;
      }
    if (impacts_ != nullptr && pair(k).first >= 0 && !is_stretched(k)) return contact_at_end(k);
    auto contact = !tangents_.empty() && pair(k).first < 0
                       ? contact_of<D>(p, pair(k), tangents_[k - state_.pairs.size()])
                       : contact_of<D>(p, pair(k), planes_);
    contact.loaded_plane = loaded_plane(k);
    return contact;
  }
  // True if a film holds pair k under so strong a tension that the normal of the end of the step
  // would be unstable.
  bool is_stretched(std::size_t k) {
    if (kappas_of_films_.empty() || !(pair(k).gamma < 0) || impacts_->is_hit(k)) return false;
    return std::max(kappas_of_films_[index_of(pair(k).first)],
                    kappas_of_films_[index_of(pair(k).second)]) > kLargestWithEndNormals;
  }
  std::int32_t loaded_plane(std::size_t k) {
    return loaded_.empty() || pair(k).first >= 0 ? -1 : loaded_[pair(k).plane()];
  }
  // The normal is that at the end of the step, where impacts have left both particles, and the gap
  // [L] that at the beginning along this normal.
  Contact<D> contact_at_end(std::size_t k);
  Contact<D> contact(std::size_t k) {
    auto contact = with_gap_to_close(contact_at_start(k), k);
    contact.w = w(contact.first_entry(), contact.second);
    return contact;
  }
  // The contact after resolved(). An overlap with an obstacle is tolerated only as far as it is
  // there at the beginning of the step, without the motion of the obstacle in it.
  Contact<D> with_gap_to_close(const Contact<D>& here, std::size_t k) {
    const auto& p = state_.particles;
    double tolerated = tolerated_;
    if (here.first < 0) {
      const auto j = index_of(here.second);
      const auto& before = planes_before_[pair(k).plane()];
      const double overlap = -(here.shaped != nullptr ? here.shaped->gap_at(before)
                                                      : gap(before, p.position(j), p.radii[j]));
      tolerated = std::clamp(overlap, 0.0, tolerated);
    }
    return resolved(here, p, pair(k), planes_, tolerated);
  }
  // Contact::w for two entries, of which the first may be an obstacle (< 0); 0 if both are given.
  double w(std::int32_t first, std::int32_t second) const {
    return (first < 0 ? 0.0 : mobilities_[index_of(first)]) + mobilities_[index_of(second)];
  }
  ResidualScales<D> residual_scales() {
    return {state_,           h_,      displacements_,
            mobilities_,      system_, constraints_ ? &*constraints_ : nullptr,
            counts_mean_load_};
  }
  bool turns_too_far(const Contact<D>& contact) const {
    if constexpr (D == 2)
      if (contact.shaped != nullptr)
        return particles::turns_too_far(contact, displacements_, step_->turns);
    return particles::turns_too_far(state_.particles, contact, displacements_);
  }
  bool have_passed(const Contact<D>& contact) const {
    if constexpr (D == 2)
      return contact.shaped != nullptr && pass(contact, displacements_, step_->turns);
    return false;
  }
  bool takes_part(std::int32_t particle) const {
    return particle >= 0 && system_.body_of(particle) >= 0;
  }
  // True if the displacements make the linearised gap of pair k smaller than `margin` [L], or take
  // shapes past each other.
  bool gap_would_close(std::size_t k, double margin);
  // True if pair k is not chosen yet, but has a particle that the solution has moved.
  bool may_have_closed(std::size_t k) {
    return !selection_.is_decided(k) &&
           (takes_part(pair(k).second) || takes_part(pair(k).first) || takes_part(loaded_plane(k)));
  }
  // True if an impulse of pair k moves at least one of its bodies.
  bool can_bear(std::size_t k) {
    const auto first = pair(k).first < 0 ? loaded_plane(k) : pair(k).first;
    return w(first, pair(k).second) > 0;
  }
  // True if a particle with a contact that is not round turns, so that a shorter step may be
  // solved.
  bool shapes_turn() const;
  // Adds the impulse of contact `c` to ProjectionResult::on_given if a motion is given.
  void take_given(std::size_t c, const PairMemory& memory, ProjectionResult& result);
  // Needs add_constraints().
  bool has_film(std::size_t k);
  // Pairs that are not chosen and whose gaps the displacements make smaller than `margin` [L]: all,
  // or those with or without films.
  std::vector<std::size_t> nearly_closed(double margin, std::optional<bool> have_films);
  // Pairs with a film or an impulse in the last step, or whose gaps the displacements would close.
  std::vector<std::size_t> closed_by_free_motion();
  // Removes pairs, without a film, whose gaps close by no more than the allowed residual and whose
  // impulses in the step before were 0 or, for sweeps, no more than errors. Returns the latter.
  std::vector<std::size_t> leave_touching(std::vector<std::size_t>& pairs,
                                          const SolverSettings& settings, double mean_radius);
  // Adds contacts of pairs that are not chosen yet. A pair that an arm keeps apart gets none.
  void choose(const std::vector<std::size_t>& pairs, bool are_optional = false);
  // Adds pairs without films that are nearly closed, as optional contacts, and those next to them.
  void choose_optional(double mean_radius);
  void refine();
  struct Understated {
    /// The mobility of the lighter particle of a contact over the least one of its island.
    double by_masses = 1;
    /// The square of the number of contacts across the island.
    double by_chains = 1;
  };
  // Factors by which the residual of a contact over w may understate the error of its impulse.
  std::vector<Understated> understated();
  // False if a Refinement of these contacts would do nothing; found without making its problem.
  bool is_worth_refining(const std::vector<std::size_t>& island);
  ImpulseError error_of_contact(std::size_t c) const;
  // Adds to the iterations and stages of `result`.
  void solve_contacts(bool is_rough, double length, int max_iterations, ProjectionResult& result);
  // Adds pairs that are connected with `pairs` and whose gaps may close next.
  std::vector<std::size_t> with_connected_pairs(const std::vector<std::size_t>& pairs, int round);
  // Must precede solve_contacts().
  void allow(double length, double fraction, double of_slips);
  // Writes the residuals of the pairs that are not chosen and, if `is_final`, also those of chosen
  // contacts and of links to `result`. Returns the pairs that are not chosen and whose gaps are
  // closed by more than allowed.
  std::vector<std::size_t> examine(const SolverSettings& settings, double mean_radius,
                                   bool is_final, ProjectionResult& result);
  void find_tangents();
  ResidualScale scale_of_link(const LinkEquations& link, ResidualScales<D>& scales) const;
  void examine_links(const SolverSettings& settings, double mean_radius, ProjectionResult& result);
  // `beyond` are the links whose residuals are not allowed.
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
  // exactly back onto a circle. If other contacts move it along the tangent, an error of second
  // order remains.
  std::vector<PlanePosition> tangents_;
  std::vector<std::unique_ptr<ShapedContact>> shaped_;  // those asked for, in the order of pair()
  double tolerated_ = 0;                                // [L]
  bool counts_mean_load_ = false;
  bool sweeps_ = false;  // SolverSettings::suits_sweeps(), and there are constraints
  double margin_ = 0;    // gap below which a pair is nearly closed [L]
  Selection selection_;  // of pair(); its members are the contacts of system_
  ContactSystem<D> system_;
  const Links* links_ = nullptr;
  const ConstraintStep* step_ = nullptr;  // null without constraints
  std::optional<ConstraintSystem<D>> constraints_;
  std::optional<PairsOfParticles> pairs_of_particles_;
  const Impacts<D>* impacts_ = nullptr;
  std::vector<double> kappas_of_films_;  // at the impulses of the step before
  std::vector<ImpulseError> errors_;     // of the contacts of system_, without constraints
  std::vector<double> rounding_;         // of the gaps of the same [L]
};

}  // namespace viscontact::particles
