// The instantaneous problem (9.1): velocities and stress at one arrangement of the spheres.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "viscontact/suspensions/linear/conjugate_gradients.hpp"
#include "viscontact/suspensions/pairs/pair_system.hpp"
#include "viscontact/suspensions/values/stress.hpp"

namespace viscontact::suspensions {

struct InstantProblem {
  const PairSystem* system = nullptr;
  SymmetricTensor strain;  ///< E of the flow of rate 1 [1/T]
  double viscosity = 0, volume = 0;
  std::vector<Motion> loads;       ///< forces and torques on the spheres
  SymmetricTensor load_stress{};   ///< of the forces of pairs among them
  std::optional<double> stress{};  ///< sigma_xy; without it the rate is 1
  /// What the softest motion resists over what a sphere resists beside others that are at rest [1]:
  /// the factor by which residuals must be smaller than errors.
  double least_resistance = 1;
  ThreadPool* pool = nullptr;
};

struct InstantSolution {
  std::vector<Motion> motions;  ///< relative to the flow
  double rate = 1;              ///< factor on the strain
  int iterations = 0;
  bool converged = true;
};

/// `start` are motions near the solution. The error of the power is about the square of `tolerance`
/// times the dissipation.
InstantSolution solve_instant(const InstantProblem& problem, std::vector<Motion> start,
                              double tolerance);

}  // namespace viscontact::suspensions
