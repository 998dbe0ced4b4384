// Solves the projection (5.3) of one step on the contacts and particles that take part in it:
// chooses them, sets their tolerances, and checks the solution. Units are those of the case.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/contact_geometry.hpp"
#include "viscontact/particles/projection/pairs_of_particles.hpp"
#include "viscontact/particles/projection/projection.hpp"
#include "viscontact/particles/solver_settings.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// Result of the projection of a step.
struct ProjectionResult {
  int iterations = 0;
  bool converged = true;
  double residual = 0;  ///< largest residual of all pairs [L]
  /// Largest residual as an impulse, divided by the impulses at work in the contact.
  double impulse_residual = 0;
  /// Largest residual, divided by the residual that is allowed of the contact.
  double excess = 0;
  double smallest_gap = 0;  ///< smallest linearised gap [L], at most 0
  Film narrowest;           ///< the pair with the smallest gap
  /// Number of contacts that exert an impulse or are glued, and turn by more than kLargestTurn.
  std::size_t unresolved = 0;
  /// Pairs in the projection; their impulses are the solution.
  std::vector<Film*> films;
  /// Residual of each impulse [M L/T], in the order of `films`.
  std::vector<double> film_errors;
  /// Particles whose displacements the projection changed.
  std::vector<std::int32_t> bodies;
};

/// Chooses the pairs that are glued (gamma < 0), had an impulse in the last step, or whose gap the
/// free displacements h u* would close, and solves the problem of contact_graph.hpp for them and
/// their particles. If the solution closes further gaps, their pairs are added and the problem is
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
  ProjectionResult solve(const SolverSettings& settings, double mean_radius);

 private:
  Film& film(std::size_t f) {
    return f < state_.pairs.size() ? state_.pairs[f] : state_.walls[f - state_.pairs.size()];
  }
  std::size_t films() const { return state_.pairs.size() + state_.walls.size(); }
  Contact<D> contact(std::size_t f);
  bool gap_would_close(std::size_t f);
  std::int32_t island(std::int32_t body);
  void join(std::int32_t island, std::int32_t other);
  void choose(const std::vector<std::size_t>& films);

  /// Scales by which the residual of a contact is measured.
  struct Scale {
    double w = 0;         ///< h (1/m_i + 1/m_j) [T/M]
    double impulse = 0;   ///< impulses at work in the contact [M L/T]
    double rounding = 0;  ///< rounding errors of the gap after the step [L], > 0
    /// Allowed residual [L]: at most `length` [L], and at most the residual that stands for
    /// `fraction` of the impulses at work. The second limit is never below the rounding errors.
    double allowed(double length, double fraction) const {
      return std::min(length, std::max(fraction * impulse * w, rounding));
    }
  };
  std::vector<std::size_t> with_pairs_reached_from(const std::vector<std::size_t>& films,
                                                   int round);
  /// Contribution of a particle to the scales of its contacts.
  struct ParticleScale {
    double impulse = 0;  ///< impulse at work on the particle [M L/T]
    /// Sum over the components d of h |u_d|, u the velocity before the step [L].
    double moved = 0;
  };
  ParticleScale scale_of_particle(std::int32_t particle, const double* moves) const;
  void find_impulses_at_work();
  Scale scale_of(const Contact<D>& here);
  void allow(double length, double fraction);
  SolverResult solve_chosen(bool is_rough, int iterations);
  std::vector<std::size_t> closed_by_free_motion();
  std::vector<std::size_t> examine(const SolverSettings& settings, double mean_radius,
                                   bool is_final, ProjectionResult& result);

  State& state_;
  double h_;
  std::span<const PlanePosition> planes_;
  std::span<double> displacements_;
  std::span<const double> mobilities_;
  ThreadPool& pool_;
  double tolerated_ = 0;  // overlap that is not pushed out [L]
  // The pairs and particles that take part. Bodies are particles, numbered in the order in which
  // the contacts name them.
  std::vector<std::size_t> chosen_;
  std::vector<char> is_chosen_;  // of each pair in the list
  // Contacts between particles; their impulses are the first guess.
  std::vector<Contact<D>> geometry_;
  // The same contacts between numbered bodies.
  std::vector<Contact<D>> contacts_;
  std::vector<std::int32_t> bodies_;
  // Body of each particle; -1 if the particle does not take part.
  std::vector<std::int32_t> number_;
  std::vector<double> free_, body_mobilities_;
  // Islands as a forest: of each body, another body of its island, or itself at the root.
  std::vector<std::int32_t> island_of_;
  // Number of bodies of each island, at its root.
  std::vector<std::size_t> island_sizes_;
  std::size_t largest_island_ = 1;
  std::vector<ParticleScale> body_scales_;
  // Largest sqrt(w) p of each island, at its root.
  std::vector<double> island_impulses_;
  ActiveSetFactor<D> factor_;  // of the last solve that needed it
  std::optional<PairsOfParticles> pairs_of_particles_;
};

extern template class StepProjection<2>;
extern template class StepProjection<3>;

}  // namespace viscontact::particles
