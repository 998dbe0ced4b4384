// The contacts and particles of the problem that a time step solves, docs/physics.md (5.4), for the
// impulses of contacts. Lengths, masses and times are in any consistent units. Numbers of
// particles, bodies and contacts count from 0. projection/ and constraints/ use it; nothing is
// checked or thrown. A change must keep the order of contacts and bodies, because rounding errors,
// and with redundant contacts also the impulses, depend on it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/dual_problem/mass_dual_problem.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// A particle takes part in the problem if add(), connect() or the rigid body of such a particle
/// put it there. It is then called a body here, also if it belongs to a rigid body. Bodies are
/// numbered in the order in which the contacts name them. Bodies that contacts connect, directly or
/// through other bodies, form an island. Contacts are only added. h is the length of the step [T],
/// u* the velocity of a body without contacts [L/T], v with them, m its mass [M].
template <int D>
class ContactSystem {
 public:
  /// `displacements`: h u* of all particles [L], D numbers for each. `mobilities`: h/m of all
  /// particles [T/M], > 0. If one particle of a rigid body of `particles` takes part, all do. All
  /// must outlive the object.
  ContactSystem(std::span<double> displacements, std::span<const double> mobilities,
                const Particles& particles)
      : displacements_(displacements),
        mobilities_(mobilities),
        particles_(particles),
        body_of_(mobilities.size(), -1) {}

  /// Adds a contact, makes its particles take part, and joins them to one island.
  void add(const Contact<D>& contact);

  /// Makes two particles take part, in one island; if `first` is -1, only `second`.
  void connect(std::int32_t first, std::int32_t second);
  /// Tells that a rigid link holds `particle`, which must take part in the problem.
  void hold(std::int32_t particle) { is_held_[index_of(island(body_of(particle)))] = 1; }

  /// Solves the dual problem, with the impulses of `contacts` as the first guess and at most
  /// `max_iterations` > 0 iterations. Sets these impulses, and in the array of the constructor the
  /// displacements h v of the bodies. If `is_rough`, the caller uses the solution only to find
  /// contacts that it must add. If it is not solved, SolverResult::residual is larger than 1.
  SolverResult solve(bool is_rough, int max_iterations, ThreadPool& pool);

  /// The contacts, which name particles by their own numbers, not by those of bodies. A caller may
  /// change `impulse` and `allowed` of a contact, and nothing else.
  std::vector<Contact<D>> contacts;

  /// True if a particle of the contact is in an island with a rigid body or a rigid link.
  bool is_held(const Contact<D>& contact);
  /// Gap of a contact, which need not be in the system, after the present displacements [L]: the
  /// linearised gap, gap_after(), or distance_after() if uses_distance().
  double gap(const Contact<D>& contact);
  /// Makes gap() the distance for the contacts of the island of this body. The island must be held,
  /// and may_use_distances(). The linearised gap of two particles in touch becomes negative when
  /// they turn about each other, and would contradict rigid bodies and links that turn with them.
  void use_distances(std::int32_t body) {
    uses_distances_[index_of(island(body))] = 1;
    has_distances_ = true;
  }
  /// True if gap() of the contact is the distance of the two surfaces.
  bool uses_distance(const Contact<D>& contact);
  /// Forbids use_distances(), for a caller whose solutions would gain energy with distances.
  void forbid_distances() { may_use_distances_ = false; }
  bool may_use_distances() const { return may_use_distances_; }  ///< false: they are forbidden

  const std::vector<std::int32_t>& bodies() const { return bodies_; }  ///< particle of each body
  /// Number of the body that a particle is; -1 if the particle does not take part.
  std::int32_t body_of(std::int32_t particle) const { return body_of_[index_of(particle)]; }
  /// Displacement h u* of a body: D numbers [L].
  const double* free_displacement(std::size_t body) const { return &free_[body * D]; }
  /// The number of the body that represents the island of `body` >= 0; add() and connect() may
  /// change it.
  std::int32_t island(std::int32_t body);

 private:
  std::int32_t number(std::int32_t particle);
  bool has_mark(const Contact<D>& contact, const std::vector<char>& marks);
  void join(std::int32_t island, std::int32_t other);

  std::span<double> displacements_;
  std::span<const double> mobilities_;
  const Particles& particles_;
  std::vector<std::int32_t> bodies_, body_of_;
  std::vector<double> free_, body_mobilities_;
  // The islands as trees (union-find): the parent of each body, which is another body of its
  // island, or the body itself if it is the root, which represents the island.
  std::vector<std::int32_t> island_of_;
  std::vector<std::size_t> island_sizes_;  // number of bodies of each island, at its root
  // 1 for an island with a rigid body or a rigid link, and for one whose gaps are distances,
  // otherwise 0; at its root.
  std::vector<char> is_held_, uses_distances_;
  // has_distances_: true if uses_distances_ has a 1, which saves two searches for each gap.
  bool may_use_distances_ = true, has_distances_ = false;
  std::size_t largest_island_ = 1;
  FreeSetFactor<D> factor_;  // of the last solve() that needed a factor, for the next one
};

}  // namespace viscontact::particles
