// Conjugate gradients for the velocities of all spheres.
#pragma once

#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/suspensions/linear/block_preconditioner.hpp"
#include "viscontact/suspensions/pairs/resistance.hpp"
#include "viscontact/suspensions/values/lanes.hpp"

namespace viscontact::suspensions {

class ConjugateGradients {
 public:
  struct Result {
    int iterations = 0;
    double start = 0, residual = 0;  ///< r.M^-1 r, a power [M L^2/T^3]
    double curvature = 0;            ///< of the change c of the motions: c.R c
    bool converged = true;
    bool stagnates = false;  ///< rounding errors keep the residual from falling
  };
  /// A residual r.M^-1 r [M L^2/T^3] at which the iteration ends, and a part of that at its start.
  struct End {
    double residual = 0;
    double reduction = 0;
  };
  explicit ConjugateGradients(ThreadPool& pool) : pool_(&pool) {}
  /// Solves R motions = loads from the given motions on. Fixed bodies have motions and
  /// loads 0. The iteration also ends where rounding errors keep the residual from falling.
  Result solve(const Resistance& resistance, const BlockPreconditioner& preconditioner,
               std::span<const Motion> loads, std::span<Motion> motions, const End& end,
               int most_iterations);

 private:
  ThreadPool* pool_;
  std::vector<Motion> residual_, direction_, product_;
};

}  // namespace viscontact::suspensions
