// Chooses the contacts of a step in a fluid and finds their impulses, docs/physics.md (6.4). Units
// are those of the case.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/fluid/contact/contact_problem.hpp"
#include "viscontact/particles/fluid/contact/fluid_contacts.hpp"

namespace viscontact::particles {

/// What the contacts of a step depend on.
struct ContactConditions {
  double h = 0;                              ///< length of the step [T], > 0
  double threshold = 0;                      ///< D_c [L], >= 0
  std::span<const PlanePosition> obstacles;  ///< at the end of the step
  double mean_radius = 0;                    ///< [L], > 0
  double mobility_error = 0;                 ///< relative error of the mobility's answers, >= 0
  /// Tolerances, and the largest number of iterations.
  SolverSettings solver;
  /// True for particles that a contact force moves; pairs of others are left out.
  std::function<bool(std::int32_t k)> is_movable;
  /// True for two particles whose distance is given, so that no contact force changes it; such pairs
  /// are left out. May be empty.
  std::function<bool(std::int32_t first, std::int32_t second)> are_apart_by_arm{};
};

/// The contacts of a step, solved.
struct StepContacts {
  PairLists pairs;  ///< in reach of each other in this step, with their memory
  /// Of all pairs of particles, then of all particles at obstacles, in the order of `pairs`.
  /// Contacts that take no part have the impulse 0 and w = 0.
  std::vector<FluidContact> contacts;
  std::vector<double> loads;       ///< sums of contact forces on each particle [M L/T^2]
  std::vector<double> velocities;  ///< with the contact forces [L/T, 1/T]
  int iterations = 0;     ///< products with the mobility, and iterations of a dense problem
  bool is_solved = true;  ///< ContactProblem::solve() reached the tolerances
};

/// Finds the impulses of all contacts, such that no gap closes that was not among the contacts
/// either. `state` is that before the step, `free_velocities` are those without contact. Throws
/// what `mobility` throws.
StepContacts solve_contacts(const State& state, std::span<const double> free_velocities,
                            const Mobility& mobility, const ContactConditions& conditions,
                            ThreadPool& pool);

}  // namespace viscontact::particles
