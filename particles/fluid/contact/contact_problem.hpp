// The contact problem of a step in a fluid, docs/physics.md (6.4): impulses that keep gaps open, as
// forces on particles whose velocities depend linearly on forces. Units are those of the case.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "viscontact/particles/fluid/contact/fluid_contact.hpp"
#include "viscontact/particles/solver_settings.hpp"

namespace viscontact::particles {

/// Velocities [L/T, 1/T] of all particles that forces and torques [M L/T^2, M L^2/T^2] add to those
/// without contact; linear, symmetric and positive definite on the forces of contacts.
using Mobility = std::function<std::vector<double>(std::span<const double> forces)>;

/// Largest number of contacts for which the matrix W is computed, by one product with the mobility
/// for each contact. Above it, products take place within conjugate gradients.
inline constexpr std::size_t kMostDenseContacts = 24;

/// Finds the impulses p of contacts with p >= gamma, D + h G v >= 0 where p = gamma, and
/// D + h G v = 0 where p > gamma, with v = free velocities + mobility(G^T p/h). This is the dual
/// problem (5.4) of docs/physics.md with W = G mobility G^T in place of h G M^-1 G^T.
///
/// Few contacts: W is assembled, and Newton's method on the set of contacts with p > gamma solves
/// (dense_contact_problem.hpp). Many contacts: the solver of the projection, MPRGP, with products
/// by the mobility (mobility_graph.hpp).
class ContactProblem {
 public:
  /// `free_velocities` [L/T] are those without contact, and h > 0 [T] is the time step. `settings`
  /// and `mean_radius` > 0 [L] say when the problem is solved. The mobility is linear and symmetric
  /// but for the relative error `mobility_error` >= 0. The arguments must outlive the object.
  ContactProblem(std::span<const double> free_velocities, double h, const Mobility& mobility,
                 MotionLayout layout, const SolverSettings& settings, double mean_radius,
                 double mobility_error);

  /// Adds a contact, whose `impulse` is a first guess. Contacts of which the mobility moves neither
  /// particle must not be added.
  void add(const FluidContact& contact) { contacts_.push_back(contact); }

  /// Finds the impulses and the `w` of all contacts. Further contacts may be added after it, and
  /// their solution begins at the impulses found. A rough solution serves only to see which other
  /// contacts take part, and saves products where there are many. Returns whether the residuals of
  /// all contacts reached the tolerances (of a rough solution, the wide ones). May throw what the
  /// mobility throws.
  [[nodiscard]] bool solve(bool is_rough);

  /// All contacts, in the order in which they were added, with the impulses of the last solve().
  const std::vector<FluidContact>& contacts() const { return contacts_; }
  /// Velocities of the particles with the impulses found [L/T, 1/T].
  const std::vector<double>& velocities() const { return velocities_; }
  /// Sums of the contact forces p/h on each particle [M L/T^2].
  std::vector<double> loads() const;
  /// Number of products with the mobility and of steps without such a product.
  int iterations() const { return iterations_; }
  /// True if the last solution was rough.
  bool is_rough() const { return is_rough_; }

 private:
  /// Both improve the impulses until the residuals are `allowed` [L].
  void solve_dense(std::span<const double> allowed);
  void solve_by_products(std::span<const double> allowed);
  double b(std::size_t c) const;

  std::span<const double> free_velocities_;
  double h_;
  const Mobility& mobility_;
  MotionLayout layout_;
  const SolverSettings& settings_;
  double mean_radius_, mobility_error_;
  std::vector<FluidContact> contacts_;
  std::vector<std::vector<double>> responses_;  // to a unit force of each contact [T/M]
  std::vector<double> velocities_;
  int iterations_ = 0;
  bool is_rough_ = false;
};

}  // namespace viscontact::particles
