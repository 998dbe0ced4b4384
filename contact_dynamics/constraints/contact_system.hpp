// The contacts and particles of the problem (5.4), docs/physics.md, and the islands that they form.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/constraint_rows/contact_rows.hpp"
#include "viscontact/constraint_rows/solver_names.hpp"
#include "viscontact/contact_solver/problem/mass_dual_problem.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/contact/shaped_contacts.hpp"
#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {

/// A particle takes part if add() or connect() names it or another particle of its rigid body. It
/// is then called a body, numbered in the order of taking part. Bodies that contacts, connect() or
/// rigid bodies join form an island. Rounding errors and, if several impulses solve the problem,
/// also the impulses depend on the order of contacts and bodies.
template <int D>
class ContactSystem {
 public:
  /// `displacements` holds those without contacts [L], D numbers for each particle and then for
  /// each plane under a load, which takes part like a particle; solve() overwrites it. `mobilities`
  /// holds h/m of the same [T/M], with the length h of the step and the mass m, or 0 if the motion
  /// is given. The three arguments must outlive the object.
  ContactSystem(std::span<double> displacements, std::span<const double> mobilities,
                const Particles& particles)
      : displacements_(displacements),
        mobilities_(mobilities),
        particles_(particles),
        body_of_(mobilities.size(), -1) {}

  /// Gives the turns of all particles and planes under a load [rad], 1 (discs) or 3 numbers for
  /// each, for gaps of particles that are not round. They must outlive the object.
  void follow_turns(std::span<const double> turns) { turns_ = turns; }

  /// Adds a contact, makes its particles take part, and joins them. `w` must be the sum of the
  /// mobilities of its particles, and `allowed` > 0 at solve().
  void add(const Contact<D>& contact);

  /// Makes two particles take part, and joins them; if `first` is -1, only `second`.
  void connect(std::int32_t first, std::int32_t second);
  /// A rigid link, which turns by finite angles, holds `particle`, which must take part.
  void mark_finite_turns(std::int32_t particle) {
    has_finite_turns_[index_of(island(body_of(particle)))] = 1;
  }

  /// Solves the dual problem with the impulses of `contacts` as the first guess, and sets these
  /// impulses and the displacements of the bodies. `is_rough`: only to find contacts that must be
  /// added. SolverResult::residual is > 1 without a solution; a NaN does not show in it.
  SolverResult solve(bool is_rough, int max_iterations, ThreadPool& pool);

  /// In the order of add(), with the numbers of particles, not of bodies. Only `impulse` and
  /// `allowed` may be changed.
  std::vector<Contact<D>> contacts;

  /// True if a particle of the contact is in an island with a rigid body, a rigid link or a
  /// particle that is not round.
  bool has_finite_turns(const Contact<D>& contact);
  /// The gap [L] of any contact after the present displacements, as uses_distance() says.
  double gap(const Contact<D>& contact);
  /// Makes gap() the distance of the surfaces for an island for which has_finite_turns() is true.
  /// When two particles in touch turn about each other, their linearised gap becomes negative,
  /// which would contradict rigid bodies and links that turn with them.
  void use_distances(std::int32_t body) {
    assert(may_use_distances_);
    uses_distances_[index_of(island(body))] = 1;
    has_distances_ = true;
  }
  bool uses_distance(const Contact<D>& contact);
  /// The gap [L] of any contact after the present displacements, never a distance of discs or
  /// spheres.
  double linear_gap(const Contact<D>& contact) const { return gap(contact, false); }
  /// Distances add energy to the solutions of some callers.
  void forbid_distances() { may_use_distances_ = false; }
  bool may_use_distances() const { return may_use_distances_; }

  const std::vector<std::int32_t>& bodies() const { return bodies_; }  ///< particle of each body
  std::size_t size_of_island(std::int32_t root) const {
    assert(island_of_[index_of(root)] == root);
    return island_sizes_[index_of(root)];
  }
  /// The result is -1 if the particle does not take part.
  std::int32_t body_of(std::int32_t particle) const { return body_of_[index_of(particle)]; }
  /// D numbers [L] without contacts, valid until another particle takes part.
  const double* free_displacement(std::size_t body) const { return &free_[body * D]; }
  /// The root of the island of `body`, a body that represents it. add() and connect() may change
  /// it.
  std::int32_t island(std::int32_t body);

 private:
  double gap(const Contact<D>& contact, bool is_distance) const;
  // Makes `particle` a body if it is none, and so the other particles of its rigid body.
  std::int32_t number(std::int32_t particle);
  // True if the island of one of the two particles has a mark; `marks` has those of roots.
  bool has_mark(const Contact<D>& contact, const std::vector<char>& marks);
  void join(std::int32_t island, std::int32_t other);

  std::span<double> displacements_;
  std::span<const double> mobilities_, turns_;
  const Particles& particles_;
  std::vector<std::int32_t> bodies_, body_of_;
  std::vector<double> free_, body_mobilities_;
  // Union-find trees: the parent of each body, or the body itself if it is the root.
  std::vector<std::int32_t> island_of_;
  std::vector<std::size_t> island_sizes_;  // of each island, at its root
  // Marks of each island, at its root: what has_finite_turns() says, and whether its gaps are
  // distances.
  std::vector<char> has_finite_turns_, uses_distances_;
  // has_distances_ says whether uses_distances_ has a mark, which saves two searches for each gap.
  bool may_use_distances_ = true, has_distances_ = false;
  std::size_t largest_island_ = 1;
  FreeSetFactor<D> factor_;  // made by the last solve() that needed one
};

}  // namespace viscontact::particles
