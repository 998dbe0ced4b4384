// The contacts and particles of the problem that a time step solves for the impulses of contacts,
// docs/physics.md (5.4). Lengths [L], masses [M] and times [T] are in any consistent units.
// Particles, bodies and contacts are numbered from 0; D is the number of dimensions, 2 or 3.
// projection/ and constraints/ use the class. Nothing is checked or thrown. A change must keep the
// order of contacts and bodies. Rounding errors depend on it and, if several impulses solve the
// problem, also the impulses.
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

/// A particle takes part in the problem if add() or connect() names it, or if another particle of
/// its rigid body takes part. It is then called a body here, also if it belongs to a rigid body.
/// Bodies are numbered in the order in which they begin to take part. Bodies that contacts,
/// connect() or rigid bodies join, directly or through other bodies, form an island. Contacts can
/// be added but not removed. h is the length of the step [T] and m the mass of a body [M]. u* is
/// the velocity of a body without the impulses of contacts [L/T], and v its velocity with them.
template <int D>
class ContactSystem {
 public:
  /// `displacements` holds h u* of all particles and then of all planes under a load [L], D numbers
  /// for each; solve() overwrites it. `mobilities` holds h/m of the same [T/M], > 0, or 0 if the
  /// motion is given. A plane under a load takes part like a particle. If one particle of a rigid body of
  /// `particles` takes part, all particles of this body do. The three arguments must outlive the
  /// object.
  ContactSystem(std::span<double> displacements, std::span<const double> mobilities,
                const Particles& particles)
      : displacements_(displacements),
        mobilities_(mobilities),
        particles_(particles),
        body_of_(mobilities.size(), -1) {}

  /// Adds a contact, makes its particles take part, and joins them to one island. The contact must
  /// have `allowed` > 0, and `w` equal to the sum of the mobilities of its particles.
  void add(const Contact<D>& contact);

  /// Makes two particles take part, and joins them to one island. If `first` is -1, it makes only
  /// `second` take part.
  void connect(std::int32_t first, std::int32_t second);
  /// Tells the object that a rigid link holds `particle`, which must take part in the problem.
  void hold(std::int32_t particle) { is_held_[index_of(island(body_of(particle)))] = 1; }

  /// Solves the dual problem, with the impulses of `contacts` as the first guess and at most
  /// `max_iterations` > 0 iterations. Sets these impulses [M L/T], and sets the displacements of
  /// the bodies in the array of the constructor to h v. `is_rough` is true if the caller uses the
  /// solution only to find contacts that it must add. If the problem is not solved,
  /// SolverResult::residual is larger than 1; a NaN does not show in it, so that the caller must
  /// measure the residuals of the step.
  SolverResult solve(bool is_rough, int max_iterations, ThreadPool& pool);

  /// The contacts in the order of add(). They name particles by the numbers of the particles, not
  /// by those of the bodies. A caller may change `impulse` and `allowed` of a contact, and nothing
  /// else.
  std::vector<Contact<D>> contacts;

  /// True if a particle of the contact is in an island with a rigid body or a rigid link.
  bool is_held(const Contact<D>& contact);
  /// Gap [L] of a contact, which need not be in the system, after the present displacements. It is
  /// distance_after() if uses_distance() is true, otherwise the linearised gap, gap_after().
  double gap(const Contact<D>& contact);
  /// Makes gap() the distance of the surfaces for all contacts of the island of this body. For this
  /// is_held() must be true for its contacts, and may_use_distances() must be true. When two
  /// particles in touch turn about each other, their linearised gap becomes negative, which would
  /// contradict rigid bodies and links that turn with them.
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
  /// Number of bodies of the island with the root `root`, a result of island().
  std::size_t size_of_island(std::int32_t root) const { return island_sizes_[index_of(root)]; }
  /// Number of the body that `particle` is, or -1 if the particle does not take part.
  std::int32_t body_of(std::int32_t particle) const { return body_of_[index_of(particle)]; }
  /// Displacement h u* [L] of a body: D numbers, valid until another particle takes part.
  const double* free_displacement(std::size_t body) const { return &free_[body * D]; }
  /// The number of the body that represents the island of `body` >= 0. add() and connect() may
  /// choose another body for an island.
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
  // Marks of each island, at its root: is_held_ is 1 if it has a rigid body or a rigid link,
  // uses_distances_ is 1 if its gaps are distances; otherwise both are 0.
  std::vector<char> is_held_, uses_distances_;
  // has_distances_ is true if uses_distances_ has a 1. It saves two searches for each gap.
  bool may_use_distances_ = true, has_distances_ = false;
  std::size_t largest_island_ = 1;
  FreeSetFactor<D> factor_;  // made by the last solve() that needed a factor, for the next solve()
};

}  // namespace viscontact::particles
