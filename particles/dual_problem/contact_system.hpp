// The contacts and particles that take part in the projection of a step, as the dual problem (5.4)
// of docs/physics.md needs them. Lengths, masses and times are in the units of the case.
// projection/ and constraints/ use it; nothing is thrown. Results depend on the order of contacts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/bodies/rigid_bodies.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/dual_problem/mass_dual_problem.hpp"

namespace viscontact::particles {

/// Particles that take part are called bodies, also if they belong to a rigid body; they are
/// numbered in the order in which the contacts name them. Contacts are only added, never removed. h
/// is the length of the step, u* the velocity without contacts, v that with them, and m the mass.
template <int D>
class ContactSystem {
 public:
  /// `displacements`: h u* of all particles, a flat array [L]. `mobilities`: h/m of all particles
  /// [T/M]. `rigid_bodies`: if one particle of a rigid body takes part, all do. All must outlive
  /// this object.
  ContactSystem(std::span<double> displacements, std::span<const double> mobilities,
                const RigidBodies& rigid_bodies)
      : displacements_(displacements),
        mobilities_(mobilities),
        rigid_bodies_(rigid_bodies),
        body_of_(mobilities.size(), -1) {}

  /// Adds a contact and makes its particles take part. Particles of a contact are in one island.
  void add(const Contact<D>& contact);

  /// Makes two particles take part, in one island. `first` may be -1: only `second`.
  void connect(std::int32_t first, std::int32_t second);

  /// Solves the dual problem, with the impulses of `contacts` as the guess. Sets these impulses,
  /// and the displacements h v of the bodies in the array of the constructor. If `is_rough`, the
  /// solution serves only to find contacts that must be added (MassDualProblem).
  SolverResult solve(bool is_rough, int max_iterations, ThreadPool& pool);

  /// The contacts, with the numbers of particles, not of bodies. `impulse` and `allowed` may be
  /// changed.
  std::vector<Contact<D>> contacts;

  const std::vector<std::int32_t>& bodies() const { return bodies_; }  ///< particle of each body
  /// Body of a particle; -1 if the particle does not take part.
  std::int32_t body_of(std::int32_t particle) const { return body_of_[index_of(particle)]; }
  /// Displacement h u* of a body: D numbers [L].
  const double* free_displacement(std::size_t body) const { return &free_[body * D]; }
  /// The body that stands for all bodies that contacts connect with `body` (union-find).
  std::int32_t island(std::int32_t body);

 private:
  std::int32_t number(std::int32_t particle);
  void join(std::int32_t island, std::int32_t other);

  std::span<double> displacements_;
  std::span<const double> mobilities_;
  const RigidBodies& rigid_bodies_;
  std::vector<std::int32_t> bodies_, body_of_;
  std::vector<double> free_, body_mobilities_;
  // Islands as a forest of union-find: the parent of each body, which is another body of its
  // island, or the body itself if it is the root.
  std::vector<std::int32_t> island_of_;
  std::vector<std::size_t> island_sizes_;  // number of bodies of each island, at its root
  std::size_t largest_island_ = 1;
  FreeSetFactor<D> factor_;  // of the last solve that needed it
};

}  // namespace viscontact::particles
