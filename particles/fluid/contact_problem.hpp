// The contact problem of a step in a fluid, docs/physics.md (6.4): impulses that keep gaps open, as
// forces on particles whose velocities depend linearly on forces. Units are those of the case.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "viscontact/particles/projection/solver_settings.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// Two particles, or a particle and an obstacle, whose gap may close in this step.
struct FluidContact {
  std::int32_t first = -1;  ///< number of a particle; -1: an obstacle
  std::int32_t second = 0;  ///< number of a particle
  Vector normal{};          ///< unit normal from first to second
  double gap = 0;           ///< D - D_c at the beginning of the step [L]
  double gamma = 0;         ///< [M L/T], <= 0: the impulse is at least this
  double impulse = 0;       ///< h lambda [M L/T]: before the solution a guess, then the solution
  double residual = 0;      ///< |min(D + h G v, w (p - gamma))| of the solution [L]
  double w = 0;             ///< change of the gap per impulse of this contact [T/M], > 0
};

/// Velocities [L/T, 1/T] of all particles that forces and torques [M L/T^2, M L^2/T^2] add to those
/// without contact; linear, symmetric and positive definite on the forces of contacts.
using Mobility = std::function<std::vector<double>(std::span<const double> forces)>;

/// Number of components of a contact's normal in the motions of particles, and the place of
/// component d of particle k in an array of motions.
struct MotionLayout {
  std::size_t components = 3;  ///< motion_components()
  std::size_t directions() const { return components == 1 ? 1 : 2; }
  std::size_t at(std::int32_t k, std::size_t d) const {
    return static_cast<std::size_t>(k) * components + d;
  }
};

/// G v: the velocity at which the gap opens [L/T].
double opening(const FluidContact& contact, std::span<const double> velocities,
               const MotionLayout& layout);

/// Adds G^T times `impulse` / `time` to forces: `impulse` pushes both particles apart.
void add_contact_force(const FluidContact& contact, double force, std::span<double> forces,
                       const MotionLayout& layout);

struct ContactSolution {
  int iterations = 0;  ///< number of products with the mobility and of sweeps
  bool converged = true;
};

/// Finds the impulses p of all contacts with p >= gamma, D + h G v >= 0 where p = gamma, and
/// D + h G v = 0 where p > gamma, v = `free_velocities` + mobility(G^T p/h). Then W = G mobility
/// G^T takes the place of h G M^-1 G^T in (5.4).
ContactSolution solve_contact_problem(std::span<FluidContact> contacts,
                                      std::span<const double> free_velocities, double h,
                                      const Mobility& mobility, const MotionLayout& layout,
                                      const SolverSettings& settings, double mean_radius);

}  // namespace viscontact::particles
