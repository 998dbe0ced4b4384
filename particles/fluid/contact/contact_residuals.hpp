// When the impulses of contacts in a fluid are exact enough: residuals, and the impulses at work
// that they are compared with. Units are those of the case.
#pragma once

#include <span>
#include <vector>

#include "viscontact/particles/fluid/contact/fluid_contact.hpp"
#include "viscontact/particles/solver_settings.hpp"

namespace viscontact::particles {

/// |min(D + h G v, w (p - gamma))| [L] of a contact whose gap after the step is `gap_after` [L].
double contact_residual(const FluidContact& contact, double gap_after);

/// Limits of the residuals of contacts.
struct ContactTolerances {
  /// Impulses at work in each contact [M L/T]: of its two particles the smaller one of the largest
  /// impulse on each. The impulses on a particle are those of its contacts, and those that would
  /// stop the motion without contact that changes a gap.
  std::vector<double> at_work;
  /// Largest residual of each contact [L].
  std::vector<double> allowed;
};

/// Relative error of velocities that are sums of responses to forces. It limits how small residuals
/// can be.
inline constexpr double kErrorOfSums = 2e-11;

/// `free_velocities` are those without contact; all velocities have the relative error
/// `velocity_error`. Contacts with w = 0 take no part.
ContactTolerances contact_tolerances(std::span<const FluidContact> contacts,
                                     std::span<const double> free_velocities, double h,
                                     const MotionLayout& layout, const SolverSettings& settings,
                                     double mean_radius, double velocity_error);

/// The residuals of a step.
struct ContactResiduals {
  std::vector<double> impulse_errors;  ///< residual/w of each contact [M L/T]; 0 where w = 0
  double largest = 0;                  ///< [L]
  /// Largest impulse error divided by the impulses at work.
  double largest_relative = 0;
  double smallest_gap = 0;  ///< smallest D - D_c + h G v [L], at most 0
  bool converged = true;    ///< all residuals are allowed
};

/// Measures the residuals of the impulses of contacts in the velocities that the particles have
/// with them.
ContactResiduals measure_residuals(std::span<const FluidContact> contacts,
                                   std::span<const double> free_velocities,
                                   std::span<const double> velocities, double h,
                                   const MotionLayout& layout, const SolverSettings& settings,
                                   double mean_radius, double velocity_error);

}  // namespace viscontact::particles
