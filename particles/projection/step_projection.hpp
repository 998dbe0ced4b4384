// The projection of a step, on the contacts and particles that take part in it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/contact_geometry.hpp"
#include "viscontact/particles/projection/pairs_of_particles.hpp"
#include "viscontact/particles/projection/projection.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// What the projection of a step found.
struct ProjectionResult {
  int iterations = 0;
  bool converged = true;
  double residual = 0;          ///< largest of a contact's conditions, over all films [L]
  double impulse_residual = 0;  ///< the same as an impulse, over the impulses at work there
  double excess = 0;            ///< largest residual over what is allowed of its contact
  double smallest_gap = 0;      ///< linearised [L], at most 0
  Film narrowest;               ///< the film of smallest_gap
  /// Pairs that exert an impulse while they move tangentially by more than kLargestTurn.
  std::size_t unresolved = 0;
  std::vector<Film*> films;          ///< in the projection; their impulses are its solution
  std::vector<double> film_errors;   ///< residual of each film's impulse [M L/T]
  std::vector<std::int32_t> bodies;  ///< whose displacements it changed
};

/// Chooses the films that hold (gamma < 0), that had an impulse in the last step, or whose gap the
/// free displacements h u* would close, and solves contact_graph.hpp's problem on them and their
/// particles. Where that closes further gaps, those are chosen too, until none is left. A first
/// rough solution shows most of the others that are closed, before much work is spent.
///
/// The step has converged when each contact's natural residual |min(D + h G v, w (p - gamma))|, D
/// without the overlap that is tolerated, is at most half of `tolerance` mean radii, and, divided by
/// w, at most `impulse_tolerance` of the impulses at work on the particle of the contact on which
/// they are smaller.
template <int D>
class StepProjection {
 public:
  /// The references outlive the object; `displacements` are h u* on entry, h v after solve().
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

  /// What residuals of a contact are measured by.
  struct Scale {
    double w = 0;         ///< h (1/m_i + 1/m_j) [T/M]
    double impulse = 0;   ///< at work in the contact [M L/T]
    double rounding = 0;  ///< rounding errors of the gap after the step [L], > 0
    /// The residual that is allowed: `length` [L], and `fraction` of the impulses at work, which
    /// cannot be less than rounding errors.
    double allowed(double length, double fraction) const {
      return std::min(length, std::max(fraction * impulse * w, rounding));
    }
  };
  std::vector<std::size_t> with_pairs_reached_from(const std::vector<std::size_t>& films,
                                                   int round);
  /// What a particle brings to the scales of its contacts.
  struct ParticleScale {
    double impulse = 0;  ///< at work on it [M L/T]
    double moved = 0;    ///< sum of h |u_d|, the velocity before the step [L]
  };
  ParticleScale scale_of_particle(std::int32_t particle, const double* moves) const;
  void find_impulses_at_work();
  Scale scale_of(const Contact<D>& here);
  void allow(double length, double fraction);
  SolverResult solve_chosen(const SolverSettings& settings, bool is_rough, int iterations);
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
  // What takes part. Bodies are numbered in the order in which contacts name them.
  std::vector<std::size_t> chosen_;
  std::vector<char> is_chosen_;       // of all films
  std::vector<Contact<D>> geometry_;  // between particles, impulses those of the guess
  std::vector<Contact<D>> contacts_;  // the same between numbered bodies
  std::vector<std::int32_t> bodies_;
  std::vector<std::int32_t> number_;  // of all particles; -1: does not take part
  std::vector<double> free_, body_mobilities_;
  std::vector<std::int32_t> island_of_;  // of bodies: a body closer to the one that stands for all
  std::vector<std::size_t> island_sizes_;  // bodies, at the body that stands for all
  std::size_t largest_island_ = 1;
  std::vector<ParticleScale> body_scales_;
  // The largest sqrt(w) p of each island, at the body that stands for it.
  std::vector<double> island_impulses_;
  ActiveSetFactor<D> factor_;  // of the solves so far
  std::optional<PairsOfParticles> pairs_of_particles_;
};

extern template class StepProjection<2>;
extern template class StepProjection<3>;

}  // namespace viscontact::particles
